#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>

namespace eyrie {

/// What the ground, roofs and their marks are made of.
enum class Material {
    asphalt,
    worn_asphalt,
    concrete,
    paving,
    grass,
    field,
    soil,
    gravel,
    kerb,
    paint,  ///< road marking, worn in places
    tar,    ///< repaired cracks and patches
    stain,  ///< oil and rubber; darkens what lies below
    roof_gravel,
    roof_tiles,
    roof_metal,
    plain  ///< one even tone
};

/// A painted surface: a material and how it varies.
struct Surface {
    Material material = Material::asphalt;
    double tone = 1;              ///< multiplies the material's brightness
    double opacity = 1;           ///< 0 … 1
    cv::Point2d direction{1, 0};  ///< of slabs, furrows, tiles; unit vector
    cv::Vec3f tint{1, 1, 1};      ///< multiplies blue, green, red
    std::uint32_t seed = 1;
};

/// Colour (blue, green, red, 0 … 255 in full sunlight) of a surface at a ground point in metres.
cv::Vec3f colourOf(const Surface& surface, cv::Point2d point);

/// Share of what lies below that the surface hides at a point, 0 … 1.
float opacityOf(const Surface& surface, cv::Point2d point);

}  // namespace eyrie

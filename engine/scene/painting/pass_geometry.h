#pragma once

#include <array>
#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "scene/camera.h"
#include "scene/painting/ground_map.h"
#include "scene/painting/mesh.h"
#include "scene/scene_description.h"

/// A picture is the mean of several passes. Each pass looks through one point of every pixel at one moment of the
/// exposure; together they stand for the pixel's area, the lens blur and the motion blur.
namespace eyrie {

/// Value at pixel (x, y): a · x + b · y + c.
struct ScreenPlane {
    float a = 0, b = 0, c = 0;
    float at(float x, float y) const { return a * x + b * y + c; }
};

/// A flat face as it lies in the picture.
struct ScreenFace {
    int count = 0;
    std::array<cv::Point2f, 14> corners;
    ScreenPlane inverse_depth;
    /// Texture coordinate: `u_base` + depth · u (likewise v). In 1/256 map texels, except for facades: metres.
    ScreenPlane u, v;
    float u_base = 0, v_base = 0;
    Finish finish = Finish::matte;
    std::array<float, 3> sunny{};   ///< colour in the sun
    std::array<float, 3> shaded{};  ///< colour in the shade
    float storey = 3;
    std::uint32_t seed = 0;
};

/// A ball, such as a crown of a tree, as it lies in the picture, px.
struct ScreenBall {
    float x = 0, y = 0, radius = 0, inverse_depth = 0;
    std::uint32_t colour = 0;  ///< with `kShines` for lamps
};

/// Beside the colour of a pixel: a lamp is seen there.
constexpr std::uint32_t kShines = 1U << 24;

/// A dark area on the ground that moves with an object.
struct ScreenShadow {
    std::vector<cv::Point2f> corners;
    bool contact = false;  ///< below the body: skylight is missing, too
};

/// An area on the ground in the light of a headlight.
struct ScreenBeam {
    std::vector<cv::Point2f> corners;
    std::uint8_t light = 0;  ///< 255: as much as full sunlight
};

/// The light over a scene.
struct Light {
    cv::Point3d to_sun;  ///< unit vector; at night to the lamps overhead
    double ambient = 0.4;
    cv::Point2d shadow;         ///< m per metre of height
    cv::Vec3f direct{1, 1, 1};  ///< colour of what comes from the sun or, at night, from lamps
    bool night = false;
    double windows = 0;  ///< share of windows that are lit
    double sight = 0;    ///< m over which haze leaves 37 % of contrast; 0: clear air
    cv::Vec3f haze;      ///< its colour

    explicit Light(const SceneDescription& scene);
};

/// The picture is painted in tiles, so that the part of the ground map that a tile shows stays in the cache.
struct TileGrid {
    cv::Size image;
    int tile_width = 160;
    int tile_height = 96;

    int columns() const { return (image.width + tile_width - 1) / tile_width; }
    int rows() const { return (image.height + tile_height - 1) / tile_height; }
    int count() const { return columns() * rows(); }
    cv::Rect tile(int index) const;
};

/// What may touch a tile: positions in the lists of its pass.
struct TileContent {
    std::vector<int> faces, balls, shadows, beams;
};

/// One pass, ready to be painted.
struct PassGeometry {
    cv::Matx33d ground_from_image;  ///< pixel → m
    std::vector<ScreenFace> faces;
    std::vector<ScreenBall> balls;
    std::vector<ScreenShadow> shadows;
    std::vector<ScreenBeam> beams;
    ScreenPlane ground_inverse_depth;
    std::vector<TileContent> tiles;
};

/// Collects what one pass sees.
class PassBuilder {
 public:
    /// `offset`: where in (or around) its pixel the pass looks, px.
    PassBuilder(CameraPose camera, cv::Point2d offset, const TileGrid& grid, const Light& light, const GroundMap& map);

    void add(const Mesh& mesh);
    void add(const Face& face);
    /// A ball whose colour is that seen.
    void add(const Ball& ball, cv::Point3d shift = {0, 0, 0});
    void addShadow(const std::vector<cv::Point2d>& outline, bool contact);
    /// `light`: share of full sunlight.
    void addBeam(const std::vector<cv::Point2d>& outline, double light);
    /// Whether something that stands within `reach` of `centre` up to `height` can be in the picture.
    bool sees(cv::Point2d centre, double reach, double height) const;
    PassGeometry finish();

 private:
    struct Bounds {
        float left = 1e30F, right = -1e30F, top = 1e30F, bottom = -1e30F;
        void hold(cv::Point2f point);
    };
    ScreenPlane planeOf(cv::Vec3d in_camera) const;
    std::vector<cv::Point2f> onScreen(const std::vector<cv::Point2d>& outline, Bounds& bounds) const;
    bool inPicture(const Bounds& bounds) const;
    /// Enters a thing into the tiles it may touch.
    void enter(const Bounds& bounds, std::vector<int> TileContent::*list, std::size_t position);

    CameraPose camera_;
    TileGrid grid_;
    const Light& light_;
    const GroundMap& map_;
    cv::Matx33d image_from_ground_;
    PassGeometry pass_;
};

}  // namespace eyrie

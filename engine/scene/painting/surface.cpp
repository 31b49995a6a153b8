#include "scene/painting/surface.h"

#include <algorithm>
#include <cmath>

#include "scene/random.h"

namespace eyrie {
namespace {

/// 1 on the joints of a grid of slabs, fading over `softness` metres.
float jointsOf(double along, double across, double length, double width, double softness) {
    const double a = std::abs(along / length - std::floor(along / length + 0.5)) * length;
    const double b = std::abs(across / width - std::floor(across / width + 0.5)) * width;
    return static_cast<float>(std::clamp(1 - std::min(a, b) / softness, 0.0, 1.0));
}

float slabTone(double along, double across, double length, double width, std::uint32_t seed) {
    const auto column = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(along / length + 0.5)));
    const auto row = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(across / width + 0.5)));
    return static_cast<float>(hashOf(column, row, seed) >> 8) * (2.0F / 16777215.0F) - 1.0F;
}

}  // namespace

cv::Vec3f colourOf(const Surface& surface, cv::Point2d p) {
    const std::uint32_t seed = surface.seed;
    const double along = p.x * surface.direction.x + p.y * surface.direction.y;
    const double across = -p.x * surface.direction.y + p.y * surface.direction.x;
    cv::Vec3f base(128, 128, 128);
    float factor = 1;
    const auto broad = [&](double wavelength, int octaves) {
        return fractalNoise(p.x / wavelength, p.y / wavelength, seed, octaves);
    };
    switch (surface.material) {
        case Material::asphalt:
            base = {101, 99, 97};
            // Long streaks along the road: wear of the wheels and seams of the paver.
            factor = 1 + 0.14F * broad(22, 4) + 0.07F * broad(0.5, 2) +
                     0.09F * fractalNoise(along / 30, across / 0.9, seed + 7, 2);
            break;
        case Material::worn_asphalt:
            base = {124, 124, 123};
            factor = 1 + 0.16F * broad(9, 5) + 0.10F * broad(0.5, 2) +
                     0.06F * fractalNoise(along / 18, across / 0.8, seed + 7, 2);
            break;
        case Material::concrete:
            base = {150, 156, 158};
            factor = 1 + 0.07F * slabTone(along, across, 7.5, 7.5, seed) + 0.09F * broad(12, 5) +
                     0.05F * broad(0.45, 2) - 0.28F * jointsOf(along, across, 7.5, 7.5, 0.12);
            break;
        case Material::paving:
            base = {142, 148, 152};
            factor = 1 + 0.09F * slabTone(along, across, 1.0, 0.75, seed) + 0.12F * broad(7, 4) -
                     0.15F * jointsOf(along, across, 1.0, 0.75, 0.1);
            break;
        case Material::grass: {
            const float dry = std::clamp(0.45F + 0.6F * broad(17, 4), 0.0F, 1.0F);
            base = cv::Vec3f(52, 92, 74) * (1 - dry) + cv::Vec3f(78, 122, 118) * dry;
            factor = 1 + 0.22F * broad(2.2, 3) + 0.22F * fractalNoise(p.x / 0.45, p.y / 0.45, seed + 3, 2);
            break;
        }
        case Material::field: {
            base = {86, 128, 132};
            factor = 1 + 0.10F * broad(30, 4) + 0.08F * broad(0.6, 2) +
                     0.13F * valueNoise(along / 14, across / 0.8, seed + 5) +
                     0.06F * valueNoise(along / 60, across / 6, seed + 6);
            break;
        }
        case Material::soil:
            base = {92, 116, 136};
            factor = 1 + 0.2F * broad(6, 5) + 0.13F * broad(0.5, 2);
            break;
        case Material::gravel:
            base = {132, 142, 148};
            factor = 1 + 0.10F * broad(5, 4) + 0.13F * broad(0.4, 1);
            break;
        case Material::kerb:
            base = {165, 168, 170};
            factor = 1 + 0.1F * slabTone(along, 0, 1, 1, seed) + 0.08F * broad(3, 2);
            break;
        case Material::paint:
            base = {212, 216, 217};
            factor = 1 + 0.10F * broad(1.4, 3);
            break;
        case Material::tar:
            base = {74, 72, 70};
            factor = 1 + 0.08F * broad(1, 2);
            break;
        case Material::stain:
            base = {58, 57, 56};
            break;
        case Material::roof_gravel:
            base = {140, 145, 147};
            factor = 1 + 0.13F * broad(5, 4) + 0.09F * broad(0.4, 1);
            break;
        case Material::roof_tiles: {
            base = {78, 88, 134};
            const double course = across / 0.42;
            const auto shade = static_cast<float>(course - std::floor(course));
            factor = 1 + 0.12F * broad(4, 4) + 0.10F * slabTone(along, across, 0.5, 0.42, seed) - 0.16F * shade;
            break;
        }
        case Material::roof_metal: {
            base = {160, 160, 156};
            const double rib = along / 1.1;
            factor = 1 + 0.06F * broad(6, 3) + (rib - std::floor(rib) < 0.22 ? -0.16F : 0.0F);
            break;
        }
        case Material::plain:
            base = {128, 128, 128};
            break;
    }
    factor *= static_cast<float>(surface.tone);
    for (int channel = 0; channel < 3; ++channel) {
        base[channel] = std::clamp(base[channel] * surface.tint[channel] * factor, 0.0F, 255.0F);
    }
    return base;
}

float opacityOf(const Surface& surface, cv::Point2d p) {
    auto opacity = static_cast<float>(surface.opacity);
    if (surface.material == Material::paint) {
        const float worn = fractalNoise(p.x / 0.7, p.y / 0.7, surface.seed + 11, 3) +
                           0.6F * fractalNoise(p.x / 9, p.y / 9, surface.seed + 12, 2);
        opacity *= std::clamp(0.92F - 1.1F * std::max(0.0F, worn - 0.05F), 0.1F, 1.0F);
    } else if (surface.material == Material::stain) {
        opacity *= std::clamp(0.55F + 0.9F * fractalNoise(p.x / 2.5, p.y / 2.5, surface.seed + 13, 3), 0.0F, 1.0F);
    }
    return opacity;
}

}  // namespace eyrie

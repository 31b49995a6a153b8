#include "scene/painting/tile_painter.h"

#include <algorithm>
#include <cmath>

#include "scene/portable_math.h"
#include "scene/random.h"

namespace eyrie {
namespace {

std::uint32_t packed(float blue, float green, float red) {
    const auto byte = [](float value) { return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 255.0F)); };
    return byte(blue) | (byte(green) << 8) | (byte(red) << 16);
}

constexpr std::uint8_t kNoSun = 1;
constexpr std::uint8_t kContact = 2;

/// A range of rows or columns, inclusive; empty when first > last.
struct Span {
    int first, last;
};

/// Columns of a convex polygon in row y.
template <class Corners>
Span columnsInRow(const Corners& corners, std::size_t count, int y, const cv::Rect& tile) {
    float left = 1e30F;
    float right = -1e30F;
    const auto row = static_cast<float>(y);
    for (std::size_t i = 0; i < count; ++i) {
        const cv::Point2f& a = corners[i];
        const cv::Point2f& b = corners[i + 1 == count ? 0 : i + 1];
        if ((a.y <= row) == (b.y <= row)) continue;
        const float x = a.x + (row - a.y) / (b.y - a.y) * (b.x - a.x);
        left = std::min(left, x);
        right = std::max(right, x);
    }
    if (right < left) return {1, 0};
    const auto low = static_cast<float>(tile.x - 1);
    const auto high = static_cast<float>(tile.x + tile.width);
    return {std::max(tile.x, static_cast<int>(std::ceil(std::clamp(left, low, high)))),
            std::min(tile.x + tile.width, static_cast<int>(std::ceil(std::clamp(right, low, high)))) - 1};
}

template <class Corners>
Span rowsOf(const Corners& corners, std::size_t count, const cv::Rect& tile) {
    float top = 1e30F;
    float bottom = -1e30F;
    for (std::size_t i = 0; i < count; ++i) {
        top = std::min(top, corners[i].y);
        bottom = std::max(bottom, corners[i].y);
    }
    const auto low = static_cast<float>(tile.y - 1);
    const auto high = static_cast<float>(tile.y + tile.height);
    return {std::max(tile.y, static_cast<int>(std::ceil(std::clamp(top, low, high)))),
            std::min(tile.y + tile.height, static_cast<int>(std::ceil(std::clamp(bottom, low, high)))) - 1};
}

/// Window panes on a wall, `along` and `up` in metres.
bool isWindow(float along, float up, float storey) {
    if (up < 0.9F) return false;
    const float bay = along / 2.4F;
    const float level = up / storey;
    const float in_bay = bay - std::floor(bay);
    const float in_level = level - std::floor(level);
    return in_bay > 0.25F && in_bay < 0.75F && in_level > 0.3F && in_level < 0.82F;
}

}  // namespace

TilePainter::TilePainter(cv::Rect tile, int index)
    : tile_(tile),
      index_(static_cast<std::size_t>(index)),
      pixels_(static_cast<std::size_t>(tile.area())),
      inverse_depth_(pixels_.size()),
      shadow_(pixels_.size()),
      sums_(pixels_.size() * 3) {}

void TilePainter::add(const PassGeometry& pass, const GroundMap& map, const Light& light) {
    std::fill(inverse_depth_.begin(), inverse_depth_.end(), 0.0F);
    std::fill(shadow_.begin(), shadow_.end(), std::uint8_t{0});
    const TileContent& content = pass.tiles[index_];
    for (const int i : content.faces) paintFace(pass.faces[static_cast<std::size_t>(i)], map, light);
    for (const int i : content.balls) paintBall(pass.balls[static_cast<std::size_t>(i)]);
    for (const int i : content.shadows) markShadow(pass.shadows[static_cast<std::size_t>(i)]);
    if (light.night) {
        beam_.assign(pixels_.size(), std::uint8_t{0});
        for (const int i : content.beams) markBeam(pass.beams[static_cast<std::size_t>(i)]);
    }
    fillGround(pass, map, light);
    if (light.sight > 0) veil(pass, light);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const std::uint32_t pixel = pixels_[i];
        sums_[3 * i] += pixel & 255;
        sums_[3 * i + 1] += (pixel >> 8) & 255;
        sums_[3 * i + 2] += (pixel >> 16) & 255;
    }
    if (!light.night) return;
    lamp_sums_.resize(sums_.size());
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const std::uint32_t pixel = pixels_[i];
        if ((pixel & kShines) == 0) continue;
        lamp_sums_[3 * i] += pixel & 255;
        lamp_sums_[3 * i + 1] += (pixel >> 8) & 255;
        lamp_sums_[3 * i + 2] += (pixel >> 16) & 255;
    }
}

void TilePainter::markBeam(const ScreenBeam& beam) {
    const Span rows = rowsOf(beam.corners, beam.corners.size(), tile_);
    for (int y = rows.first; y <= rows.last; ++y) {
        const Span columns = columnsInRow(beam.corners, beam.corners.size(), y, tile_);
        for (int x = columns.first; x <= columns.last; ++x) {
            std::uint8_t& light = beam_[indexOf(x, y)];
            light = static_cast<std::uint8_t>(std::min(255, light + beam.light));
        }
    }
}

void TilePainter::veil(const PassGeometry& pass, const Light& light) {
    // What is left of the contrast after so many 1/64 of the sight, of 256.
    std::array<std::uint32_t, 512> left{};
    for (std::size_t i = 0; i < left.size(); ++i) {
        left[i] = static_cast<std::uint32_t>(256 * portable::exponential(-static_cast<double>(i) / 64) + 0.5);
    }
    const auto per_metre = static_cast<float>(64 / light.sight);
    std::array<std::uint32_t, 3> haze{};
    for (std::size_t c = 0; c < 3; ++c) haze[c] = static_cast<std::uint32_t>(light.haze[static_cast<int>(c)]);
    for (int row = 0; row < tile_.height; ++row) {
        for (int column = 0; column < tile_.width; ++column) {
            const int x = tile_.x + column;
            const int y = tile_.y + row;
            const std::size_t place = indexOf(x, y);
            float inverse = inverse_depth_[place];
            if (!(inverse > 0)) inverse = pass.ground_inverse_depth.at(static_cast<float>(x), static_cast<float>(y));
            const float away = std::clamp(per_metre / std::max(inverse, 1e-6F), 0.0F, 511.0F);
            const std::uint32_t share = left[static_cast<std::size_t>(away)];
            std::uint32_t& pixel = pixels_[place];
            std::uint32_t veiled = pixel & kShines;
            for (std::size_t c = 0; c < 3; ++c) {
                const std::uint32_t value = (pixel >> (8 * c)) & 255;
                veiled |= ((value * share + haze[c] * (256 - share)) >> 8) << (8 * c);
            }
            pixel = veiled;
        }
    }
}

void TilePainter::markShadow(const ScreenShadow& shadow) {
    const Span rows = rowsOf(shadow.corners, shadow.corners.size(), tile_);
    const std::uint8_t mark = shadow.contact ? kContact : kNoSun;
    for (int y = rows.first; y <= rows.last; ++y) {
        const Span columns = columnsInRow(shadow.corners, shadow.corners.size(), y, tile_);
        for (int x = columns.first; x <= columns.last; ++x) shadow_[indexOf(x, y)] |= mark;
    }
}

std::uint32_t TilePainter::groundLit(std::uint32_t texel, std::size_t place, const Light& light) const {
    const auto base = static_cast<std::uint32_t>(light.ambient * 65536);
    const auto direct = static_cast<std::uint32_t>((1 - light.ambient) * 65536 / 255);
    if (!light.night) {
        std::uint32_t sum = shadow_[place] == 0 ? base + direct * (texel >> 24) : base;
        if (shadow_[place] & kContact) sum /= 2;
        return (((texel & 255) * sum) >> 16) | ((((texel >> 8) & 255) * sum >> 16) << 8) |
               ((((texel >> 16) & 255) * sum >> 16) << 16);
    }
    // Headlights are white; lamps have their tint.
    const std::uint32_t white = base + 257U * beam_[place];
    std::uint32_t colour = 0;
    for (int c = 0; c < 3; ++c) {
        const auto tinted = static_cast<std::uint32_t>(static_cast<float>(direct * (texel >> 24)) * light.direct[c]);
        const std::uint32_t sum = (shadow_[place] & kContact) ? white / 2 : white + tinted;
        colour |= std::min(255U, ((texel >> (8 * c)) & 255) * sum >> 16) << (8 * c);
    }
    return colour;
}

void TilePainter::fillGround(const PassGeometry& pass, const GroundMap& map, const Light& light) {
    const double per_metre = 256 / map.texel();
    const cv::Matx33d& g = pass.ground_from_image;
    for (int row = 0; row < tile_.height; ++row) {
        const double y = tile_.y + row;
        const double wb = g(2, 1) * y + g(2, 2);
        const double xa = g(0, 0) - map.origin().x * g(2, 0);
        const double xb = g(0, 1) * y + g(0, 2) - map.origin().x * wb;
        const double ya = g(1, 0) - map.origin().y * g(2, 0);
        const double yb = g(1, 1) * y + g(1, 2) - map.origin().y * wb;
        for (int column = 0; column < tile_.width; ++column) {
            const std::size_t place = indexOf(tile_.x + column, tile_.y + row);
            if (inverse_depth_[place] > 0) continue;
            const double x = tile_.x + column;
            const double scale = per_metre / (g(2, 0) * x + wb);
            const std::uint32_t texel = map.sample(static_cast<std::int32_t>((xa * x + xb) * scale),
                                                   static_cast<std::int32_t>((ya * x + yb) * scale));
            pixels_[place] = groundLit(texel, place, light);
        }
    }
}

std::uint32_t TilePainter::facadeAt(const ScreenFace& face, float u, float v, const Light& light) {
    const bool window = isWindow(u, v, face.storey);
    if (!light.night) {
        const float tone = window ? 0.38F : 1.0F;
        return packed(face.sunny[0] * tone, face.sunny[1] * tone, face.sunny[2] * tone);
    }
    const auto bay = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(u / 2.4F)));
    const auto level = static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(v / face.storey)));
    const std::uint32_t dice = hashOf(bay, level, face.seed);
    if (window && (dice >> 16) < light.windows * 65536) {
        const float glow = 70 + static_cast<float>(dice & 127);
        return (dice & 3) != 0 ? packed(glow * 0.55F, glow * 0.85F, glow) : packed(glow, glow * 0.95F, glow * 0.8F);
    }
    // The light of the street reaches the lower storeys.
    const float low = 1 / (1 + v * v / 36);
    const float tone = window ? 0.3F : 1.0F;
    std::array<float, 3> colour{};
    for (std::size_t c = 0; c < 3; ++c) colour[c] = face.shaded[c] + (face.sunny[c] - face.shaded[c]) * low;
    return packed(colour[0] * tone, colour[1] * tone, colour[2] * tone);
}

void TilePainter::paintFace(const ScreenFace& face, const GroundMap& map, const Light& light) {
    const auto count = static_cast<std::size_t>(face.count);
    const Span rows = rowsOf(face.corners, count, tile_);
    for (int y = rows.first; y <= rows.last; ++y) {
        const Span columns = columnsInRow(face.corners, count, y, tile_);
        const auto fy = static_cast<float>(y);
        for (int x = columns.first; x <= columns.last; ++x) {
            const auto fx = static_cast<float>(x);
            const float inverse = face.inverse_depth.at(fx, fy);
            float& nearest = inverse_depth_[indexOf(x, y)];
            if (!(inverse > nearest)) continue;
            nearest = inverse;
            const float depth = 1 / inverse;
            const float u = face.u_base + depth * face.u.at(fx, fy);
            const float v = face.v_base + depth * face.v.at(fx, fy);
            std::uint32_t& pixel = pixels_[indexOf(x, y)];
            if (face.finish == Finish::facade) {
                pixel = facadeAt(face, u, v, light);
                continue;
            }
            const std::uint32_t below = map.sample(static_cast<std::int32_t>(u), static_cast<std::int32_t>(v));
            const float sun = static_cast<float>(below >> 24) * (1.0F / 255);
            std::array<float, 3> colour{};
            for (std::size_t c = 0; c < 3; ++c) colour[c] = face.shaded[c] + (face.sunny[c] - face.shaded[c]) * sun;
            if (face.finish == Finish::map_roof) {
                for (std::size_t c = 0; c < 3; ++c) colour[c] *= static_cast<float>((below >> (8 * c)) & 255);
            }
            pixel = packed(colour[0], colour[1], colour[2]);
            if (light.night && face.finish == Finish::lamp) pixel |= kShines;
        }
    }
}

void TilePainter::paintBall(const ScreenBall& ball) {
    const int top = std::max(tile_.y, static_cast<int>(std::ceil(ball.y - ball.radius)));
    const int bottom = std::min(tile_.y + tile_.height - 1, static_cast<int>(std::floor(ball.y + ball.radius)));
    for (int y = top; y <= bottom; ++y) {
        const float dy = static_cast<float>(y) - ball.y;
        const float half = std::sqrt(std::max(0.0F, ball.radius * ball.radius - dy * dy));
        const int first = std::max(tile_.x, static_cast<int>(std::ceil(ball.x - half)));
        const int last = std::min(tile_.x + tile_.width - 1, static_cast<int>(std::floor(ball.x + half)));
        for (int x = first; x <= last; ++x) {
            float& nearest = inverse_depth_[indexOf(x, y)];
            if (!(ball.inverse_depth > nearest)) continue;
            nearest = ball.inverse_depth;
            pixels_[indexOf(x, y)] = ball.colour;
        }
    }
}

}  // namespace eyrie

#include "scene/painting/tile_painter.h"

#include <algorithm>
#include <cmath>

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

void TilePainter::add(const PassGeometry& pass, const GroundMap& map, double ambient) {
    std::fill(inverse_depth_.begin(), inverse_depth_.end(), 0.0F);
    std::fill(shadow_.begin(), shadow_.end(), std::uint8_t{0});
    const TileContent& content = pass.tiles[index_];
    for (const int i : content.faces) paintFace(pass.faces[static_cast<std::size_t>(i)], map);
    for (const int i : content.balls) paintBall(pass.balls[static_cast<std::size_t>(i)]);
    for (const int i : content.shadows) markShadow(pass.shadows[static_cast<std::size_t>(i)]);
    fillGround(pass, map, ambient);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const std::uint32_t pixel = pixels_[i];
        sums_[3 * i] += pixel & 255;
        sums_[3 * i + 1] += (pixel >> 8) & 255;
        sums_[3 * i + 2] += (pixel >> 16) & 255;
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

void TilePainter::fillGround(const PassGeometry& pass, const GroundMap& map, double ambient) {
    const double per_metre = 256 / map.texel();
    const auto base = static_cast<std::uint32_t>(ambient * 65536);
    const auto direct = static_cast<std::uint32_t>((1 - ambient) * 65536 / 255);
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
            std::uint32_t light = shadow_[place] == 0 ? base + direct * (texel >> 24) : base;
            if (shadow_[place] & kContact) light /= 2;
            pixels_[place] = (((texel & 255) * light) >> 16) | ((((texel >> 8) & 255) * light >> 16) << 8) |
                             ((((texel >> 16) & 255) * light >> 16) << 16);
        }
    }
}

void TilePainter::paintFace(const ScreenFace& face, const GroundMap& map) {
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
                const float tone = isWindow(u, v, face.storey) ? 0.38F : 1.0F;
                pixel = packed(face.sunny[0] * tone, face.sunny[1] * tone, face.sunny[2] * tone);
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

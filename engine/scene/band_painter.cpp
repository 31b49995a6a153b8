#include "scene/band_painter.h"

#include <algorithm>
#include <cmath>


namespace eyrie {
namespace {

std::uint32_t packed(float blue, float green, float red) {
    const auto byte = [](float value) { return static_cast<std::uint32_t>(std::clamp(value, 0.0F, 255.0F)); };
    return byte(blue) | (byte(green) << 8) | (byte(red) << 16);
}

/// First and last pixel of a convex polygon in row y; empty when first > last.
template <class Corners>
void spanInRow(const Corners& corners, std::size_t count, int y, int width, int& first, int& last) {
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
    if (right < left) {
        first = 1;
        last = 0;
        return;
    }
    first = std::max(0, static_cast<int>(std::ceil(left)));
    last = std::min(width - 1, static_cast<int>(std::ceil(right)) - 1);
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

BandPainter::BandPainter(int width, int first_row, int rows)
    : width_(width),
      first_row_(first_row),
      rows_(rows),
      pixels_(static_cast<std::size_t>(width) * static_cast<std::size_t>(rows)),
      inverse_depth_(pixels_.size()),
      sums_(pixels_.size() * 3) {}

void BandPainter::add(const PassGeometry& pass, const GroundMap& map, double ambient) {
    paintGround(pass, map);
    for (const ScreenShadow& shadow : pass.shadows) paintShadow(shadow);
    lightGround(ambient);
    std::fill(inverse_depth_.begin(), inverse_depth_.end(), 0.0F);
    for (const ScreenFace& face : pass.faces) paintFace(face, map);
    for (const ScreenBall& ball : pass.balls) paintBall(ball);
    for (std::size_t i = 0; i < pixels_.size(); ++i) {
        const std::uint32_t pixel = pixels_[i];
        sums_[3 * i] += pixel & 255;
        sums_[3 * i + 1] += (pixel >> 8) & 255;
        sums_[3 * i + 2] += (pixel >> 16) & 255;
    }
}

void BandPainter::paintGround(const PassGeometry& pass, const GroundMap& map) {
    const double per_metre = 256 / map.texel();
    const cv::Matx33d& g = pass.ground_from_image;
    std::vector<std::int32_t> u(static_cast<std::size_t>(width_));
    std::vector<std::int32_t> v(u.size());
    for (int row = 0; row < rows_; ++row) {
        const double y = first_row_ + row;
        const double xa = g(0, 0) - map.origin().x * g(2, 0);
        const double xb = g(0, 1) * y + g(0, 2) - map.origin().x * (g(2, 1) * y + g(2, 2));
        const double ya = g(1, 0) - map.origin().y * g(2, 0);
        const double yb = g(1, 1) * y + g(1, 2) - map.origin().y * (g(2, 1) * y + g(2, 2));
        const double wb = g(2, 1) * y + g(2, 2);
        for (int x = 0; x < width_; ++x) {
            const double scale = per_metre / (g(2, 0) * x + wb);
            u[static_cast<std::size_t>(x)] = static_cast<std::int32_t>((xa * x + xb) * scale);
            v[static_cast<std::size_t>(x)] = static_cast<std::int32_t>((ya * x + yb) * scale);
        }
        std::uint32_t* pixels = pixels_.data() + static_cast<std::size_t>(row) * u.size();
        for (std::size_t x = 0; x < u.size(); ++x) pixels[x] = map.sample(u[x], v[x]);
    }
}

void BandPainter::paintShadow(const ScreenShadow& shadow) {
    const int bottom = std::min(shadow.bottom, first_row_ + rows_ - 1);
    for (int y = std::max(shadow.top, first_row_); y <= bottom; ++y) {
        int first = 0;
        int last = -1;
        spanInRow(shadow.corners, shadow.corners.size(), y, width_, first, last);
        std::uint32_t* row = pixels_.data() + static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_);
        for (int x = first; x <= last; ++x) {
            row[x] &= 0x00FFFFFFU;
            if (shadow.contact) row[x] = (row[x] >> 1) & 0x007F7F7FU;
        }
    }
}

void BandPainter::lightGround(double ambient) {
    const auto base = static_cast<std::uint32_t>(ambient * 65536);
    const auto direct = static_cast<std::uint32_t>((1 - ambient) * 65536 / 255);
    for (std::uint32_t& pixel : pixels_) {
        const std::uint32_t light = base + direct * (pixel >> 24);
        pixel = (((pixel & 255) * light) >> 16) | ((((pixel >> 8) & 255) * light >> 16) << 8) |
                ((((pixel >> 16) & 255) * light >> 16) << 16);
    }
}

void BandPainter::paintFace(const ScreenFace& face, const GroundMap& map) {
    const int bottom = std::min(face.bottom, first_row_ + rows_ - 1);
    for (int y = std::max(face.top, first_row_); y <= bottom; ++y) {
        int first = 0;
        int last = -1;
        spanInRow(face.corners, static_cast<std::size_t>(face.count), y, width_, first, last);
        const std::size_t start = static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_);
        const auto fy = static_cast<float>(y);
        for (int x = first; x <= last; ++x) {
            const auto fx = static_cast<float>(x);
            const float inverse = face.inverse_depth.at(fx, fy);
            float& nearest = inverse_depth_[start + static_cast<std::size_t>(x)];
            if (!(inverse > nearest)) continue;
            nearest = inverse;
            const float depth = 1 / inverse;
            const float u = face.u_base + depth * face.u.at(fx, fy);
            const float v = face.v_base + depth * face.v.at(fx, fy);
            std::uint32_t& pixel = pixels_[start + static_cast<std::size_t>(x)];
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

void BandPainter::paintBall(const ScreenBall& ball) {
    const int top = std::max(first_row_, static_cast<int>(std::ceil(ball.y - ball.radius)));
    const int bottom = std::min(first_row_ + rows_ - 1, static_cast<int>(std::floor(ball.y + ball.radius)));
    for (int y = top; y <= bottom; ++y) {
        const float dy = static_cast<float>(y) - ball.y;
        const float half = std::sqrt(std::max(0.0F, ball.radius * ball.radius - dy * dy));
        const int first = std::max(0, static_cast<int>(std::ceil(ball.x - half)));
        const int last = std::min(width_ - 1, static_cast<int>(std::floor(ball.x + half)));
        const std::size_t start = static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_);
        for (int x = first; x <= last; ++x) {
            float& nearest = inverse_depth_[start + static_cast<std::size_t>(x)];
            if (!(ball.inverse_depth > nearest)) continue;
            nearest = ball.inverse_depth;
            pixels_[start + static_cast<std::size_t>(x)] = ball.colour;
        }
    }
}

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "scene/scene_description.h"

namespace eyrie {

/// Everything that lies flat and stands still, seen straight from above: colours in full sunlight (blue, green, red in
/// the three low bytes) and the share of sunlight that arrives (high byte). Roofs are painted where their buildings
/// stand.
class GroundMap {
 public:
    /// Paints the scene's ground over `area` (m) with texels of this size (m).
    GroundMap(const SceneDescription& scene, cv::Rect2d area, double texel);

    /// Map coordinates of a ground point; integers are texel centres.
    cv::Point2d mapFromGround(cv::Point2d ground) const { return (ground - origin_) * (1 / texel_); }
    cv::Point2d origin() const { return origin_; }
    double texel() const { return texel_; }

    /// Bilinear sample at map coordinates given in 1/256 texels; beyond the edges the edge goes on.
    std::uint32_t sample(std::int32_t x256, std::int32_t y256) const {
        std::int32_t x = x256 >> 8;
        std::int32_t y = y256 >> 8;
        std::uint64_t fx = static_cast<std::uint64_t>(x256 & 255);
        std::uint64_t fy = static_cast<std::uint64_t>(y256 & 255);
        if (static_cast<std::uint32_t>(x) >= static_cast<std::uint32_t>(width_ - 1)) {
            fx = 0;
            x = x < 0 ? 0 : width_ - 2;
        }
        if (static_cast<std::uint32_t>(y) >= static_cast<std::uint32_t>(height_ - 1)) {
            fy = 0;
            y = y < 0 ? 0 : height_ - 2;
        }
        const std::uint32_t* top = texels_.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + x;
        const std::uint32_t* bottom = top + width_;
        const std::uint64_t a = blend(spread(top[0]), spread(top[1]), fx);
        const std::uint64_t b = blend(spread(bottom[0]), spread(bottom[1]), fx);
        const std::uint64_t mixed = blend(a, b, fy);
        const std::uint64_t low = mixed | (mixed >> 8);
        return static_cast<std::uint32_t>((low & 0xFFFF) | ((low >> 16) & 0xFFFF0000U));
    }
    /// Share of sunlight at a ground point, 0 … 255.
    int sunAt(std::int32_t x256, std::int32_t y256) const { return static_cast<int>(sample(x256, y256) >> 24); }

 private:
    /// Four bytes to four 16-bit lanes, so that one product weighs all channels.
    static std::uint64_t spread(std::uint32_t bytes) {
        const std::uint64_t halves = (static_cast<std::uint64_t>(bytes & 0xFFFF0000U) << 16) | (bytes & 0xFFFFU);
        return (halves | (halves << 8)) & 0x00FF00FF00FF00FFULL;
    }
    static std::uint64_t blend(std::uint64_t a, std::uint64_t b, std::uint64_t share) {
        return ((a * (256 - share) + b * share + 0x0080008000800080ULL) >> 8) & 0x00FF00FF00FF00FFULL;
    }

    /// One outline to be painted, in map coordinates.
    struct Job {
        std::vector<cv::Point2d> outline;
        double top = 0, bottom = 0;  ///< rows
        Surface surface;
        enum class Effect { paint, roof, shadow, lamp } effect = Effect::paint;
        cv::Point2d lamp;  ///< m: below the light
        double height = 0;
        double strength = 0;
    };
    Job job(const std::vector<cv::Point2d>& outline, const Surface& surface, Job::Effect effect) const;
    std::vector<Job> jobsOf(const SceneDescription& scene) const;
    void paintRows(const Surface& base, const std::vector<Job>& jobs, int begin, int end);
    void paint(const Job& job, cv::Rect bounds);
    void darken(const Job& job, cv::Rect bounds);
    void lighten(const Job& job, cv::Rect bounds);

    cv::Point2d origin_;  ///< ground point at the centre of texel (0, 0)
    double texel_;
    int width_ = 0;
    int height_ = 0;
    bool night_ = false;  ///< the high byte holds the light of lamps
    std::vector<std::uint32_t> texels_;
};

}  // namespace eyrie

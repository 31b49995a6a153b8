#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <vector>

#include "scene/painting/pass_geometry.h"

namespace eyrie {

/// Paints one tile of a picture, pass by pass, and adds the passes up. One per thread.
class TilePainter {
 public:
    /// `index`: the tile's number in the grid of the passes.
    TilePainter(cv::Rect tile, int index);

    void add(const PassGeometry& pass, const GroundMap& map, const Light& light);
    /// Sum over the passes, three channels a pixel, row by row.
    const std::vector<std::uint32_t>& sums() const { return sums_; }
    /// The same of lamps alone; empty by day.
    const std::vector<std::uint32_t>& lampSums() const { return lamp_sums_; }

 private:
    std::size_t indexOf(int x, int y) const {
        return static_cast<std::size_t>(y - tile_.y) * static_cast<std::size_t>(tile_.width) +
               static_cast<std::size_t>(x - tile_.x);
    }
    void markShadow(const ScreenShadow& shadow);
    /// Paints the ground wherever nothing stands before it.
    void fillGround(const PassGeometry& pass, const GroundMap& map, const Light& light);
    /// The colour of a texel of the ground in what light there is at a pixel.
    std::uint32_t groundLit(std::uint32_t texel, std::size_t place, const Light& light) const;
    void paintFace(const ScreenFace& face, const GroundMap& map, const Light& light);
    static std::uint32_t facadeAt(const ScreenFace& face, float u, float v, const Light& light);
    void markBeam(const ScreenBeam& beam);
    void veil(const PassGeometry& pass, const Light& light);
    void paintBall(const ScreenBall& ball);

    cv::Rect tile_;
    std::size_t index_;
    std::vector<std::uint32_t> pixels_;  ///< blue, green, red
    std::vector<float> inverse_depth_;   ///< 0: the ground
    std::vector<std::uint8_t> shadow_;   ///< where the ground lies in shadows that move
    std::vector<std::uint8_t> beam_;     ///< light of headlights on the ground; empty by day
    std::vector<std::uint32_t> sums_;
    std::vector<std::uint32_t> lamp_sums_;
};

}  // namespace eyrie

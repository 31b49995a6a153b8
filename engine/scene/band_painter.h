#pragma once

#include <cstdint>
#include <vector>

#include "scene/pass_geometry.h"

namespace eyrie {

/// Paints some rows of a picture, pass by pass, and adds the passes up. One per thread.
class BandPainter {
   public:
    /// Rows [first_row, first_row + rows) of an image this wide.
    BandPainter(int width, int first_row, int rows);

    void add(const PassGeometry& pass, const GroundMap& map, double ambient);
    /// Sum over the passes, three channels a pixel, row by row.
    const std::vector<std::uint32_t>& sums() const { return sums_; }

   private:
    void paintGround(const PassGeometry& pass, const GroundMap& map);
    void paintShadow(const ScreenShadow& shadow);
    void lightGround(double ambient);
    void paintFace(const ScreenFace& face, const GroundMap& map);
    void paintBall(const ScreenBall& ball);

    int width_;
    int first_row_;
    int rows_;
    std::vector<std::uint32_t> pixels_;  ///< blue, green, red, sunlight; later blue, green, red
    std::vector<float> inverse_depth_;   ///< 0: the ground
    std::vector<std::uint32_t> sums_;
};

}  // namespace eyrie

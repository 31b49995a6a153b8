#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// Where in the picture standing corners seem to move less than in the whole: a plain road is stiller than the relief
/// around it, and a slow vehicle on it can be told from the ground. Never the other way: what relief feigns is the
/// parallax test's to judge.
class NoiseMap {
 public:
    /// `cell`: side of a cell as a share of the picture's width; 0: the same noise everywhere.
    NoiseMap(cv::Size image, double cell);

    /// A standing corner at `position`, px, and its speed in multiples of the whole picture's usual one.
    void add(cv::Point2f position, double share);
    /// To be called between the last `add` and the first `at`.
    void finish();
    /// Noise in the cell here and those around it as a share of the whole picture's: 0.3 … 0.8, or 1 where it is hardly
    /// less or fewer than kEnoughCorners stand. `position`: px; outside the picture that of the nearest cell.
    double at(cv::Point2f position) const;

 private:
    cv::Point cellOf(cv::Point2f position) const;
    std::vector<float> sharesAround(cv::Point cell) const;
    std::size_t index(cv::Point cell) const { return static_cast<std::size_t>(cell.y * grid_.width + cell.x); }

    double cell_;    ///< px
    cv::Size grid_;  ///< cells; none where the noise is the same everywhere
    std::vector<std::vector<float>> shares_;
    std::vector<double> noise_;
};

}  // namespace eyrie

#pragma once

#include <algorithm>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

namespace eyrie {

/// Where the pixels of an area are found in another picture.
struct AreaMatch {
    cv::Point2d shift{0, 0};  ///< px, from the one picture to the other
    double correlation = -1;  ///< −1 … 1, normalised, over the area's pixels
};

/// Looks for the best correlation of `pixels` of the picture `from` in the picture `to` (both CV_8UC1) within `reach`
/// px around a shift by `around`, as far as the area stays in the picture with a pixel around it. To a fraction of a
/// pixel. Nothing where it does not stay inside at `around` itself, is plain, or has more than 65,000 pixels.
std::optional<AreaMatch> matchArea(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& to,
                                   cv::Point around, int reach);

/// Where an area went on to and where it came from.
struct AreaWay {
    AreaMatch on;    ///< into the later picture
    AreaMatch came;  ///< into the earlier one: about the opposite shift
    /// Of the poorer match.
    double correlation() const { return std::min(on.correlation, came.correlation); }
};

/// Looks for the shift, within `reach` px around `around`, by which `pixels` of the picture `from` went on into the
/// picture `later`, and by whose opposite they came from the picture `earlier`, but for a share `give` of it. Each of
/// the two alone would find something alike where little contrast is and much is in reach. All are CV_8UC1, the last
/// two of one size; the area stays in both with a pixel around it. Nothing where it does not at `around` itself, or is
/// plain or too large, as above, or where nothing is alike.
std::optional<AreaWay> matchWay(const std::vector<cv::Point>& pixels, const cv::Mat& from, const cv::Mat& later,
                                const cv::Mat& earlier, cv::Point around, int reach, double give);

}  // namespace eyrie

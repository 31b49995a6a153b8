#include "tracking/silhouettes/ground_contrast.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie {
namespace {

constexpr double kContrastShare = 0.1;  ///< of the ground's brightness, that a vehicle or shadow differs by, too
constexpr double kDarkestShadow = 0.25;
constexpr double kBrightestShadow = 0.85;  ///< shares of the ground's brightness between which it is in the shade
constexpr double kDarkGround = 60;         ///< grey values

}  // namespace

GroundMasks masksAgainst(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds,
                         const std::vector<cv::Mat>& unknown) {
    GroundMasks masks{cv::Mat(vehicle.size(), CV_8UC1, cv::Scalar(255)),
                      cv::Mat(vehicle.size(), CV_8UC1, cv::Scalar(255))};
    cv::Mat untold(vehicle.size(), CV_8UC1, cv::Scalar(255));
    for (std::size_t i = 0; i < grounds.size(); ++i) {
        for (int y = 0; y < vehicle.rows; ++y) {
            for (int x = 0; x < vehicle.cols; ++x) {
                if (!unknown.empty() && unknown[i].at<uchar>(y, x) != 0) continue;
                untold.at<uchar>(y, x) = 0;
                const double here = vehicle.at<uchar>(y, x);
                const double bare = grounds[i].at<uchar>(y, x);
                const double off = std::abs(here - bare);
                if (off <= kGroundContrast || off <= kContrastShare * bare) masks.differs.at<uchar>(y, x) = 0;
                const double share = here / std::max(1.0, bare);
                if (share <= kDarkestShadow || share >= kBrightestShadow) masks.shaded.at<uchar>(y, x) = 0;
            }
        }
    }
    masks.differs.setTo(0, untold);
    masks.shaded.setTo(0, untold);
    return masks;
}

bool allDark(const std::vector<cv::Mat>& grounds) {
    return std::all_of(grounds.begin(), grounds.end(),
                       [](const cv::Mat& ground) { return cv::mean(ground)[0] < kDarkGround; });
}

}  // namespace eyrie

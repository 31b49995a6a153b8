#include "registration/search/feature_search.h"

#include <algorithm>
#include <opencv2/features2d.hpp>
#include <vector>

namespace eyrie {
namespace {

constexpr int kShortestSide = 64;    ///< px; smaller pictures have no scale space to speak of
constexpr int kLongestSide = 1100;   ///< px of the level on which features are looked for
constexpr float kThreshold = 1e-4F;  ///< of AKAZE's response; a tenth of the usual, for night and haze
constexpr int kMostFeatures = 3000;  ///< the strongest of a picture
constexpr float kRatio = 0.85F;      ///< to the second best match
constexpr double kTolerancePx = 3;   ///< of a match that agrees, on its level
constexpr int kFewestAgreeing = 20;
constexpr double kFewestShare = 0.35;  ///< of the matches; by chance, or on one large vehicle, up to .33 were seen
constexpr double kMostSpreadPx = 2.5;  ///< deviation of those that agree, on their level

struct Features {
    std::vector<cv::KeyPoint> points;
    cv::Mat descriptors;
};

int levelFor(const ImagePyramid& pyramid) {
    int level = 0;
    while (level + 1 < pyramid.levels() &&
           std::max(pyramid.level(level).width(), pyramid.level(level).height()) > kLongestSide)
        ++level;
    return level;
}

Features featuresOf(const ImagePyramid& pyramid, int level, const PictureMask& graphics) {
    const PaddedPicture& picture = pyramid.level(level);
    // Only read; OpenCV knows no view of constant pixels.
    const cv::Mat gray(picture.height(), picture.width(), CV_8UC1, const_cast<std::uint8_t*>(picture.row(0)),
                       static_cast<std::size_t>(picture.stride()));
    const auto detector = cv::AKAZE::create(cv::AKAZE::DESCRIPTOR_MLDB, 0, 3, kThreshold, 3, 3);
    Features features;
    detector->detect(gray, features.points);
    std::erase_if(features.points,
                  [&](const cv::KeyPoint& point) { return graphics.marks(ImagePyramid::fromLevel(point.pt, level)); });
    cv::KeyPointsFilter::retainBest(features.points, kMostFeatures);
    detector->compute(gray, features.points, features.descriptors);
    return features;
}

/// Best matches that are mutual and clearly better than the second.
std::vector<cv::DMatch> matched(const Features& from, const Features& to) {
    const cv::BFMatcher matcher(cv::NORM_HAMMING);
    std::vector<std::vector<cv::DMatch>> on;
    std::vector<std::vector<cv::DMatch>> back;
    matcher.knnMatch(from.descriptors, to.descriptors, on, 2);
    matcher.knnMatch(to.descriptors, from.descriptors, back, 1);
    std::vector<cv::DMatch> matches;
    for (const auto& candidates : on) {
        if (candidates.size() < 2 || candidates[0].distance > kRatio * candidates[1].distance) continue;
        const auto& returned = back[static_cast<std::size_t>(candidates[0].trainIdx)];
        if (!returned.empty() && returned[0].trainIdx == candidates[0].queryIdx) matches.push_back(candidates[0]);
    }
    return matches;
}

}  // namespace

std::optional<HomographyFit> searchFeatures(const ImagePyramid& from, const ImagePyramid& to,
                                            const HomographyEstimator& between_frames, const PictureMask& graphics) {
    const int level = levelFor(from);
    const PaddedPicture& picture = from.level(level);
    if (std::min(picture.width(), picture.height()) < kShortestSide) return std::nullopt;
    const Features before = featuresOf(from, level, graphics);
    const Features now = featuresOf(to, level, graphics);
    if (before.points.size() < kFewestAgreeing || now.points.size() < kFewestAgreeing) return std::nullopt;
    Correspondences points;
    for (const cv::DMatch& match : matched(before, now)) {
        points.add(ImagePyramid::fromLevel(before.points[static_cast<std::size_t>(match.queryIdx)].pt, level),
                   ImagePyramid::fromLevel(now.points[static_cast<std::size_t>(match.trainIdx)].pt, level));
    }
    if (points.size() < kFewestAgreeing) return std::nullopt;
    const HomographyEstimator estimator = between_frames.anyPerspective();
    const double tolerance = kTolerancePx * double(1 << level);
    std::optional<HomographyFit> best;
    for (const MotionModel model : {MotionModel::similarity, MotionModel::homography}) {
        const auto sampled = estimator.search(points, model, tolerance);
        if (!sampled) continue;
        const auto fit = estimator.refine(points, *sampled, 2.0 * double(1 << level), 2 * tolerance);
        if (!fit || fit->inliers < kFewestAgreeing || fit->inlier_share < kFewestShare) continue;
        if (fit->sigma_px > kMostSpreadPx * double(1 << level)) continue;
        if (!plausibleMotion(fit->matrix, from.size()) || (best && fit->inliers <= best->inliers)) continue;
        best = fit;
    }
    return best;
}

}  // namespace eyrie

#pragma once

#include <algorithm>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <optional>

#include "core/parameter.h"
#include "registration/estimation/correspondences.h"

namespace eyrie {

/// When corners agree with a homography, and when there are enough of them.
struct HomographyOptions {
    double inlier_distance = 1.0;  ///< px
    int min_inliers = 16;
    double min_inlier_share = 0.12;

    void describe(ParameterVisitor& visitor);
};

/// A homography in px and how well the correspondences agree with it.
struct HomographyFit {
    cv::Matx33d matrix = cv::Matx33d::eye();
    double sigma_px = 0;            ///< robust deviation of the residuals in one direction
    double inlier_distance_px = 0;  ///< what counts as agreement: five times that, within fixed limits
    int inliers = 0;
    double inlier_share = 0;  ///< inliers per correspondence with a weight
    double rms_px = 0;        ///< of the inliers
};

/// What a random search draws.
enum class MotionModel {
    similarity,  ///< two points: shift, turn, scale; robust where points are few and coarse
    homography   ///< four points
};

/// Estimates the projective map between two pictures (Teutsch §4.2) from tracked corners of which some move or are
/// wrong: iteratively reweighted least squares (Tukey) from a start, and a random search (MSAC) where there is none.
/// Deterministic: the random numbers start anew in every call.
class HomographyEstimator {
 public:
    HomographyEstimator(const HomographyOptions& options, cv::Size image);

    /// The same for pictures that may show the ground from anywhere. Between neighbouring frames perspective changes
    /// little, and many points are needed to say otherwise; across a jump or in a sharp turn near the ground it changes
    /// by much. Searches more thoroughly, too.
    HomographyEstimator anyPerspective() const;

    /// Refines `start` on all points. Empty when there are too few. `coarseness` widens all distances, for points that
    /// were located on a pyramid level; points farther than `first_cutoff_px` from where `start` takes them never
    /// count.
    std::optional<HomographyFit> refine(const Correspondences& points, const cv::Matx33d& start, double coarseness = 1,
                                        double first_cutoff_px = 1e6) const;

    /// Searches with random samples of up to 512 points; `tolerance_px` is the residual that a good point may have. The
    /// result is refined on these points only. Empty when no sample gives a sensible map.
    std::optional<cv::Matx33d> search(const Correspondences& points, MotionModel model, double tolerance_px) const;

    /// Whether enough points agree.
    bool trustworthy(const HomographyFit& fit) const {
        // A thousand corners do not agree by chance, however many others there are; a few dozen may.
        constexpr int kVerySure = 1000;
        constexpr int kSure = 300;
        constexpr double kShareOfFew = 0.3;
        double share = std::max(options_.min_inlier_share, kShareOfFew);
        if (fit.inliers >= kSure) share = options_.min_inlier_share;
        if (fit.inliers >= kVerySure) share = options_.min_inlier_share / 2;
        return fit.inliers >= options_.min_inliers && fit.inlier_share >= share;
    }

 private:
    Correspondences normalised(const Correspondences& points) const;
    cv::Matx33d normalisedFromPx() const;

    HomographyOptions options_;
    double centre_x_;
    double centre_y_;
    double per_px_;                ///< normalised units per px; the longer side spans 2 units
    double projective_deviation_;  ///< expected change of the two projective numbers, in 1 / normalised units
    int search_rounds_;
};

/// Whether a map between two pictures of this size is one that a camera makes between frames: no mirror image, no
/// horizon inside the picture, scale within 1/4 … 4.
bool plausibleMotion(const cv::Matx33d& to_from, cv::Size image);

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>

#include "registration/pictures/padded_picture.h"

/// Finding a small patch again with sub-pixel accuracy: inverse compositional Lucas–Kanade (Baker and Matthews 2004)
/// for a translation and a brightness offset. Vectorised, with the instruction set chosen at run time.
namespace eyrie {

inline constexpr int kSmallestWindow = 5;
inline constexpr int kLargestWindow = 15;

/// How many samples a stored patch takes: the window and one pixel around it, and room for whole vectors.
constexpr int patchSamples(int window) {
    return ((window + 2) * (window + 2) + 16 + 15) / 16 * 16;
}

/// Whether the window about `centre`, and what interpolation and gradients need around it, lies in the picture.
bool patchFits(const PaddedPicture& picture, cv::Point2f centre, int window);

/// Stores the patch about `centre`, bilinearly interpolated, in 1/64 grey levels; `samples` holds
/// patchSamples(window). The patch must fit.
void cutPatch(const PaddedPicture& picture, cv::Point2f centre, int window, std::int16_t* samples);

/// A linear map between two pictures of one spot, for directions and distances in px.
struct LocalTurn {
    float xx = 1, xy = 0, yx = 0, yy = 1;
};

/// px that a stored surrounding reaches from its centre: enough for the window in any direction.
constexpr int surroundingReach(int window) {
    return (window / 2 + 1) * 3 / 2 + 1;
}
/// How many samples a stored surrounding takes.
constexpr int surroundingSamples(int window) {
    return (2 * surroundingReach(window) + 1) * (2 * surroundingReach(window) + 1);
}

/// Stores the surrounding of a whole pixel, in 1/64 grey levels; beyond the picture its border repeats.
void cutSurrounding(const PaddedPicture& picture, cv::Point centre, int window, std::int16_t* samples);

/// The patch as it looks in a picture that is turned and scaled: `present_from_stored` maps directions of the picture
/// that the surrounding was taken from. False when the surrounding does not reach as far.
bool turnPatch(const std::int16_t* surrounding, int window, const LocalTurn& present_from_stored,
               std::int16_t* samples);

/// A patch made ready for alignment. Reused for many patches of one window size; pixels near the centre of the window
/// weigh more, so that what lies beside a small vehicle pulls less.
class alignas(64) PatchTemplate {
 public:
    /// `window` is odd, kSmallestWindow … kLargestWindow.
    explicit PatchTemplate(int window);

    /// Takes over a stored patch. False when it is so flat that it cannot be located.
    bool prepare(const std::int16_t* samples);

    int window() const { return window_; }
    /// Variance of the grey levels in the window.
    float contrast() const { return contrast_; }
    /// Trace of the inverse of the structure tensor, px² per grey level²: times the noise variance, this is the
    /// variance of the position.
    float positionVariance() const { return (inverse_xx_ + inverse_yy_) / weight_scale_; }

    // Read by the kernels.
    static constexpr int kPitch = 16;
    static constexpr int kCells = kLargestWindow * kPitch;
    float values_[kCells];
    float weighted_gx_[kCells];
    float weighted_gy_[kCells];
    float weights_[kCells];  ///< sum to 1, 0 outside the window
    int window_;
    float weight_scale_;  ///< number of pixels that the weights are worth
    float mean_gx_ = 0;
    float mean_gy_ = 0;
    float inverse_xx_ = 0;
    float inverse_xy_ = 0;
    float inverse_yy_ = 0;
    float contrast_ = 0;
};

/// When a patch counts as found.
struct AlignmentLimits {
    int max_iterations = 12;
    float converged_px = 0.01F;
    float max_shift_px = 6;  ///< farther from the start than this, the patch counts as not found
};

/// Where a patch was found in the next picture.
struct Alignment {
    bool found = false;
    cv::Point2f position{0, 0};  ///< of the window's centre, px
    float residual = 0;          ///< mean square difference of the grey levels, brightness offset removed
    int iterations = 0;
};

/// Looks for the patch near `start`. Not found: it left the picture, ran away or did not settle.
Alignment align(const PatchTemplate& patch, const PaddedPicture& picture, cv::Point2f start,
                const AlignmentLimits& limits);

}  // namespace eyrie

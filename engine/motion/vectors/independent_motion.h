#pragma once

#include <deque>
#include <optional>
#include <vector>

#include "core/values/corner.h"
#include "core/values/frame.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/differences/silhouettes.h"
#include "motion/vectors/background_noise.h"
#include "motion/vectors/corner_history.h"
#include "motion/vectors/corner_verdict.h"
#include "motion/vectors/independent_motion_options.h"
#include "motion/vectors/shadow_owners.h"

namespace eyrie {

/// Decides which corners move independently of the camera (Teutsch §4.2): velocity relative to the ground from a
/// corner's position now and n frames ago, compared with what the background's corners show in the same frame.
///
/// A frozen picture repeats the last answer: no time passes in it. A frame that could not be registered has no vectors;
/// corners that come back after it with their ids go on, since the product of the guessed homography and the next one
/// is true again (see Registrar). A frame that does not follow the last drops all histories.
class IndependentMotion {
 public:
    IndependentMotion(const IndependentMotionOptions& options, const SceneScale& scale);

    /// The motion of the next frame. `registered.corners` must ascend by id, else Error(internal). `frame.gray`
    /// is only read by the shadow test and for silhouettes and may be empty, which switches these off for the frame.
    /// `verdicts`, if given, receives how every corner was judged.
    FrameMotion next(const RegisteredFrame& registered, const Frame& frame, CornerVerdicts* verdicts = nullptr);
    /// Takes a frame whose motion nobody asks for: what comes after is the same, but it costs next to nothing.
    void remember(const RegisteredFrame& registered, const Frame& frame);
    void reset();

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// The way from an earlier picture to the newest.
    struct Path {
        Homography current_from_past;
        int frames = 0;  ///< how long ago, not counting frozen ones

        template <class Archive>
        void transfer(Archive& archive);
    };
    struct Measured {
        int baseline = 0;  ///< frames; 0: too young
        cv::Point2d velocity{0, 0};
    };
    /// Sets what follows from the scale in a frame.
    void zoomTo(double zoom);
    void restart();
    bool follow(const RegisteredFrame& registered);
    bool extendPaths(const Registration& registration);
    void takePicture(const RegisteredFrame& registered);
    Measured measure(std::size_t corner, cv::Point2d now, int longest) const;
    cv::Point2d presentVelocity(std::size_t corner, cv::Point2d now, cv::Point2d mean, double sigma) const;
    /// Which vectors look like the outline of a shadow; none where that is not tested.
    std::vector<char> shadowLooks(const Frame& frame, const std::vector<MotionVector>& vectors);
    void leaveOutShadows(FrameMotion& motion, const std::vector<char>& looks_like_shadow, CornerVerdicts* verdicts);
    void inferRoofs(FrameMotion& motion, std::vector<char>& looks_like_shadow);
    void sortCorners(const RegisteredFrame& registered, const Frame& frame, FrameMotion& motion,
                     CornerVerdicts* verdicts);
    /// Speeds that the options declare in m/s, at a place, px/frame.
    struct SpeedLimits {
        double least;
        double least_slow;
        double most;  ///< 0: none
    };
    SpeedLimits limitsUnder(const SceneScale& here) const;
    SpeedLimits limitsAt(cv::Point2d place) const {
        return scale_.slope.isFlat() ? everywhere_ : limitsUnder(scale_.at(place));
    }
    /// What the speed over `measured.baseline` frames must reach, and which parameter says so.
    double speedLimit(double min_speed, double sigma) const;
    CornerVerdict verdictOn(const Corner& corner, const Measured& measured, const Measured& slow,
                            const BackgroundNoise& noise, double noise_here) const;

    IndependentMotionOptions options_;
    SceneScale first_scale_;  ///< of the first frame
    double zoom_ = 1;         ///< of the frame in hand
    SceneScale scale_;        ///< likewise
    SpeedLimits everywhere_;  ///< where the scale is the same everywhere
    ShadowTest shadow_test_;
    ShadowOwners shadow_owners_;
    LocalBackground local_background_;
    ParallaxTest parallax_test_;
    Silhouettes silhouettes_;
    MovingAreas areas_;
    CornerHistory history_;
    std::deque<Path> paths_;  ///< [n − 1]: from n usable pictures before the newest
    Path newest_;             ///< from the newest usable picture to the last frame
    bool any_picture_ = false;
    std::optional<FrameIndex> last_frame_;
    FrameMotion last_motion_;
};

}  // namespace eyrie

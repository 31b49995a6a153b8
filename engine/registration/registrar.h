#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <vector>

#include "core/values/corner.h"
#include "core/values/frame.h"
#include "core/values/frame_result.h"
#include "core/values/scene_scale.h"
#include "registration/clock_follower.h"
#include "registration/corners/corner_detector.h"
#include "registration/corners/corner_tracker.h"
#include "registration/estimation/homography_estimator.h"
#include "registration/graphics/burned_in_graphics.h"
#include "registration/pictures/image_pyramid.h"
#include "registration/pictures/picture_difference.h"
#include "registration/registration_options.h"
#include "registration/search/coarse_registration.h"
#include "registration/zoom_follower.h"

namespace eyrie {

/// Registers each frame of a video onto the one before it (Teutsch §4.2): tracks corners, estimates the homography of
/// the ground plane, and replaces corners that were lost. Says so when a frame cannot be registered, and recovers by
/// itself: corner tracks outlive a black, blurred or spoiled frame (they are absent from that frame's result and come
/// back, with the same ids, in the next that fits); after a cut it starts anew. Ids are never reused.
class Registrar {
 public:
    /// `scale`: of the run's first frame; `zoom_before`: Registration::zoom of the first frame that will come.
    Registrar(const RegistrationOptions& options, const SceneScale& scale, double zoom_before = 1);

    /// The next frame in order of time. Fills the times of corners, tracking_corners and homography when asked. Throws
    /// Error(input) for a frame that is empty, not CV_8UC1 or of another size than the one before; the registrar then
    /// stays as it was.
    RegisteredFrame next(const Frame& frame, StageTimes* times = nullptr);

    /// Forgets the video; the next frame is a first one. Ids go on.
    void reset();

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into a registrar
    /// of the same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// A picture with its corners, onto which later ones are registered.
    struct Anchor {
        ImagePyramid pyramid;
        CornerSet corners;
        double noise = 1;
        cv::Matx33d latest_from_anchor = cv::Matx33d::eye();  ///< to the newest frame handed out; a guess if not that
        int frames_ago = 0;                                   ///< how long that is after the anchor
        FrameIndex frame = 0;                                 ///< whose picture it is
        std::int64_t time_us = 0;                             ///< of that frame

        template <class Archive>
        void transfer(Archive& archive);
    };
    /// A successful registration of the new picture onto an anchor.
    struct Match {
        HomographyFit fit;
        std::vector<TrackedPosition> positions;
        int elapsed = 1;  ///< Registration::elapsed
    };

    /// The picture in hand, without corners.
    Anchor freshAnchor(const Frame& frame) const;
    RegisteredFrame firstFrame(const Frame& frame, StageTimes& times);
    RegisteredFrame repeatedFrame(const Frame& frame);
    RegisteredFrame registeredFrame(const Frame& frame, Anchor anchor, const Match& match, StageTimes& times);
    RegisteredFrame failedFrame(const Frame& frame, RegistrationFailure failure, StageTimes& times);

    std::optional<Match> registerOnto(const Anchor& anchor, RegistrationFailure& failure, StageTimes& times) const;
    /// Follows the corners of a picture into the one in hand, and tells over how many frames they have moved on.
    void trackMovers(const Anchor& anchor, const cv::Matx33d& start, double noise, Match& match) const;
    std::vector<cv::Matx33d> predictionsFor(const Anchor& anchor) const;
    /// Over how many frames everything may have moved on from an anchor that is the frame before, or the last one
    /// before frozen ones, to the picture in hand: what the clock says, or else one for each of those.
    int mostPassedSince(const Anchor& anchor) const;
    void replenish(Anchor& anchor, StageTimes& times);
    /// Sets what follows from the scale when the camera has zoomed so far.
    void zoomTo(double zoom);
    void checkFrame(const Frame& frame) const;

    RegistrationOptions options_;
    SceneScale scale_;  ///< of the first frame
    CornerDetector detector_;
    CornerTracker tracker_;
    std::optional<HomographyEstimator> estimator_;  ///< made for the size of the first frame
    RepetitionDetector repetition_;
    BurnedInGraphics graphics_;
    ZoomFollower zoom_;
    ClockFollower clock_;

    std::optional<Anchor> anchor_;  ///< the newest usable picture
    std::optional<Anchor> older_;   ///< the last good picture before frames that failed
    ImagePyramid current_;          ///< of the frame in hand
    double current_noise_ = 1;
    std::int64_t current_time_us_ = 0;
    cv::Matx33d motion_ = cv::Matx33d::eye();  ///< last measured motion per frame
    std::deque<cv::Matx33d> recent_;           ///< the last ones, newest last
    int repeated_ = 0;                         ///< frozen frames since the last real one
    double usual_corners_ = 0;                 ///< how many corners the video's pictures carry
    FrameIndex last_frame_ = 0;
    CornerId next_id_ = 0;
};

}  // namespace eyrie

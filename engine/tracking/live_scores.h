#pragma once

#include <deque>
#include <map>
#include <vector>

#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "core/values/track_state.h"
#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_score.h"

namespace eyrie {

/// The score of tracks while a run works: what the finished track would have if it were what is known of it so far. Of
/// its motion the last 64 windows count. Frames must come in ascending order.
class LiveScores {
 public:
    explicit LiveScores(const SceneScale& scale) : frame_rate_hz_(scale.frame_rate_hz) {}

    /// Sets the score of every track. `detections`: those of the frame, with what the classifier says of them.
    void judge(std::vector<TrackState>& tracks, const std::vector<Detection>& detections, const FrameMotion& motion);

    /// What is remembered of the frames so far, written or read; see core/state_archive.h.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// Where the ground under a track was carried since, for one window of its motion.
    struct Window {
        cv::Point2d begin{0, 0};    ///< px, in its first frame
        cv::Point2d carried{0, 0};  ///< the same place in the present frame
        FrameIndex first = 0;
        int states = 0;           ///< of the track since
        int frames = 0;           ///< since
        bool known = true;        ///< how the ground moved
        bool from_start = false;  ///< it begins where the track does
        bool begun_standing = false;
        bool ended_standing = false;
        FlowMoments flow{};

        bool counts() const {
            return known && !begun_standing && !ended_standing && frames >= (from_start ? 1 : kShortestFlowWindow);
        }

        template <class Archive>
        void transfer(Archive& archive);
    };
    struct Known {
        TrackTally tally;
        int states = 0;  ///< with those in which it stands
        std::deque<Window> open;
        std::deque<FlowMoments> closed;

        template <class Archive>
        void transfer(Archive& archive);
    };
    static std::optional<FlowComparison> comparisonOf(const Known& known);
    void addState(Known& known, const TrackState& state, FrameIndex frame) const;

    double frame_rate_hz_;
    std::map<TrackId, Known> known_;
};

}  // namespace eyrie

#pragma once

#include <deque>
#include <utility>
#include <vector>

#include "canvas/trail.h"
#include "core/values/frame_result.h"

namespace eyrie::ui {

/// Where the tracks of one frame were, and how the camera came there.
struct TrailStep {
    FrameIndex frame = 0;
    Homography current_from_previous;
    std::vector<std::pair<TrackId, cv::Point2f>> centres;  ///< ascending id
};

/// Remembers the tracks of the last frames and draws their way in the pixels of the newest, camera motion undone.
class TrailHistory {
 public:
    /// `length`: frames a trail reaches back, the present one included.
    explicit TrailHistory(int length) : length_(length) {}

    /// The next frame; one that does not follow the last begins anew.
    void add(TrailStep step);
    void add(const FrameResult& result);
    /// Trails of the tracks that live in the newest frame, at least two points each; ascending id.
    std::vector<Trail> trails() const;

 private:
    int length_;
    std::deque<TrailStep> steps_;
};

}  // namespace eyrie::ui

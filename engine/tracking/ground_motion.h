#pragma once

#include <deque>
#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/scene_scale.h"
#include "tracking/finishing/track_finishing.h"

namespace eyrie {

/// A box with its velocity relative to the ground, in some frame.
struct MovingState {
    OrientedBox box;
    cv::Point2d velocity{0, 0};  ///< px/frame
};

/// The box and the velocity of a track's state.
inline MovingState movingOf(const PathState& state) {
    return {state.box, state.velocity};
}

/// The camera's motion over a whole run: carries points and boxes from frame to frame over the ground.
class GroundMotion {
 public:
    GroundMotion() = default;
    explicit GroundMotion(const std::vector<FrameMotionSummary>& motion);
    /// Adds a frame; they come in ascending order.
    void add(const FrameMotionSummary& summary);

    /// What moves over ground that is seen at an angle grows as it comes nearer; flat until told otherwise.
    void seenAt(const ScaleSlope& slope) { slope_ = slope; }
    /// The scale of the first frame with the zoom of all.
    SceneScale zooming(SceneScale scale) const;
    /// How much larger than at one place of a picture the same thing is at another; 1 where the view is flat.
    double enlargement(cv::Point2d from, cv::Point2d to) const { return slope_.factorAt(to) / slope_.factorAt(from); }

    /// How much a map of the ground enlarges what is at a place beyond what comes of the other place it takes it to:
    /// the camera's zoom and height.
    double zoomAt(const cv::Matx33d& map, cv::Point2d place) const;

    /// Whether a whole box lies above the horizon, where the view has one: what is seen there is no ground.
    bool aboveHorizon(const OrientedBox& box) const;

    /// The map into an adjacent frame, null when the frame is unknown or its registration degenerate or, unless
    /// `guesses` are allowed, not reliable.
    const cv::Matx33d* step(FrameIndex from, FrameIndex to, bool guesses) const;
    /// Carries a box by its own velocity to another frame; nothing when a step is missing. Nothing moves by itself in
    /// frozen frames.
    std::optional<MovingState> carried(MovingState state, FrameIndex from, FrameIndex to, bool guesses) const;
    /// Over how many frames things moved on by themselves between two adjacent ones: Registration::framesPassed() of
    /// the later one.
    int elapsed(FrameIndex from, FrameIndex to) const;
    /// Empty when the frame is unknown.
    cv::Size imageSize(FrameIndex frame) const;
    /// Whether less than the whole box lies in the image.
    bool cutByBorder(const OrientedBox& box, FrameIndex frame) const;

 private:
    struct Step {
        FrameIndex frame = 0;
        cv::Matx33d forward;   ///< from the frame before
        cv::Matx33d backward;  ///< to the frame before
        double zoom = 1;       ///< since the first frame of the run
        bool usable = false;
        bool reliable = false;
        int elapsed = 1;
        cv::Size image_size;
    };
    const Step* stepInto(FrameIndex frame) const;
    OrientedBox movedBy(OrientedBox box, cv::Point2d way) const;
    ScaleSlope slope_;
    std::deque<Step> steps_;  ///< ascending frames; an hour of them, so without the slack of a vector
};

/// Enlargement of the ground at a point by a map.
double localScale(const cv::Matx33d& map, cv::Point2d point);

}  // namespace eyrie

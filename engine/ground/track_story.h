#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "annotation/pictures/object_stack.h"
#include "events/event_options.h"
#include "events/ground/ground_stretches.h"
#include "events/stored_events.h"

namespace eyrie {

/// A moment of a vehicle's drive over the ground.
struct StoryPoint {
    FrameIndex frame = 0;
    double seconds = 0;       ///< in the video
    double speed = 0;         ///< m/s by the scale there, known or not; of a track too short to tell 0
    double way_m = 0;         ///< driven since the first point, by the scale there
    cv::Point2d at{0, 0};     ///< m on its ground
    cv::Point2d image{0, 0};  ///< px in the frame
    double length_px = 0;     ///< of the vehicle in the frame
};

/// How a track drove over the ground around a frame: all of it that lies on the ground of that frame; empty where it
/// has no box on it. `ground` must be that of the run's footage.
std::vector<StoryPoint> storyOf(const StoredTracks& run, const GroundStretches& ground, TrackId track,
                                FrameIndex around, const EventOptions& options = {});

/// The frames of a story to look at around one: at most `most`, evenly spread from `before_s` before to `after_s`
/// after; of one alone, that nearest to `around`.
std::vector<StoryPoint> chosenAround(const std::vector<StoryPoint>& story, FrameIndex around, double before_s,
                                     double after_s, int most);

/// A vehicle as it looks over the frames around one, noise averaged away, heading to the right (Teutsch §5.3); without
/// a picture where too few of its frames can be read, or it is not to be seen in that frame.
ObjectStack stackOfTrack(const StoredTracks& run, TrackId track, FrameIndex around, const GrayFrames& gray,
                         const std::stop_token& stop = {});

/// The surroundings of a place as filmed, `side` px of the picture made `size` px; black beyond the border.
cv::Mat chipOf(const cv::Mat& picture, cv::Point2d place, double side, int size);

}  // namespace eyrie

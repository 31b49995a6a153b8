#pragma once

#include <cstddef>
#include <vector>

#include "events/event.h"
#include "events/event_options.h"
#include "events/ground/ground_stretches.h"

namespace eyrie {

/// A vehicle at one moment, on the ground.
struct GroundSample {
    FrameIndex frame = 0;
    cv::Point2d at;        ///< on the ground, m by the scale in the middle of the picture, smoothed
    cv::Point2d velocity;  ///< m/s by the scale at the place, as all below
    double speed = 0;      ///< m/s
    double by_place = 1;   ///< metres there, of a metre on the ground; 1 unless the view is oblique
    bool moving = false;   ///< with hysteresis
};

/// The part of a track that lies on one ground.
struct GroundPath {
    const EventTrack* track = nullptr;
    std::size_t first_box = 0;  ///< of the track; the others follow
    int stretch = 0;
    bool begins = false;    ///< the track begins here
    bool ends = false;      ///< the track ends here
    bool measured = false;  ///< long enough to tell speeds; otherwise it stands for nothing but its places
    std::vector<GroundSample> samples;

    TrackId id() const { return track->id; }
    const TrackedBox& box(std::size_t sample) const { return track->boxes[first_box + sample]; }
};

/// Consecutive samples, both included.
struct SampleSpan {
    std::size_t first = 0;
    std::size_t last = 0;
};

/// Maximal spans of samples that move, or stand, in their order.
std::vector<SampleSpan> spansOf(const GroundPath& path, bool moving);

/// From one sample's frame to another's, s; negative where the second comes first.
double secondsBetween(const GroundSample& a, const GroundSample& b, const SceneScale& scale);
double secondsBetween(const GroundPath& path, std::size_t from, std::size_t to, const SceneScale& scale);
/// Between two places of one ground, m by the scale there.
double metresBetween(const GroundSample& a, const GroundSample& b);
/// How far the vehicle drives from one sample to another, m; what it seems to move while it stands does not count.
double wayBetween(const GroundPath& path, std::size_t from, std::size_t to);
/// The first sample at or after a frame; the number of samples where there is none.
std::size_t sampleAt(const GroundPath& path, FrameIndex frame);

/// All tracks on the ground, in the order of the tracks, with speeds and standstills. `tracks` must outlive them.
/// Frames that were not searched are left out.
std::vector<GroundPath> groundPaths(const std::vector<EventTrack>& tracks, const GroundStretches& ground,
                                    const EventOptions& options);

}  // namespace eyrie

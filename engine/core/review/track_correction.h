#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

/// What a person corrects of the tracks of a video. As all of reviewing it belongs to the video, not to a run: nothing
/// here names a track. A box in a frame is a place on the ground at a time, in every run of the same video.
namespace eyrie {

/// What a person says of tracks.
enum class CorrectionKind {
    add,    ///< a vehicle that has no track
    join,   ///< two tracks are of one vehicle
    split,  ///< one track is of two vehicles
    reject  ///< a track is of nothing that drives
};
/// What came of it, for files and on screen: "added", "joined", "split", "rejected".
const char* nameOf(CorrectionKind kind);

/// Where a vehicle is in a frame.
struct Sighting {
    FrameIndex frame = 0;
    OrientedBox box;

    bool operator==(const Sighting& other) const;
};

/// One thing that a person says of tracks, in terms of places and frames: it holds for any run.
struct TrackCorrection {
    int id = 0;  ///< within a project, from 1; never used again. Those of lower numbers were made, and hold, before
    CorrectionKind kind = CorrectionKind::add;
    /// add: where the box was drawn; split: the first frame of the later vehicle; join: where the later track begins;
    /// reject: where the track begins.
    FrameIndex frame = 0;
    /// add: the vehicle in all frames in which it is seen; else some by which the track is found. Ascending frames.
    std::vector<Sighting> track;
    /// join: some of the other track; reject: some of the track that was kept of those on one vehicle, where there was
    /// one; else none.
    std::vector<Sighting> other;
    std::string person;    ///< who made it
    std::string when_utc;  ///< and when, ISO 8601

    bool operator==(const TrackCorrection&) const = default;
};

/// Throws Error(internal) for numbers, frames and boxes that cannot be, Error(parameter) for a text that is too long.
void checkCorrection(const TrackCorrection& correction);
/// Whether boxes of a vehicle can be: finite, with an area, in ascending frames of a video.
bool areSightings(const std::vector<Sighting>& sightings);

/// A vehicle is seen in at most so many frames.
inline constexpr std::size_t kMostSightings = 1'000'000;

}  // namespace eyrie

#include "correction/made_corrections.h"

#include <utility>

#include "core/error.h"
#include "correction/track_frames.h"

namespace eyrie {

TrackCorrection additionOf(std::vector<Sighting> boxes, FrameIndex drawn) {
    TrackCorrection correction;
    correction.kind = CorrectionKind::add;
    correction.frame = drawn;
    correction.track = std::move(boxes);
    return correction;
}

TrackCorrection joinOf(const std::vector<TrackFrame>& one, const std::vector<TrackFrame>& other) {
    const bool in_order = one.front().frame <= other.front().frame;
    const std::vector<TrackFrame>& first = in_order ? one : other;
    const std::vector<TrackFrame>& second = in_order ? other : one;
    TrackCorrection correction;
    correction.kind = CorrectionKind::join;
    correction.frame = second.front().frame;
    correction.track = sightingsOf(first.begin(), first.end());
    correction.other = sightingsOf(second.begin(), second.end());
    return correction;
}

TrackCorrection splitOf(const std::vector<TrackFrame>& track, FrameIndex frame) {
    if (track.empty() || frame <= track.front().frame || frame > track.back().frame) {
        throw Error(ErrorKind::parameter, "the track can be split between its first and its last frame, not at frame " +
                                              std::to_string(frame) + "; go to where the next vehicle takes it over");
    }
    const auto cut = firstFrom(track, frame);
    TrackCorrection correction;
    correction.kind = CorrectionKind::split;
    correction.frame = frame;
    correction.track = sightingsOf(track.begin(), cut);
    for (const Sighting& each : sightingsOf(cut, track.end())) correction.track.push_back(each);
    return correction;
}

TrackCorrection rejectionOf(const std::vector<TrackFrame>& track, const std::vector<TrackFrame>& beside) {
    TrackCorrection correction;
    correction.kind = CorrectionKind::reject;
    correction.frame = track.front().frame;
    correction.track = sightingsOf(track.begin(), track.end());
    correction.other = sightingsOf(firstFrom(beside, track.front().frame), firstFrom(beside, track.back().frame + 1));
    return correction;
}

}  // namespace eyrie

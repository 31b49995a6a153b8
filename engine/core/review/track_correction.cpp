#include "core/review/track_correction.h"

#include <array>
#include <cmath>

#include "core/error.h"
#include "core/review/review_edit.h"
#include "core/values/last_frame.h"

namespace eyrie {
namespace {

constexpr double kFarthest_px = 1e6;

bool isPossibleBox(const OrientedBox& box) {
    const auto isPlace = [](double px) { return std::abs(px) <= kFarthest_px; };  // false for what is no number
    const auto isLength = [](double px) { return px > 0 && px <= kFarthest_px; };
    return isPlace(box.centre.x) && isPlace(box.centre.y) && isLength(box.length) && isLength(box.width) &&
           std::isfinite(box.heading);
}

[[noreturn]] void refuseCorrection(const TrackCorrection& correction, const std::string& what) {
    throw Error(ErrorKind::internal,
                "this step of the review cannot be made: correction " + std::to_string(correction.id) + " " + what);
}

}  // namespace

const char* nameOf(CorrectionKind kind) {
    constexpr std::array<const char*, 4> kNames = {"added", "joined", "split", "rejected"};
    return kNames.at(static_cast<std::size_t>(kind));
}

bool Sighting::operator==(const Sighting& other) const {
    return frame == other.frame && box.centre == other.box.centre && box.length == other.box.length &&
           box.width == other.box.width && box.heading == other.box.heading;
}

bool areSightings(const std::vector<Sighting>& sightings) {
    if (sightings.size() > kMostSightings) return false;
    FrameIndex before = -1;
    for (const Sighting& sighting : sightings) {
        if (sighting.frame <= before || sighting.frame > kLastFrame || !isPossibleBox(sighting.box)) return false;
        before = sighting.frame;
    }
    return true;
}

void checkCorrection(const TrackCorrection& correction) {
    if (correction.id < 1) refuseCorrection(correction, "has no number above 0");
    if (correction.frame < 0 || correction.frame > kLastFrame) refuseCorrection(correction, "has an invalid frame");
    if (correction.track.empty() || !areSightings(correction.track) || !areSightings(correction.other))
        refuseCorrection(correction, "has invalid boxes");
    const bool may_name_another = correction.kind == CorrectionKind::join || correction.kind == CorrectionKind::reject;
    if ((correction.other.empty() && correction.kind == CorrectionKind::join) ||
        (!correction.other.empty() && !may_name_another))
        refuseCorrection(correction, "names the wrong number of tracks");
    const FrameIndex first = correction.track.front().frame;
    const FrameIndex last = correction.track.back().frame;
    if (correction.kind == CorrectionKind::split && (first >= correction.frame || last < correction.frame))
        refuseCorrection(correction, "leaves nothing of a track");
    for (const std::string* text : {&correction.person, &correction.when_utc}) {
        if (text->size() > kLongestReviewText) throw Error(ErrorKind::parameter, "a name or date is too long");
    }
}

}  // namespace eyrie

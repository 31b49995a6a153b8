#pragma once

#include <string>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

namespace eyrie {

/// Why what the tracker followed is not among the finished tracks of a run.
enum class TrackDrop {
    unconfirmed,      ///< never confirmed
    too_small,        ///< its boxes stayed smaller than any vehicle
    wider_than_long,  ///< as hardly any vehicle is, from whatever side it is seen
    shares_place,     ///< it lies on a track that was detected more often
    shadow,           ///< it drives beside a vehicle as if fixed to it
    hardly_detected,  ///< guessed rather than detected
    on_graphics,      ///< it is text or a mark that was drawn into the picture
    could_stand,      ///< parallax alone may have moved it, and it does not look like a vehicle
    unlikely          ///< all in all its evidence hardly speaks for a vehicle that moves
};

/// One state of a track that was left out when the tracks of a run were finished.
struct DroppedState {
    TrackId id = 0;
    OrientedBox box;
    TrackDrop why = TrackDrop::unconfirmed;
    TrackId beside = 0;  ///< the track that stayed; 0 where there is none
};

/// One sentence without full stop: "track 12 lies on track 7, which was detected more often".
std::string textOf(const DroppedState& dropped);
/// The parameter that decides: "finishing.max_sharing".
const char* parameterOf(TrackDrop why);

}  // namespace eyrie

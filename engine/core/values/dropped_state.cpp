#include "core/values/dropped_state.h"

namespace eyrie {

std::string textOf(const DroppedState& dropped) {
    const std::string track = "track " + std::to_string(dropped.id);
    const std::string other = "track " + std::to_string(dropped.beside);
    switch (dropped.why) {
        case TrackDrop::unconfirmed:
            return track + " was never confirmed";
        case TrackDrop::too_small:
            return track + " stayed smaller than any vehicle";
        case TrackDrop::wider_than_long:
            return track + " stayed wider than long, as people, riders and upright things seen from the side do";
        case TrackDrop::shares_place:
            return track + " lies on " + other + ", which was detected more often";
        case TrackDrop::shadow:
            return track + " drives beside " + other + " as if fixed to it, as its shadow or side would";
        case TrackDrop::hardly_detected:
            return track + " was guessed rather than detected";
        case TrackDrop::on_graphics:
            return track + " is text or a mark that is drawn into the picture";
        case TrackDrop::could_stand:
            return track +
                   " moves no faster than the parallax of a standing thing, and was never classified as a vehicle";
        case TrackDrop::unlikely:
            return track + " is unlikely to be a moving vehicle: seldom detected, unlike a vehicle, or short";
    }
    return track;
}

const char* parameterOf(TrackDrop why) {
    switch (why) {
        case TrackDrop::unconfirmed:
            return "tracking.confirm_hits";
        case TrackDrop::too_small:
            return "finishing.min_length";
        case TrackDrop::wider_than_long:
            return "finishing.max_aspect";
        case TrackDrop::shares_place:
            return "finishing.max_sharing";
        case TrackDrop::shadow:
            return "finishing.drop_shadows";
        case TrackDrop::hardly_detected:
            return "finishing.min_detected";
        case TrackDrop::on_graphics:
            return "registration.leave_out_graphics";
        case TrackDrop::could_stand:
            return "finishing.standing_height";
        case TrackDrop::unlikely:
            return "finishing.min_score";
    }
    return "";
}

}  // namespace eyrie

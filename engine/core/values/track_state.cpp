#include "core/values/track_state.h"

namespace eyrie {

const char* nameOf(StateOrigin origin) {
    switch (origin) {
        case StateOrigin::detected:
            return "detected";
        case StateOrigin::reconstructed:
            return "reconstructed";
        case StateOrigin::predicted:
            return "predicted";
        case StateOrigin::standing:
            return "standing";
        case StateOrigin::by_hand:
            return "by hand";
    }
    return "";
}

const char* nameOf(TrackStatus status) {
    switch (status) {
        case TrackStatus::tentative:
            return "tentative";
        case TrackStatus::confirmed:
            return "confirmed";
        case TrackStatus::coasting:
            return "coasting";
    }
    return "";
}

std::optional<StateOrigin> stateOriginOf(std::string_view word) {
    for (int i = 0; i < kStateOrigins; ++i)
        if (word == nameOf(static_cast<StateOrigin>(i))) return static_cast<StateOrigin>(i);
    return std::nullopt;
}

}  // namespace eyrie

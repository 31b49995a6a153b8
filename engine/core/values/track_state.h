#pragma once

#include <cstdint>
#include <opencv2/core/types.hpp>
#include <optional>
#include <string_view>

#include "core/geometry/oriented_box.h"
#include "core/values/ids.h"

namespace eyrie {

/// How sure the track management is of a track (Teutsch §6.4).
enum class TrackStatus : std::uint8_t {
    tentative,  ///< too new to be reliable; not part of the result
    confirmed,  ///< reliable
    coasting    ///< confirmed earlier, without a detection now
};

/// Where the box of a track state came from (Teutsch §6.3).
enum class StateOrigin : std::uint8_t {
    detected,       ///< updated by a detection
    reconstructed,  ///< by a box rebuilt from associated motion vectors, or followed in the pictures after the run
    predicted,      ///< the Kalman prediction alone
    standing,       ///< it stands: the picture at its place on the ground goes on to look like it
    by_hand         ///< a person drew it, or it was followed from there; no run has such states
};
inline constexpr int kStateOrigins = static_cast<int>(StateOrigin::by_hand) + 1;

/// One object in one frame. A track is the sequence of its states with one id.
struct TrackState {
    TrackId id = 0;
    OrientedBox box;
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, in current image axes
    TrackStatus status = TrackStatus::tentative;
    StateOrigin origin = StateOrigin::detected;
    int age = 0;   ///< frames since the first detection
    int hits = 0;  ///< frames with a real detection
    /// 0 … 1. While a run works: share of the last frames that were detected. In its result: the probability that the
    /// track is a vehicle that moves, the same in all its states; where no classifier takes part, the former.
    double score = 0;
};

/// The word used in files and on screen.
const char* nameOf(StateOrigin origin);
const char* nameOf(TrackStatus status);
/// What nameOf() calls so; nothing where none is called so.
std::optional<StateOrigin> stateOriginOf(std::string_view word);

}  // namespace eyrie

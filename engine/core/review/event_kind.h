#pragma once

#include <string>
#include <vector>

namespace eyrie {

/// What can happen to a vehicle, as an operator asks for it.
enum class EventKind {
    appears,       ///< its track begins
    leaves,        ///< it drives out of the picture
    lost,          ///< its track ends in mid-picture
    starts,        ///< it stood and drives off
    stops,         ///< it drove and comes to stand
    stands,        ///< it does not move for some time
    turns_back,    ///< it drives back where it came from
    against_flow,  ///< it drives where others come the other way, or an arrow points the other way
    leaves_flow,   ///< it turns off to where no other drives
    over_speed,    ///< faster than a limit
    under_speed,   ///< slower than a limit without standing
    convoy,        ///< several follow each other at steady distances
    meeting,       ///< two that came from different directions stand side by side
    loiters,       ///< it drives about in one place
    enters,        ///< it comes into a zone
    exits,         ///< it leaves a zone
    crosses        ///< it crosses a line
};
inline constexpr int kEventKinds = 17;

/// The word used in files and on screen: "turns back", "against the flow".
const char* nameOf(EventKind kind);
/// All kinds, in the order of their numbers.
std::vector<EventKind> allEventKinds();
/// A kind by its name; "-" and "_" count as blanks. Throws Error(parameter) with the nearest one.
EventKind eventKindOf(const std::string& name);

/// How an event crosses a line, seen when looking along it from its first point on.
enum class CrossingSense { none, to_right, to_left };
const char* nameOf(CrossingSense sense);

}  // namespace eyrie

#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/review/verdict.h"
#include "events/event.h"

namespace eyrie {

/// Seconds from the beginning of the video at which a frame is shown.
using FrameClock = std::function<double(FrameIndex)>;

/// When a frame was taken, as text ("2026-11-21T08:00:00.240Z"); empty where nobody knows.
using FrameMoment = std::function<std::string(FrameIndex)>;

/// Columns kind, first_frame, last_frame, start_s, end_s, clock, tracks (separated by blanks), figure, unit, zone,
/// sense, frame, x, y, ground_frame, ground_x, ground_y, verdict, note, tags, starred, person, when_utc, by
/// ("machine", or what a person did to the tracks: "person: added"), number, utc (of first_frame). `verdicts`: of each
/// event, null for none; or empty. `numbers`: of each event among all of the run; empty: they are all. `makers`: of
/// each event, see makerText(); empty: the machine. No `moment`: nobody knows when the video was taken. Throws
/// Error(output).
void writeEventCsv(const std::filesystem::path& path, const std::vector<Event>& events, const FrameClock& clock,
                   const std::vector<const Verdict*>& verdicts = {}, const std::vector<int>& numbers = {},
                   const std::vector<std::string>& makers = {}, const FrameMoment& moment = {});

}  // namespace eyrie

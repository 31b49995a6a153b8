#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <stop_token>

#include "chain/chain_run.h"
#include "io/video/frame_source.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

/// Some frames of a run's video as a video of their own.
namespace eyrie {

/// What is kept before and after an event where nobody says how much, seconds.
inline constexpr double kAroundClip_s = 2;

/// Which frames of a run become a clip, and what is drawn on them.
struct ClipWish {
    FrameRange range;          ///< first and last frame, both included
    bool overlay = false;      ///< draw the tracks with their numbers and trails
    bool uncorrected = false;  ///< draw them as the run found them, whatever people corrected
};

/// `event`, which is brought into `whole`, with what lies up to `around_s` seconds before and after it, as far as that
/// goes. `secondsOf` answers the time of a frame, which need not be even.
FrameRange framesAround(FrameRange event, double around_s, FrameRange whole,
                        const std::function<double(FrameIndex)>& secondsOf);

/// Writes the frames of `wish.range` at their distances in time, as far as the video goes, and answers which these
/// were. Stopped or failed, there is no file; stopped, there is no answer either. `progress` (0 … 1) may be empty.
/// Throws Error(input) where the video ends before the range begins, Error(output), Error(project).
std::optional<FrameRange> writeClip(const ClipWish& wish, ProjectFile& project, const RunRecord& run,
                                    FrameSource& source, const std::filesystem::path& out,
                                    const std::function<void(double)>& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie

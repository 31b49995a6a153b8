#include "cli/run_clock.h"

#include <cmath>
#include <cstdio>
#include <utility>

#include "cli/arguments/input.h"
#include "cli/arguments/video_arguments.h"
#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/video/parts/part_list.h"
#include "store/project/video_start.h"

namespace eyrie::cli {

VideoClock clockOf(ProjectFile& project, const RunRecord& run, const std::string& start, bool ask_video,
                   const std::stop_token& stop) {
    const auto given_us = videoStartOf(project, run.sequence.id, startOf(start));
    // Of several parts it does not tell what was not recorded between them.
    if (given_us && !hasPartListName(run.sequence.path)) return VideoClock::startingAt(*given_us);
    if (!given_us && !ask_video) return {};
    try {
        const auto pixels = openInput(run.sequence.path, 0, stop, run.sequence.frame_rate_hz);
        const FoundMetadata found = metadataOf(*pixels, stop);
        // What was not read to its end knows less than the video does.
        if (stop.stop_requested())
            throw Error(ErrorKind::input, run.sequence.path + ": stopped while reading its metadata");
        return VideoClock::of(found, given_us);
    } catch (const Error& error) {
        if (stop.stop_requested()) throw;
        std::fprintf(stderr, "eyrie-cli: the video tells no clock times: %s\n", error.what());
        return given_us ? VideoClock::startingAt(*given_us) : VideoClock();
    }
}

FrameMoment momentsBy(VideoClock clock, FrameClock seconds) {
    if (clock.source() == VideoClock::Source::none) return {};
    return [clock = std::move(clock), seconds = std::move(seconds)](FrameIndex frame) {
        const auto utc_us = clock.at(std::llround(seconds(frame) * 1e6));
        return utc_us ? utcTextToMilliseconds(*utc_us) : std::string();
    };
}

}  // namespace eyrie::cli

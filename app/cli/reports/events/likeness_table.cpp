#include "cli/reports/events/likeness_table.h"

#include <algorithm>
#include <cstdio>
#include <string>

#include "core/time/time_text.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie::cli {
namespace {

const EventTrack& trackOf(const StoredTracks& stored, TrackId id) {
    return *std::lower_bound(stored.tracks.begin(), stored.tracks.end(), id,
                             [](const EventTrack& track, TrackId wanted) { return track.id < wanted; });
}

/// In seven characters.
std::string looksText(const TrackLikeness& each) {
    char text[32];
    if (each.looks)
        std::snprintf(text, sizeof text, "%-6.2f ", *each.looks);
    else
        std::snprintf(text, sizeof text, "%-6s ", "-");
    return text;
}

}  // namespace

void printLikeness(TrackId chosen, const std::vector<TrackLikeness>& found, const StoredTracks& stored, bool looks) {
    std::printf("%-8s %-9s %-6s %-6s %-6s %s%-15s %s\n", "track", "likeness", "path", "speed", "size",
                looks ? "looks  " : "", "frames", "clock");
    for (const TrackLikeness& each : found) {
        const EventTrack& track = trackOf(stored, each.track);
        const std::string frames =
            std::to_string(track.boxes.front().frame) + "-" + std::to_string(track.boxes.back().frame);
        const std::string look = looks ? looksText(each) : std::string();
        std::printf("%-8d %-9.2f %-6.2f %-6.2f %-6.2f %s%-15s %s\n", each.track, each.likeness, each.path, each.speed,
                    each.size, look.c_str(), frames.c_str(),
                    videoClockText(stored.secondsOf(track.boxes.front().frame)).c_str());
    }
    std::printf("%zu other track%s, by likeness to track %d\n", found.size(), found.size() == 1 ? "" : "s", chosen);
}

void writeLikenessCsv(const std::filesystem::path& path, const std::vector<TrackLikeness>& found,
                      const StoredTracks& stored) {
    std::string text = "track,first_frame,last_frame,start_s,end_s,likeness,path,speed,size,looks\n";
    for (const TrackLikeness& each : found) {
        const EventTrack& track = trackOf(stored, each.track);
        const FrameIndex first = track.boxes.front().frame;
        const FrameIndex last = track.boxes.back().frame;
        text += std::to_string(each.track) + ',' + std::to_string(first) + ',' + std::to_string(last) + ',' +
                fixedText(stored.secondsOf(first), 3) + ',' + fixedText(stored.secondsOf(last), 3);
        for (const double value : {each.likeness, each.path, each.speed, each.size}) text += ',' + fixedText(value, 4);
        text += ',' + (each.looks ? fixedText(*each.looks, 4) : std::string()) + '\n';
    }
    writeFileAtomically(path, text);
}

}  // namespace eyrie::cli

#include "cli/run_report.h"

#include <cstdio>
#include <nlohmann/json.hpp>

#include "chain/scale_estimation.h"
#include "cli/console_progress.h"
#include "io/atomic_file.h"

namespace eyrie::cli {
namespace {

template <class... Values>
std::string formatted(const char* format, Values... values) {
    char text[512];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

const char* nameOf(RunOutcome outcome) {
    switch (outcome) {
        case RunOutcome::finished:
            return "finished";
        case RunOutcome::stopped:
            return "stopped";
        case RunOutcome::failed:
            return "failed";
    }
    return "";
}

std::string speedText(const SceneScale& scale, double px_per_frame) {
    return scale.gsd_known ? formatted("%.0f km/h", scale.metresPerSecond(px_per_frame) * 3.6)
                           : formatted("%.2f px/frame", px_per_frame);
}

/// A scale that nobody gave: seen in the traffic, or not even that.
std::string scaleGuess(const SceneScale& scale) {
    return isFallbackScale(scale)
               ? formatted(
                     "GSD unknown and the traffic shows none: works with a fallback of %.2g m/px, which may be far "
                     "off; give --gsd",
                     scale.gsd_m_per_px)
               : formatted("GSD unknown, estimated %.2g m/px from the traffic (give --gsd for metres and km/h)",
                           scale.gsd_m_per_px);
}

}  // namespace

std::string summaryText(const VideoInfo& video, const RunRecord& run, const RunSummary& summary,
                        const std::vector<TrackSummary>& tracks, const std::filesystem::path& project) {
    std::string text = formatted(
        "%s: %dx%d, %d frames at %.3g Hz, %s\n", video.path.filename().c_str(), video.size.width, video.size.height,
        video.frame_count, video.frame_rate_hz,
        run.scale.gsd_known ? formatted("%.3g m/px", run.scale.gsd_m_per_px).c_str() : scaleGuess(run.scale).c_str());
    text += formatted("Run %d %s: %d of %d frames in %s (%.1f frames/s)", run.id, nameOf(summary.outcome),
                      summary.frames_done, summary.frames_total, clockText(summary.seconds).c_str(),
                      summary.seconds > 0 ? summary.frames_done / summary.seconds : 0.0);
    if (summary.unregistered_frames > 0) text += formatted(", %d not registered", summary.unregistered_frames);
    text += "\n";
    int confirmed = 0;
    double speed = 0;
    for (const auto& track : tracks) {
        if (!track.confirmed) continue;
        ++confirmed;
        speed += track.mean_speed_px;
    }
    text += formatted("Vehicles followed: %d", confirmed);
    if (confirmed > 0) text += formatted(", mean speed %s", speedText(run.scale, speed / confirmed).c_str());
    text += "\nMedian per frame:";
    for (int i = 0; i < kStageCount; ++i) {
        const float ms = summary.median_ms[static_cast<std::size_t>(i)];
        if (ms > 0.005F)
            text += formatted(" %s %.2f ms;", eyrie::nameOf(static_cast<Stage>(i)), static_cast<double>(ms));
    }
    if (text.back() == ';') text.pop_back();
    text += "\nProject: " + project.string() + "\n";
    return text;
}

void writeTiming(const std::filesystem::path& path, const RunSummary& summary) {
    nlohmann::ordered_json json;
    json["frames"] = summary.frames_done;
    json["seconds"] = summary.seconds;
    json["frames_per_second"] = summary.seconds > 0 ? summary.frames_done / summary.seconds : 0.0;
    for (int i = 0; i < kStageCount; ++i) {
        json["median_ms"][eyrie::nameOf(static_cast<Stage>(i))] = summary.median_ms[static_cast<std::size_t>(i)];
    }
    writeFileAtomically(path, json.dump(2) + "\n");
}

}  // namespace eyrie::cli

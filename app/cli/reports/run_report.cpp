#include "cli/reports/run_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/reports/console_progress.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

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

std::string scaleText(const RunFacts& facts, const SceneScale& in_picture, cv::Size picture) {
    const std::string scale = describe(in_picture, facts.scale_basis, picture);
    switch (facts.scale_basis.origin) {
        case ScaleOrigin::given:
        case ScaleOrigin::metadata:
            return scale;
        case ScaleOrigin::estimated:
            return "GSD unknown: worked with " + scale + " (give --gsd for metres and km/h)";
        case ScaleOrigin::assumed:
            break;
    }
    return "GSD unknown and the traffic shows none: worked with " + scale + "; give --gsd";
}

/// "Not registered: 12 frames (too few corners 9, cut 3)"; empty when all were.
std::string unregisteredText(const RunCounts& counts) {
    if (counts.unregistered == 0) return {};
    std::string text =
        formatted("Not registered: %d frame%s (", counts.unregistered, counts.unregistered == 1 ? "" : "s");
    for (const ReasonCount& count : counts.reasons)
        text += formatted("%s %d, ", nameOf(count.fault, count.picture).c_str(), count.frames);
    text.resize(text.size() - 2);
    return text + ")\n";
}

std::string whyNothing(const RunFacts& facts) {
    switch (facts.nothing) {
        case NothingFollowed::has_tracks:
            return "";
        case NothingFollowed::no_frames:
            return "no frame was processed";
        case NothingFollowed::too_few_frames:
            return formatted(
                "%d frame%s %s too few for a track, which needs at least %d (tracking.confirm_hits decides)",
                facts.counts.frames, facts.counts.frames == 1 ? "" : "s", facts.counts.frames == 1 ? "is" : "are",
                facts.frames_needed);
        case NothingFollowed::not_registered:
            return "no frame could be registered onto the one before it, so no motion could be measured";
        case NothingFollowed::no_motion:
            return "nothing moved differently from the ground (motion.min_speed decides)";
        case NothingFollowed::no_detections:
            return "something moved, but nothing looked like a vehicle (detection.method decides, and --gsd)";
        case NothingFollowed::all_rejected:
            return "every detection was rejected as duplicate, outlier or for its size; check --gsd";
        case NothingFollowed::none_confirmed:
            return "nothing was detected often enough to become a track (tracking.confirm_hits decides)";
        case NothingFollowed::all_dropped:
            return "every track was dropped when the tracks were finished (the finishing parameters decide)";
    }
    return "";
}

}  // namespace

std::string estimateText(const ScaleEstimate& estimate) {
    return formatted("Estimated %.2g m/px from %d vehicle%s: in nine of ten videos between %.2g and %.2g m/px",
                     estimate.gsd_m_per_px, estimate.vehicles, estimate.vehicles == 1 ? "" : "s",
                     estimate.gsd_m_per_px / estimate.uncertainty, estimate.gsd_m_per_px * estimate.uncertainty);
}

std::vector<std::string> remarksOn(const StatedScale& stated) {
    const MetadataScale& scale = stated.by_metadata;
    if (scale.usable())
        return {"GSD " + fixedText(scale.gsd_m_per_px, 4) + " m/px from the video's metadata (" + nameOf(scale.source) +
                "), known in " + std::to_string(scale.frames_known) + " of " + std::to_string(scale.frames_asked) +
                " frames; --gsd overrides it"};
    if (!scale.why_not.empty()) return {"The video's metadata (KLV) are not used for the scale: " + scale.why_not};
    return {};
}

std::vector<std::string> remarksOn(const ChosenScale& chosen) {
    if (!chosen.why_not.empty()) return {"The scale is not estimated, which needs a classifier: " + chosen.why_not};
    std::vector<std::string> remarks;
    if (chosen.estimate) remarks.push_back(estimateText(*chosen.estimate));
    if (chosen.gsd_of_vehicles) {
        remarks.push_back(
            formatted("The view is oblique, and %.2g m/px is the scale where vehicles drive; in the middle "
                      "of the picture it is %.2g m/px",
                      *chosen.gsd_of_vehicles, chosen.scale.gsd_m_per_px));
    }
    return remarks;
}

std::vector<std::string> remarksOn(const StatedScale& stated, const ChosenScale& chosen) {
    std::vector<std::string> remarks = remarksOn(stated);
    for (std::string& remark : remarksOn(chosen)) remarks.push_back(std::move(remark));
    return remarks;
}

std::string summaryText(const VideoInfo& video, const RunRecord& run, const RunSummary& summary, const RunFacts& facts,
                        const std::vector<TrackSummary>& tracks, const std::filesystem::path& project) {
    std::string text = formatted("%s: %dx%d, %d frames at %.3g Hz%s, %s\n", video.path.filename().c_str(),
                                 video.size.width, video.size.height, video.frame_count, video.frame_rate_hz,
                                 video.frame_rate_assumed ? " (assumed: give --fps)" : "",
                                 scaleText(facts, run.scale, video.size).c_str());
    text += formatted("Run %d %s: %d of %d frames in %s (%.1f frames/s)", run.id, nameOf(summary.outcome),
                      summary.frames_done, summary.frames_total, clockText(summary.seconds).c_str(),
                      summary.seconds > 0 ? summary.frames_done / summary.seconds : 0.0);
    text += "\n";
    if (summary.outcome == RunOutcome::finished && !run.message.empty()) text += "Note: " + run.message + "\n";
    text += unregisteredText(facts.counts);
    int confirmed = 0;
    int two_wheelers = 0;
    int persons = 0;
    double speed = 0;
    for (const auto& track : tracks) {
        if (!track.confirmed) continue;
        ++confirmed;
        two_wheelers += track.track_class == TrackClass::two_wheeler;
        persons += track.track_class == TrackClass::person;
        // In pixels of the middle of the picture, where the view is oblique.
        speed +=
            run.scale.gsd_known ? track.mean_speed_px / run.scale.slope.factorAt(track.place) : track.mean_speed_px;
    }
    text += formatted("Vehicles followed: %d", confirmed);
    if (confirmed > 0) text += formatted(", mean speed %s", speedText(run.scale, speed / confirmed).c_str());
    if (two_wheelers + persons > 0)
        text += formatted(" (by their size two-wheelers %d, persons %d)", two_wheelers, persons);
    if (facts.nothing != NothingFollowed::has_tracks) {
        const std::string doubt = doubtfulScaleOf(facts);
        text += ": " + (doubt.empty() ? whyNothing(facts) : doubt);
    }
    const bool lit = std::any_of(run.light.begin(), run.light.end(), [](const LightFinding& finding) {
        return finding.outcome == LightOutcome::shadows || finding.outcome == LightOutcome::beams;
    });
    if (lit) text += "\nLight: " + describe(run.light, run.scale);
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

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <stop_token>
#include <string>
#include <vector>

#include "cli/arguments/earlier_state.h"
#include "cli/arguments/input.h"
#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/comparison/stored_comparison.h"
#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/time/utc_time.h"
#include "io/video/frame_source.h"
#include "io/video/parts/part_list.h"
#include "io/video/parts/part_source.h"
#include "store/health/file_check.h"
#include "store/labels/annotation_store.h"
#include "store/runs/run_store.h"
#include "store/sweeps/sweep_store.h"

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

Json factsOf(const FrameSource& source) {
    const VideoInfo& info = source.info();
    const double last_us = static_cast<double>(source.timeOf(info.frame_count - 1));
    Json facts{{"file", info.path.string()},
               {"kind", info.is_image_sequence ? "images" : "video"},
               {"container", info.container},
               {"codec", info.codec},
               {"width", info.size.width},
               {"height", info.size.height},
               {"frames", info.frame_count},
               {"frame_rate_hz", info.frame_rate_hz},
               {"variable_frame_rate", info.variable_frame_rate},
               {"duration_s", last_us / 1e6 + 1 / info.frame_rate_hz}};
    for (const VideoPart& part : info.parts)
        facts["parts"].push_back(
            {{"file", part.file.string()},
             {"first_frame", part.first_frame},
             {"frames", part.frame_count},
             {"first_s", static_cast<double>(part.first_time_us) / 1e6},
             {"start_utc", part.start_utc_us ? Json(utcText(*part.start_utc_us)) : Json(nullptr)}});
    return facts;
}

/// Headings in degrees, clockwise from +x in the picture of the first frame.
Json factsOf(const LightFinding& finding, const SceneScale& scale) {
    Json facts{
        {"first_frame", finding.first_frame}, {"last_frame", finding.last_frame}, {"outcome", nameOf(finding.outcome)}};
    if (finding.outcome == LightOutcome::shadows) {
        facts["heading_deg"] = degreesFromRadians(finding.heading);
        facts["reach_px"] = scale.px(finding.reach_m);
        facts["reach_m"] = scale.gsd_known ? Json(finding.reach_m) : Json(nullptr);
        facts["scatter_px"] = scale.px(finding.scatter_m);
        facts["agreement"] = finding.agreement;
        facts["darkening"] = finding.darkening ? Json(*finding.darkening) : Json(nullptr);
    }
    facts["vehicles"] = finding.vehicles;
    facts["trimmed_tracks"] = finding.trimmed;
    facts["dropped_tracks"] = finding.dropped;
    return facts;
}

Json factsOf(RunStore& store, const RunRecord& run) {
    const SequenceRecord& sequence = run.sequence;
    Json facts{{"id", run.id},
               {"name", run.name},
               {"state", nameOf(stateNow(run))},
               {"message", run.message},
               {"started", run.started_utc},
               {"engine_version", run.engine_version},
               {"preset", run.preset},
               {"video", sequence.path},
               {"width", sequence.size.width},
               {"height", sequence.size.height},
               {"first_frame", run.first_frame},
               {"last_frame", run.last_frame},
               {"frames_done", run.frames_done},
               {"frame_rate_hz", run.scale.frame_rate_hz},
               {"frame_rate_assumed", run.rate_assumed}};
    facts["gsd_m_per_px"] = run.scale.gsd_known ? Json(run.scale.gsd_m_per_px) : Json(nullptr);
    if (!run.scale.gsd_known) {
        facts["worked_with_m_per_px"] = run.scale.gsd_m_per_px;
        facts["scale_is_fallback"] = run.scale_basis.origin == ScaleOrigin::assumed;
    }
    facts["scale_origin"] = nameOf(run.scale_basis.origin);
    facts["scale_uncertainty"] = run.scale_basis.uncertainty ? Json(*run.scale_basis.uncertainty) : Json(nullptr);
    facts["scale_vehicles"] = run.scale_basis.vehicles;
    facts["scale_growth_right_per_px"] = run.scale.slope.right_per_px;
    facts["scale_growth_down_per_px"] = run.scale.slope.down_per_px;
    facts["scale"] = describe(run.scale, run.scale_basis, run.sequence.size);
    facts["light"] = Json::array();
    for (const LightFinding& finding : run.light) facts["light"].push_back(factsOf(finding, run.scale));
    facts["light_in_words"] = describe(run.light, run.scale);
    int confirmed = 0;
    for (const TrackSummary& track : store.tracks(run.id)) confirmed += track.confirmed ? 1 : 0;
    facts["tracks"] = confirmed;
    return facts;
}

void printVideo(const Json& facts) {
    std::printf("%s\n", facts["file"].get<std::string>().c_str());
    std::printf("  %s, %s\n", facts["codec"].get<std::string>().c_str(), facts["container"].get<std::string>().c_str());
    std::printf("  %d×%d px, %d frames, %.4g frames/s%s, %.2f s\n", facts["width"].get<int>(),
                facts["height"].get<int>(), facts["frames"].get<int>(), facts["frame_rate_hz"].get<double>(),
                facts["variable_frame_rate"].get<bool>() ? " on average (variable)" : "",
                facts["duration_s"].get<double>());
    if (!facts.contains("parts")) return;
    for (const Json& part : facts["parts"]) {
        const int first = part["first_frame"].get<int>();
        std::printf("  frames %d to %d: %s%s\n", first, first + part["frames"].get<int>() - 1,
                    part["file"].get<std::string>().c_str(),
                    part["start_utc"].is_null() ? "" : (", " + part["start_utc"].get<std::string>()).c_str());
    }
}

void printProject(const Json& facts) {
    std::printf("%s\n", facts["file"].get<std::string>().c_str());
    if (facts["runs"].empty()) std::printf("  no runs\n");
    for (const Json& run : facts["runs"]) {
        const std::string name = run["name"].get<std::string>();
        const std::string message = run["message"].get<std::string>();
        const int planned = run["last_frame"].get<int>() - run["first_frame"].get<int>() + 1;
        std::printf("  run %d%s: %s%s%s\n", run["id"].get<int>(), name.empty() ? "" : (" \"" + name + "\"").c_str(),
                    run["state"].get<std::string>().c_str(), message.empty() ? "" : ", ", message.c_str());
        std::printf("    %s, %d×%d px\n", run["video"].get<std::string>().c_str(), run["width"].get<int>(),
                    run["height"].get<int>());
        std::printf("    frames %d to %d, %d of %d done, %d tracks%s\n", run["first_frame"].get<int>(),
                    run["last_frame"].get<int>(), run["frames_done"].get<int>(), planned, run["tracks"].get<int>(),
                    run["frame_rate_assumed"].get<bool>() ? ", frame rate assumed" : "");
        const char* scale = run["gsd_m_per_px"].is_null() ? "scale unknown, worked with " : "";
        std::printf("    %s, engine %s, preset %s, %s%s\n", run["started"].get<std::string>().c_str(),
                    run["engine_version"].get<std::string>().c_str(), run["preset"].get<std::string>().c_str(), scale,
                    run["scale"].get<std::string>().c_str());
        if (const std::string light = run["light_in_words"].get<std::string>(); !light.empty())
            std::printf("    light: %s\n", light.c_str());
    }
    for (const Json& labels : facts["labels"])
        std::printf("  labels of %s: %d objects\n", labels["video"].get<std::string>().c_str(),
                    labels["objects"].get<int>());
    for (const Json& sweep : facts["sweeps"])
        std::printf("  sweep %d: %s, %d of %d points done\n", sweep["id"].get<int>(),
                    sweep["name"].get<std::string>().c_str(), sweep["points_done"].get<int>(),
                    sweep["points"].get<int>());
    for (const Json& comparison : facts["comparisons"]) std::printf("%s", comparisonText(comparison).c_str());
}

/// As much of it as could be read until the stop.
Json projectFacts(const std::filesystem::path& path, const std::stop_token& stop) {
    ProjectFile project = openForReading(path);
    RunStore store(project);
    Json facts{{"file", std::filesystem::absolute(path).string()}, {"kind", "project"}, {"runs", Json::array()}};
    for (const RunRecord& run : store.runs()) {
        if (stop.stop_requested()) return facts;
        facts["runs"].push_back(factsOf(store, run));
    }
    facts["labels"] = Json::array();
    for (const SequenceRecord& sequence : sequencesOf(project)) {
        if (stop.stop_requested()) return facts;
        const AnnotationSet labels = readAnnotations(project, sequence.id);
        if (!labels.objects.empty())
            facts["labels"].push_back({{"video", sequence.path}, {"objects", labels.objects.size()}});
    }
    facts["sweeps"] = Json::array();
    for (const SweepRecord& sweep : SweepStore(project).sweeps())
        facts["sweeps"].push_back({{"id", sweep.id},
                                   {"name", sweep.name},
                                   {"points", sweep.point_count},
                                   {"points_done", sweep.points_done}});
    facts["comparisons"] = Json::array();
    for (const ComparisonRecord& comparison : comparisons(project))
        facts["comparisons"].push_back(comparisonFacts(comparison));
    return facts;
}

struct InfoArguments {
    std::vector<std::string> files;
    double frame_rate_hz = 0;
    std::string list;
    OutputArguments outputs;
    bool json = false;
};

/// A video, a folder of images, or several video files that are one video.
Json videoFacts(const InfoArguments& arguments, const std::stop_token& stop) {
    if (!arguments.list.empty()) {
        if (arguments.files.size() < 2 || !hasPartListName(arguments.list))
            throw Error(ErrorKind::parameter, "--list " + arguments.list + ": name a file (*" + kPartListEnding +
                                                  ") for the list of several video files");
        arguments.outputs.check({{arguments.list, FileKind::text}}, {arguments.files.begin(), arguments.files.end()});
    }
    if (arguments.files.size() == 1) {
        SourceOptions options;
        options.frame_rate_hz = arguments.frame_rate_hz;
        return factsOf(*openSource(arguments.files.front(), options, {}, stop));
    }
    const auto source = openInputs(arguments.files, arguments.frame_rate_hz, stop, {});
    Json facts = factsOf(*source);
    if (!arguments.list.empty()) {
        writePartList(arguments.list, dynamic_cast<PartSource&>(*source).listed());
        facts["file"] = std::filesystem::absolute(arguments.list).lexically_normal().string();
    }
    return facts;
}

int tellFacts(const InfoArguments& arguments, const std::stop_token& stop) {
    const bool is_project = arguments.files.size() == 1 && isProject(arguments.files.front());
    const Json facts = is_project ? projectFacts(arguments.files.front(), stop) : videoFacts(arguments, stop);
    if (stop.stop_requested()) return exit_stopped;
    if (arguments.json) {
        std::printf("%s\n", facts.dump(2, ' ', false, Json::error_handler_t::replace).c_str());
    } else {
        is_project ? printProject(facts) : printVideo(facts);
    }
    return exit_ok;
}

}  // namespace

void addInfoCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<InfoArguments>();
    CLI::App* command = app.add_subcommand("info", "Show what a video, a folder of images or a project holds");
    command
        ->add_option(
            "FILE", arguments->files,
            "Video, folder of images or project (.eyrie); several video files count as one video, in their order")
        ->required();
    command->add_option("--fps", arguments->frame_rate_hz, "Frames per second, instead of the video's own")
        ->check(CLI::PositiveNumber);
    command->add_option("--list", arguments->list,
                        "Write the list of several video files (*.parts), which every command takes for a video");
    arguments->outputs.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments, &exit_code] {
        exit_code = untilStopped([&](const std::stop_token& stop) { return tellFacts(*arguments, stop); });
    });
}

}  // namespace eyrie::cli

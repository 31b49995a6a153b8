#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/calib3d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "chain/chain.h"
#include "cli/arguments/input.h"
#include "cli/arguments/preset_arguments.h"
#include "cli/arguments/video_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/reports/console_progress.h"
#include "cli/reports/method_times.h"
#include "cli/reports/preview_times.h"
#include "cli/reports/sweep_times.h"
#include "core/error.h"
#include "core/stopwatch.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"

namespace eyrie::cli {
namespace {

struct BenchArguments {
    std::string input = "scene:seq1";
    double gsd_m_per_px = 0.345;
    int frames = 60;
    int warm_up = 10;  ///< frames that nothing is learnt from: corners must age and tracks form first
    std::vector<int> corners{7000, 22000};
    PresetArguments preset;
    bool json = false;
};

/// Times of one stage over all frames, ms.
struct TimeSample {
    std::vector<double> ms;
    double at(double share) const {
        if (ms.empty()) return 0;
        std::vector<double> sorted = ms;
        const auto place = sorted.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(sorted.size() - 1));
        std::nth_element(sorted.begin(), place, sorted.end());
        return *place;
    }
    double median() const { return at(0.5); }
    double p10() const { return at(0.1); }
};

/// What was measured at one number of corners.
struct Column {
    int wanted_corners = 0;
    int corners = 0;         ///< median of those tracked
    int motion_vectors = 0;  ///< median
    std::map<std::string, TimeSample> stages;
};

/// A project that is thrown away.
class ScratchProject {
 public:
    ScratchProject() {
        std::string name = (std::filesystem::temp_directory_path() / "eyrie-bench-XXXXXX").string();
        if (mkdtemp(name.data()) == nullptr)
            throw Error(ErrorKind::output, name + ": cannot be created; check TMPDIR and the space left there");
        folder_ = name;
        ProjectFile::openOrCreate(path());
    }
    ScratchProject(const ScratchProject&) = delete;
    ScratchProject& operator=(const ScratchProject&) = delete;
    ~ScratchProject() {
        std::error_code ignored;
        std::filesystem::remove_all(folder_, ignored);
    }
    std::filesystem::path path() const { return folder_ / "bench.eyrie"; }

 private:
    std::filesystem::path folder_;
};

std::vector<Frame> readFrames(FrameSource& source, const BenchArguments& arguments, TimeSample& read) {
    std::vector<Frame> frames;
    const int available = std::min(arguments.frames + arguments.warm_up, source.info().frame_count);
    ConsoleProgress progress("frames read");
    const auto start = std::chrono::steady_clock::now();
    for (int i = 0; i < available; ++i) {
        StageTimes times{};
        {
            const Stopwatch watch(times, Stage::read);
            frames.push_back(source.read(i, false));
        }
        read.ms.push_back(static_cast<double>(times[static_cast<std::size_t>(Stage::read)]));
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        progress.show(i + 1, available, (i + 1) / std::max(seconds, 1e-9), seconds / (i + 1) * (available - i - 1));
    }
    return frames;
}

Column measureChain(const std::vector<Frame>& frames, ChainOptions options, const SceneScale& scale, int warm_up,
                    int corners) {
    setParameter(describeOf(options), "registration.max_corners", std::to_string(corners));
    setParameter(describeOf(options), "registration.corner_spacing", "0.1");
    Chain chain(options, scale);
    const ScratchProject project;
    Column column;
    column.wanted_corners = corners;
    std::vector<double> counts, vectors;
    {
        RunRecord run;
        run.sequence.path = "bench";
        run.sequence.size = frames.front().gray.size();
        run.scale = scale;
        run.last_frame = static_cast<int>(frames.size()) - 1;
        ResultWriter writer(project.path(), run, {});
        for (const auto& frame : frames) {
            FrameResult result = chain.next(frame);
            {
                const Stopwatch watch(result.stage_ms, Stage::store);
                writer.write(result);
            }
            if (frame.index < warm_up) continue;
            double total = 0;
            for (int i = 0; i < kStageCount; ++i) {
                const auto ms = static_cast<double>(result.stage_ms[static_cast<std::size_t>(i)]);
                column.stages[nameOf(static_cast<Stage>(i))].ms.push_back(ms);
                total += ms;
            }
            column.stages["chain and store"].ms.push_back(total);
            counts.push_back(result.motion.corner_count);
            vectors.push_back(static_cast<double>(result.motion.motion_vectors.size()));
        }
        writer.finish(RunState::finished, "");
    }
    column.corners = static_cast<int>(TimeSample{counts}.median());
    column.motion_vectors = static_cast<int>(TimeSample{vectors}.median());
    return column;
}

/// The same work by the usual means: OpenCV's corner detector, pyramidal Lucas–Kanade and RANSAC homography.
TimeSample measureBaseline(const std::vector<Frame>& frames, int corners) {
    TimeSample sample;
    for (std::size_t i = 1; i < frames.size() && i <= 12; ++i) {
        const auto start = std::chrono::steady_clock::now();
        std::vector<cv::Point2f> from, to;
        cv::goodFeaturesToTrack(frames[i - 1].gray, from, corners, 1e-4, 2);
        std::vector<unsigned char> found;
        std::vector<float> error;
        cv::calcOpticalFlowPyrLK(frames[i - 1].gray, frames[i].gray, from, to, found, error, {13, 13}, 2);
        if (from.size() >= 4) cv::findHomography(from, to, cv::RANSAC, 1.0);
        sample.ms.push_back(
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    }
    return sample;
}

void printMethods(const std::vector<MethodTimes>& methods) {
    std::printf("\n%-32s%10s%10s%10s%10s%10s   ms per frame after the motion vectors\n", "method", "areas", "stacking",
                "detection", "removal", "tracking");
    for (const MethodTimes& method : methods) {
        std::printf("%-32s%10.2f%10.2f%10.2f%10.2f%10.2f\n", method.name.c_str(), method.areas_ms, method.stacking_ms,
                    method.detection_ms, method.removal_ms, method.tracking_ms);
    }
}

void printSweep(const SweepTimes& times) {
    std::printf("\ntuning on these %d frames, gradient based segmentation\n", times.frames);
    std::printf("%-52s%10.2f s\n", "one run with its evaluation", times.run_s);
    std::printf("%-52s%10.2f s   %.1fx faster than %d runs\n", "46 quantiles at once", times.sweep_s, times.speedUp(),
                times.sweep_points);
    std::printf("%-52s%10.2f s\n", "figures after a changed clustering parameter", times.clustering_s);
    std::printf("%-52s%10.2f s\n", "figures after a changed parameter of removal", times.removal_s);
    std::printf("%-52s%10.2f s\n", "figures after a changed tracking parameter", times.tracking_s);
    std::printf("%-52s%10.2f ms\n", "one frame again after a changed quantile", times.preview_ms);
}

void printPreview(const PreviewTimes& times) {
    std::printf("\nlive preview on %dx%d frames, ms %32s%10s%12s\n", times.size.width, times.size.height,
                "first picture: median", "longest", "with tracks");
    for (const PreviewTimes::Moved& moved : times.moved)
        std::printf("  %-50s%10.1f%12.1f%12.1f\n", moved.parameter.c_str(), moved.median_ms, moved.longest_ms,
                    moved.final_ms);
    std::printf("  %-50s%10.1f\n", "the first of all", times.first_ms);
}

void printTable(const VideoInfo& video, const std::vector<Column>& columns, const std::vector<TimeSample>& baseline) {
    std::printf("%s, %dx%d; median (10th percentile) ms per frame, one frame after the other\n\n%-28s",
                video.path.string().c_str(), video.size.width, video.size.height, "stage");
    for (const auto& column : columns) std::printf("%9d corners", column.corners);
    std::printf("\n");
    std::vector<std::string> names;
    for (int i = 0; i < kStageCount; ++i) names.emplace_back(nameOf(static_cast<Stage>(i)));
    names.emplace_back("chain and store");
    for (const auto& name : names) {
        if (name == nameOf(Stage::read)) continue;
        std::printf("%-28s", name.c_str());
        for (const auto& column : columns) {
            const TimeSample& sample = column.stages.at(name);
            std::printf("%9.2f (%5.2f)", sample.median(), sample.p10());
        }
        std::printf("\n");
    }
    std::printf("%-28s", "motion vectors");
    for (const auto& column : columns) std::printf("%17d", column.motion_vectors);
    std::printf("\n%-28s", "OpenCV baseline, ms");
    for (const auto& sample : baseline) std::printf("%17.2f", sample.median());
    std::printf("\n%-28s", "baseline / our registration");
    for (std::size_t i = 0; i < columns.size(); ++i) {
        double ours = 0;
        for (const Stage stage : {Stage::corners, Stage::tracking_corners, Stage::homography}) {
            ours += columns[i].stages.at(nameOf(stage)).median();
        }
        std::printf("%16.1fx", baseline[i].median() / std::max(ours, 1e-9));
    }
    std::printf("\n");
}

void printJson(const std::vector<Column>& columns, const std::vector<TimeSample>& baseline, const TimeSample& read,
               const std::vector<MethodTimes>& methods, const SweepTimes& sweep, const PreviewTimes& preview) {
    nlohmann::ordered_json json;
    json["read_ms"] = read.median();
    for (std::size_t i = 0; i < columns.size(); ++i) {
        nlohmann::ordered_json entry{{"corners", columns[i].corners}, {"motion_vectors", columns[i].motion_vectors}};
        for (const auto& [name, sample] : columns[i].stages) {
            entry["stages"][name] = {{"median_ms", sample.median()}, {"p10_ms", sample.p10()}};
        }
        entry["baseline_ms"] = baseline[i].median();
        json["columns"].push_back(std::move(entry));
    }
    for (const MethodTimes& method : methods) {
        json["methods"].push_back({{"name", method.name},
                                   {"areas_ms", method.areas_ms},
                                   {"stacking_ms", method.stacking_ms},
                                   {"detection_ms", method.detection_ms},
                                   {"removal_ms", method.removal_ms},
                                   {"tracking_ms", method.tracking_ms}});
    }
    json["sweep"] = {
        {"frames", sweep.frames},          {"run_s", sweep.run_s},           {"quantiles_s", sweep.sweep_s},
        {"quantiles", sweep.sweep_points}, {"speed_up", sweep.speedUp()},    {"clustering_s", sweep.clustering_s},
        {"removal_s", sweep.removal_s},    {"tracking_s", sweep.tracking_s}, {"preview_ms", sweep.preview_ms}};
    json["preview"] = {{"width", preview.size.width}, {"height", preview.size.height}, {"first_ms", preview.first_ms}};
    for (const PreviewTimes::Moved& moved : preview.moved) {
        json["preview"]["moved"].push_back({{"parameter", moved.parameter},
                                            {"median_ms", moved.median_ms},
                                            {"longest_ms", moved.longest_ms},
                                            {"with_tracks_ms", moved.final_ms}});
    }
    std::puts(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace).c_str());
}

void bench(const BenchArguments& arguments) {
    checkGsd(arguments.gsd_m_per_px);
    const ChainOptions options = arguments.preset.options();
    const auto source = openInput(arguments.input, 0, {});
    SceneScale scale;
    scale.gsd_m_per_px = arguments.gsd_m_per_px;
    scale.gsd_known = true;
    scale.frame_rate_hz = source->info().frame_rate_hz;
    TimeSample read;
    const std::vector<Frame> frames = readFrames(*source, arguments, read);
    if (static_cast<int>(frames.size()) <= arguments.warm_up) {
        throw Error(ErrorKind::input, arguments.input + " is too short to measure: more than " +
                                          std::to_string(arguments.warm_up) + " frames are needed");
    }
    std::vector<Column> columns;
    std::vector<TimeSample> baseline;
    for (const int corners : arguments.corners) {
        columns.push_back(measureChain(frames, options, scale, arguments.warm_up, corners));
        baseline.push_back(measureBaseline(frames, corners));
    }
    const std::vector<MethodTimes> methods = measureMethods(frames, options, scale, arguments.warm_up);
    const SweepTimes sweep = measureSweep(frames, options, scale);
    const ScratchProject scratch;
    const PreviewTimes preview = measurePreview(frames, options, scale, scratch.path());
    if (arguments.json) {
        printJson(columns, baseline, read, methods, sweep, preview);
    } else {
        printTable(source->info(), columns, baseline);
        printMethods(methods);
        printSweep(sweep);
        printPreview(preview);
    }
}

}  // namespace

void addBenchCommand(CLI::App& app, int&) {
    const auto arguments = std::make_shared<BenchArguments>();
    CLI::App* command = app.add_subcommand("bench", "Measure the time of every stage, next to a plain OpenCV baseline");
    command->add_option("--input", arguments->input, "Video, folder of images or scene:NAME")->capture_default_str();
    command->add_option("--gsd", arguments->gsd_m_per_px, "Ground sampling distance in metres per pixel")
        ->capture_default_str();
    command->add_option("--frames", arguments->frames, "Frames to measure")
        ->capture_default_str()
        ->check(CLI::Range(1, 100000));
    command->add_option("--warm-up", arguments->warm_up, "Frames before them that are not measured")
        ->capture_default_str()
        ->check(CLI::Range(0, 100000));
    command->add_option("--corners", arguments->corners, "Numbers of corners to measure at")
        ->capture_default_str()
        ->check(CLI::Range(100, 50000));
    arguments->preset.addTo(*command);
    addJson(*command, arguments->json);
    command->callback([arguments] { bench(*arguments); });
}

}  // namespace eyrie::cli

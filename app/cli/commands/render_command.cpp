#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <vector>

#include "cli/arguments/output_arguments.h"
#include "cli/command.h"
#include "cli/common_options.h"
#include "cli/interrupt.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "io/atomic_file.h"
#include "io/tables/box_csv.h"
#include "io/tables/homography_csv.h"
#include "io/video/video_writer.h"
#include "scene/painting/scene_renderer.h"
#include "scene/towns/scene_preset.h"

namespace eyrie::cli {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
    std::string scene;
    std::string folder;
    OutputArguments outputs;
    std::uint32_t seed = 0;
    std::optional<int> frames;
    double lost = 0;
    bool video = false;
    bool upright = false;
    bool quiet = false;
};

std::string frameName(FrameIndex frame) {
    char name[32];
    std::snprintf(name, sizeof name, "%06d.png", frame);
    return name;
}

/// Frames of an earlier, longer rendering, which would not fit the truth.
std::vector<fs::path> staleFrames(const fs::path& frames, int frame_count) {
    std::vector<fs::path> stale;
    std::error_code error;
    for (fs::directory_iterator entry(frames, error), end; !error && entry != end; entry.increment(error)) {
        const fs::path& path = entry->path();
        const std::string stem = path.stem().string();
        const bool ours =
            path.extension() == ".png" && stem.size() == 6 && stem.find_first_not_of("0123456789") == std::string::npos;
        if (ours && std::stoi(stem) >= frame_count) stale.push_back(path);
    }
    return stale;
}

/// Makes the folder for the frames; what lies in it is replaced or removed only when that is agreed to.
fs::path prepareFolder(const RenderArguments& arguments, int frame_count) {
    std::error_code error;
    const fs::path folder = arguments.folder;
    const fs::path frames = folder / "frames";
    const std::vector<fs::path> stale = staleFrames(frames, frame_count);
    std::vector<OutputFile> files;
    const auto add = [&](const fs::path& path, FileKind kind) { files.push_back({path, kind, false, true}); };
    for (int frame = 0; frame < frame_count; ++frame) add(frames / frameName(frame), FileKind::image);
    for (const fs::path& path : stale) add(path, FileKind::image);
    add(folder / "ground_truth.csv", FileKind::text);
    add(folder / "homography.csv", FileKind::text);
    add(folder / "scene.json", FileKind::json);
    if (arguments.video) add(folder / "video.mp4", FileKind::video);
    arguments.outputs.check(files, {});
    fs::create_directories(frames, error);
    if (error) {
        throw Error(ErrorKind::output, frames.string() + ": the folder cannot be made (" + error.message() +
                                           "); choose another with --out");
    }
    for (const fs::path& path : stale) fs::remove(path, error);
    return frames;
}

void writePicture(const fs::path& path, const cv::Mat& picture) {
    std::vector<std::uint8_t> bytes;
    if (!cv::imencode(".png", picture, bytes, {cv::IMWRITE_PNG_COMPRESSION, 2})) {
        throw Error(ErrorKind::internal, path.string() + ": the picture could not be encoded as PNG");
    }
    writeFileAtomically(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()}, Durability::left_to_system);
}

void writeDescription(const fs::path& path, const SceneDescription& scene, int frames) {
    const nlohmann::ordered_json json = {{"name", scene.name},
                                         {"description", scene.text},
                                         {"seed", scene.seed},
                                         {"frames", frames},
                                         {"fps", scene.frame_rate_hz},
                                         {"gsd", scene.gsd_m_per_px},
                                         {"width", scene.image_size.width},
                                         {"height", scene.image_size.height},
                                         {"lost_frames", !scene.shown.empty()}};
    writeFileAtomically(path, json.dump(2) + "\n");
}

void collectTruth(const RenderedFrame& rendered, bool upright, BoxesByFrame& boxes) {
    std::vector<BoxRecord>& records = boxes[rendered.frame.index];
    for (const SceneObject& object : rendered.truth) {
        BoxRecord record;
        record.frame = rendered.frame.index;
        record.id = object.id;
        record.box = upright ? object.box.upright() : object.box;
        record.object_class = nameOf(object.kind);
        record.ignore = object.ignore;
        record.velocity = object.velocity;
        records.push_back(record);
    }
}

int run(const RenderArguments& arguments) {
    SceneDescription description = scenePreset(arguments.scene, arguments.seed);
    const int count = arguments.frames.value_or(description.frame_count);
    if (count < 1 || count > description.frame_count) {
        throw Error(ErrorKind::parameter, "--frames " + std::to_string(count) + ": scene '" + description.name +
                                              "' has frames 1.." + std::to_string(description.frame_count));
    }
    if (!(arguments.lost >= 0 && arguments.lost <= 0.5)) {
        throw Error(ErrorKind::parameter, "--lost: expected a share of 0..0.5 of the frames, e.g. 0.05");
    }
    if (arguments.lost > 0) loseFrames(description, arguments.lost);

    const fs::path folder = arguments.folder;
    const fs::path frames_folder = prepareFolder(arguments, count);
    const InterruptGuard interrupt;
    const SceneRenderer renderer(std::move(description));
    const SceneDescription& scene = renderer.scene();
    std::unique_ptr<VideoWriter> video;
    if (arguments.video) {
        VideoWriterOptions options;
        options.frame_rate_hz = scene.frame_rate_hz;
        video = std::make_unique<VideoWriter>(folder / "video.mp4", scene.image_size, options);
    }

    BoxesByFrame boxes;
    std::vector<Homography> homographies;
    std::optional<ConsoleProgress> progress;
    if (!arguments.quiet) progress.emplace("frames");
    const auto start = std::chrono::steady_clock::now();
    int done = 0;
    for (; done < count && !interrupt.token().stop_requested(); ++done) {
        const RenderedFrame rendered = renderer.render(done);
        writePicture(frames_folder / frameName(done), scene.sensor.gray ? rendered.frame.gray : rendered.frame.colour);
        if (video) video->write(rendered.frame.colour);
        collectTruth(rendered, arguments.upright, boxes);
        homographies.push_back(rendered.first_from_frame);
        if (progress) {
            const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
            const double rate = (done + 1) / std::max(seconds, 1e-6);
            progress->show(done + 1, count, rate, (count - done - 1) / rate);
        }
    }
    progress.reset();
    writeGroundTruthCsv(folder / "ground_truth.csv", boxes);
    writeHomographyCsv(folder / "homography.csv", homographies);
    writeDescription(folder / "scene.json", scene, done);
    if (video) video->finish();
    std::printf("%d frames of scene '%s' (seed %u%s) with their ground truth: %s\n", done, scene.name.c_str(),
                scene.seed, arguments.seed == 0 ? ", the scene's own" : "", folder.string().c_str());
    return done < count ? exit_stopped : exit_ok;
}

std::string sceneList() {
    std::string list;
    for (const std::string& name : scenePresetNames()) list += (list.empty() ? "" : ", ") + name;
    return list;
}

}  // namespace

void addRenderCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<RenderArguments>();
    CLI::App* command = app.add_subcommand("render", "Paint an aerial scene with exact ground truth into a folder");
    command->add_option("scene", arguments->scene, "One of " + sceneList())->required();
    command
        ->add_option("--out", arguments->folder,
                     "Folder for frames/, ground_truth.csv, homography.csv and scene.json; with --force "
                     "files of an earlier rendering there are replaced")
        ->required();
    command->add_option("--seed", arguments->seed, "Another scene of the same kind (default: the scene's own)");
    command->add_option("--frames", arguments->frames, "Only the first N frames");
    command->add_option("--lost", arguments->lost, "Share of frames that a bad radio link freezes or drops (0..0.5)");
    command->add_flag("--upright", arguments->upright, "Ground truth with upright boxes, as the original egtest01 has");
    command->add_flag("--video", arguments->video, "Also write video.mp4");
    arguments->outputs.addTo(*command);
    addQuiet(*command, arguments->quiet);
    command->callback([arguments, &exit_code] { exit_code = run(*arguments); });
}

}  // namespace eyrie::cli

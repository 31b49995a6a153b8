#include "cli/arguments/sample_sources.h"

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <opencv2/core.hpp>
#include <optional>

#include "cli/arguments/input.h"
#include "cli/reports/console_progress.h"
#include "core/error.h"
#include "core/labels/box_record.h"
#include "io/tables/box_csv.h"
#include "learning/training/labelled_frames.h"
#include "scene/painting/scene_renderer.h"
#include "scene/towns/scene_preset.h"

namespace eyrie::cli {
namespace {

constexpr double kClearlySeen = 0.85;  // share of a rendered vehicle that must be visible and in the image
constexpr int kFramesPerScene = 8;     // far apart in time, so that they show different places and vehicles
constexpr double kParkedMargin = 1.5;  // around the footprint, which leaves out the vehicle's height
const std::vector<std::string> kKinds{"seq1", "seq2", "egtest01"};

/// Boxes in the image around the footprints of parked vehicles, which the truth does not list.
std::vector<OrientedBox> parkedBoxes(const SceneDescription& scene, const cv::Matx33d& frame_from_ground) {
    const auto toFrame = [&](cv::Point2d p) {
        const cv::Vec3d v = frame_from_ground * cv::Vec3d(p.x, p.y, 1);
        return cv::Point2d(v[0] / v[2], v[1] / v[2]);
    };
    std::vector<OrientedBox> boxes;
    for (const ParkedVehicle& parked : scene.parked) {
        const cv::Point2d ahead = parked.pose.direction;
        const cv::Point2d right(-ahead.y, ahead.x);
        std::vector<cv::Point2d> corners;
        for (const double along : {-0.5, 0.5}) {
            for (const double across : {-0.5, 0.5}) {
                corners.push_back(toFrame(parked.pose.position + ahead * (along * parked.look.length) +
                                          right * (across * parked.look.width)));
            }
        }
        const cv::Point2d direction = corners[2] - corners[0];
        const OrientedBox box =
            boxAround(corners, std::atan2(direction.y, direction.x)).scaled(kParkedMargin, kParkedMargin);
        if (areaInImage(box, scene.image_size) > 0) boxes.push_back(box);
    }
    return boxes;
}

LabelledImage labelledFrame(const SceneRenderer& renderer, FrameIndex frame, const std::string& group) {
    const RenderedFrame rendered = renderer.render(frame);
    LabelledImage image;
    image.gray = rendered.frame.gray;
    image.source = "rendered";
    image.group = group;
    for (const SceneObject& object : rendered.truth) {
        const bool clear = object.visibility > kClearlySeen && object.inside > kClearlySeen;
        (clear && isVehicle(object.kind) ? image.vehicles : image.unclear).push_back(object.box);
    }
    const auto parked = parkedBoxes(renderer.scene(), rendered.frame_from_ground);
    image.unclear.insert(image.unclear.end(), parked.begin(), parked.end());
    return image;
}

class StepProgress {
 public:
    StepProgress(std::string unit, int total, bool shown) : total_(total) {
        if (shown) progress_.emplace(std::move(unit));
    }
    void show(int done) {
        if (!progress_) return;
        const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count() + 1e-6;
        progress_->show(done, total_, done / seconds, (total_ - done) * seconds / std::max(done, 1));
    }

 private:
    std::optional<ConsoleProgress> progress_;
    int total_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

std::vector<std::string> sampleFolders(const std::vector<std::string>& lists) {
    std::vector<std::string> folders;
    for (const std::string& list : lists) {
        std::size_t begin = 0;
        while (begin <= list.size()) {
            const std::size_t end = std::min(list.find(',', begin), list.size());
            if (end > begin) folders.push_back(list.substr(begin, end - begin));
            begin = end + 1;
        }
    }
    return folders;
}

SampleSet readSampleFolders(const std::vector<std::string>& folders, const WindowFit& fit) {
    SampleSet samples;
    for (const std::string& folder : sampleFolders(folders)) {
        SampleSet read = readPatchSheets(folder, fit);
        std::move(read.begin(), read.end(), std::back_inserter(samples));
    }
    return samples;
}

std::vector<LabelledImage> renderLabelledImages(int frames, std::uint64_t seed, bool show_progress,
                                                std::stop_token stop) {
    std::vector<LabelledImage> images;
    StepProgress progress("frames rendered", frames, show_progress);
    for (int scene = 0; static_cast<int>(images.size()) < frames && !stop.stop_requested(); ++scene) {
        const std::string& kind = kKinds[static_cast<std::size_t>(scene) % kKinds.size()];
        const auto scene_seed = static_cast<std::uint32_t>(0x7e570000U + 131 * seed + static_cast<unsigned>(scene));
        const SceneRenderer renderer(scenePreset(kind, scene_seed));
        const int wanted = std::min(kFramesPerScene, frames - static_cast<int>(images.size()));
        for (int k = 0; k < wanted && !stop.stop_requested(); ++k) {
            const FrameIndex frame = (renderer.frameCount() - 1) * k / kFramesPerScene;
            images.push_back(labelledFrame(renderer, frame, kind + " " + std::to_string(scene_seed)));
            progress.show(static_cast<int>(images.size()));
        }
    }
    return images;
}

std::vector<LabelledImage> readLabelledFrames(const std::string& input, const std::string& ground_truth, int step,
                                              bool show_progress, std::stop_token stop) {
    if (step < 1) throw Error(ErrorKind::parameter, "--every " + std::to_string(step) + ": expected 1 or more");
    const BoxesByFrame boxes = readBoxCsv(ground_truth);
    const auto source = openInput(input, 0, stop);
    const std::string name = std::filesystem::path(input).filename().string();
    TrainingBoxes training;
    for (const auto& [frame, records] : boxes)
        for (const BoxRecord& record : records) training[frame].push_back(trainingBoxOf(record));
    constexpr int kParts = 1000;
    StepProgress progress("‰ of the frames read", kParts, show_progress);
    return labelledImagesOf(
        training, name, source->info().frame_count, step,
        [&](FrameIndex frame) { return source->read(frame, false).gray; }, stop,
        [&](double share) { progress.show(static_cast<int>(kParts * share)); });
}

}  // namespace eyrie::cli

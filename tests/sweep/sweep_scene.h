#pragma once

#include <memory>
#include <vector>

#include "core/labels/box_record.h"
#include "support/moving_scene.h"
#include "sweep/sweep_runner.h"

/// A short clip with its truth, drawn once.
namespace eyrie::test {

inline const SceneScale kSweepScale{0.2, 25, true};
inline constexpr int kSweepFrames = 30;

inline const std::vector<cv::Mat>& sweepPictures() {
    static const std::vector<cv::Mat> pictures = [] {
        MovingScene scene;
        scene.frames = kSweepFrames;
        std::vector<cv::Mat> drawn;
        for (int i = 0; i < scene.frames; ++i) drawn.push_back(scene.draw(i));
        return drawn;
    }();
    return pictures;
}

inline std::unique_ptr<FrameSource> sweepSource() {
    return std::make_unique<MemorySource>(kSweepFrames, cv::Size(320, 240),
                                          [](int index) { return sweepPictures()[static_cast<std::size_t>(index)]; });
}

inline BoxesByFrame sweepTruth() {
    const MovingScene scene;
    BoxesByFrame truth;
    for (int i = 0; i < kSweepFrames; ++i) {
        for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
            const auto& vehicle = scene.vehicles[v];
            BoxRecord record;
            record.frame = i;
            record.id = static_cast<int>(v) + 1;
            record.object_class = "car";
            record.box = {scene.vehicleAt(vehicle, i), vehicle.size.width, vehicle.size.height,
                          std::atan2(vehicle.velocity.y, vehicle.velocity.x)};
            truth[i].push_back(record);
        }
    }
    return truth;
}

inline ChainOptions sweepBase() {
    ChainOptions options;
    options.detection.method = DetectionMethod::gradient;
    return options;
}

inline SweepPlan sweepPlan(const std::vector<std::string>& axes) {
    SweepPlan plan;
    plan.engine_version = "test";
    for (const std::string& axis : axes) plan.axes.push_back(parseAxis(axis, sweepBase()));
    plan.base = parameterValues(sweepBase());
    SweepClip clip;
    clip.sequence = "memory";
    clip.ground_truth = "truth.csv";
    clip.size = {320, 240};
    clip.last_frame = kSweepFrames - 1;
    clip.scale = kSweepScale;
    clip.digest = "0";
    plan.clips.push_back(clip);
    return plan;
}

inline std::vector<SweepInput> sweepInputs() {
    std::vector<SweepInput> inputs(1);
    inputs[0].cache = std::make_unique<StageCache>(sweepSource, FrameRange{}, kSweepScale);
    inputs[0].scoring.truth.boxes = sweepTruth();
    return inputs;
}

}  // namespace eyrie::test

#pragma once

#include <string>

#include "core/geometry/angle.h"
#include "detection/sliding_window/sliding_window_options.h"
#include "learning/training/sample_set.h"
#include "learning/training/trainer.h"
#include "support/driven_scene.h"
#include "support/temporary_folder.h"

namespace eyrie::test {

/// A small model of the vehicles that drivenScene() draws, in a file that lives as long as the program.
inline const std::string& drivenSceneModel() {
    static const TemporaryFolder folder;
    static const std::string path = [] {
        SampleSet samples;
        for (int i = 0; i < 80; ++i) {
            const auto seed = static_cast<std::uint64_t>(1000 + i);
            const DrivenScene scene = drivenScene(-kPi + 0.0785 * i, {150 + 0.15 * i, 118 + 0.05 * i}, seed);
            LabelledImage image{scene.frame.gray, {scene.vehicle}, {}, "driven", std::to_string(i)};
            const SampleSet found = samplesFromImage(image, 12, scene.vehicle, seed);
            samples.insert(samples.end(), found.begin(), found.end());
        }
        TrainingOptions options;
        options.classifier_options.trees = 64;
        options.hard_negative_rounds = 1;
        std::string file = (folder / "driven.eyriemodel").string();
        saveModel(trainModel(samples, options, {}).value(), file);
        return file;
    }();
    return path;
}

/// Options for a sliding window that looks for vehicles of 40 × 16 px at kContractScale.
inline SlidingWindowOptions drivenSceneWindow() {
    SlidingWindowOptions options;
    options.model = drivenSceneModel();
    options.car_length_m = 40 * kContractScale.gsd_m_per_px;
    options.car_width_m = 16 * kContractScale.gsd_m_per_px;
    options.smallest_scale = 0.8;
    options.largest_scale = 1.25;
    return options;
}

}  // namespace eyrie::test

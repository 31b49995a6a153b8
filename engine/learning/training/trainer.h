#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "learning/models/vehicle_model.h"
#include "learning/training/sample_set.h"

namespace eyrie {

/// How a model is trained.
struct TrainingOptions {
    DescriptorKind descriptor = DescriptorKind::channel_features;
    ClassifierKind classifier = ClassifierKind::adaboost;
    ClassifierOptions classifier_options;
    int seed = 1;
    int hard_negative_rounds = 2;
    double others_per_vehicle = 1;       ///< of the first round
    double hard_others_per_vehicle = 1;  ///< added by each hard-negative round, at most
    bool duplicates = false;             ///< use samples that are nearly equal to others, too
    bool fill_window = false;            ///< samples are, or were, cut as Teutsch §7.2 says: SampleCutting::thesis()
    bool mirrored = true;                ///< vehicles also with sides, and front and rear, exchanged
    double contrast_change = 0.4;        ///< contrast of copies is multiplied by 1 − c … 1 + c
    int varied_copies = 1;               ///< copies of each vehicle with another contrast
    int misfit_copies = 1;               ///< others made of each vehicle by moving it aside or stretching it

    /// How samples are cut out of labelled images.
    SampleCutting cutting() const { return fill_window ? SampleCutting::thesis() : SampleCutting{}; }
    /// Group "training".
    void describe(ParameterVisitor& visitor);
};

/// Delivers windows that are no vehicle and that the model so far takes for one: at most `wanted`, the worst first.
using HardNegativeSource = std::function<SampleSet(const VehicleModel& model, int wanted)>;

/// Trains a model on all vehicles and as many others, then in each round adds the others that the model so far
/// misjudges most — from the rest of the set and from `more`, where there is one — and trains anew. The same samples
/// and options give the same model. `record` is taken over with the counts filled in. Empty when stopped. Throws
/// Error(input) where the samples do not suffice, Error(parameter) where the classifier cannot take so many.
std::optional<VehicleModel> trainModel(const SampleSet& samples, const TrainingOptions& options, TrainingRecord record,
                                       const TrainingWatch& watch = {}, const HardNegativeSource& more = {});

/// "kit_ais: 2462 vehicles, 2600 others", a source a line.
std::string describeSources(const SampleSet& samples);

}  // namespace eyrie

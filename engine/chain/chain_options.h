#pragma once

#include <string>
#include <utility>
#include <vector>

#include "chain/scale/view_options.h"
#include "core/labels/track_class.h"
#include "core/parameter.h"
#include "core/values/scene_scale.h"
#include "detection/detection_options.h"
#include "motion/clusters/motion_clustering.h"
#include "motion/differences/difference_options.h"
#include "motion/vectors/independent_motion.h"
#include "registration/registrar.h"
#include "removal/duplicate_removal.h"
#include "removal/outlier_removal.h"
#include "stacking/image_stacker.h"
#include "tracking/finishing/track_finishing.h"
#include "tracking/tracker.h"

namespace eyrie {

/// Every parameter of the chain, in the order of the chain.
struct ChainOptions {
    ViewOptions view;
    RegistrationOptions registration;
    IndependentMotionOptions motion;
    DifferenceOptions difference;  ///< in place of clustering, where `difference.method` says so
    MotionClusteringOptions clustering;
    StackingOptions stacking;
    DetectionOptions detection;
    DuplicateRemovalOptions duplicates;
    OutlierRemovalOptions outliers;
    TrackerOptions tracking;
    FinishingOptions finishing;
    TrackClassOptions classes;

    void describe(ParameterVisitor& visitor);
};

/// Names of the built-in presets: "default" (the best we know) and "thesis" (the text to the letter, its optima).
std::vector<std::string> builtInPresets();
/// Throws Error(parameter) for an unknown name.
ChainOptions builtInPreset(const std::string& name);

/// All parameters as name and value, for presets, the project file and comparison.
std::vector<std::pair<std::string, std::string>> parameterValues(const ChainOptions& options);

/// The chain's parameters as a run stored them. Parameters that this version does not know, and values that it does
/// not take, are left at their defaults; their names go to `unknown`, if given.
ChainOptions storedOptions(const std::vector<std::pair<std::string, std::string>>& parameters,
                           std::vector<std::string>* unknown = nullptr);

}  // namespace eyrie

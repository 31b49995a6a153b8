#include "chain/chain_options.h"

#include "core/error.h"
#include "store/details/recording_options.h"

namespace eyrie {

void ChainOptions::describe(ParameterVisitor& visitor) {
    view.describe(visitor);
    registration.describe(visitor);
    motion.describe(visitor);
    difference.describe(visitor);
    clustering.describe(visitor);
    stacking.describe(visitor);
    detection.describe(visitor);
    duplicates.describe(visitor);
    outliers.describe(visitor);
    tracking.describe(visitor);
    finishing.describe(visitor);
    classes.describe(visitor);
}

std::vector<std::string> builtInPresets() {
    return {"default", "thesis"};
}

ChainOptions builtInPreset(const std::string& name) {
    ChainOptions options;
    if (name == "default") return options;
    if (name == "thesis") {
        options.view = ViewOptions::thesis();
        options.registration = RegistrationOptions::thesis();
        options.motion = IndependentMotionOptions::thesis();
        options.difference = DifferenceOptions::thesis();
        options.clustering = MotionClusteringOptions::thesis();
        options.stacking = StackingOptions::thesis();
        options.detection = DetectionOptions::thesis();
        options.duplicates = DuplicateRemovalOptions::thesis();
        options.outliers = OutlierRemovalOptions::thesis();
        options.tracking = TrackerOptions::thesis();
        options.finishing = FinishingOptions::thesis();
        return options;
    }
    throw Error(ErrorKind::parameter, "there is no preset \"" + name + "\"; built in are: default, thesis");
}

std::vector<std::pair<std::string, std::string>> parameterValues(const ChainOptions& options) {
    ChainOptions copy = options;
    std::vector<std::pair<std::string, std::string>> values;
    for (const auto& parameter : listParameters(describeOf(copy))) values.emplace_back(parameter.name, parameter.value);
    return values;
}

ChainOptions storedOptions(const std::vector<std::pair<std::string, std::string>>& parameters,
                           std::vector<std::string>* unknown) {
    ChainOptions options;
    for (const auto& [name, value] : parameters) {
        if (isOfRecording(name)) continue;
        try {
            setParameter(describeOf(options), name, value);
        } catch (const Error&) {
            if (unknown != nullptr) unknown->push_back(name);
        }
    }
    return options;
}

}  // namespace eyrie

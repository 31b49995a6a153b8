#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "evaluation/evaluate.h"
#include "evaluation/measures/registration_error.h"

namespace eyrie::cli {

/// All that `evaluate` has to say.
struct EvaluationReport {
    std::string ground_truth;  ///< where the truth came from
    std::string result;        ///< where the result came from
    EvaluationOptions options;
    std::vector<Measures> measures;  ///< one for each T_ov
    std::optional<RegistrationError> registration;
    std::vector<std::string> remarks;
};

/// A table for people, one column for each T_ov.
std::string tableText(const EvaluationReport& report);
/// The same as JSON; measures that are not defined are null.
std::string jsonText(const EvaluationReport& report);
/// Adds every measure by its key.
void addMeasures(nlohmann::ordered_json& entry, const Measures& measures);

}  // namespace eyrie::cli

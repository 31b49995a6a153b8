#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "store/sweeps/comparison_store.h"

namespace eyrie::cli {

/// A comparison that a project keeps, for `info --json`: `id`, `made`, `sequence`, and under `figures` what `compare
/// --json` printed; null where that is no JSON.
nlohmann::ordered_json comparisonFacts(const ComparisonRecord& comparison);

/// The same for people: a line per method and T_ov, indented as `info` shows a project's parts.
std::string comparisonText(const nlohmann::ordered_json& facts);

}  // namespace eyrie::cli

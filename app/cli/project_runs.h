#pragma once

#include <optional>
#include <string>

#include "store/runs/run_store.h"

namespace eyrie::cli {

/// "run 2 (thesis)": its number, with its name or what it was made with.
std::string runText(const RunRecord& run);

/// The run that a command works on: number `id`, or the last that has any frame, or the last; says which it takes where
/// nobody chose among several. Throws Error(project)
/// when the project holds no run and Error(parameter), naming those it holds, when there is none of that number.
/// `option` is what names it, for messages.
RunRecord chosenRun(const RunStore& store, const std::string& project, std::optional<int> id,
                    const std::string& option = "--run");

}  // namespace eyrie::cli

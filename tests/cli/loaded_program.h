#pragma once

#include <string>
#include <vector>

#include "support/process.h"

namespace eyrie::test {

/// eyrie-cli with these arguments, in a process of its own that has the program's libraries loaded already: loading
/// them takes most of the time of a short command. What is about the program as a file (signals, streams that are
/// closed, a shell, commands that start themselves again) takes runProcess() and programPath(). Throws
/// std::runtime_error when there is no process to be had.
ProcessResult runLoaded(const std::vector<std::string>& arguments);

}  // namespace eyrie::test

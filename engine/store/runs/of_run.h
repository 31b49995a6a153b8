#pragma once

#include <string>

namespace eyrie {

/// Ends the name of an operation in messages: " of run 3".
inline std::string ofRun(int run_id) {
    return " of run " + std::to_string(run_id);
}

}  // namespace eyrie

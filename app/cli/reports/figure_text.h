#pragma once

#include <cstdio>
#include <string>

namespace eyrie::cli {

/// A number in messages, with no more digits than it needs: "0.25".
inline std::string numberText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

}  // namespace eyrie::cli

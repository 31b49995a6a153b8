#include "core/measure_text.h"

#include <cmath>
#include <cstdio>

namespace eyrie {

std::string numberText(double value) {
    char text[32];
    if (std::abs(value) >= 999.5)  // which rounds to 1000, for which the other would write 1e+03
        std::snprintf(text, sizeof text, "%.0f", value);
    else
        std::snprintf(text, sizeof text, "%.3g", value);
    return text;
}

std::string countText(std::size_t count, const std::string& one, const std::string& many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string pxText(double px, const SceneScale& here) {
    std::string text = numberText(px) + " px";
    if (here.gsd_known) text += " (" + numberText(here.metres(px)) + " m)";
    return text;
}

}  // namespace eyrie

#include "core/values/scene_scale.h"

#include <cstdio>

namespace eyrie {
namespace {

/// Pixels along a car: fewer carry neither corners nor motion, more are larger than any search area.
constexpr double kFewestPixels = 2;
constexpr double kMostPixels = 1000;

bool carCanBeFound(double gsd_m_per_px) {
    const double pixels = kCarLength_m / gsd_m_per_px;
    return pixels >= kFewestPixels && pixels <= kMostPixels;
}

std::string gsdText(double value) {
    char text[32];
    std::snprintf(text, sizeof text, value < 1000 ? "%.3g" : "%.0f", value);  // no powers of ten
    return text;
}

/// "80 cm are 0.8", where centimetres make sense of the number.
std::string inCentimetres(double value) {
    const double metres = value / 100;
    if (value <= 1 || !carCanBeFound(metres)) return {};
    return "; if " + gsdText(value) + " is in cm, give " + gsdText(metres);
}

}  // namespace

std::string whyNotAGsd(double gsd_m_per_px) {
    if (gsd_m_per_px >= kSmallestGsd && gsd_m_per_px <= kLargestGsd) return {};
    return "the ground sampling distance is in metres on the ground per pixel, from " + gsdText(kSmallestGsd) + " to " +
           gsdText(kLargestGsd) + ", e.g. 0.3" + inCentimetres(gsd_m_per_px);
}

std::string doubtOfGsd(double gsd_m_per_px) {
    if (!whyNotAGsd(gsd_m_per_px).empty() || carCanBeFound(gsd_m_per_px)) return {};
    return "at " + gsdText(gsd_m_per_px) + " m/px a car is " + gsdText(kCarLength_m / gsd_m_per_px) + " px long, too " +
           (gsd_m_per_px > 1 ? "short" : "long") +
           " to be found. The ground sampling distance is in metres on the ground per pixel" +
           inCentimetres(gsd_m_per_px);
}

}  // namespace eyrie

#include "core/values/scale_basis.h"

#include <charconv>

namespace eyrie {
namespace {

/// An estimate is no surer than this; digits beyond would claim it.
constexpr int kDigitsOfGuess = 2;
constexpr int kDigitsOfKnown = 4;

/// With a point in every locale.
std::string significant(double value, int digits) {
    char text[32];
    const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, digits);
    return {text, end.ptr};
}

}  // namespace

const char* nameOf(ScaleOrigin origin) {
    switch (origin) {
        case ScaleOrigin::given:
            return "given";
        case ScaleOrigin::metadata:
            return "metadata";
        case ScaleOrigin::estimated:
            return "estimated";
        case ScaleOrigin::assumed:
            return "assumed";
    }
    return "";
}

bool isKnownScale(ScaleOrigin origin) {
    return origin == ScaleOrigin::given || origin == ScaleOrigin::metadata;
}

ScaleBasis basisOf(const SceneScale& scale) {
    ScaleBasis basis;
    if (scale.gsd_known)
        basis.origin = ScaleOrigin::given;
    else if (scale.gsd_m_per_px != SceneScale().gsd_m_per_px)
        basis.origin = ScaleOrigin::estimated;
    return basis;
}

ScaleBasis agreeing(const ScaleBasis& basis, const SceneScale& scale) {
    return isKnownScale(basis.origin) == scale.gsd_known ? basis : basisOf(scale);
}

std::string describe(const ScaleBasis& basis) {
    switch (basis.origin) {
        case ScaleOrigin::given:
            return "as given";
        case ScaleOrigin::metadata:
            return "from the video's metadata";
        case ScaleOrigin::estimated:
            break;
        case ScaleOrigin::assumed:
            return "assumed, may be far off";
    }
    std::string text = "estimated from ";
    if (basis.vehicles > 0)
        text += std::to_string(basis.vehicles) + (basis.vehicles == 1 ? " vehicle" : " vehicles");
    else
        text += "the traffic";
    if (basis.uncertainty) text += ", right to within a factor of " + significant(*basis.uncertainty, kDigitsOfGuess);
    return text;
}

std::string describe(double gsd_m_per_px, const ScaleBasis& basis) {
    const int digits = isKnownScale(basis.origin) ? kDigitsOfKnown : kDigitsOfGuess;
    return significant(gsd_m_per_px, digits) + " m/px, " + describe(basis);
}

std::string describe(const SceneScale& scale, const ScaleBasis& basis, cv::Size picture) {
    if (scale.slope.isFlat()) return describe(scale.gsd_m_per_px, basis);
    const int digits = isKnownScale(basis.origin) ? kDigitsOfKnown : kDigitsOfGuess;
    const auto at = [&](double x, double y) { return significant(scale.at({x, y}).gsd_m_per_px, kDigitsOfGuess); };
    const double middle_x = (picture.width - 1) / 2.0;
    const double middle_y = (picture.height - 1) / 2.0;
    const bool tilted =
        std::abs(scale.slope.down_per_px) * picture.height >= std::abs(scale.slope.right_per_px) * picture.width;
    const std::string edges =
        tilted ? at(middle_x, 0) + " at its upper edge, " + at(middle_x, picture.height - 1) + " at its lower edge"
               : at(0, middle_y) + " at its left edge, " + at(picture.width - 1, middle_y) + " at its right edge";
    // What a person gave may be that of another place.
    const std::string source = basis.origin == ScaleOrigin::given ? "from what was given" : describe(basis);
    return significant(scale.gsd_m_per_px, digits) + " m/px in the middle of an oblique view (" + edges + "), " +
           source;
}

}  // namespace eyrie

#include "removal/removal_wording.h"

#include <algorithm>

#include "core/measure_text.h"

namespace eyrie {
namespace {

/// Per cent; what is rounded up to all would contradict itself.
constexpr double kNearlyAll = 99.9;

std::string sizeText(const RemovalVerdict& verdict, const SceneScale& here) {
    if (verdict.parameter == "outliers.inside_image")
        return numberText(std::min(100 * verdict.value, kNearlyAll)) +
               " % of the box is in the picture, all of it must be";
    const auto size = [&](double value) {
        return verdict.parameter == "outliers.min_area" ? numberText(value) + " px²" : pxText(value, here);
    };
    return size(verdict.value) + (verdict.at_most ? ", at most " : ", at least ") + size(verdict.limit);
}

}  // namespace

std::string textOf(const RemovalVerdict& verdict, const SceneScale& here) {
    if (verdict.rejection == Rejection::duplicate) return "removed as a duplicate of another detection";
    if (verdict.parameter.empty()) return {};
    if (verdict.rejection == Rejection::size) return sizeText(verdict, here);
    const auto count = static_cast<std::size_t>(verdict.value);
    return (verdict.moving_alike
                ? countText(count, "motion vector moves with the box", "motion vectors move with the box")
                : countText(count, "motion vector inside", "motion vectors inside")) +
           ", " + numberText(verdict.limit) + (verdict.limit == 1 ? " is needed" : " are needed");
}

}  // namespace eyrie

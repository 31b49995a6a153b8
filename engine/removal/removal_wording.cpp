#include "removal/removal_wording.h"

#include "core/measure_text.h"

namespace eyrie {
namespace {

std::string sizeText(const RemovalVerdict& verdict, const SceneScale& here) {
    if (verdict.parameter == "outliers.inside_image")
        return numberText(100 * verdict.value) + " % of the box is in the picture, all of it must be";
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
    return countText(static_cast<std::size_t>(verdict.value), "motion vector", "motion vectors") + " inside, " +
           numberText(verdict.limit) + " are needed";
}

}  // namespace eyrie

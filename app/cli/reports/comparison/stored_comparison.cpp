#include "cli/reports/comparison/stored_comparison.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

struct StoredFigure {
    const char* title;
    const char* key;
    const char* format;
};

constexpr std::array kStoredFigures{
    StoredFigure{"T_ov", "overlap", "%.2g"},    StoredFigure{"precision", "precision", "%.3f"},
    StoredFigure{"recall", "recall", "%.3f"},   StoredFigure{"f-score", "f_score", "%.3f"},
    StoredFigure{"N-MODP", "n_modp", "%.3f"},   StoredFigure{"MOTA", "mota", "%.3f"},
    StoredFigure{"IDS", "id_switches", "%.0f"}, StoredFigure{"ms", "ms_per_frame", "%.1f"},
};
constexpr int kFigureWidth = 11;

/// "-" where the method has no such figure.
std::string figureOf(const Json& result, const StoredFigure& figure) {
    const auto value = result.find(figure.key);
    if (value == result.end() || !value->is_number()) return "-";
    char text[64];
    std::snprintf(text, sizeof text, figure.format, value->get<double>());
    return text;
}

std::string methodOf(const Json& result) {
    const auto name = result.find("name");
    return name != result.end() && name->is_string() ? name->get<std::string>() : "?";
}

/// The rows of a report as `compare` writes it; none of any other JSON.
std::vector<Json> resultsOf(const Json& figures) {
    std::vector<Json> rows;
    if (!figures.is_object() || !figures.contains("results")) return rows;
    for (const Json& result : figures["results"])
        if (result.is_object()) rows.push_back(result);
    return rows;
}

std::string atTheRight(const std::string& text) {
    char cell[96];
    std::snprintf(cell, sizeof cell, "%*s", kFigureWidth, text.c_str());
    return cell;
}

}  // namespace

Json comparisonFacts(const ComparisonRecord& comparison) {
    Json figures = Json::parse(comparison.report, nullptr, false);
    if (figures.is_discarded()) figures = nullptr;
    return {{"id", comparison.id},
            {"made", comparison.made_utc},
            {"sequence", comparison.sequence},
            {"figures", std::move(figures)}};
}

std::string comparisonText(const Json& facts) {
    const std::vector<Json> results = resultsOf(facts["figures"]);
    std::string text = "  comparison " + std::to_string(facts["id"].get<int>()) + ": " +
                       facts["sequence"].get<std::string>() + ", " + facts["made"].get<std::string>() + "\n";
    if (results.empty()) return text + "    no figures that can be read\n";
    std::size_t width = 0;
    for (const Json& result : results) width = std::max(width, methodOf(result).size());
    text += "    " + std::string(width, ' ');
    for (const StoredFigure& figure : kStoredFigures) text += atTheRight(figure.title);
    text += "\n";
    for (const Json& result : results) {
        const std::string method = methodOf(result);
        text += "    " + method + std::string(width - method.size(), ' ');
        for (const StoredFigure& figure : kStoredFigures) text += atTheRight(figureOf(result, figure));
        text += "\n";
    }
    return text;
}

}  // namespace eyrie::cli

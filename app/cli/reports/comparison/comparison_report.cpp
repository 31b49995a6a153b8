#include "cli/reports/comparison/comparison_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "cli/reports/evaluation_text.h"
#include "evaluation/comparison/published_figures.h"

namespace eyrie::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kSmallestName = 24;

std::string number(const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    return text;
}

std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string left(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, text.size()), ' ');
}

/// A measure of the tables, by its key in listMeasures().
struct MeasureColumn {
    const char* title;
    const char* key;
    std::size_t width;
    int decimals;
};

constexpr std::array kColumns{
    MeasureColumn{"TP", "tp", 7, 0},
    MeasureColumn{"FP", "fp", 7, 0},
    MeasureColumn{"FN", "fn", 7, 0},
    MeasureColumn{"precision", "precision", 10, 3},
    MeasureColumn{"recall", "recall", 8, 3},
    MeasureColumn{"f-score", "f_score", 8, 3},
    MeasureColumn{"N-MODA", "n_moda", 8, 3},
    MeasureColumn{"N-MODP", "n_modp", 8, 3},
    MeasureColumn{"MOTA", "mota", 8, 3},
    MeasureColumn{"MOTP", "motp", 8, 3},
    MeasureColumn{"IDS", "id_switches", 6, 0},
    MeasureColumn{"MT", "mostly_tracked", 5, 0},
    MeasureColumn{"PT", "partially_tracked", 5, 0},
    MeasureColumn{"MLT", "mostly_lost", 5, 0},
    MeasureColumn{"FM", "fragments", 5, 0},
};

/// Empty where the result has no such measure.
std::optional<double> valueOf(const MeasureColumn& column, const Measures& measures) {
    for (const NamedMeasure& measure : listMeasures(measures))
        if (measure.key == column.key) return measure.value;
    return std::nullopt;
}

std::string valueText(const MeasureColumn& column, const Measures& measures) {
    const std::optional<double> value = valueOf(column, measures);
    if (!value) return "-";
    return column.decimals == 0 ? number("%.0f", *value) : number("%.3f", *value);
}

std::string intervalText(const BootstrapInterval& interval) {
    return number("%+.3f", interval.value) + " [" + number("%+.3f", interval.low) + ", " +
           number("%+.3f", interval.high) + "]";
}

void addBlock(std::string& text, const std::vector<ComparisonRow>& rows) {
    std::size_t width = kSmallestName;
    for (const ComparisonRow& row : rows) width = std::max(width, row.name().size() + 1);
    text += '\n';
    text += left("T_ov " + number("%g", rows.front().measures.overlap), width);
    for (const MeasureColumn& column : kColumns) text += right(column.title, column.width);
    text += right("ms", 8) + "\n";
    for (const ComparisonRow& row : rows) {
        text += left(row.name(), width);
        for (const MeasureColumn& column : kColumns) text += right(valueText(column, row.measures), column.width);
        text += right(number("%.1f", row.ms_per_frame), 8) + "\n";
    }
    if (rows.size() < 2) return;
    text += '\n';
    text += left("difference", width + 2) + left("f-score [95 %]", 28) + left("MOTA [95 %]", 28) + "to\n";
    for (const ComparisonRow& row : rows) {
        if (!row.difference) continue;
        text += left(row.name(), width + 2);
        text += left(intervalText(row.difference->f_score), 28);
        text += left(row.difference->mota ? intervalText(*row.difference->mota) : "-", 28);
        text += row.compared_with + "\n";
    }
}

Json jsonOf(const BootstrapInterval& interval) {
    return {{"value", interval.value}, {"low", interval.low}, {"high", interval.high}};
}

Json publishedJson(const std::string& sequence) {
    const auto orNull = [](const auto& value) { return value ? Json(*value) : Json(); };
    Json rows = Json::array();
    for (const PublishedFigures& row : publishedFigures(sequence)) {
        rows.push_back({{"name", row.method},
                        {"source", row.source},
                        {"overlap", kPublishedOverlap},
                        {"tp", orNull(row.true_positives)},
                        {"fp", orNull(row.false_positives)},
                        {"fn", orNull(row.false_negatives)},
                        {"precision", row.precision},
                        {"recall", row.recall},
                        {"f_score", row.f_score},
                        {"n_moda", orNull(row.n_moda)},
                        {"n_modp", orNull(row.n_modp)},
                        {"mota", orNull(row.mota)},
                        {"motp", orNull(row.motp)},
                        {"mostly_tracked", orNull(row.mostly_tracked)},
                        {"partially_tracked", orNull(row.partially_tracked)},
                        {"mostly_lost", orNull(row.mostly_lost)},
                        {"fragments", orNull(row.fragments)}});
    }
    return rows;
}

}  // namespace

std::string ComparisonRow::name() const {
    return method + (stacking ? " + stacking" : "") + (tracking ? " + tracking" : "");
}

std::string tableText(const ComparisonReport& report) {
    std::string text = "Sequence      " + report.sequence + ", " + std::to_string(report.frames) + " frames\n";
    text += "Ground truth  " + report.ground_truth + "\n";
    text +=
        std::string("Compared      ") + (report.options.upright ? "enclosing upright boxes" : "oriented boxes") +
        countedText(report.options) +
        (report.options.border ? ", without results within " + number("%g", *report.options.border) + " px of the edge"
                               : "") +
        "\n";
    for (const auto& rows : report.blocks) {
        if (!rows.empty()) addBlock(text, rows);
    }
    if (!report.remarks.empty()) text += "\n";
    for (const std::string& remark : report.remarks) text += "Note: " + remark + "\n";
    if (!report.published.empty()) text += "\n" + publishedText(report.published);
    return text;
}

std::string csvText(const ComparisonReport& report) {
    std::string text = "method,stacking,tracking,overlap";
    for (const MeasureColumn& column : kColumns) text += std::string(",") + column.key;
    text +=
        ",ms_per_frame,f_score_low,f_score_high,f_score_difference,f_score_difference_low,f_score_difference_high,"
        "mota_difference,mota_difference_low,mota_difference_high\n";
    const auto interval = [](const BootstrapInterval& i) {
        return number(",%.6g", i.value) + number(",%.6g", i.low) + number(",%.6g", i.high);
    };
    for (const auto& rows : report.blocks) {
        for (const ComparisonRow& row : rows) {
            text += row.method + (row.stacking ? ",1" : ",0") + (row.tracking ? ",1" : ",0") +
                    number(",%g", row.measures.overlap);
            for (const MeasureColumn& column : kColumns) {
                const std::optional<double> value = valueOf(column, row.measures);
                text += value ? number(",%.6g", *value) : ",";
            }
            text += number(",%.3f", row.ms_per_frame) + number(",%.6g", row.f_score.low) +
                    number(",%.6g", row.f_score.high);
            text += row.difference ? interval(row.difference->f_score) : ",,,";
            text += row.difference && row.difference->mota ? interval(*row.difference->mota) : ",,,";
            text += "\n";
        }
    }
    return text;
}

std::string jsonText(const ComparisonReport& report) {
    Json json{{"sequence", report.sequence},
              {"ground_truth", report.ground_truth},
              {"frames", report.frames},
              {"upright", report.options.upright},
              {"vehicles_only", report.options.vehicles_only},
              {"classes", wordOfScored(report.options.one_class)}};
    json["border_px"] = report.options.border ? Json(*report.options.border) : Json();
    json["results"] = Json::array();
    for (const auto& rows : report.blocks) {
        for (const ComparisonRow& row : rows) {
            Json entry{{"name", row.name()},
                       {"method", row.method},
                       {"stacking", row.stacking},
                       {"tracking", row.tracking},
                       {"overlap", row.measures.overlap},
                       {"ms_per_frame", row.ms_per_frame}};
            addMeasures(entry, row.measures);
            entry["f_score_interval"] = jsonOf(row.f_score);
            if (row.difference) {
                Json difference{{"to", row.compared_with}, {"f_score", jsonOf(row.difference->f_score)}};
                if (row.difference->mota) difference["mota"] = jsonOf(*row.difference->mota);
                entry["difference"] = difference;
            }
            json["results"].push_back(std::move(entry));
        }
    }
    json["remarks"] = report.remarks;
    if (!report.published.empty()) json["published"] = publishedJson(report.published);
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace eyrie::cli

#include "sweep/results/sweep_report.h"

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/text.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

std::string padded(const std::string& text, std::size_t width) {
    return std::string(width > text.size() ? width - text.size() : 0, ' ') + text;
}

std::string cell(const std::optional<double>& value, int decimals) {
    if (!value) return "-";
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals, *value);
    return text;
}

/// A column of the table for one parameter.
struct Column {
    std::string title;
    SweepCriterion what;
};

std::vector<Column> columnsFor(const SweepPlan& plan, const SweepCriterion& criterion) {
    std::vector<Column> columns;
    const auto add = [&](const std::string& title, const std::string& key, bool tracks, double overlap) {
        columns.push_back({title, {key, tracks, overlap, criterion.clip}});
    };
    for (const double overlap : plan.overlaps) {
        const std::string at = std::string("@") + shortestText(overlap);
        add("prec" + at, "precision", criterion.tracks, overlap);
        add("rec" + at, "recall", criterion.tracks, overlap);
        add("f" + at, "f_score", criterion.tracks, overlap);
    }
    const double first = plan.overlaps.front();
    add("MOTA@" + shortestText(first), "mota", true, first);
    add("IDF1@" + shortestText(first), "idf1", true, first);
    add("HOTA", "hota", true, first);
    return columns;
}

std::string curveText(const SweepTable& table, const SweepCriterion& criterion) {
    const SweepAxis& axis = table.plan.axes.front();
    std::size_t width = axis.name.size();
    for (const std::string& value : axis.values) width = std::max(width, value.size());
    const std::vector<Column> columns = columnsFor(table.plan, criterion);
    std::string text = axis.name + std::string(width - axis.name.size(), ' ');
    for (const Column& column : columns) text += padded(column.title, 11);
    text += '\n';
    for (int i = 0; i < table.plan.pointCount(); ++i) {
        const std::string& value = axis.values[static_cast<std::size_t>(i)];
        text += value + std::string(width - value.size(), ' ');
        for (const Column& column : columns) text += padded(cell(valueAt(table, i, column.what), 4), 11);
        text += table.points.contains(i) ? "\n" : "   not done\n";
    }
    return text;
}

std::string gridText(const SweepTable& table, const SweepCriterion& criterion) {
    const SweepAxis& rows = table.plan.axes[0];
    const SweepAxis& columns = table.plan.axes[1];
    const int decimals = measureText(criterion.key).decimals;
    std::size_t width = 8;
    for (const std::string& value : rows.values) width = std::max(width, value.size());
    std::string text = rows.name + " down, " + columns.name + " across\n" + std::string(width, ' ');
    for (const std::string& value : columns.values) text += padded(value, std::max<std::size_t>(9, value.size() + 2));
    text += '\n';
    for (std::size_t r = 0; r < rows.values.size(); ++r) {
        text += padded(rows.values[r], width);
        for (std::size_t c = 0; c < columns.values.size(); ++c) {
            const int position = table.plan.positionOf({static_cast<int>(r), static_cast<int>(c)});
            text += padded(cell(valueAt(table, position, criterion), decimals),
                           std::max<std::size_t>(9, columns.values[c].size() + 2));
        }
        text += '\n';
    }
    return text;
}

}  // namespace

std::string bestText(const SweepTable& table, const SweepCriterion& criterion) {
    const auto best = bestPoint(table, criterion);
    if (!best) return "no point has a " + describe(criterion, table.plan) + " yet\n";
    const int decimals = measureText(criterion.key).decimals;
    std::string text = "best " + describe(criterion, table.plan) + ": " + cell(best->value, decimals) + " at " +
                       table.plan.describe(best->position) + "\nwithin " + shortestText(kUsualTolerance * 100) +
                       " % of it:";
    for (std::size_t a = 0; a < table.plan.axes.size(); ++a) {
        const SweepAxis& axis = table.plan.axes[a];
        const auto [first, last] = best->neighbourhood[a];
        text += (a > 0 ? ", " : " ") + axis.name + " " + axis.values[static_cast<std::size_t>(first)];
        if (last > first) text += " to " + axis.values[static_cast<std::size_t>(last)];
    }
    return text + "\n";
}

std::string tableText(const SweepTable& table, const SweepCriterion& criterion) {
    std::string text;
    if (table.plan.axes.size() == 1) {
        text = (criterion.tracks ? "tracks" : "detections");
        text += table.plan.clips.size() > 1 ? ", mean over the sequences\n" : "\n";
        text += curveText(table, criterion);
    } else {
        text = describe(criterion, table.plan) + "\n" + gridText(table, criterion);
    }
    text += "\n" + bestText(table, criterion);
    const std::size_t done = table.points.size();
    const auto planned = static_cast<std::size_t>(table.plan.pointCount());
    if (done < planned) text += std::to_string(done) + " of " + std::to_string(planned) + " points are done\n";
    return text;
}

std::string csvText(const SweepTable& table) {
    std::string text;
    for (const SweepAxis& axis : table.plan.axes) text.append(axis.name).append(",");
    text += "sequence,of,overlap";
    for (const MeasureText& measure : sweepMeasures()) text.append(",").append(measure.key);
    text += '\n';
    for (const auto& [position, figures] : table.points) {
        for (const SweepFigures& one : figures) {
            for (const std::string& value : table.plan.valuesOf(position)) text += csvField(value) + ",";
            text += csvField(displayText(table.plan.clips.at(static_cast<std::size_t>(one.clip)).sequence));
            text += one.tracks ? ",tracks," : ",detections,";
            text += shortestText(one.overlap);
            for (const MeasureText& measure : sweepMeasures()) {
                const auto value = one.at(measure.key);
                text += ',';
                if (value) text += shortestText(*value);
            }
            text += '\n';
        }
    }
    return text;
}

std::string jsonText(const SweepTable& table, const SweepCriterion& criterion) {
    nlohmann::ordered_json json;
    json["plan"] = nlohmann::ordered_json::parse(textOf(table.plan));
    json["points_planned"] = table.plan.pointCount();
    json["points_done"] = table.points.size();
    for (const auto& [position, figures] : table.points) {
        nlohmann::ordered_json point;
        const std::vector<std::string> values = table.plan.valuesOf(position);
        for (std::size_t a = 0; a < values.size(); ++a) point["values"][table.plan.axes[a].name] = values[a];
        point["figures"] = nlohmann::ordered_json::parse(textOf(figures));
        json["points"].push_back(std::move(point));
    }
    if (const auto best = bestPoint(table, criterion)) {
        json["best"]["criterion"] = describe(criterion, table.plan);
        json["best"]["value"] = best->value;
        const std::vector<std::string> values = table.plan.valuesOf(best->position);
        for (std::size_t a = 0; a < values.size(); ++a) {
            const SweepAxis& axis = table.plan.axes[a];
            json["best"]["values"][axis.name] = values[a];
            json["best"]["neighbourhood"][axis.name] = {
                axis.values[static_cast<std::size_t>(best->neighbourhood[a].first)],
                axis.values[static_cast<std::size_t>(best->neighbourhood[a].second)]};
        }
    }
    if (table.plan.axes.size() == 1) {
        for (const double overlap : table.plan.overlaps) {
            const TradeOffCurve curve = tradeOff(table, criterion.tracks, overlap);
            nlohmann::ordered_json entry{{"overlap", overlap},
                                         {"area", curve.precision_recall_area},
                                         {"points", nlohmann::ordered_json::array()}};
            for (const TradeOffPoint& point : curve.points) {
                entry["points"].push_back({{"value", table.plan.valuesOf(point.position).front()},
                                           {"recall", point.recall},
                                           {"precision", point.precision},
                                           {"fp_per_frame", point.false_per_frame}});
            }
            json["precision_recall"].push_back(std::move(entry));
        }
    }
    return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

}  // namespace eyrie

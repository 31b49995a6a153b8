#include "tune/sweep/sweep_views.h"

#include <QLocale>
#include <QObject>
#include <algorithm>
#include <cmath>

#include "io/tables/number_text.h"

namespace eyrie::ui {

namespace {

QString valueText(const std::string& value) {
    return QString::fromStdString(value);
}

QString axisLabel(const std::string& name, const std::function<QString(const std::string&)>& unit_of) {
    const QString unit = unit_of(name);
    return unit.isEmpty() ? valueText(name) : QObject::tr("%1 (%2)").arg(valueText(name), unit);
}

/// The values of an axis as numbers, or 0, 1, 2 … where one of them is a word.
std::vector<double> placesOf(const SweepAxis& axis, QStringList& words) {
    std::vector<double> places;
    for (const std::string& value : axis.values) {
        const auto number = parseReal(value);
        if (!number) {
            words.clear();
            for (const std::string& word : axis.values) words << valueText(word);
            places.clear();
            for (std::size_t i = 0; i < axis.values.size(); ++i) places.push_back(static_cast<double>(i));
            return places;
        }
        places.push_back(*number);
    }
    return places;
}

QString overlapName(double overlap) {
    return QObject::tr("T_ov %1").arg(QString::number(overlap));
}

/// A measure along the first axis; ascending places.
SweepChartData::Series curveOf(const SweepTable& table, const SweepCriterion& criterion,
                               const std::vector<double>& places, const QString& name, int colour, bool bold) {
    SweepChartData::Series series{name, colour, bold, {}, {}, {}};
    std::vector<std::size_t> order(places.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return places[a] < places[b]; });
    for (const std::size_t i : order) {
        const auto value = valueAt(table, static_cast<int>(i), criterion);
        if (!value) continue;
        series.x.push_back(places[i]);
        series.y.push_back(*value);
        series.positions.push_back(static_cast<int>(i));
    }
    return series;
}

void markBest(SweepChartData& data, const SweepTable& table, const SweepCriterion& criterion,
              const std::vector<double>& places, bool with_mark) {
    const auto best = bestPoint(table, criterion);
    if (!best) return;
    const auto [first, last] = best->neighbourhood.front();
    const double a = places[static_cast<std::size_t>(first)];
    const double b = places[static_cast<std::size_t>(last)];
    data.band = std::make_pair(std::min(a, b), std::max(a, b));
    if (with_mark) data.best.emplace_back(places[static_cast<std::size_t>(best->position)], best->value);
}

SweepChartData mapOf(const SweepTable& table, const SweepCriterion& criterion,
                     const std::function<QString(const std::string&)>& unit_of) {
    SweepChartData data;
    const SweepAxis& down = table.plan.axes[0];
    const SweepAxis& across = table.plan.axes[1];
    data.y_label = axisLabel(down.name, unit_of);
    data.x_label = axisLabel(across.name, unit_of);
    for (const std::string& value : down.values) data.rows << valueText(value);
    for (const std::string& value : across.values) data.columns << valueText(value);
    data.value_label = valueText(measureText(criterion.key).label);
    data.decimals = measureText(criterion.key).decimals;
    for (int position = 0; position < table.plan.pointCount(); ++position)
        data.cells.push_back(valueAt(table, position, criterion).value_or(std::nan("")));
    if (const auto best = bestPoint(table, criterion)) {
        const std::vector<int> indices = table.plan.indicesOf(best->position);
        data.best_cell = std::make_pair(indices[0], indices[1]);
        data.best_rows_columns = std::make_pair(best->neighbourhood[0], best->neighbourhood[1]);
    }
    return data;
}

SweepChartData tradeOffOf(const SweepTable& table, SweepView view, const SweepCriterion& criterion) {
    SweepChartData data;
    data.share = true;
    const bool alarms = view == SweepView::false_alarms;
    data.x_label = alarms ? QObject::tr("false alarms per frame") : QObject::tr("recall");
    data.y_label = alarms ? QObject::tr("recall") : QObject::tr("precision");
    const bool one_overlap = criterion.overlap || table.plan.axes.size() == 2;
    if (one_overlap)
        data.y_label += QObject::tr(" at %1").arg(overlapName(criterion.overlap.value_or(table.plan.overlaps.front())));
    int colour = 0;
    const int others = table.plan.axes.size() == 2 ? static_cast<int>(table.plan.axes[1].values.size()) : 1;
    const auto add = [&](const QString& name, double overlap, int other) {
        SweepChartData::Series series{name, colour++, false, {}, {}, {}};
        for (const TradeOffPoint& point : tradeOff(table, criterion.tracks, overlap, other).points) {
            series.x.push_back(alarms ? point.false_per_frame : point.recall);
            series.y.push_back(alarms ? point.recall : point.precision);
            series.positions.push_back(point.position);
        }
        data.series.push_back(std::move(series));
    };
    if (others > 1) {
        // A line for each value of the second parameter, as fig. 7.8 has one for each T_dov.
        const double overlap = criterion.overlap.value_or(table.plan.overlaps.front());
        const std::string& name = table.plan.axes[1].name;
        const QString short_name = valueText(name.substr(name.find('.') + 1));
        for (int other = 0; other < others; ++other) {
            const QString value = valueText(table.plan.axes[1].values[static_cast<std::size_t>(other)]);
            add(other == 0 ? short_name + QLatin1Char(' ') + value : value, overlap, other);
        }
    } else {
        for (const double overlap : table.plan.overlaps) {
            if (!criterion.overlap || *criterion.overlap == overlap) add(overlapName(overlap), overlap, 0);
        }
    }
    if (const auto best = bestPoint(table, criterion)) {
        for (const SweepChartData::Series& series : data.series) {
            for (std::size_t i = 0; i < series.positions.size(); ++i) {
                if (series.positions[i] == best->position) data.best.emplace_back(series.x[i], series.y[i]);
            }
        }
    }
    return data;
}

}  // namespace

SweepChartData chartOf(const SweepTable& table, SweepView view, const SweepCriterion& criterion,
                       const std::function<QString(const std::string&)>& unit_of) {
    if (view == SweepView::trade_off || view == SweepView::false_alarms) return tradeOffOf(table, view, criterion);
    if (table.plan.axes.size() == 2) return mapOf(table, criterion, unit_of);
    SweepChartData data;
    const SweepAxis& axis = table.plan.axes.front();
    const std::vector<double> places = placesOf(axis, data.x_words);
    data.x_label = axisLabel(axis.name, unit_of);
    if (view == SweepView::precision_recall) {
        data.share = true;
        data.y_label = QObject::tr("share");
        int colour = 0;
        for (const char* key : {"precision", "recall", "f_score"}) {
            SweepCriterion one = criterion;
            one.key = key;
            data.series.push_back(curveOf(table, one, places, valueText(measureText(key).label), colour++, false));
        }
        data.series.back().bold = true;
        SweepCriterion f_score = criterion;
        f_score.key = "f_score";
        markBest(data, table, f_score, places, true);
        return data;
    }
    const MeasureText& measure = measureText(criterion.key);
    data.y_label = valueText(measure.label);
    data.decimals = measure.decimals;
    data.share = measure.decimals == 4;
    int colour = 0;
    for (const double overlap : table.plan.overlaps) {
        SweepCriterion one = criterion;
        one.overlap = overlap;
        const bool chosen = criterion.overlap && *criterion.overlap == overlap;
        data.series.push_back(curveOf(table, one, places, overlapName(overlap), colour++, chosen));
    }
    if (!criterion.overlap && table.plan.overlaps.size() > 1)
        data.series.push_back(curveOf(table, criterion, places, QObject::tr("mean"), colour, true));
    markBest(data, table, criterion, places, true);
    return data;
}

QString pointText(const SweepTable& table, int position, const SweepCriterion& criterion) {
    const auto value = valueAt(table, position, criterion);
    const QString shown =
        value ? QLocale::c().toString(*value, 'f', measureText(criterion.key).decimals) : QObject::tr("not computed");
    return QObject::tr("<b>%1</b>: %2").arg(valueText(table.plan.describe(position)).toHtmlEscaped(), shown);
}

QString bestPointText(const SweepTable& table, const SweepCriterion& criterion) {
    const auto best = bestPoint(table, criterion);
    if (!best) return QObject::tr("No point has this measure yet.");
    QStringList reach;
    for (std::size_t a = 0; a < table.plan.axes.size(); ++a) {
        const SweepAxis& axis = table.plan.axes[a];
        const auto [first, last] = best->neighbourhood[a];
        const QString from = valueText(axis.values[static_cast<std::size_t>(first)]);
        const QString to = valueText(axis.values[static_cast<std::size_t>(last)]);
        reach << (first == last ? QObject::tr("%1 %2 only").arg(valueText(axis.name), from)
                                : QObject::tr("%1 %2 to %3").arg(valueText(axis.name), from, to));
    }
    return QObject::tr("Best %1, %2. Within 1 % of it: %3.")
        .arg(pointText(table, best->position, criterion), valueText(describe(criterion, table.plan)),
             reach.join(QStringLiteral(", ")));
}

}  // namespace eyrie::ui

#include "canvas/timeline/timeline_kinds.h"

#include <QCoreApplication>
#include <QStringList>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "widgets/theme_colours.h"

namespace eyrie::ui {

namespace {

QString timelineKindsText(const char* text) {
    return QCoreApplication::translate("TimelineKinds", text);
}

TimelineKinds::Bar barOf(const TimelineHappening& happening, const TimelineAxis& axis) {
    const double from = std::floor(axis.xOf(happening.first));
    return {from, std::max(from + TimelineKinds::kLeastBar, std::floor(axis.xOf(happening.last + 1)))};
}

/// How far x is from a bar, px; 0 on it.
double distanceTo(const TimelineKinds::Bar& bar, double x) {
    return std::max({0.0, bar.first - x, x - bar.second});
}

}  // namespace

std::vector<QRectF> filledParts(BarShape shape, const QRectF& bar) {
    const double half = bar.height() / 2;
    const double edge = bar.height() / 4;
    switch (shape) {
        case BarShape::full_height:
            break;
        case BarShape::upper_half:
            return {bar.adjusted(0, 0, 0, -half)};
        case BarShape::lower_half:
            return {bar.adjusted(0, half, 0, 0)};
        case BarShape::edges:
            return {bar.adjusted(0, 0, 0, edge - bar.height()), bar.adjusted(0, bar.height() - edge, 0, 0)};
    }
    return {bar};
}

TimelineKinds::TimelineKinds(std::vector<TimelineKind> kinds) {
    std::erase_if(kinds, [](const TimelineKind& kind) { return kind.happenings.empty(); });
    // What is rare is what one looks for: it has a row of its own.
    std::vector<std::size_t> by_count(kinds.size());
    std::iota(by_count.begin(), by_count.end(), std::size_t{0});
    std::stable_sort(by_count.begin(), by_count.end(), [&](std::size_t a, std::size_t b) {
        return kinds[a].happenings.size() < kinds[b].happenings.size();
    });
    const std::size_t alone = kinds.size() <= kMostRows ? kinds.size() : kMostRows - 1;
    std::vector<bool> is_alone(kinds.size(), false);
    for (std::size_t i = 0; i < alone; ++i) is_alone[by_count[i]] = true;
    Row others;
    for (std::size_t i = 0; i < kinds.size(); ++i)
        add(is_alone[i] ? rows_.emplace_back() : others, std::move(kinds[i]));
    if (!others.names.empty()) rows_.push_back(std::move(others));
    for (Row& row : rows_)
        std::stable_sort(row.entries.begin(), row.entries.end(),
                         [](const Entry& a, const Entry& b) { return a.happening.first < b.happening.first; });
}

void TimelineKinds::add(Row& row, TimelineKind kind) {
    for (const TimelineHappening& happening : kind.happenings) row.entries.push_back({happening, row.names.size()});
    row.counts.push_back(static_cast<int>(kind.happenings.size()));
    const bool alone = row.names.empty();
    row.on_light = alone ? kind.on_light : QColor();
    row.on_dark = alone ? kind.on_dark : QColor();
    row.shape = alone ? kind.shape : BarShape::full_height;
    row.names.push_back(std::move(kind.name));
}

std::optional<int> TimelineKinds::rowAt(double y) const {
    const int row = static_cast<int>(std::floor(y / kRowStep));
    return y >= 0 && row < rowCount() ? std::optional(row) : std::nullopt;
}

QString TimelineKinds::nameOf(int row) const {
    const auto& names = at(row).names;
    return names.size() == 1
               ? names.front()
               : timelineKindsText(QT_TRANSLATE_NOOP("TimelineKinds", "%1 other kinds")).arg(names.size());
}

QColor TimelineKinds::colourOf(int row, const QPalette& palette) const {
    const QColor& colour = isDark(palette) ? at(row).on_dark : at(row).on_light;
    return colour.isValid() ? colour : quietText(palette);
}

std::vector<TimelineKinds::Bar> TimelineKinds::bars(int row, const TimelineAxis& axis) const {
    std::vector<Bar> bars;
    const FrameIndex first = axis.firstVisible(), last = axis.lastVisible();
    for (const Entry& entry : at(row).entries) {
        if (entry.happening.first > last) break;
        if (entry.happening.last < first) continue;
        Bar bar = barOf(entry.happening, axis);
        bar.first = std::max(bar.first, axis.left());
        bar.second = std::min(bar.second, axis.right());
        if (!bars.empty() && bar.first <= bars.back().second)
            bars.back().second = std::max(bars.back().second, bar.second);
        else
            bars.push_back(bar);
    }
    return bars;
}

QString TimelineKinds::textAt(int row, double x, const TimelineAxis& axis, double reach) const {
    const Row& shown = at(row);
    std::vector<int> here(shown.names.size(), 0);
    for (const Entry& entry : shown.entries)
        if (distanceTo(barOf(entry.happening, axis), x) <= reach) ++here[entry.kind];
    QStringList lines;
    for (std::size_t kind = 0; kind < here.size(); ++kind)
        if (here[kind] > 0 || shown.names.size() == 1)
            lines << timelineKindsText(QT_TRANSLATE_NOOP("TimelineKinds", "%1: %2 here, %3 in all"))
                         .arg(shown.names[kind])
                         .arg(here[kind])
                         .arg(shown.counts[kind]);
    if (lines.isEmpty()) {
        QStringList names;
        for (const QString& name : shown.names) names << name;
        lines << QStringLiteral("%1: %2").arg(nameOf(row), names.join(QStringLiteral(", ")));
    }
    return lines.join(QLatin1Char('\n'));
}

std::optional<int> TimelineKinds::nearest(int row, double x, const TimelineAxis& axis, double reach) const {
    std::optional<int> best;
    double best_far = reach;
    for (const Entry& entry : at(row).entries) {
        const double far = distanceTo(barOf(entry.happening, axis), x);
        if (far > best_far) continue;
        best = entry.happening.id;
        best_far = far;
    }
    return best;
}

std::optional<std::pair<int, TimelineHappening>> TimelineKinds::find(int id) const {
    for (int row = 0; row < rowCount(); ++row)
        for (const Entry& entry : at(row).entries)
            if (entry.happening.id == id) return std::pair(row, entry.happening);
    return std::nullopt;
}

}  // namespace eyrie::ui

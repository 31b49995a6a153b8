#include "widgets/charts/stage_times_data.h"

#include <QCoreApplication>
#include <QLocale>
#include <algorithm>
#include <cmath>

namespace eyrie::ui {
namespace {

constexpr double kShareInsideAxis = 0.98;
constexpr double kBarHeadroom = 1.2;
constexpr std::size_t kStagesDescribed = 4;

/// The value that `share` of all lie at or below; 0 of none.
double quantile(std::vector<double> values, double share) {
    if (values.empty()) return 0;
    const auto place = static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), values.begin() + place, values.end());
    return values[static_cast<std::size_t>(place)];
}

QString milliseconds(double value) {
    return QLocale().toString(value, 'f', value < 10 ? 2 : 1);
}

}  // namespace

QString shownName(Stage stage) {
    return QCoreApplication::translate("Stage", nameOf(stage));
}

void StageTimesData::clear() {
    *this = {};
}

void StageTimesData::append(const FrameSummary& frame) {
    if (!frames_.empty() && frame.frame <= frames_.back().frame) return;
    Entry entry{frame.frame, {}};
    double top = 0;
    for (std::size_t stage = 0; stage < frame.stage_ms.size(); ++stage) {
        const double ms = static_cast<double>(frame.stage_ms[stage]);
        if (std::isfinite(ms) && ms > 0) {
            top += ms;
            used_[stage] = true;
        }
        entry.tops[stage] = top;
    }
    frames_.push_back(entry);
}

double StageTimesData::stageAt(std::size_t position, Stage stage) const {
    const auto index = static_cast<std::size_t>(stage);
    const Tops& tops = frames_[position].tops;
    return index == 0 ? tops[0] : tops[index] - tops[index - 1];
}

double StageTimesData::median(Stage stage) const {
    std::vector<double> times;
    for (std::size_t i = 0; i < size(); ++i) times.push_back(stageAt(i, stage));
    return quantile(std::move(times), 0.5);
}

double StageTimesData::axisMaximum() const {
    std::vector<double> totals;
    for (std::size_t i = 0; i < size(); ++i) totals.push_back(totalAt(i));
    return std::max(1.0, quantile(std::move(totals), kShareInsideAxis) * kBarHeadroom);
}

std::optional<std::size_t> StageTimesData::positionOf(FrameIndex frame) const {
    const auto after = std::upper_bound(frames_.begin(), frames_.end(), frame,
                                        [](FrameIndex value, const Entry& entry) { return value < entry.frame; });
    if (after == frames_.begin()) return std::nullopt;
    return static_cast<std::size_t>(after - frames_.begin()) - 1;
}

std::vector<StageTimesData::Bin> StageTimesData::bins(FrameIndex first, FrameIndex last, std::size_t most) const {
    if (frames_.empty()) return {};
    const std::size_t from = positionOf(first - 1).value_or(0);
    const std::size_t to = std::min(positionOf(last).value_or(0) + 2, frames_.size());
    const std::size_t count = to - std::min(from, to);
    const std::size_t per_bin = (count + std::max<std::size_t>(most, 1) - 1) / std::max<std::size_t>(most, 1);
    std::vector<Bin> bins;
    // Bins begin at multiples of their size, so that they stay as they are while a run grows.
    for (std::size_t at = from; at < to;) {
        const std::size_t end = std::min(to, (at / per_bin + 1) * per_bin);
        const auto members = static_cast<double>(end - at);
        Bin bin;
        bin.frame = 0.5 * (frames_[at].frame + frames_[end - 1].frame);
        for (; at < end; ++at) {
            for (std::size_t stage = 0; stage < bin.tops.size(); ++stage) {
                bin.tops[stage] += frames_[at].tops[stage] / members;
            }
            bin.peak = std::max(bin.peak, frames_[at].tops.back());
        }
        bins.push_back(bin);
    }
    return bins;
}

QString StageTimesData::describe(std::size_t position) const {
    std::vector<Stage> stages;
    for (int i = 0; i < kStageCount; ++i) {
        if (stageAt(position, static_cast<Stage>(i)) > 0) stages.push_back(static_cast<Stage>(i));
    }
    std::stable_sort(stages.begin(), stages.end(),
                     [&](Stage a, Stage b) { return stageAt(position, a) > stageAt(position, b); });
    QString text = QCoreApplication::translate("StageTimesChart", "frame %1: %2 ms")
                       .arg(frameAt(position))
                       .arg(milliseconds(totalAt(position)));
    for (std::size_t i = 0; i < std::min(stages.size(), kStagesDescribed); ++i) {
        text += QStringLiteral(" · %1 %2").arg(shownName(stages[i]), milliseconds(stageAt(position, stages[i])));
    }
    return text;
}

QString StageTimesData::text() const {
    QString text = QStringLiteral("frame");
    for (int i = 0; i < kStageCount; ++i) {
        if (isUsed(static_cast<Stage>(i))) text += QStringLiteral("\t%1 (ms)").arg(shownName(static_cast<Stage>(i)));
    }
    text += QStringLiteral("\tsum (ms)\n");
    for (std::size_t position = 0; position < size(); ++position) {
        text += QString::number(frameAt(position));
        for (int i = 0; i < kStageCount; ++i) {
            const auto stage = static_cast<Stage>(i);
            if (isUsed(stage)) text += QLatin1Char('\t') + QString::number(stageAt(position, stage), 'f', 3);
        }
        text += QLatin1Char('\t') + QString::number(totalAt(position), 'f', 3) + QLatin1Char('\n');
    }
    return text;
}

}  // namespace eyrie::ui

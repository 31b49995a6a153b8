#include "tune/evaluate/evaluation_wording.h"

#include <QObject>
#include <QStringList>
#include <algorithm>
#include <limits>

#include "widgets/display_text.h"

namespace eyrie::ui {

namespace {

QString spanText(const BootstrapInterval& interval) {
    return QObject::tr("%1 (%2 to %3)")
        .arg(numberText(interval.value, 3), numberText(interval.low, 3), numberText(interval.high, 3));
}

QString differenceLine(const QString& measure, const BootstrapInterval& difference, const RunRecord& other) {
    const QString sign = difference.value >= 0 ? QStringLiteral("+") : QString();
    const QString numbers =
        QObject::tr("%1%2 (%3 to %4)")
            .arg(sign, numberText(difference.value, 3), numberText(difference.low, 3), numberText(difference.high, 3));
    const bool real = difference.low > 0 || difference.high < 0;
    if (!real)
        return QObject::tr("%1 against %2: %3, <b>no significant difference</b>")
            .arg(measure, evaluatedRunName(other), numbers);
    return difference.value > 0 ? QObject::tr("%1 against %2: %3, <b>significantly better</b>")
                                      .arg(measure, evaluatedRunName(other), numbers)
                                : QObject::tr("%1 against %2: %3, <b>significantly worse</b>")
                                      .arg(measure, evaluatedRunName(other), numbers);
}

}  // namespace

QString evaluatedRunName(const RunRecord& run) {
    return run.name.empty() ? QObject::tr("run %1").arg(run.id)
                            : QObject::tr("run %1, %2").arg(run.id).arg(QString::fromStdString(run.name));
}

WindowedRatios windowedRatios(const std::vector<FrameCounts>& frames, int window) {
    WindowedRatios ratios;
    const int count = static_cast<int>(frames.size());
    const double nothing = std::numeric_limits<double>::quiet_NaN();
    for (int i = 0; i < count; ++i) {
        double found = 0;
        double missed = 0;
        double alarms = 0;
        for (int k = std::max(0, i - window / 2); k <= std::min(count - 1, i + window / 2); ++k) {
            found += frames[static_cast<std::size_t>(k)].found;
            missed += frames[static_cast<std::size_t>(k)].missed;
            alarms += frames[static_cast<std::size_t>(k)].false_alarms;
        }
        ratios.precision.push_back(found + alarms > 0 ? found / (found + alarms) : nothing);
        ratios.recall.push_back(found + missed > 0 ? found / (found + missed) : nothing);
    }
    return ratios;
}

QString certaintyText(const RunEvaluation& evaluation) {
    QStringList lines;
    lines << QObject::tr("f-score <b>%1</b>, 95 % interval %2 to %3")
                 .arg(numberText(evaluation.f_score.value, 3), numberText(evaluation.f_score.low, 3),
                      numberText(evaluation.f_score.high, 3));
    if (evaluation.mota) lines.back() += QObject::tr(" · MOTA %1").arg(spanText(*evaluation.mota));
    if (evaluation.difference) {
        const RunDifference& difference = *evaluation.difference;
        lines << differenceLine(QObject::tr("f-score"), difference.difference.f_score, difference.other);
        if (difference.difference.mota)
            lines << differenceLine(QObject::tr("MOTA"), *difference.difference.mota, difference.other);
    }
    return lines.join(QStringLiteral("<br>"));
}

}  // namespace eyrie::ui

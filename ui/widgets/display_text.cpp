#include "widgets/display_text.h"

#include <QDateTime>
#include <QLocale>
#include <cmath>

#include "core/project_name.h"
#include "core/text.h"
#include "core/time/time_text.h"
#include "core/time/utc_time.h"

namespace eyrie::ui {
namespace {

constexpr double kKmhPerMetrePerSecond = 3.6;

}  // namespace

QString lengthUnit(const SceneScale& scale) {
    return scale.gsd_known ? QStringLiteral("m") : QStringLiteral("px");
}

double shownLength(double px, const SceneScale& scale) {
    return scale.gsd_known ? scale.metres(px) : px;
}

QString speedUnit(const SceneScale& scale) {
    return scale.gsd_known ? QStringLiteral("km/h") : QStringLiteral("px/frame");
}

double shownSpeed(double px_per_frame, const SceneScale& scale) {
    return scale.gsd_known ? scale.metresPerSecond(px_per_frame) * kKmhPerMetrePerSecond : px_per_frame;
}

QString numberText(double value, int decimals) {
    return std::isfinite(value) ? QLocale().toString(value, 'f', decimals) : QStringLiteral("–");
}

QString speedText(double px_per_frame, const SceneScale& scale) {
    return numberText(shownSpeed(px_per_frame, scale), scale.gsd_known ? 1 : 2) + QLatin1Char(' ') + speedUnit(scale);
}

QString shortSpeedText(double px_per_frame, const SceneScale& scale) {
    return numberText(shownSpeed(px_per_frame, scale), scale.gsd_known ? 0 : 1) + QLatin1Char(' ') + speedUnit(scale);
}

QString lengthText(double px, const SceneScale& scale) {
    return numberText(shownLength(px, scale), 1) + QLatin1Char(' ') + lengthUnit(scale);
}

QString durationText(double seconds) {
    if (!std::isfinite(seconds) || seconds < 0) return QStringLiteral("–");
    // Rounded before it is split, so that 59.96 s does not become "60.0 s".
    const auto tenths = static_cast<long long>(std::llround(seconds * 10));
    if (tenths < 600) return QLocale().toString(static_cast<double>(tenths) / 10, 'f', 1) + QStringLiteral(" s");
    const long long whole = tenths / 10;
    const QChar zero = QLatin1Char('0');
    if (whole < 3600) {
        const QString rest = QLocale().toString(static_cast<double>(tenths % 600) / 10, 'f', 1);
        return QStringLiteral("%1:%2").arg(whole / 60).arg(rest, 4, zero);
    }
    return QStringLiteral("%1:%2:%3").arg(whole / 3600).arg(whole / 60 % 60, 2, 10, zero).arg(whole % 60, 2, 10, zero);
}

QString utcMomentText(std::int64_t utc_us) {
    QString text = QString::fromStdString(utcTextToMilliseconds(utc_us)).remove(QLatin1Char('Z'));
    return QObject::tr("%1 UTC").arg(text.replace(QLatin1Char('T'), QLatin1Char(' ')));
}

QString withEnding(const QString& path, const char* ending) {
    if (path.isEmpty() || hasEnding(path.toStdString(), ending)) return path;
    return path + QString::fromLatin1(ending);
}

QString projectFilter() {
    return QObject::tr("Eyrie projects (*%1)").arg(QString::fromLatin1(kProjectEnding));
}

QString projectOrAnyFilter() {
    return QObject::tr("Eyrie projects (*%1);;All files (*)").arg(QString::fromLatin1(kProjectEnding));
}

QString leftText(double seconds) {
    const auto whole_us = static_cast<std::int64_t>(std::ceil(seconds)) * 1'000'000;
    return QObject::tr("%1 left").arg(QString::fromStdString(timeText(whole_us, 0)));
}

QString capitalised(QString text) {
    if (!text.isEmpty()) text[0] = text[0].toUpper();
    return text;
}

QString shownName(CorrectionKind kind) {
    switch (kind) {
        case CorrectionKind::add:
            return QObject::tr("by hand");
        case CorrectionKind::join:
            return QObject::tr("joined");
        case CorrectionKind::split:
            return QObject::tr("split");
        case CorrectionKind::reject:
            return QObject::tr("rejected");
    }
    return {};
}

QString shownName(TrackClass track_class) {
    switch (track_class) {
        case TrackClass::unknown:
            break;
        case TrackClass::vehicle:
            return QObject::tr("vehicle");
        case TrackClass::two_wheeler:
            return QObject::tr("two-wheeler");
        case TrackClass::person:
            return QObject::tr("person");
    }
    return QStringLiteral("–");
}

QString localTimeText(const std::string& utc) {
    const QString text = QString::fromStdString(utc);
    const QDateTime time = QDateTime::fromString(text, Qt::ISODate);
    if (!time.isValid()) return text;
    const QDateTime local = time.toLocalTime();
    const QString clock = QLocale().toString(local.time(), QLocale::ShortFormat);
    if (local.date() == QDate::currentDate()) return clock;
    return QLocale().toString(local.date(), QStringLiteral("d MMM yyyy ")) + clock;
}

}  // namespace eyrie::ui

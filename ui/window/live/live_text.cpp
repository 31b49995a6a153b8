#include "window/live/live_text.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

#include "widgets/display_text.h"

namespace eyrie::ui {
namespace {

constexpr double kSilent_s = 2;                        ///< from here on people are told that nothing comes
constexpr double kInPace_s = 0.3;                      ///< what waits for a shorter time is not worth a word
constexpr std::uint64_t kLittleSpace = 2'000'000'000;  ///< bytes: some minutes to an hour

QString tr(const char* text) {
    return QCoreApplication::translate("LiveText", text);
}

QString bytesText(std::uint64_t bytes) {
    return QLocale().formattedDataSize(static_cast<qint64>(bytes), 1, QLocale::DataSizeSIFormat);
}

}  // namespace

Signal signalOf(const LiveStatus& status) {
    if (!status.load.facts.connected) return Signal::bad;
    return status.load.facts.silent_s > kSilent_s ? Signal::warning : Signal::good;
}

QString liveStateText(const LiveStatus& status, double give_up_s) {
    const LiveFacts& facts = status.load.facts;
    if (!facts.ended.empty()) return tr("ended: %1").arg(QString::fromStdString(facts.ended));
    const QString since = durationText(facts.silent_s);
    switch (signalOf(status)) {
        case Signal::bad:
            return tr("connection lost %1 ago; trying again for %2").arg(since, durationText(give_up_s));
        case Signal::warning:
            return tr("no picture for %1").arg(since);
        case Signal::good:
            break;
    }
    if (status.behind_s < kInPace_s) return tr("receiving");
    return tr("receiving, %1 behind").arg(durationText(status.behind_s));
}

QString liveLoadText(const LiveStatus& status) {
    const LiveLoad& load = status.load;
    const QLocale locale;
    const QString of = locale.toString(load.facts.frames);
    QStringList parts;
    if (status.lighter) parts << tr("fewer corners now");
    if (load.facts.skipped > 0) parts << tr("%1 of %2 frames left out").arg(locale.toString(load.facts.skipped), of);
    if (!status.lighter && load.fewer_corners > 0)
        parts << (load.facts.skipped > 0
                      ? tr("%1 with fewer corners").arg(locale.toString(load.fewer_corners))
                      : tr("%1 of %2 frames with fewer corners").arg(locale.toString(load.fewer_corners), of));
    if (load.facts.reconnects > 0) parts << tr("connected again %1×").arg(locale.toString(load.facts.reconnects));
    return parts.isEmpty() ? tr("keeps pace") : parts.join(QStringLiteral("; "));
}

QString liveRecordingText(const LiveFacts& facts) {
    const QString recorded = tr("%1 recorded").arg(bytesText(facts.recorded_bytes));
    return isNearlyFull(facts) ? tr("%1, only %2 left").arg(recorded, bytesText(facts.free_bytes)) : recorded;
}

QString liveSpaceText(const LiveFacts& facts) {
    if (facts.free_bytes == 0) return {};
    const QString left = tr("%1 left on the disk.").arg(bytesText(facts.free_bytes));
    return isNearlyFull(facts) ? left + QLatin1Char(' ') + tr("Watching ends before the disk is full.") : left;
}

bool isNearlyFull(const LiveFacts& facts) {
    return facts.free_bytes > 0 && facts.free_bytes < kLittleSpace;
}

}  // namespace eyrie::ui

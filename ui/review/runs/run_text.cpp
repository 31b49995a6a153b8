#include "review/runs/run_text.h"

#include <QCoreApplication>
#include <QLocale>
#include <QStringList>

#include "review/runs/runs_model.h"
#include "widgets/display_text.h"

namespace eyrie::ui {
namespace {

QString tr(const char* text) {
    return QCoreApplication::translate("RunText", text);
}

QString frames(int count) {
    return count == 1 ? tr("1 frame") : tr("%1 frames").arg(QLocale().toString(count));
}

QString howItEnded(const RunRecord& run, const RunFacts& facts) {
    const QString name = shownName(run);
    const QString done = frames(facts.counts.frames);
    switch (facts.state) {
        case RunState::finished:
            return tr("%1 finished").arg(name);
        case RunState::failed:
            return tr("%1 failed after %2").arg(name, done);
        case RunState::running:
            return tr("%1 is still running").arg(name);
        case RunState::stopped:
            break;
    }
    return tr("%1 was stopped after %2 of %3, which are kept")
        .arg(name, QLocale().toString(facts.counts.frames), frames(facts.frames_planned));
}

/// "0.5 s could not be searched: 12 frames could not be registered (too few corners: 9, cut: 3)".
QString unregisteredText(const RunRecord& run, const RunCounts& counts) {
    QStringList reasons;
    for (const ReasonCount& count : counts.reasons)
        reasons << tr("%1: %2").arg(QString::fromStdString(nameOf(count.fault, count.picture)),
                                    QLocale().toString(count.frames));
    const double rate_hz = run.scale.frame_rate_hz > 0 ? run.scale.frame_rate_hz : run.sequence.frame_rate_hz;
    return tr("%1 could not be searched: %2 could not be registered (%3)")
        .arg(durationText(counts.unregistered / rate_hz), frames(counts.unregistered),
             reasons.join(QStringLiteral(", ")));
}

}  // namespace

QString scaleText(const RunRecord& run) {
    return QString::fromStdString(describe(run.scale, run.scale_basis, run.sequence.size));
}

QString lightText(const RunRecord& run) {
    return QString::fromStdString(describe(run.light, run.scale));
}

QString whyNoTracks(const RunFacts& facts) {
    if (const QString doubt = QString::fromStdString(doubtfulScaleOf(facts)); !doubt.isEmpty())
        return capitalised(doubt) + QLatin1Char('.');
    switch (facts.nothing) {
        case NothingFollowed::has_tracks:
            return {};
        case NothingFollowed::no_frames:
            return tr("No frame was processed.");
        case NothingFollowed::too_few_frames:
            return facts.counts.frames == 1
                       ? tr("1 frame is too few for a track, which needs at least %1 (tracking.confirm_hits).")
                             .arg(QLocale().toString(facts.frames_needed))
                       : tr("%1 frames are too few for a track, which needs at least %2 (tracking.confirm_hits).")
                             .arg(QLocale().toString(facts.counts.frames), QLocale().toString(facts.frames_needed));
        case NothingFollowed::not_registered:
            return tr("No frame could be registered onto the one before it (%1), so no motion could be measured. "
                      "Blurred or blank pictures, cuts and ground without texture cannot be registered.")
                .arg(facts.counts.reasons.empty()
                         ? tr("no reason was stored")
                         : QString::fromStdString(
                               nameOf(facts.counts.reasons.front().fault, facts.counts.reasons.front().picture)));
        case NothingFollowed::no_motion:
            return tr("Nothing moved differently from the ground. Vehicles slower than motion.min_speed are not seen.");
        case NothingFollowed::no_detections:
            return tr(
                "Something moved, but nothing looked like a vehicle. Check the GSD, or ask “Why?” about a vehicle to "
                "see why it was missed.");
        case NothingFollowed::all_rejected:
            return tr(
                "Every detection was rejected as a duplicate, an outlier or for its size. Check the GSD, or "
                "show rejected detections in the menu Overlays.");
        case NothingFollowed::none_confirmed:
            return tr("Vehicles were detected, but none often enough to become a track (tracking.confirm_hits).");
        case NothingFollowed::all_dropped:
            return tr("Every track was dropped when the tracks were finished. Ask “Why?” about a vehicle to see why.");
    }
    return {};
}

QString runSummaryText(const RunRecord& run, const RunFacts& facts, std::size_t events) {
    QStringList sentences;
    const int tracks = facts.counts.tracks;
    if (tracks == 0) {
        sentences << tr("%1: no tracks. %2").arg(howItEnded(run, facts), whyNoTracks(facts));
    } else {
        QStringList found{tracks == 1 ? tr("1 track") : tr("%1 tracks").arg(QLocale().toString(tracks))};
        if (events > 0)
            found << (events == 1 ? tr("1 event")
                                  : tr("%1 events").arg(QLocale().toString(static_cast<qulonglong>(events))));
        sentences << tr("%1: %2.").arg(howItEnded(run, facts), found.join(QStringLiteral(", ")));
    }
    if (facts.state == RunState::finished && !run.message.empty())
        sentences << capitalised(QString::fromStdString(run.message)) + QLatin1Char('.');
    if (facts.counts.unregistered > 0) sentences << unregisteredText(run, facts.counts) + QLatin1Char('.');
    sentences << tr("Scale: %1.").arg(scaleText(run));
    if (run.rate_assumed)
        sentences
            << tr("The frame rate is not known: %1 frames per second are assumed, so times and speeds may be wrong.")
                   .arg(QLocale().toString(run.scale.frame_rate_hz, 'g', 4));
    return sentences.join(QLatin1Char(' '));
}

}  // namespace eyrie::ui

#include "window/docks/event_report.h"

#include <QDesktopServices>
#include <QFileInfo>
#include <QUrl>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "io/file_digest.h"
#include "report/review/review_report.h"
#include "review/events/event_review.h"
#include "review/events/event_thresholds.h"
#include "review/events/events_dock.h"
#include "review/events/events_panel.h"
#include "session/project_session.h"
#include "widgets/message_bar.h"

namespace eyrie::ui {

namespace {

const QString kReportTopic = QStringLiteral("event report");

/// The hash of a video; empty where it cannot be read, which the report says.
std::string digestOf(const std::string& video, const std::stop_token& stop) {
    if (isScene(video)) return {};
    try {
        return sha256Of(video, {}, stop);
    } catch (const Error&) {
        return {};
    }
}

}  // namespace

EventReport::EventReport(const EventReportParts& parts)
    : QObject(&parts.events),
      parts_(parts),
      writer_({
          .show_progress = [this](double share) { showWriting(share); },
          .tell_written =
              [this](const std::filesystem::path& path) {
                  const QString file = QString::fromStdString(path.string());
                  parts_.messages.showTopic(kReportTopic, MessageKind::info, tr("Wrote the report %1.").arg(file),
                                            tr("Open"),
                                            [file] { QDesktopServices::openUrl(QUrl::fromLocalFile(file)); });
              },
          .fail =
              [this](const QString& message) { parts_.messages.showTopic(kReportTopic, MessageKind::error, message); },
          .tell_stopped =
              [this] {
                  parts_.messages.showTopic(kReportTopic, MessageKind::info,
                                            tr("The report was stopped; nothing was written."));
              },
      }) {
    connect(&parts_.events.panel(), &EventsPanel::reportWanted, this, &EventReport::ask);
}

void EventReport::ask(ReportedEvents which) {
    if (!parts_.session.runData()) {
        parts_.messages.showTopic(kReportTopic, MessageKind::info,
                                  tr("Run the video first; a report shows what a run found."));
        return;
    }
    if (parts_.events.review().asOf()) {  // numbers of events are not what they will be
        parts_.messages.showTopic(kReportTopic, MessageKind::info,
                                  tr("The run is still running; its report can be written when it has ended."));
        return;
    }
    const RunRecord& run = parts_.session.runData()->record;
    const QString name = QFileInfo(QString::fromStdString(run.sequence.path)).completeBaseName();
    const QString path = askForReportFile(parts_.window, tr("%1 events").arg(name));
    if (!path.isEmpty()) write(path.toStdString(), which);
}

void EventReport::showWriting(double share) {
    parts_.messages.showTopic(kReportTopic, MessageKind::info,
                              tr("Writing the report… %1 %").arg(static_cast<int>(100 * share)), tr("Cancel"),
                              [this] { writer_.stop(); });
}

void EventReport::write(const std::filesystem::path& path, ReportedEvents which) {
    if (!parts_.session.runData()) return;
    if (writer_.working()) {
        parts_.messages.showTopic(kReportTopic, MessageKind::info, ReportWriter::workingText());
        return;
    }
    if (which == ReportedEvents::listed && parts_.events.panel().listedNumbers().empty()) {
        parts_.messages.showTopic(kReportTopic, MessageKind::info, tr("No event is listed."));
        return;
    }
    showWriting(0);
    EventChoice choice;
    choice.options = parts_.events.panel().thresholds().options();
    if (which == ReportedEvents::judged) choice.judgements = {Judgement::relevant, Judgement::unsure};
    if (which == ReportedEvents::listed) choice.numbers = parts_.events.panel().listedNumbers();
    const RunRecord run = parts_.session.runData()->record;
    const std::filesystem::path project = parts_.session.project();
    writer_.write({path,
                   {project, run.sequence.path},
                   parts_.session.media(),
                   [choice, run, project](FrameSource* pixels, const std::function<void(double)>& progress,
                                          const std::stop_token& stop) {
                       ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
                       ReviewReportInput input = gatherReviewReport(file, run, choice, pixels, {}, stop);
                       if (pixels != nullptr) input.video_digest = digestOf(run.sequence.path, stop);
                       input.made_utc = nowUtc();
                       return makeReviewReport(input, pixels, progress, stop);
                   }});
}

}  // namespace eyrie::ui

#include "moc_event_report.cpp"

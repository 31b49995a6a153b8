#pragma once

#include <QObject>
#include <filesystem>
#include <optional>

#include "review/events/events_panel.h"
#include "window/docks/report_writer.h"

class QWidget;

namespace eyrie::ui {

class EventsDock;
class MessageBar;
class ProjectSession;

/// What reports about events are made of. All must outlive it.
struct EventReportParts {
    ProjectSession& session;
    EventsDock& events;
    MessageBar& messages;
    QWidget& window;
};

/// The report about the events of the run shown, as they were judged: asks where to, and writes it in the background.
class EventReport : public QObject {
    Q_OBJECT

 public:
    explicit EventReport(const EventReportParts& parts);

    /// Writes without asking; PDF where the name ends so.
    void write(const std::filesystem::path& path, ReportedEvents which);

 private:
    void ask(ReportedEvents which);
    void showWriting(double share);

    EventReportParts parts_;
    ReportWriter writer_;  ///< last: stops before the rest goes
};

}  // namespace eyrie::ui

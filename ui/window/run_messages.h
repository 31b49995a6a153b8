#pragma once

#include <QObject>
#include <functional>

namespace eyrie::ui {

class DockRegistry;
class MessageBar;
class ProjectSession;

/// What the session has to say, said above the canvas: problems, notices, what came of a run, what can be undone.
class RunMessages : public QObject {
    Q_OBJECT

 public:
    /// All must outlive it. `locate_video` asks for a video that is missing.
    RunMessages(ProjectSession& session, MessageBar& messages, DockRegistry& docks, std::function<void()> locate_video,
                QObject* parent);

 private:
    void wireRuns();

    ProjectSession& session_;
    MessageBar& messages_;
    DockRegistry& docks_;
};

}  // namespace eyrie::ui

#pragma once

#include <QObject>
#include <QString>
#include <cstddef>
#include <functional>
#include <optional>

#include "chain/recording/run_facts.h"

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

    /// So many events were found in a run; what was said about its end tells them from now on, if it is still there.
    void tellEvents(int run_id, std::size_t count);

 private:
    struct Summary {
        RunRecord run;
        RunFacts facts;
    };
    struct Events {
        int run_id = 0;
        std::size_t count = 0;
    };
    void wireRuns();
    void forgetRun();
    void showSummary();

    ProjectSession& session_;
    MessageBar& messages_;
    DockRegistry& docks_;
    std::optional<Summary> summary_;  ///< of the run that ended last
    Events events_;                   ///< those found last
};

}  // namespace eyrie::ui

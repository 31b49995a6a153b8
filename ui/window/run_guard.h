#pragma once

#include <QObject>
#include <functional>

#include "session/project_session.h"

namespace eyrie::ui {

/// Nothing ends or removes a run before the user was asked.
class RunGuard : public QObject {
    Q_OBJECT

 public:
    /// Asks over `window`, which owns it. The session must outlive it.
    RunGuard(ProjectSession& session, QWidget& window);

    /// Does `then` at once when no run works. Else asks whether the run is to be stopped for it, or whether it can wait
    /// for the end of the run; what was asked for last counts. `doing` completes "before …": "the window closes".
    void beforeEnding(const QString& doing, std::function<void()> then);
    /// Asks whether a run is to be removed, and removes it.
    void remove(int run_id);

 private:
    ProjectSession& session_;
    QWidget& window_;
    std::function<void()> when_ended_;  ///< what waits for the end of the run
};

}  // namespace eyrie::ui

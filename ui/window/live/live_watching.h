#pragma once

#include <QObject>
#include <QPointer>
#include <functional>

#include "session/project_session.h"
#include "window/live/live_dialog.h"

class QMainWindow;

namespace eyrie::ui {

class RunGuard;
class WindowActions;
class WindowSettings;

/// What watching a live source touches. All must outlive LiveWatching.
struct LiveParts {
    ProjectSession& session;
    WindowSettings& settings;
    WindowActions& actions;
    RunGuard& guard;
    std::function<void()> leave_view;  ///< what is shown is about to be left
    QMainWindow& window;
};

/// The command that watches a live source: asks for it, waits for it to answer, and tells what was wrong.
class LiveWatching : public QObject {
    Q_OBJECT

 public:
    explicit LiveWatching(const LiveParts& parts);

    /// Opens the dialog, after asking what becomes of a run that works. An empty address: the one watched last;
    /// `gsd_m_per_px` is what stands there at first, 0: nothing.
    void ask(const QString& address = {}, double gsd_m_per_px = 0);
    /// Null while it is closed.
    LiveDialog* dialog() const { return dialog_; }

 private:
    void openDialog(const QString& address, double gsd_m_per_px);
    void watch(const LiveRequest& request);
    void endWaiting();
    QString proposedProject() const;

    LiveParts parts_;
    QPointer<LiveDialog> dialog_;
};

}  // namespace eyrie::ui

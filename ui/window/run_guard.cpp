#include "window/run_guard.h"

#include <QLocale>
#include <QWidget>
#include <algorithm>
#include <utility>

#include "review/runs/runs_model.h"
#include "window/question.h"

namespace eyrie::ui {

RunGuard::RunGuard(ProjectSession& session, QWidget& window) : QObject(&window), session_(session), window_(window) {
    connect(
        &session_, &ProjectSession::runFinished, this,
        [this] {
            if (const auto then = std::exchange(when_ended_, nullptr)) then();
        },
        Qt::QueuedConnection);  // everybody has heard of the end by then
}

void RunGuard::beforeEnding(const QString& doing, std::function<void()> then) {
    if (!session_.running()) {
        then();
        return;
    }
    const auto wait = [this, then = std::move(then)] {
        // The run may have ended while the question was open.
        if (session_.running())
            when_ended_ = then;
        else
            then();
    };
    if (session_.liveSource() != nullptr) {
        // It may never end by itself, so nothing can wait for that.
        ask(window_, tr("A live source is being watched. Stop watching before %1?").arg(doing),
            tr("What was recorded and found so far is kept."), {{tr("Stop watching"), [this, wait] {
                                                                     session_.stopRun();
                                                                     wait();
                                                                 }}});
        return;
    }
    ask(window_, tr("A run is still running. Stop it before %1?").arg(doing),
        tr("The frames done so far are kept in either case."),
        {{tr("Stop the run"),
          [this, wait] {
              session_.stopRun();
              wait();
          }},
         {tr("Wait for its end"), wait}});
}

void RunGuard::remove(int run_id) {
    const auto& runs = session_.runs();
    const auto run = std::find_if(runs.begin(), runs.end(), [&](const RunRecord& r) { return r.id == run_id; });
    if (run == runs.end()) return;
    ask(window_,
        tr("Remove “%1” with its %2 frames from the project?")
            .arg(shownName(*run), QLocale().toString(run->frames_done)),
        tr("It can be brought back until the project is closed; then it is deleted for good."),
        {{tr("Remove"), [this, run_id] { session_.removeRun(run_id); }}});
}

}  // namespace eyrie::ui

#include "moc_run_guard.cpp"

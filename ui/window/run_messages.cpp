#include "window/run_messages.h"

#include <utility>

#include "review/runs/run_text.h"
#include "review/runs/runs_model.h"
#include "session/project_session.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/dock_registry.h"

namespace eyrie::ui {

namespace {
/// What messages are about; a later one about the same takes the place of the former.
const QString kRunTopic = QStringLiteral("run");
const QString kVideoTopic = QStringLiteral("video");
}  // namespace

RunMessages::RunMessages(ProjectSession& session, MessageBar& messages, DockRegistry& docks,
                         std::function<void()> locate_video, QObject* parent)
    : QObject(parent), session_(session), messages_(messages), docks_(docks) {
    connect(&session_, &ProjectSession::problem, this,
            [this](const QString& text) { messages_.showMessage(MessageKind::error, text); });
    connect(&session_, &ProjectSession::notice, this,
            [this](const QString& text) { messages_.showMessage(MessageKind::info, text); });
    connect(&session_, &ProjectSession::videoNotFound, this,
            [this, locate_video = std::move(locate_video)](const QString& text) {
                messages_.showTopic(kVideoTopic, MessageKind::warning,
                                    tr("%1. The results can be viewed without it.").arg(text), tr("Locate…"),
                                    locate_video);
            });
    wireRuns();
}

void RunMessages::wireRuns() {
    // A run of the former video may have been summarised meanwhile.
    whenChanged(session_, this,
                {{SessionChange::opened, [this] { forgetRun(); }}, {SessionChange::run_preparing, [this] {
                                                                        // What was wrong with the former run, or kept
                                                                        // this one from starting, is of no use any
                                                                        // more.
                                                                        messages_.dismiss(MessageKind::error);
                                                                        forgetRun();
                                                                    }}});
    connect(&session_, &ProjectSession::runSummarised, this, [this](const RunRecord& run, const RunFacts& facts) {
        summary_ = Summary{run, facts};
        showSummary();
    });
    connect(&session_, &ProjectSession::runRemoved, this, [this](const RunRecord& run) {
        summary_.reset();
        messages_.showTopic(kRunTopic, MessageKind::info,
                            tr("Removed “%1”. It can be brought back until the project is closed.").arg(shownName(run)),
                            tr("Bring it back"), [this, id = run.id] { session_.restoreRun(id); });
    });
}

void RunMessages::forgetRun() {
    summary_.reset();
    events_ = {};
    messages_.dismissTopic(kRunTopic);
}

void RunMessages::showSummary() {
    const RunFacts& facts = summary_->facts;
    const bool any_tracks = facts.counts.tracks > 0;
    const std::size_t events = any_tracks && events_.run_id == summary_->run.id ? events_.count : 0;
    const bool doubtful = !any_tracks || facts.state == RunState::failed;
    const QString action = events > 0 ? tr("Review the events") : any_tracks ? tr("Show the tracks") : QString();
    messages_.showTopic(kRunTopic, doubtful ? MessageKind::warning : MessageKind::info,
                        runSummaryText(summary_->run, facts, events), action,
                        [this, dock = events > 0 ? DockId::events : DockId::tracks] { docks_.raise(dock); });
}

void RunMessages::tellEvents(int run_id, std::size_t count) {
    if (events_.run_id == run_id && events_.count == count) return;
    events_ = {run_id, count};
    // What a person has sent away does not come back.
    if (summary_ && summary_->run.id == run_id && messages_.shows(kRunTopic)) showSummary();
}

}  // namespace eyrie::ui

#include "moc_run_messages.cpp"

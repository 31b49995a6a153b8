#include "window/run_messages.h"

#include <utility>

#include "review/run_text.h"
#include "review/runs_model.h"
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
                {{SessionChange::opened, [this] { messages_.dismissTopic(kRunTopic); }},
                 {SessionChange::run_preparing, [this] {
                      // What was wrong with the former run, or kept this one from starting, is of
                      // no use any more.
                      messages_.dismiss(MessageKind::error);
                      messages_.dismissTopic(kRunTopic);
                  }}});
    connect(&session_, &ProjectSession::runSummarised, this, [this](const RunRecord& run, const RunFacts& facts) {
        const bool doubtful = facts.counts.tracks == 0 || facts.state == RunState::failed;
        messages_.showTopic(kRunTopic, doubtful ? MessageKind::warning : MessageKind::info, runSummaryText(run, facts),
                            facts.counts.tracks > 0 ? tr("Show the tracks") : QString(),
                            [this] { docks_.raise(DockId::tracks); });
    });
    connect(&session_, &ProjectSession::runRemoved, this, [this](const RunRecord& run) {
        messages_.showTopic(kRunTopic, MessageKind::info,
                            tr("Removed “%1”. It can be brought back until the project is closed.").arg(shownName(run)),
                            tr("Bring it back"), [this, id = run.id] { session_.restoreRun(id); });
    });
}

}  // namespace eyrie::ui

#include "review/earth/start_time.h"

#include <QAction>
#include <utility>

#include "review/earth/start_time_dialog.h"
#include "review/earth/video_earth.h"
#include "session/project_session.h"
#include "store/labels/annotation_store.h"
#include "store/project/video_start.h"
#include "widgets/message_bar.h"
#include "widgets/wiring.h"
#include "workspace/session_reactions.h"
#include "workspace/window_actions.h"

namespace eyrie::ui {

namespace {
const QString kStartTopic = QStringLiteral("start time");
}

StartTime::StartTime(const StartTimeParts& parts, QObject* parent) : QObject(parent), parts_(parts) {
    bindCommands(this, {{parts_.actions.start_time, [this] { ask(); }}});
    followSession(
        parts_.session, this,
        {{{SessionChange::video, SessionChange::project, SessionChange::opened}, [this] { enableActions(); }}});
    enableActions();
}

StartTime::~StartTime() = default;

void StartTime::enableActions() {
    // What a person says is kept in the project, which has to be there.
    parts_.actions.start_time->setEnabled(parts_.session.video() && !parts_.session.project().empty());
}

void StartTime::ask() {
    const auto& times = parts_.session.timesUs();
    const KnownStart known{parts_.earth.utcAt(times.empty() ? 0 : times.front()), parts_.earth.givenStart().has_value(),
                           parts_.earth.clockOrigin()};
    // Meanwhile another video may be opened: what was asked about that one is not said of this.
    const auto answer = [this, project = parts_.session.project(),
                         identity = parts_.session.media()->identity](std::optional<std::int64_t> utc_us) {
        const auto& media = parts_.session.media();
        if (media && media->identity == identity && parts_.session.project() == project) store(utc_us);
    };
    auto* dialog = new StartTimeDialog(known, answer, parts_.messages.window());
    dialog->setAttribute(Qt::WA_DeleteOnClose);
    dialog->open();
}

void StartTime::store(std::optional<std::int64_t> utc_us) {
    parts_.messages.dismissTopic(kStartTopic);
    const auto settle = [this](const QString& problem) {
        if (!problem.isEmpty()) parts_.messages.showTopic(kStartTopic, MessageKind::error, problem);
        parts_.earth.layOnEarth();
    };
    query_.write(
        [project_path = parts_.session.project(), sequence = parts_.session.sequenceToStore(), utc_us,
         settle](const BackgroundTask& task) {
            ProjectFile project = ProjectFile::open(project_path);
            storeVideoStart(project, ensureSequence(project, sequence), utc_us);
            task.tell([settle] { settle(QString()); });
        },
        settle);
}

}  // namespace eyrie::ui

#include "moc_start_time.cpp"

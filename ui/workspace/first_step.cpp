#include "workspace/first_step.h"

#include <QCoreApplication>

#include "session/project_session.h"

namespace eyrie::ui {

QString firstStep(const ProjectSession& session) {
    if (session.currentRun()) return {};
    if (session.running()) return QCoreApplication::translate("FirstStep", "Wait for the first frames of the run.");
    if (session.video() || session.liveSource() != nullptr)
        return QCoreApplication::translate("FirstStep", "Run the video first, or choose a run.");
    return QCoreApplication::translate("FirstStep", "Open a video first.");
}

QString afterFirstStep(const ProjectSession& session, const QString& about) {
    const QString step = firstStep(session);
    return step.isEmpty() ? about : step + QLatin1Char(' ') + about;
}

QString notProcessedText() {
    return QCoreApplication::translate("FirstStep", "The run has not processed this frame.");
}

}  // namespace eyrie::ui

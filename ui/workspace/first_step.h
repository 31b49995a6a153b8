#pragma once

#include <QString>

namespace eyrie::ui {

class ProjectSession;

/// What has to be done before a dock can show anything of a run, in one sentence, the same in all of them: "Open a
/// video first."; to wait, while a run has no frames yet; empty once a run is shown.
QString firstStep(const ProjectSession& session);
/// The sentence and, behind it, what the dock shows.
QString afterFirstStep(const ProjectSession& session, const QString& about);
/// What a dock says where the run shown has nothing of the frame shown.
QString notProcessedText();

}  // namespace eyrie::ui

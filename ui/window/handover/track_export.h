#pragma once

#include "workspace/export_dialog.h"

namespace eyrie::ui {

class ProjectSession;

/// The tracks of the run shown, as people corrected them, in any format for other programs. The session must show a run
/// that was read.
ExportSource trackExport(const ProjectSession& session);

}  // namespace eyrie::ui

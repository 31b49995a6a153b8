#pragma once

#include "chain/chain_run.h"
#include "workspace/export_dialog.h"

class QWidget;

namespace eyrie::ui {

class ProjectSession;

/// The tracks of the run shown, as people corrected them, in any format for other programs. The session must show a run
/// that was read.
ExportSource trackExport(const ProjectSession& session);

}  // namespace eyrie::ui

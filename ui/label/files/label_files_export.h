#pragma once

#include <QString>

#include "formats/label_formats.h"
#include "workspace/export_dialog.h"

namespace eyrie::ui {

class LabelSession;

/// How a format of labels is offered.
ExportOffer offerOf(const LabelFormatInfo& format);
/// The files that are written in a format of labels.
std::vector<OutputFile> labelOutputs(const ExportWish& wish, const ExportOptions& options);
/// What was written, and what the format could not carry, for people.
QString exportText(const ExportReport& report);
/// The options that a wish comes to. `video` names the sequence.
ExportOptions exportOptionsOf(const ExportWish& wish, const std::filesystem::path& video);

/// The labels as they are when they are exported, in any format. `labels` must be open and outlive it.
ExportSource labelExport(const LabelSession& labels);

}  // namespace eyrie::ui

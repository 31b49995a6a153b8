#pragma once

#include <vector>

#include "label/canvas/label_timeline.h"
#include "label/editor/label_editor.h"
#include "label/label_session.h"
#include "label/lists/object_inspector.h"
#include "label/lists/objects_model.h"

/// Labels as lists, timeline and inspector show them.
namespace eyrie::ui {

std::vector<ObjectRow> objectRows(const LabelSession& labels);
std::vector<ObjectTimelineRow> timelineRows(const LabelSession& labels);
/// Of the selected object, which must exist.
ObjectDetails objectDetails(const LabelSession& labels, const LabelEditor& editor, const SceneScale& scale);
/// The candidate for people: "car 7, 12 frames later, 3.1 px away".
QString joinText(const LabelSession& labels, ObjectId other, bool later, int gap, double distance_px);

}  // namespace eyrie::ui

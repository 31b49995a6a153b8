#pragma once

#include "core/values/scene_scale.h"
#include "label/canvas/label_mark.h"
#include "label/computing/label_proposals.h"

namespace eyrie::ui {

/// All labels and pending proposals of a frame, as the canvas draws them. `planned`: an edit that waits for a yes; what
/// its objects would be is drawn around what they are. Null: none.
LabelScene labelScene(const LabelSession& labels, const LabelProposals& proposals, FrameIndex frame,
                      const SceneScale& scale, const AnnotationEdit* planned = nullptr);

}  // namespace eyrie::ui

#pragma once

#include "core/scene_scale.h"
#include "session/label_proposals.h"
#include "view/label_mark.h"

namespace eyrie::ui {

/// All labels and pending proposals of a frame, as the canvas draws them.
LabelScene labelScene(const LabelSession& labels, const LabelProposals& proposals, FrameIndex frame,
                      const SceneScale& scale);

}  // namespace eyrie::ui

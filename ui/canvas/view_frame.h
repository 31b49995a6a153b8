#pragma once

#include <QImage>
#include <memory>
#include <optional>
#include <vector>

#include "canvas/marks/stack_mark.h"
#include "canvas/marks/verdict_mark.h"
#include "canvas/marks/zone_mark.h"
#include "canvas/trail.h"
#include "core/evidence/light_finding.h"
#include "core/labels/box_record.h"
#include "core/values/frame_result.h"
#include "core/values/scene_scale.h"

namespace eyrie::ui {

/// Everything the canvas shows of one frame: the picture and what belongs on it. Live runs and stored runs make the
/// same. A value; picture and result are shared, never changed.
struct ViewFrame {
    FrameIndex index = 0;
    std::int64_t time_us = 0;
    QImage image;                               ///< null when the picture could not be read
    std::shared_ptr<const FrameResult> result;  ///< null when the run has no such frame
    SceneScale scale;                           ///< of the run that the result is of
    std::vector<TrackState> doubtful;   ///< of tracks that only their score kept out of the result; ascending id
    std::optional<FrameShadow> shadow;  ///< where shadows fall to, as far as the run knows
    std::vector<Trail> trails;          ///< ascending track id
    std::vector<BoxRecord> ground_truth;
    bool evaluated = false;             ///< the frame was compared with ground truth
    std::vector<VerdictMark> verdicts;  ///< what came of it
    std::vector<StackMark> stacks;      ///< empty until somebody asked for them: they are not stored
    std::vector<ZoneMark> zones;        ///< what is watched; belongs to the video, so that it comes apart
    std::optional<double> north_deg;    ///< in the middle of the picture, clockwise from +x; comes apart, too
};

/// The state of a track in a frame, also of one that only its score kept out of the result; null where it has none.
/// Lives as long as the frame.
const TrackState* stateOf(const ViewFrame& frame, TrackId track);

}  // namespace eyrie::ui

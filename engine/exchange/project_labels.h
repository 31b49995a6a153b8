#pragma once

#include <optional>

#include "annotation/keyframes/camera_motion.h"
#include "core/labels/annotation.h"
#include "correction/corrected_tracks.h"
#include "formats/label_stream.h"
#include "store/runs/run_store.h"

/// Labels and runs of a project in the words of the formats.
namespace eyrie {

/// The last run over a video with more than one frame.
std::optional<RunRecord> lastRunOver(const RunStore& store, int sequence_id);
/// How the camera moved, as the last run over the video found it; knows nothing without one.
CameraMotion cameraMotionOf(const RunStore& store, int sequence_id);

/// Labels of a video as a file would have them: objects frame by frame where they are in the image, ignore regions as
/// ignored boxes without id.
LabelFile labelsOf(const AnnotationSet& annotations, const SequenceRecord& sequence, const CameraMotion& camera);

/// The same frame by frame, and tracks of a run, or its detections. `annotations`, `camera` and `store` must outlive
/// the result; of a run that may be written meanwhile a Snapshot is to be held.
LabelStream labelStreamOf(const AnnotationSet& annotations, const SequenceRecord& sequence, const CameraMotion& camera);
LabelStream labelStreamOf(const RunStore& store, const RunRecord& run, bool detections);
/// Tracks of a run as people corrected them; notes say what they did.
LabelStream labelStreamOf(const RunStore& store, const RunRecord& run, CorrectedTracks corrected);

}  // namespace eyrie

#pragma once

#include <optional>
#include <string>

#include "annotation/camera_motion.h"
#include "formats/label_formats.h"
#include "store/project_file.h"
#include "store/run_store.h"

/// Labels between files and projects.
namespace eyrie::cli {

/// The video of a project that labels belong to: the only one, or that of number `id`. Throws Error(parameter) saying
/// which there are, Error(project) when there is none.
SequenceRecord chosenSequence(ProjectFile& project, std::optional<int> id);

/// The last run over a video with a registration to rely on; nothing without one.
std::optional<RunRecord> lastRunOver(const RunStore& store, int sequence_id);
/// How the camera moved, as the last run over the video found it; knows nothing without one.
CameraMotion cameraMotionOf(const RunStore& store, int sequence_id);

/// Labels of a video as a file would have them: objects frame by frame, ignore regions as ignored boxes without id.
LabelFile labelsOfProject(ProjectFile& project, const SequenceRecord& sequence);
/// Tracks of a run, or its detections.
LabelFile labelsOfRun(const RunStore& store, const RunRecord& run, bool detections);

struct LabelImport {
    int objects = 0;
    int boxes = 0;      ///< of the file
    int keyframes = 0;  ///< made of them
    int regions = 0;
    std::vector<std::string> notes;
};

/// Adds labels to a project in one step that can be undone. Few keyframes are chosen whose interpolation over the
/// ground stays within `tolerance_px` of every box; 0 takes every box for a keyframe. Ids of the file are kept in a
/// project that never had an object. Throws Error(output) while another program labels the project.
LabelImport importIntoProject(ProjectFile& project, const SequenceRecord& sequence, const LabelFile& labels,
                              double tolerance_px);

}  // namespace eyrie::cli

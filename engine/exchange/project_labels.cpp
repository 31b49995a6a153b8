#include "exchange/project_labels.h"

#include <algorithm>
#include <limits>
#include <set>

#include "annotation/edits/ignore_regions.h"
#include "annotation/keyframes/interpolation.h"

namespace eyrie {
namespace {

/// A region as ignored boxes: one where it is a rectangle, otherwise rows that cover it.
std::vector<OrientedBox> boxesOf(const std::vector<cv::Point2d>& polygon) {
    if (polygon.size() == 4) {
        const CornerBox fitted = boxFromCorners({polygon[1], polygon[2], polygon[3], polygon[0]});
        if (fitted.departure < 0.5) return {fitted.box};
    }
    return coveringBoxes(polygon);
}

}  // namespace

std::optional<RunRecord> lastRunOver(const RunStore& store, int sequence_id) {
    std::optional<RunRecord> last;
    for (const RunRecord& run : store.runs()) {
        if (run.sequence.id == sequence_id && run.frames_done > 1) last = run;
    }
    return last;
}

CameraMotion cameraMotionOf(const RunStore& store, int sequence_id) {
    const std::optional<RunRecord> run = lastRunOver(store, sequence_id);
    if (!run) return {};
    return CameraMotion::fromRegistrations(store.registrations(run->id));
}

LabelFile labelsOf(const AnnotationSet& annotations, const SequenceRecord& sequence, const CameraMotion& camera) {
    LabelFile labels;
    labels.image_size = sequence.size;
    labels.frame_count = sequence.frame_count;
    labels.frame_rate_hz = sequence.frame_rate_hz;
    const FrameIndex last =
        sequence.frame_count > 0 ? sequence.frame_count - 1 : std::numeric_limits<FrameIndex>::max() - 1;
    for (const auto& [id, object] : annotations.objects) {
        for (FrameIndex frame = firstFrameOf(object); frame <= std::min(object.last_frame, last); ++frame) {
            const LabelledBox found = boxAt(object, frame, camera);
            if (!found.visible()) continue;
            LabelBox box;
            box.frame = frame;
            box.id = id;
            box.box = found.box;
            box.object_class = object.object_class;
            box.ignore = found.ignore;
            box.occlusion = found.occlusion;
            labels.boxes[frame].push_back(std::move(box));
        }
    }
    std::set<FrameIndex> with_regions;
    for (const auto& [id, region] : annotations.regions) {
        for (FrameIndex frame = region.first_frame; frame <= std::min(region.last_frame, last); ++frame) {
            with_regions.insert(frame);
        }
    }
    for (const FrameIndex frame : with_regions) {
        for (const RegionInFrame& region : regionsAt(annotations, frame, camera)) {
            for (const OrientedBox& box : boxesOf(region.polygon)) {
                LabelBox area;
                area.frame = frame;
                area.ignore = true;
                area.box = box;
                labels.boxes[frame].push_back(std::move(area));
            }
        }
    }
    if (camera.empty()) {
        labels.notes.push_back("the video was never registered, so boxes between keyframes run straight in the image");
    }
    return labels;
}

LabelFile labelsOf(const RunStore& store, const RunRecord& run, bool detections) {
    LabelFile labels;
    labels.boxes = labelBoxes(detections ? store.detectionBoxes(run.id) : store.trackBoxes(run.id));
    labels.image_size = run.sequence.size;
    labels.frame_count = run.sequence.frame_count;
    labels.frame_rate_hz = run.sequence.frame_rate_hz;
    if (run.scale.gsd_known) labels.gsd_m = run.scale.gsd_m_per_px;
    return labels;
}

}  // namespace eyrie

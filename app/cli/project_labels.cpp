#include "cli/project_labels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "annotation/ignore_regions.h"
#include "annotation/interpolation.h"
#include "annotation/keyframe_reduction.h"
#include "core/error.h"
#include "store/annotation_store.h"

namespace eyrie::cli {
namespace {

/// Colours apart from each other for any number of objects, by golden steps around the circle of hues.
std::uint32_t colourOf(ObjectId id) {
    const double hue = std::fmod(id * 0.61803398875, 1.0) * 6;
    const auto channel = [&](double shift) {
        const double distance = std::abs(std::fmod(hue + shift, 6.0) - 3.0);
        return static_cast<std::uint32_t>(std::lround(70 + 170 * std::clamp(distance - 1.0, 0.0, 1.0)));
    };
    return channel(0) << 16 | channel(4) << 8 | channel(2);
}

/// The boxes of one object, ascending frames.
using Track = std::vector<const LabelBox*>;

bool sameFlags(const LabelBox& a, const LabelBox& b) {
    return a.ignore == b.ignore && a.occlusion == b.occlusion;
}

std::vector<FrameBox> frameBoxes(const Track& track, std::size_t begin, std::size_t end) {
    std::vector<FrameBox> boxes;
    for (std::size_t i = begin; i < end; ++i) boxes.push_back({track[i]->frame, track[i]->box});
    return boxes;
}

/// Few keyframes for dense boxes: by stretches with the same flags, outside over gaps.
void reduceObject(LabelledObject& object, const Track& track, const CameraMotion& camera,
                  const ReductionOptions& options) {
    object.keyframes.clear();
    object.last_frame = track.back()->frame;
    std::size_t begin = 0;
    for (std::size_t i = 1; i <= track.size(); ++i) {
        const bool over = i == track.size();
        const bool gap = !over && track[i]->frame != track[i - 1]->frame + 1;
        if (!over && !gap && sameFlags(*track[i], *track[begin])) continue;
        for (const Keyframe& keyframe : reduceToKeyframes(frameBoxes(track, begin, i), camera, options)) {
            object.keyframes.push_back(keyframe);
        }
        if (gap) {
            Keyframe outside;
            outside.frame = track[i - 1]->frame + 1;
            outside.box = track[i - 1]->box;
            outside.heading_set = true;
            outside.outside = true;
            object.keyframes.push_back(outside);
        }
        begin = i;
    }
    object = refined(std::move(object), frameBoxes(track, 0, track.size()), camera, options);
    object.last_frame = std::max(object.last_frame, object.keyframes.back().frame);
    for (Keyframe& keyframe : object.keyframes) {
        const auto found = std::lower_bound(track.begin(), track.end(), keyframe.frame,
                                            [](const LabelBox* box, FrameIndex frame) { return box->frame < frame; });
        if (found == track.end() || (*found)->frame != keyframe.frame) continue;
        keyframe.outside = false;
        keyframe.ignore = (*found)->ignore;
        keyframe.occlusion = (*found)->occlusion;
    }
}

/// What lies behind the end of the video is left out.
int cutAtEnd(LabelFile& labels, int frame_count) {
    int left_out = 0;
    if (frame_count <= 0) return 0;
    for (auto entry = labels.boxes.lower_bound(frame_count); entry != labels.boxes.end();) {
        left_out += static_cast<int>(entry->second.size());
        entry = labels.boxes.erase(entry);
    }
    if (left_out > 0) labels.objects.clear();  // the boxes are cut, so they make the objects
    return left_out;
}

AnnotationEdit editFor(const ImportedLabels& imported, AnnotationStore& store) {
    AnnotationEdit edit;
    const auto& objects = imported.annotations.objects;
    edit.name = "Import " + std::to_string(objects.size()) + (objects.size() == 1 ? " object" : " objects");
    const ObjectId first_free = store.newObjectId();
    const bool keep_ids = first_free == 1;
    ObjectId next = first_free;
    for (const auto& [id, object] : objects) {
        LabelledObject added = object;
        added.id = keep_ids ? id : next++;
        added.colour = colourOf(added.id);
        edit.objects.push_back({std::nullopt, std::move(added)});
    }
    for (const auto& [id, region] : imported.annotations.regions) {
        IgnoreRegion added = region;
        added.id = store.newRegionId();
        edit.regions.push_back({std::nullopt, std::move(added)});
    }
    std::vector<ObjectClass> classes = store.annotations().classes;
    for (const ObjectClass& wanted : imported.annotations.classes) {
        const bool known = std::any_of(classes.begin(), classes.end(),
                                       [&](const ObjectClass& entry) { return entry.name == wanted.name; });
        if (!known) classes.push_back(wanted);
    }
    if (classes.size() != store.annotations().classes.size()) {
        Change<std::vector<ObjectClass>> change;
        change.before = store.annotations().classes;
        change.after = classes;
        edit.classes = change;
    }
    return edit;
}

/// A region as ignored boxes: one where it is a rectangle, otherwise rows that cover it.
std::vector<OrientedBox> boxesOf(const std::vector<cv::Point2d>& polygon) {
    if (polygon.size() == 4) {
        const CornerBox fitted = boxFromCorners({polygon[1], polygon[2], polygon[3], polygon[0]});
        if (fitted.departure < 0.5) return {fitted.box};
    }
    return coveringBoxes(polygon);
}

}  // namespace

SequenceRecord chosenSequence(ProjectFile& project, std::optional<int> id) {
    const std::vector<SequenceRecord> sequences = sequencesOf(project);
    const std::string name = project.path().string();
    if (sequences.empty()) {
        throw Error(ErrorKind::project,
                    name + ": knows no video; make a run first (eyrie-cli run) or name the video (--video)");
    }
    if (!id && sequences.size() == 1) return sequences.front();
    std::string known;
    for (const SequenceRecord& sequence : sequences) {
        if (id == sequence.id) return sequence;
        known += (known.empty() ? "" : ", ") + std::to_string(sequence.id) + " " + sequence.path;
    }
    throw Error(ErrorKind::parameter, name + ": holds several videos; choose one by its number (--sequence): " + known);
}

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
    std::map<FrameIndex, RegistrationState> states;
    for (const FrameSummary& frame : store.frameSummaries(run->id)) states[frame.frame] = frame.state;
    std::vector<Registration> registrations;
    for (const Homography& homography : store.homographies(run->id)) {
        const auto state = states.find(homography.to_frame);
        if (state != states.end()) registrations.push_back({state->second, homography, {}});
    }
    return CameraMotion::fromRegistrations(registrations);
}

LabelFile labelsOfProject(ProjectFile& project, const SequenceRecord& sequence) {
    const RunStore store(project);
    const CameraMotion camera = cameraMotionOf(store, sequence.id);
    const AnnotationSet annotations = readAnnotations(project, sequence.id);
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

LabelFile labelsOfRun(const RunStore& store, const RunRecord& run, bool detections) {
    LabelFile labels;
    labels.boxes = labelBoxes(detections ? store.detectionBoxes(run.id) : store.trackBoxes(run.id));
    labels.image_size = run.sequence.size;
    labels.frame_count = run.sequence.frame_count;
    labels.frame_rate_hz = run.sequence.frame_rate_hz;
    if (run.scale.gsd_known) labels.gsd_m = run.scale.gsd_m_per_px;
    return labels;
}

LabelImport importIntoProject(ProjectFile& project, const SequenceRecord& sequence, const LabelFile& file,
                              double tolerance_px) {
    AnnotationStore store(project, sequence.id);
    if (store.readOnly()) throw Error(ErrorKind::output, store.readOnlyReason());
    const RunStore runs(project);
    const CameraMotion camera = cameraMotionOf(runs, sequence.id);
    LabelFile labels = file;
    LabelImport result;
    const int behind = cutAtEnd(labels, sequence.frame_count);
    for (const auto& [frame, records] : labels.boxes) result.boxes += static_cast<int>(records.size());

    ImportedLabels imported = annotationsOf(labels);
    result.notes = imported.notes;
    if (behind > 0) {
        result.notes.push_back(std::to_string(behind) + " boxes lie behind the video's last frame, " +
                               std::to_string(sequence.frame_count - 1) + ", and were left out; is the shift right?");
    }
    if (imported.left_out > 0) {
        result.notes.push_back(std::to_string(imported.left_out) +
                               " boxes have no id and belong to no object; they were left out");
    }
    if (tolerance_px > 0) {
        const int step = labels.boxes.empty() || imported.annotations.objects.empty() ? 0 : imported.id_step;
        std::map<int, Track> tracks;
        for (const auto& [frame, records] : labels.boxes) {
            for (const LabelBox& record : records) {
                if (!record.id) continue;
                Track& track = tracks[*record.id + step];
                if (track.empty() || track.back()->frame != frame) track.push_back(&record);
            }
        }
        ReductionOptions options;
        options.tolerance_px = tolerance_px;
        for (auto& [id, object] : imported.annotations.objects) reduceObject(object, tracks.at(id), camera, options);
        if (camera.empty()) {
            result.notes.push_back("the video was never registered, so keyframes were chosen for motion in the image");
        }
    }
    const AnnotationEdit edit = editFor(imported, store);
    for (const auto& change : edit.objects) result.keyframes += static_cast<int>(change.after->keyframes.size());
    result.objects = static_cast<int>(edit.objects.size());
    result.regions = static_cast<int>(edit.regions.size());
    store.apply(edit);
    return result;
}

}  // namespace eyrie::cli

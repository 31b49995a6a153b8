#include "exchange/label_import.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "annotation/keyframes/keyframe_reduction.h"
#include "core/geometry/upright.h"

namespace eyrie {
namespace {

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

/// All boxes lie along the image's axes, as those of a format without rotation do.
bool staysUpright(const Track& track) {
    return std::all_of(track.begin(), track.end(), [](const LabelBox* box) { return isUpright(box->box); });
}

/// Boxes that a file has upright stay so however the camera turns, for which the interpolation wants two keyframes.
void keepUpright(LabelledObject& object, const Track& track) {
    if (object.keyframes.size() != 1 || track.size() < 2) return;
    Keyframe last = object.keyframes.front();
    last.frame = track.back()->frame;
    last.box = track.back()->box;
    object.keyframes.push_back(last);
}

/// Few keyframes for dense boxes: by stretches with the same flags, outside over gaps.
void reduceObject(LabelledObject& object, const Track& track, const CameraMotion& camera, ReductionOptions options) {
    options.headings_set = staysUpright(track);
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
    if (options.headings_set) keepUpright(object, track);
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

/// All objects, each by itself on whatever core is free.
void reduceObjects(std::map<ObjectId, LabelledObject>& objects, const std::map<int, Track>& tracks,
                   const CameraMotion& camera, const ReductionOptions& options) {
    std::vector<std::pair<LabelledObject*, const Track*>> all;
    for (auto& [id, object] : objects) all.emplace_back(&object, &tracks.at(id));
    cv::parallel_for_({0, static_cast<int>(all.size())}, [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto& [object, track] = all[static_cast<std::size_t>(i)];
            reduceObject(*object, *track, camera, options);
        }
    });
}

/// What lies behind the end of the video is left out.
std::int64_t cutAtEnd(LabelFile& labels, int frame_count) {
    std::int64_t left_out = 0;
    if (frame_count <= 0) return 0;
    for (auto entry = labels.boxes.lower_bound(frame_count); entry != labels.boxes.end();) {
        left_out += static_cast<std::int64_t>(entry->second.size());
        entry = labels.boxes.erase(entry);
    }
    if (left_out > 0) labels.objects.clear();  // the boxes are cut, so they make the objects
    return left_out + labels.not_filled;
}

/// Takes out what the project has already; answers how many objects and regions.
int leaveDoublesOut(ImportedLabels& imported, const LabelFile& labels, const CameraMotion& camera,
                    const AnnotationSet& present, double tolerance_px) {
    // What was imported before is known by its keyframes only, which are as exact as the tolerance.
    constexpr double kSame_px = 1;
    const double within = kSame_px + tolerance_px;
    int left_out = 0;
    for (const auto& [id, there] : alreadyLabelled(labels, present, camera, within))
        left_out += static_cast<int>(imported.annotations.objects.erase(id + imported.id_step));
    left_out += static_cast<int>(std::erase_if(
        imported.annotations.regions, [&](const auto& entry) { return hasRegion(present, entry.second, kSame_px); }));
    return left_out;
}

constexpr ObjectId kHighestKeptId = 2'000'000'000;

AnnotationEdit editFor(const ImportedLabels& imported, const ImportGround& ground) {
    AnnotationEdit edit;
    const auto& objects = imported.annotations.objects;
    edit.name = "Import " + std::to_string(objects.size()) + (objects.size() == 1 ? " object" : " objects");
    const ObjectId first_free = ground.first_object;
    // An id near the largest number would leave none for objects to come.
    const bool keep_ids = first_free == 1 && (objects.empty() || objects.rbegin()->first <= kHighestKeptId);
    ObjectId next = first_free;
    for (const auto& [id, object] : objects) {
        LabelledObject added = object;
        added.id = keep_ids ? id : next++;
        edit.objects.push_back({std::nullopt, std::move(added)});
    }
    int next_region = ground.first_region;
    for (const auto& [id, region] : imported.annotations.regions) {
        IgnoreRegion added = region;
        added.id = next_region++;
        edit.regions.push_back({std::nullopt, std::move(added)});
    }
    std::vector<ObjectClass> classes = ground.present.classes;
    for (const ObjectClass& wanted : imported.annotations.classes) {
        const bool known = std::any_of(classes.begin(), classes.end(),
                                       [&](const ObjectClass& entry) { return entry.name == wanted.name; });
        if (!known) classes.push_back(wanted);
    }
    if (classes.size() != ground.present.classes.size()) {
        Change<std::vector<ObjectClass>> change;
        change.before = ground.present.classes;
        change.after = classes;
        edit.classes = change;
    }
    return edit;
}

}  // namespace

LabelImport planImport(LabelFile labels, const SequenceRecord& sequence, const CameraMotion& camera,
                       const ImportGround& ground, double tolerance_px, Doubles doubles, LooseBoxes loose) {
    LabelImport result;
    const std::int64_t behind = cutAtEnd(labels, sequence.frame_count);
    for (const auto& [frame, records] : labels.boxes) result.boxes += static_cast<int>(records.size());

    result.loose = gatherLooseBoxes(labels, loose);
    ImportedLabels imported = annotationsOf(labels);
    result.notes = imported.notes;
    if (behind > 0) {
        result.notes.push_back(std::to_string(behind) + " boxes lie after the video's last frame, " +
                               std::to_string(sequence.frame_count - 1) + ", and were left out; is the shift right?");
    }
    if (result.loose.boxes > 0) {
        result.notes.push_back(std::to_string(result.loose.boxes) + " boxes have no id; " +
                               (loose == LooseBoxes::link
                                    ? "linked by their overlap from frame to frame into " +
                                          std::to_string(result.loose.objects) + " objects; please check them"
                                    : "each is an object of one frame, unless they are linked"));
    }
    if (doubles == Doubles::skip)
        result.doubles = leaveDoublesOut(imported, labels, camera, ground.present, tolerance_px);
    if (result.doubles > 0) {
        result.notes.push_back(std::to_string(result.doubles) +
                               " objects or regions are labelled already with the same boxes, and were left out");
    }
    if (tolerance_px > 0) {
        std::map<int, Track> tracks;
        for (const auto& [frame, records] : labels.boxes) {
            for (const LabelBox& record : records) {
                if (!record.id) continue;
                Track& track = tracks[*record.id + imported.id_step];
                if (track.empty() || track.back()->frame != frame) track.push_back(&record);
            }
        }
        ReductionOptions options;
        options.tolerance_px = tolerance_px;
        reduceObjects(imported.annotations.objects, tracks, camera, options);
        if (camera.empty()) {
            result.notes.emplace_back(
                "the video was never registered, so keyframes were chosen for motion in the image");
        }
    }
    result.objects = static_cast<int>(imported.annotations.objects.size());
    result.regions = static_cast<int>(imported.annotations.regions.size());
    if (result.objects == 0 && result.regions == 0) return result;  // classes alone are no import
    result.edit = editFor(imported, ground);
    for (const auto& change : result.edit.objects) result.keyframes += static_cast<int>(change.after->keyframes.size());
    return result;
}

LabelImport planImport(LabelFile labels, const SequenceRecord& sequence, const CameraMotion& camera,
                       AnnotationStore& store, double tolerance_px, Doubles doubles, LooseBoxes loose) {
    return planImport(std::move(labels), sequence, camera, ImportGround(store), tolerance_px, doubles, loose);
}

}  // namespace eyrie

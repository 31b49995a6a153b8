#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "formats/label_file.h"

namespace eyrie {
namespace {

Keyframe keyframeOf(const LabelBox& record) {
    Keyframe keyframe;
    keyframe.frame = record.frame;
    keyframe.box = record.box;
    keyframe.heading_set = true;
    keyframe.occlusion = record.occlusion;
    keyframe.ignore = record.ignore;
    return keyframe;
}

/// One keyframe per box; over a gap the object is outside.
std::map<ObjectId, LabelledObject> objectsOfBoxes(const LabelBoxes& boxes, std::vector<std::string>& notes) {
    std::map<ObjectId, LabelledObject> objects;
    std::map<ObjectId, std::map<std::string, int>> classes;
    for (const auto& [frame, records] : boxes) {
        for (const LabelBox& record : records) {
            if (!record.id) continue;
            LabelledObject& object = objects[*record.id];
            if (!object.keyframes.empty() && object.last_frame == frame) continue;  // an ignored box may repeat an id
            if (!object.keyframes.empty() && object.last_frame + 1 < frame) {
                Keyframe gap = object.keyframes.back();
                gap.frame = object.last_frame + 1;
                gap.outside = true;
                object.keyframes.push_back(gap);
            }
            object.id = *record.id;
            object.last_frame = frame;
            object.keyframes.push_back(keyframeOf(record));
            ++classes[*record.id][record.object_class];
        }
    }
    int changing = 0;
    for (auto& [id, object] : objects) {
        const auto& votes = classes.at(id);
        if (votes.size() > 1) ++changing;
        object.object_class = std::max_element(votes.begin(), votes.end(), [](const auto& a, const auto& b) {
                                  return a.second < b.second;
                              })->first;
    }
    if (changing > 0) {
        notes.push_back(std::to_string(changing) + " objects change their class; each takes its most frequent one");
    }
    return objects;
}

/// Ids of a project count from 1.
int numberFromOne(std::map<ObjectId, LabelledObject>& objects, std::vector<std::string>& notes) {
    if (objects.empty() || objects.begin()->first > 0) return 0;
    std::map<ObjectId, LabelledObject> moved;
    const int step = 1 - objects.begin()->first;
    for (auto& [id, object] : objects) {
        object.id = id + step;
        moved.emplace(object.id, std::move(object));
    }
    objects = std::move(moved);
    notes.push_back("ids were raised by " + std::to_string(step) + ": Eyrie's count from 1");
    return step;
}

/// Ignored boxes without id, merged while they stay as they are from frame to frame.
std::map<int, IgnoreRegion> regionsOf(const LabelBoxes& boxes) {
    std::map<int, IgnoreRegion> regions;
    std::vector<std::pair<OrientedBox, int>> open;  // box and the region it extends
    int next = 1;
    FrameIndex before = -2;
    for (const auto& [frame, records] : boxes) {
        std::vector<std::pair<OrientedBox, int>> still_open;
        const bool follows = before + 1 == frame;
        for (const LabelBox& record : records) {
            if (record.id || !record.ignore) continue;
            const OrientedBox& box = record.box;
            const auto same = std::find_if(open.begin(), open.end(), [&](const auto& entry) {
                const OrientedBox& other = entry.first;
                return follows && other.centre == box.centre && other.length == box.length &&
                       other.width == box.width && other.heading == box.heading;
            });
            if (same != open.end()) {
                regions.at(same->second).last_frame = frame;
                still_open.push_back(*same);
                open.erase(same);
                continue;
            }
            const auto corners = box.corners();
            IgnoreRegion region;
            region.id = next;
            region.polygon.assign(corners.begin(), corners.end());
            region.reference_frame = region.first_frame = region.last_frame = frame;
            regions.emplace(next, std::move(region));
            still_open.emplace_back(box, next++);
        }
        open = std::move(still_open);
        before = frame;
    }
    return regions;
}

}  // namespace

ImportedLabels annotationsOf(const LabelFile& labels) {
    ImportedLabels imported;
    std::map<ObjectId, LabelledObject>& objects = imported.annotations.objects;
    if (labels.objects.empty()) {
        objects = objectsOfBoxes(labels.boxes, imported.notes);
    } else {
        for (const LabelledObject& object : labels.objects) objects[object.id] = object;
    }
    imported.id_step = numberFromOne(objects, imported.notes);
    for (auto& [id, object] : objects) {
        object.origin = ObjectOrigin::imported;
        if (object.object_class.empty()) object.object_class = "other";
    }
    imported.annotations.regions = regionsOf(labels.boxes);
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records) imported.left_out += !record.id && !record.ignore;
    }
    static const std::set<std::string> known{"car", "truck", "bus", "van", "motorcycle", "bicycle", "person", "other"};
    std::set<std::string> own;
    for (const auto& [id, object] : objects) {
        if (!known.contains(object.object_class)) own.insert(object.object_class);
    }
    for (const std::string& name : own) {
        ObjectClass object_class;
        object_class.name = name;
        object_class.vehicle = isVehicleClass(name);
        imported.annotations.classes.push_back(object_class);
    }
    return imported;
}

}  // namespace eyrie

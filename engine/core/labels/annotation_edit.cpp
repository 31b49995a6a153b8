#include "core/labels/annotation_edit.h"

#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"

namespace eyrie {
namespace {

[[noreturn]] void refuse(const std::string& what) {
    throw Error(ErrorKind::internal, "this change of the labels cannot be made: " + what);
}

bool isFinite(const OrientedBox& box) {
    return std::isfinite(box.centre.x) && std::isfinite(box.centre.y) && std::isfinite(box.length) &&
           std::isfinite(box.width) && std::isfinite(box.heading);
}

template <class Value>
void invert(Change<Value>& change) {
    std::swap(change.before, change.after);
}

/// What is changed must be there, what is added must not.
template <class Value>
void checkChanges(const std::map<int, Value>& present, const std::vector<Change<Value>>& changes, const char* noun) {
    std::set<int> seen;
    for (const auto& change : changes) {
        if (!change.before && !change.after) refuse(std::string("a change of no ") + noun);
        if (change.before && change.after && change.before->id != change.after->id) {
            refuse(std::string(noun) + " " + std::to_string(change.before->id) + " would change its number");
        }
        const int id = change.before ? change.before->id : change.after->id;
        if (present.count(id) != (change.before ? 1U : 0U)) {
            refuse(std::string(noun) + " " + std::to_string(id) +
                   (change.before ? " is not there" : " is there already"));
        }
        if (!seen.insert(id).second) refuse(std::string(noun) + " " + std::to_string(id) + " would be changed twice");
    }
}

template <class Value>
void change(std::map<int, Value>& present, const std::vector<Change<Value>>& changes) {
    for (const auto& each : changes) {
        if (each.after) {
            present[each.after->id] = *each.after;
        } else {
            present.erase(each.before->id);
        }
    }
}

}  // namespace

AnnotationEdit inverseOf(AnnotationEdit edit) {
    for (auto& object : edit.objects) invert(object);
    for (auto& region : edit.regions) invert(region);
    if (edit.reviews) std::swap(edit.reviews->removed, edit.reviews->added);
    if (edit.classes) invert(*edit.classes);
    return edit;
}

void applyEdit(AnnotationSet& set, const AnnotationEdit& edit) {
    checkChanges(set.objects, edit.objects, "object");
    checkChanges(set.regions, edit.regions, "region");
    for (const auto& object : edit.objects) {
        if (object.after) checkObject(*object.after);
    }
    for (const auto& region : edit.regions) {
        if (region.after) checkRegion(*region.after);
    }
    if (edit.classes && edit.classes->after) {
        for (const ObjectClass& each : *edit.classes->after) {
            if (!std::isfinite(each.length_m) || !std::isfinite(each.width_m)) {
                refuse("a size of class " + each.name + " is not finite");
            }
        }
    }
    if (edit.reviews && edit.reviews->kept + edit.reviews->removed.size() != set.reviews.size()) {
        refuse("the review marks were changed in the meantime");
    }
    change(set.objects, edit.objects);
    change(set.regions, edit.regions);
    if (edit.reviews) {
        set.reviews.resize(edit.reviews->kept);
        set.reviews.insert(set.reviews.end(), edit.reviews->added.begin(), edit.reviews->added.end());
    }
    if (edit.classes) set.classes = edit.classes->after.value_or(std::vector<ObjectClass>{});
}

void checkObject(const LabelledObject& object) {
    const std::string who = "object " + std::to_string(object.id);
    if (object.id < 1) refuse(who + " has no number above 0");
    if (object.keyframes.empty()) refuse(who + " has no keyframe");
    FrameIndex before = -1;
    for (const Keyframe& keyframe : object.keyframes) {
        const std::string where = who + ", frame " + std::to_string(keyframe.frame);
        if (keyframe.frame <= before) refuse(where + ": keyframes must ascend from frame 0");
        if (!isFinite(keyframe.box)) refuse(where + ": a number of the box is not finite");
        if (keyframe.box.length < 0 || keyframe.box.width < 0) refuse(where + ": the box has a negative size");
        before = keyframe.frame;
    }
    if (object.last_frame < object.keyframes.front().frame) refuse(who + " ends before it begins");
}

void checkRegion(const IgnoreRegion& region) {
    const std::string who = "region " + std::to_string(region.id);
    if (region.id < 1) refuse(who + " has no number above 0");
    if (region.polygon.size() < 3) refuse(who + " has fewer than three corners");
    for (const cv::Point2d& corner : region.polygon) {
        if (!std::isfinite(corner.x) || !std::isfinite(corner.y)) refuse(who + ": a corner is not finite");
    }
    if (region.first_frame < 0 || region.last_frame < region.first_frame || region.reference_frame < 0) {
        refuse(who + " has an invalid range of frames");
    }
}

}  // namespace eyrie

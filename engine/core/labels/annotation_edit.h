#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation.h"
#include "core/labels/change.h"

/// Changes of labels as values: named, reversible, small enough to keep hundreds of.
namespace eyrie {

/// The end of a list replaced: `kept` values stay, `removed` went, `added` came in their place.
template <class Value>
struct TailChange {
    std::size_t kept = 0;
    std::vector<Value> removed;
    std::vector<Value> added;
};

/// One step of work on the labels of a sequence, as undone and redone.
struct AnnotationEdit {
    std::string name;  ///< for the menu: "Move box of car 12"
    std::vector<Change<LabelledObject>> objects;
    std::vector<Change<IgnoreRegion>> regions;
    std::optional<TailChange<ReviewMark>> reviews;
    std::optional<Change<std::vector<ObjectClass>>> classes;

    bool empty() const { return objects.empty() && regions.empty() && !reviews && !classes; }
};

/// The edit that takes the edit back.
AnnotationEdit inverseOf(AnnotationEdit edit);

/// Carries an edit out. Throws Error(internal), changing nothing, when `set` is not what the edit starts from: an
/// object to change is not there, one to add is there already, an object without keyframes or with frames out of order.
void applyEdit(AnnotationSet& set, const AnnotationEdit& edit);

/// Throws Error(internal) naming the object and what is wrong: no keyframes, frames out of order or negative, an end
/// before the first keyframe, numbers that are not finite, negative sizes.
void checkObject(const LabelledObject& object);
void checkRegion(const IgnoreRegion& region);

}  // namespace eyrie

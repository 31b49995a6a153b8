#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/labels/annotation.h"

namespace eyrie {

/// A run of frames of an object with the same judgement.
struct ReviewSpan {
    FrameIndex first_frame = 0;
    FrameIndex last_frame = 0;  ///< included
    ReviewState state = ReviewState::unseen;
    std::string person;
    std::string when_utc;
};

/// The marks of a sequence brought into order: later ones replace earlier ones where they meet. Built once per change.
class ReviewIndex {
 public:
    explicit ReviewIndex(const AnnotationSet& set);

    ReviewState stateAt(ObjectId object, FrameIndex frame) const;
    /// The whole life of an object, without gaps, ascending; unseen spans included. Empty for an unknown object.
    const std::vector<ReviewSpan>& spansOf(ObjectId object) const;
    /// Share of all frames of all objects that are checked, 0 … 1; 0 when there is nothing.
    double checkedShare() const;

    struct Place {
        ObjectId object = 0;
        FrameIndex frame = 0;
    };
    /// The next object and frame nobody has checked: later frames of the same object first, then the objects with
    /// higher ids from their first unchecked frame on, then from the lowest id on. Nothing when all is checked.
    std::optional<Place> nextUnchecked(ObjectId object, FrameIndex frame) const;

 private:
    std::map<ObjectId, std::vector<ReviewSpan>> spans_;
};

}  // namespace eyrie

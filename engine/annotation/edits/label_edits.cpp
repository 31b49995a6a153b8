// The part of identity_edits.h that makes edits of changes.
#include <algorithm>
#include <set>

#include "annotation/edits/identity_edits.h"

namespace eyrie {
namespace {

bool sameMark(const ReviewMark& a, const ReviewMark& b) {
    return a.object == b.object && a.first_frame == b.first_frame && a.last_frame == b.last_frame &&
           a.state == b.state && a.person == b.person && a.when_utc == b.when_utc;
}

/// The change from one list of marks to another; nothing when they are the same.
std::optional<TailChange<ReviewMark>> tailChange(const std::vector<ReviewMark>& before,
                                                 const std::vector<ReviewMark>& after) {
    const auto [a, b] = std::mismatch(before.begin(), before.end(), after.begin(), after.end(), sameMark);
    if (a == before.end() && b == after.end()) return std::nullopt;
    return TailChange<ReviewMark>{static_cast<std::size_t>(a - before.begin()), {a, before.end()}, {b, after.end()}};
}

/// Marks after moves: what lies in the range of a move goes over, the rest stays.
std::vector<ReviewMark> movedMarks(const std::vector<ReviewMark>& marks, const std::vector<ReviewMove>& moves) {
    std::vector<ReviewMark> result;
    for (const ReviewMark& mark : marks) {
        std::vector<ReviewMark> staying{mark};
        std::vector<ReviewMark> going;
        for (const ReviewMove& move : moves) {
            if (move.from != mark.object) continue;
            std::vector<ReviewMark> rest;
            for (const ReviewMark& part : staying) {
                const FrameIndex first = std::max(part.first_frame, move.first_frame);
                const FrameIndex last = std::min(part.last_frame, move.last_frame);
                if (first > last) {
                    rest.push_back(part);
                    continue;
                }
                ReviewMark piece = part;
                if (part.first_frame < first) {
                    piece.last_frame = first - 1;
                    rest.push_back(piece);
                }
                piece = part;
                piece.object = move.to;
                piece.first_frame = first;
                piece.last_frame = last;
                going.push_back(piece);
                piece = part;
                if (part.last_frame > last) {
                    piece.first_frame = last + 1;
                    rest.push_back(piece);
                }
            }
            staying = std::move(rest);
        }
        result.insert(result.end(), staying.begin(), staying.end());
        result.insert(result.end(), going.begin(), going.end());
    }
    return result;
}

void addChange(AnnotationEdit& edit, const AnnotationSet& set, const LabelledObject& after) {
    const auto present = set.objects.find(after.id);
    edit.objects.push_back(
        {present == set.objects.end() ? std::nullopt : std::optional<LabelledObject>(present->second), after});
}

}  // namespace

AnnotationEdit editOf(const std::string& name, const AnnotationSet& set, const IdentityChange& change) {
    AnnotationEdit edit;
    edit.name = name;
    for (const LabelledObject& after : change.after) addChange(edit, set, after);
    for (const ObjectId id : change.removed) {
        const auto present = set.objects.find(id);
        if (present != set.objects.end()) edit.objects.push_back({present->second, std::nullopt});
    }
    std::vector<ReviewMark> marks = movedMarks(set.reviews, change.review_moves);
    const std::set<ObjectId> removed(change.removed.begin(), change.removed.end());
    marks.erase(std::remove_if(marks.begin(), marks.end(),
                               [&](const ReviewMark& mark) { return removed.count(mark.object) > 0; }),
                marks.end());
    edit.reviews = tailChange(set.reviews, marks);
    return edit;
}

AnnotationEdit editOf(const std::string& name, const AnnotationSet& set, const std::vector<LabelledObject>& after) {
    AnnotationEdit edit;
    edit.name = name;
    for (const LabelledObject& object : after) addChange(edit, set, object);
    return edit;
}

AnnotationEdit deletionOf(const std::string& name, const AnnotationSet& set, const std::vector<ObjectId>& ids) {
    IdentityChange change;
    change.removed = ids;
    return editOf(name, set, change);
}

AnnotationEdit regionEdit(const std::string& name, const AnnotationSet& set, const std::vector<IgnoreRegion>& after,
                          const std::vector<int>& removed) {
    AnnotationEdit edit;
    edit.name = name;
    const auto presentOf = [&](int id) {
        const auto present = set.regions.find(id);
        return present == set.regions.end() ? std::nullopt : std::optional<IgnoreRegion>(present->second);
    };
    for (const IgnoreRegion& region : after) edit.regions.push_back({presentOf(region.id), region});
    for (const int id : removed) {
        if (auto present = presentOf(id)) edit.regions.push_back({std::move(present), std::nullopt});
    }
    return edit;
}

AnnotationEdit reviewEdit(const std::string& name, const AnnotationSet& set, const std::vector<ReviewMark>& marks) {
    AnnotationEdit edit;
    edit.name = name;
    if (!marks.empty()) edit.reviews = TailChange<ReviewMark>{set.reviews.size(), {}, marks};
    return edit;
}

}  // namespace eyrie

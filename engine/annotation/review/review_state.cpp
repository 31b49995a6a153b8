#include "annotation/review/review_state.h"

#include <algorithm>

#include "annotation/keyframes/interpolation.h"

namespace eyrie {
namespace {

/// The span at or after a frame.
auto spanAt(const std::vector<ReviewSpan>& spans, FrameIndex frame) {
    return std::lower_bound(spans.begin(), spans.end(), frame,
                            [](const ReviewSpan& span, FrameIndex f) { return span.last_frame < f; });
}

/// Lays a mark over spans without gaps.
std::vector<ReviewSpan> covered(const std::vector<ReviewSpan>& spans, const ReviewMark& mark) {
    std::vector<ReviewSpan> result;
    for (const ReviewSpan& span : spans) {
        const FrameIndex first = std::max(span.first_frame, mark.first_frame);
        const FrameIndex last = std::min(span.last_frame, mark.last_frame);
        if (first > last) {
            result.push_back(span);
            continue;
        }
        ReviewSpan piece = span;
        if (span.first_frame < first) {
            piece.last_frame = first - 1;
            result.push_back(piece);
        }
        result.push_back({first, last, mark.state, mark.person, mark.when_utc});
        if (span.last_frame > last) {
            piece = span;
            piece.first_frame = last + 1;
            result.push_back(piece);
        }
    }
    return result;
}

/// Neighbouring spans of the same judgement as one.
std::vector<ReviewSpan> merged(const std::vector<ReviewSpan>& spans) {
    std::vector<ReviewSpan> result;
    for (const ReviewSpan& span : spans) {
        if (!result.empty() && result.back().state == span.state && result.back().person == span.person &&
            result.back().when_utc == span.when_utc) {
            result.back().last_frame = span.last_frame;
        } else {
            result.push_back(span);
        }
    }
    return result;
}

}  // namespace

ReviewIndex::ReviewIndex(const AnnotationSet& set) {
    for (const auto& [id, object] : set.objects) {
        if (object.keyframes.empty()) continue;
        spans_[id] = {{firstFrameOf(object), object.last_frame, ReviewState::unseen, "", ""}};
    }
    for (const ReviewMark& mark : set.reviews) {
        const auto found = spans_.find(mark.object);
        if (found != spans_.end()) found->second = merged(covered(found->second, mark));
    }
}

ReviewState ReviewIndex::stateAt(ObjectId object, FrameIndex frame) const {
    const auto found = spans_.find(object);
    if (found == spans_.end()) return ReviewState::unseen;
    const auto span = spanAt(found->second, frame);
    return span != found->second.end() && span->first_frame <= frame ? span->state : ReviewState::unseen;
}

const std::vector<ReviewSpan>& ReviewIndex::spansOf(ObjectId object) const {
    static const std::vector<ReviewSpan> nothing;
    const auto found = spans_.find(object);
    return found == spans_.end() ? nothing : found->second;
}

double ReviewIndex::checkedShare() const {
    double all = 0;
    double checked = 0;
    for (const auto& [id, spans] : spans_) {
        for (const ReviewSpan& span : spans) {
            const double frames = span.last_frame - span.first_frame + 1;
            all += frames;
            if (span.state == ReviewState::checked) checked += frames;
        }
    }
    return all > 0 ? checked / all : 0;
}

std::optional<ReviewIndex::Place> ReviewIndex::nextUnchecked(ObjectId object, FrameIndex frame) const {
    const auto firstUnchecked = [](const std::vector<ReviewSpan>& spans, FrameIndex from) -> std::optional<FrameIndex> {
        for (const ReviewSpan& span : spans) {
            if (span.state != ReviewState::checked && span.last_frame >= from) return std::max(from, span.first_frame);
        }
        return std::nullopt;
    };
    const auto own = spans_.find(object);
    if (own != spans_.end()) {
        if (const auto there = firstUnchecked(own->second, frame + 1)) return Place{object, *there};
    }
    const auto after = spans_.upper_bound(object);
    for (auto it = after; it != spans_.end(); ++it) {
        if (const auto there = firstUnchecked(it->second, 0)) return Place{it->first, *there};
    }
    for (auto it = spans_.begin(); it != after; ++it) {
        if (const auto there = firstUnchecked(it->second, 0)) return Place{it->first, *there};
    }
    return std::nullopt;
}

}  // namespace eyrie

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

std::vector<float> ReviewIndex::checkedShares(FrameIndex first, FrameIndex last) const {
    if (last < first) return {};
    // Differences first, sums after: a span costs two steps however long it is.
    const auto size = static_cast<std::size_t>(last - first + 1);
    std::vector<int> all(size + 1);
    std::vector<int> checked(size + 1);
    for (const auto& [id, spans] : spans_) {
        for (const ReviewSpan& span : spans) {
            const FrameIndex begin = std::max(first, span.first_frame);
            const FrameIndex end = std::min(last, span.last_frame);
            if (begin > end) continue;
            const auto from = static_cast<std::size_t>(begin - first);
            const auto to = static_cast<std::size_t>(end - first + 1);
            ++all[from];
            --all[to];
            if (span.state != ReviewState::checked) continue;
            ++checked[from];
            --checked[to];
        }
    }
    std::vector<float> shares(size);
    int objects = 0;
    int done = 0;
    for (std::size_t i = 0; i < size; ++i) {
        objects += all[i];
        done += checked[i];
        shares[i] = objects > 0 ? static_cast<float>(done) / static_cast<float>(objects) : 1.F;
    }
    return shares;
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

std::optional<ReviewIndex::Place> ReviewIndex::nextUncheckedInTime(FrameIndex frame) const {
    std::optional<Place> next;
    std::optional<Place> first;
    for (const auto& [id, spans] : spans_) {
        for (const ReviewSpan& span : spans) {
            if (span.state == ReviewState::checked) continue;
            if (!first || span.first_frame < first->frame) first = Place{id, span.first_frame};
            if (span.last_frame <= frame) continue;
            const FrameIndex there = std::max(frame + 1, span.first_frame);
            if (!next || there < next->frame) next = Place{id, there};
        }
    }
    return next ? next : first;
}

}  // namespace eyrie

#include "annotation/review/proposals.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core/utility.hpp>

#include "annotation/edits/object_pieces.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/review/join_suggestions.h"

namespace eyrie {
namespace {

/// The object that shows the same boxes for the most part, if there is one; some frames are looked at.
ObjectId labelledAlready(const DenseTrack& track, const AnnotationSet& labelled, const CameraMotion& camera,
                         double min_overlap) {
    constexpr std::size_t kLooks = 12;
    const std::size_t step = std::max<std::size_t>(1, track.boxes.size() / kLooks);
    ObjectId best = 0;
    double most = 0;
    for (const auto& [id, object] : labelled.objects) {
        if (object.last_frame < track.boxes.front().frame || firstFrameOf(object) > track.boxes.back().frame) continue;
        double sum = 0;
        int looks = 0;
        int shared = 0;
        for (std::size_t i = 0; i < track.boxes.size(); i += step) {
            ++looks;
            const LabelledBox box = boxAt(object, track.boxes[i].frame, camera);
            if (!box.visible()) continue;
            ++shared;
            sum += overlap(box.box, track.boxes[i].box);
        }
        // At least a third of the track, so that a vehicle that passes another is not taken for it.
        if (shared * 3 >= looks && shared > 0 && sum / shared > most) {
            most = sum / shared;
            best = id;
        }
    }
    return most >= min_overlap ? best : 0;
}

Proposal propose(const DenseTrack& track, const AnnotationSet& labelled, const CameraMotion& camera,
                 const ProposalOptions& options) {
    Proposal proposal;
    proposal.track = track.id;
    proposal.track_class = track.track_class;
    proposal.object.object_class = options.object_class;
    proposal.object.origin = ObjectOrigin::proposal_accepted;
    ReductionOptions reduction = options.reduction;
    std::vector<double> lengths;
    for (const FrameBox& box : track.boxes) lengths.push_back(box.box.length);
    std::nth_element(lengths.begin(), lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2), lengths.end());
    const double usual = lengths[lengths.size() / 2];
    if (reduction.tolerance_px > 0)
        reduction.tolerance_px = std::max(reduction.tolerance_px, options.tolerance_of_length * usual);
    reduction.thorough = true;  // every keyframe less is one less to check
    proposal.object.keyframes = reduceToKeyframes(track.boxes, camera, reduction);
    for (Keyframe& keyframe : proposal.object.keyframes) keyframe.computed = true;
    proposal.object.last_frame = track.boxes.back().frame;
    proposal.max_corner_px = reductionError(proposal.object, track.boxes, camera).corner_px;
    proposal.same_as = labelledAlready(track, labelled, camera, options.min_overlap_with_object);
    return proposal;
}

/// An object that shows the vehicle of a proposal in some of its frames, or shortly before or after; null: none does.
const LabelledObject* neighbourOf(const LabelledObject& proposed, const AnnotationSet& labelled,
                                  const CameraMotion& camera) {
    constexpr int kLongestGap = 50;  // frames
    // Where both are seen, those that are far apart all the time are left out before anything is compared closely.
    const auto near_in = [&](const LabelledObject& object) {
        const FrameIndex first = std::max(firstFrameOf(object), firstFrameOf(proposed));
        const FrameIndex last = std::min(object.last_frame, proposed.last_frame);
        if (first > last) return true;
        const auto near_at = [&](FrameIndex frame) {
            const OrientedBox there = boxAt(object, frame, camera).box;
            const OrientedBox here = boxAt(proposed, frame, camera).box;
            return cv::norm(there.centre - here.centre) < there.length + here.length;
        };
        return near_at(first) || near_at((first + last) / 2) || near_at(last);
    };
    AnnotationSet near;
    for (const auto& [id, object] : labelled.objects) {
        if (object.last_frame + kLongestGap < firstFrameOf(proposed)) continue;
        if (firstFrameOf(object) > proposed.last_frame + kLongestGap) continue;
        if (!near_in(object)) continue;
        near.objects.emplace_hint(near.objects.end(), id, object);
    }
    if (near.objects.empty()) return nullptr;
    const ObjectId id = 0;  // proposals have no number yet
    near.objects[id] = proposed;
    near.objects[id].id = id;
    const auto fusions = suggestFusions(near, id, camera);
    if (!fusions.empty()) return &labelled.objects.at(fusions.front().object);
    SuggestionOptions options;
    options.max_gap = kLongestGap;
    options.max_distance_px = proposed.keyframes.front().box.length;  // farther off it may be another vehicle
    options.px_per_gap_frame = 0;
    options.max_count = 1;
    const auto joins = suggestJoins(near, id, camera, options);
    return joins.empty() ? nullptr : &labelled.objects.at(joins.front().object);
}

}  // namespace

std::string classOfProposal(const Proposal& proposal, const AnnotationSet& labelled, const CameraMotion& camera,
                            const std::string& drawn) {
    if (!proposal.object.keyframes.empty())
        if (const LabelledObject* neighbour = neighbourOf(proposal.object, labelled, camera))
            return neighbour->object_class;
    // A class of one's own may be of any kind.
    const TrackClass kind = trackClassOf(drawn);
    const bool agrees = kind == TrackClass::unknown || kind == proposal.track_class;
    return agrees || proposal.track_class == TrackClass::unknown ? drawn : commonestWordOf(proposal.track_class);
}

std::vector<Proposal> proposeTracks(const std::vector<DenseTrack>& tracks, const AnnotationSet& labelled,
                                    const CameraMotion& camera, const ProposalOptions& options) {
    std::vector<const DenseTrack*> offered;
    for (const DenseTrack& track : tracks) {
        if (static_cast<int>(track.boxes.size()) >= std::max(1, options.min_frames)) offered.push_back(&track);
    }
    std::vector<Proposal> proposals(offered.size());
    cv::parallel_for_({0, static_cast<int>(offered.size())}, [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            const auto place = static_cast<std::size_t>(i);
            proposals[place] = propose(*offered[place], labelled, camera, options);
        }
    });
    return proposals;
}

LabelledObject cutToRange(const LabelledObject& object, FrameIndex first, FrameIndex last, const CameraMotion& camera) {
    if (std::max(first, firstFrameOf(object)) > std::min(last, object.last_frame)) {
        LabelledObject nothing = object;
        nothing.keyframes.clear();
        return nothing;
    }
    return pieceOf(object, first, last, camera);
}

LabelledObject accepted(const Proposal& proposal, ObjectId id, std::uint32_t colour) {
    LabelledObject object = proposal.object;
    object.id = id;
    object.colour = colour;
    object.origin = ObjectOrigin::proposal_accepted;
    return object;
}

ObjectOrigin originAfterChange(ObjectOrigin origin) {
    return origin == ObjectOrigin::proposal_accepted ? ObjectOrigin::proposal_corrected : origin;
}

}  // namespace eyrie

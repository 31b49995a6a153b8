#include "scoring/scoring.h"

#include <algorithm>

#include "core/error.h"

namespace eyrie {
namespace {

std::string rangeText(const ScoredFrames& frames) {
    return std::to_string(frames.first) + " to " + std::to_string(frames.second);
}

bool holdsBoxes(const BoxesByFrame::value_type& frame) {
    return !frame.second.empty();
}

void keepFrames(GroundTruth& truth, const ScoredFrames& covered) {
    BoxesByFrame within(truth.boxes.lower_bound(covered.first), truth.boxes.upper_bound(covered.second));
    if (std::none_of(within.begin(), within.end(), holdsBoxes)) {
        std::string known = "none at all";
        const auto first = std::find_if(truth.boxes.begin(), truth.boxes.end(), holdsBoxes);
        if (first != truth.boxes.end()) {
            const auto last = std::find_if(truth.boxes.rbegin(), truth.boxes.rend(), holdsBoxes);
            known = "only in frames " + rangeText({first->first, last->first});
        }
        throw Error(ErrorKind::input, truth.name + ": holds no box in the frames to be measured, " +
                                          rangeText(covered) + ", " + known +
                                          "; is it the ground truth of this video, and does it count frames alike?");
    }
    const std::size_t all = truth.boxes.size();
    if (within.size() < all) {
        truth.remarks.push_back("the result covers frames " + rangeText(covered) + ", so " +
                                std::to_string(all - within.size()) + " of " + std::to_string(all) +
                                " frames of the ground truth were left out");
    }
    truth.boxes = std::move(within);
}

}  // namespace

Scoring scoringOf(GroundTruth truth, const EvaluationOptions& wishes, const std::optional<ScoredFrames>& covered) {
    Scoring scoring{std::move(truth), wishes};
    GroundTruth& kept = scoring.truth;
    const bool upright = allUpright(kept.boxes);
    if (covered) keepFrames(kept, *covered);
    if (wishes.upright) return scoring;
    if (!kept.has_headings) {
        scoring.options.upright = true;
        kept.remarks.push_back(kept.name + ": its format has no headings, so enclosing upright boxes are compared");
    } else if (upright) {
        kept.remarks.push_back(kept.name + ": all boxes are upright; if they have no headings, compare upright boxes");
    }
    return scoring;
}

ScoredFrames coveredFrames(const RunRecord& run) {
    return {run.first_frame, run.first_frame + run.frames_done - 1};
}

}  // namespace eyrie

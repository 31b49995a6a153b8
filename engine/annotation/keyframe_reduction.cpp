#include "annotation/keyframe_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "annotation/corner_distance.h"
#include "annotation/keyframe_thinning.h"

namespace eyrie {
namespace {

/// Keeps the deviation of every dense box while keyframes come and go, computing anew only what a change can reach.
class Reducer {
 public:
    Reducer(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
            const ReductionOptions& options, bool set_headings)
        : object_(std::move(object)),
          boxes_(boxes),
          camera_(camera),
          options_(options),
          set_headings_(set_headings),
          excess_(boxes.size()) {
        measure(0, boxes_.size());
    }

    /// Adds keyframes where it is worst until all is within the tolerance.
    void insertUntilGood() {
        for (;;) {
            const std::size_t worst = worstBox();
            if (excess_[worst] <= 1) return;
            if (!improve(boxes_[worst])) {
                // The interpolation cannot be told any better here.
                given_up_.push_back(worst);
                excess_[worst] = 0;
            }
        }
    }

    /// Takes out keyframes that are not needed, as long as there are any; the first stays.
    void removeNeedless() {
        for (bool removed = true; removed;) {
            removed = false;
            for (std::size_t i = object_.keyframes.size(); i-- > 1;) removed = tryWithout(i) || removed;
        }
    }

    /// Tries every inner keyframe earlier and later; a better place may make another needless.
    void shift() {
        for (std::size_t i = 1; i + 1 < object_.keyframes.size(); ++i) tryShifted(i);
    }

    const LabelledObject& object() const { return object_; }
    /// Nothing had to be given up.
    bool allWithin() const { return given_up_.empty(); }
    std::size_t keyframeCount() const { return object_.keyframes.size(); }

 private:
    double excessOf(std::size_t i) const { return deviationOf(object_, boxes_[i], camera_, options_); }

    void measure(std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) excess_[i] = excessOf(i);
        for (const std::size_t i : given_up_) excess_[i] = 0;
    }

    std::size_t worstBox() const {
        return static_cast<std::size_t>(std::max_element(excess_.begin(), excess_.end()) - excess_.begin());
    }

    std::size_t boxFrom(FrameIndex frame) const {
        return static_cast<std::size_t>(
            std::lower_bound(boxes_.begin(), boxes_.end(), frame,
                             [](const FrameBox& box, FrameIndex f) { return box.frame < f; }) -
            boxes_.begin());
    }

    /// The dense boxes that keyframe i can reach: three pieces to either side.
    std::pair<std::size_t, std::size_t> reachOf(std::size_t keyframe) const {
        constexpr std::size_t kReach = 3;
        const auto& keyframes = object_.keyframes;
        const std::size_t first = keyframe > kReach ? boxFrom(keyframes[keyframe - kReach].frame) : 0;
        const std::size_t last =
            keyframe + kReach < keyframes.size() ? boxFrom(keyframes[keyframe + kReach].frame) : boxes_.size();
        return {first, last};
    }

    void measureAround(std::size_t keyframe) {
        const auto [first, last] = reachOf(std::min(keyframe, object_.keyframes.size() - 1));
        measure(first, last);
    }

    /// A keyframe for a dense box, or its heading set if it has one already. Answers whether that changed anything.
    bool improve(const FrameBox& box) {
        auto& keyframes = object_.keyframes;
        auto place = std::lower_bound(keyframes.begin(), keyframes.end(), box.frame,
                                      [](const Keyframe& keyframe, FrameIndex f) { return keyframe.frame < f; });
        if (place != keyframes.end() && place->frame == box.frame) {
            if (place->heading_set) return false;
            setHeading(*place, box);
            measureAround(static_cast<std::size_t>(place - keyframes.begin()));
            return true;
        }
        Keyframe keyframe = place == keyframes.begin() ? keyframes.front() : *(place - 1);
        keyframe.frame = box.frame;
        keyframe.box = box.box;
        keyframe.heading_set = set_headings_;
        place = keyframes.insert(place, keyframe);
        const auto here = static_cast<std::size_t>(place - keyframes.begin());
        // The path has changed, and with it the headings that follow it.
        for (std::size_t i = here > 0 ? here - 1 : 0; i <= here + 1 && i < keyframes.size(); ++i) {
            const std::size_t dense = boxFrom(keyframes[i].frame);
            if (dense < boxes_.size() && boxes_[dense].frame == keyframes[i].frame && excessOf(dense) > 1) {
                setHeading(keyframes[i], boxes_[dense]);
            }
        }
        measureAround(here);
        return true;
    }

    static void setHeading(Keyframe& keyframe, const FrameBox& box) {
        keyframe.heading_set = true;
        keyframe.box.heading = box.box.heading;
    }

    bool tryWithout(std::size_t i) {
        auto& keyframes = object_.keyframes;
        const Keyframe kept = keyframes[i];
        const auto [first, last] = reachOf(i);
        keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(i));
        for (std::size_t k = first; k < last; ++k) {
            if (excess_[k] <= 1 && !isGivenUp(k) && excessOf(k) > 1) {
                keyframes.insert(keyframes.begin() + static_cast<std::ptrdiff_t>(i), kept);
                return false;
            }
        }
        measure(first, last);
        return true;
    }

    bool isGivenUp(std::size_t box) const {
        return std::find(given_up_.begin(), given_up_.end(), box) != given_up_.end();
    }

    /// The largest excess in a range; stops looking beyond `enough`.
    double worstIn(std::size_t first, std::size_t last, double enough) const {
        double worst = 0;
        for (std::size_t i = first; i < last && worst < enough; ++i) {
            if (!isGivenUp(i)) worst = std::max(worst, excessOf(i));
        }
        return worst;
    }

    void tryShifted(std::size_t i) {
        auto& keyframes = object_.keyframes;
        const auto [first, last] = reachOf(i);
        const FrameIndex low = keyframes[i - 1].frame;
        const FrameIndex high = keyframes[i + 1].frame;
        const FrameIndex here = keyframes[i].frame;
        Keyframe best = keyframes[i];
        double least = worstIn(first, last, std::numeric_limits<double>::max());
        constexpr int kPlaces = 8;
        for (int k = -kPlaces; k <= kPlaces; ++k) {
            const std::size_t there = boxFrom(here + (k < 0 ? here - low : high - here) * k / (2 * kPlaces));
            if (there >= boxes_.size()) continue;
            const FrameBox& box = boxes_[there];
            if (box.frame <= low || box.frame >= high || box.frame == here) continue;
            keyframes[i].frame = box.frame;
            keyframes[i].box = box.box;
            const double worst = worstIn(first, last, least);
            if (worst < least - 1e-9) {
                least = worst;
                best = keyframes[i];
            }
        }
        keyframes[i] = best;
        measure(first, last);
    }

    LabelledObject object_;
    const std::vector<FrameBox>& boxes_;
    const CameraMotion& camera_;
    const ReductionOptions& options_;
    bool set_headings_;
    std::vector<double> excess_;
    std::vector<std::size_t> given_up_;
};

LabelledObject startOf(const std::vector<FrameBox>& boxes, bool set_headings) {
    LabelledObject object;
    Keyframe first;
    first.frame = boxes.front().frame;
    first.box = boxes.front().box;
    first.heading_set = set_headings;
    object.keyframes.push_back(first);
    object.last_frame = boxes.back().frame;
    return object;
}

// Long searches are not worth it for what has many keyframes anyway.
constexpr std::size_t kMostToThin = 20;

std::vector<Keyframe> reduced(const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                              const ReductionOptions& options, bool set_headings) {
    Reducer reducer(startOf(boxes, set_headings), boxes, camera, options, set_headings);
    reducer.insertUntilGood();
    reducer.removeNeedless();
    // Better places for the keyframes left may make more of them needless.
    constexpr int kRounds = 4;
    for (int round = 0; round < kRounds; ++round) {
        const std::size_t before = reducer.keyframeCount();
        reducer.shift();
        reducer.insertUntilGood();
        reducer.removeNeedless();
        if (reducer.keyframeCount() >= before) break;
    }
    if (!options.thorough || !reducer.allWithin() || reducer.keyframeCount() > kMostToThin)
        return reducer.object().keyframes;
    return thinned(reducer.object(), boxes, camera, options).keyframes;
}

}  // namespace

std::vector<Keyframe> reduceToKeyframes(const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                                        const ReductionOptions& options) {
    if (boxes.empty()) return {};
    if (options.headings_set) return reduced(boxes, camera, options, true);
    auto free = reduced(boxes, camera, options, false);
    if (free.size() <= 2) return free;
    // Headings help through turns; noisy ones do not.
    auto headed = reduced(boxes, camera, options, true);
    return headed.size() < free.size() ? headed : free;
}

ReductionError reductionError(const LabelledObject& object, const std::vector<FrameBox>& boxes,
                              const CameraMotion& camera, PathShape shape) {
    ReductionError error;
    double worst = -1;
    for (const FrameBox& box : boxes) {
        const LabelledBox found = boxAt(object, box.frame, camera, shape);
        const double corner =
            found.exists() ? cornerDistance(found.box, box.box) : std::numeric_limits<double>::infinity();
        error.min_overlap = std::min(error.min_overlap, found.exists() ? overlap(found.box, box.box) : 0);
        if (corner > worst) {
            worst = corner;
            error.worst_frame = box.frame;
        }
        error.corner_px = std::max(error.corner_px, corner);
    }
    return error;
}

LabelledObject refined(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const ReductionOptions& options) {
    if (boxes.empty() || object.keyframes.empty()) return object;
    const bool set_headings = object.keyframes.front().heading_set;
    Reducer reducer(std::move(object), boxes, camera, options, set_headings);
    reducer.insertUntilGood();
    return reducer.object();
}

}  // namespace eyrie

#include "annotation/keyframes/keyframe_reduction.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "annotation/edits/carried_boxes.h"
#include "annotation/edits/corner_distance.h"
#include "annotation/keyframes/dense_boxes.h"
#include "annotation/keyframes/keyframe_thinning.h"

namespace eyrie {
namespace {

/// Keeps the deviation of every dense box while keyframes come and go, computing anew only what a change can reach.
class Reducer {
 public:
    Reducer(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
            const ReductionOptions& options, bool set_headings)
        : object_(std::move(object)),
          boxes_(boxes, options),
          camera_(camera),
          carried_(camera, boxes.size()),
          options_(options),
          set_headings_(set_headings),
          excess_(boxes.size()),
          given_up_(boxes.size(), 0),
          suspect_(boxes.size()) {
        measure(0, boxes_.size());
    }

    /// Adds keyframes where it is worst until all is within the tolerance.
    void insertUntilGood() {
        for (;;) {
            const std::size_t worst = excess_.worst();
            if (excess_[worst] <= 1) return;
            if (!improve(boxes_[worst])) {
                // The interpolation cannot be told any better here.
                given_up_[worst] = 1;
                all_within_ = false;
                excess_.set(worst, 0);
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
    bool allWithin() const { return all_within_; }
    std::size_t keyframeCount() const { return object_.keyframes.size(); }

 private:
    BoxReader shown() const { return {object_, camera_, options_.shape, &carried_}; }

    double excessOf(std::size_t i) const {
        BoxReader reader = shown();
        return boxes_.deviation(i, reader);
    }

    void measure(std::size_t first, std::size_t last) {
        BoxReader reader = shown();
        for (std::size_t i = first; i < last; ++i) excess_.set(i, given_up_[i] ? 0 : boxes_.deviation(i, reader));
    }

    /// The dense boxes that keyframe i can reach: three pieces to either side.
    std::pair<std::size_t, std::size_t> reachOf(std::size_t keyframe) const {
        const auto& keyframes = object_.keyframes;
        const std::size_t first =
            keyframe > kKeyframeReach ? boxes_.from(keyframes[keyframe - kKeyframeReach].frame) : 0;
        const std::size_t last = keyframe + kKeyframeReach < keyframes.size()
                                     ? boxes_.from(keyframes[keyframe + kKeyframeReach].frame)
                                     : boxes_.size();
        return {first, last};
    }

    void measureAround(std::size_t keyframe) {
        const auto [first, last] = reachOf(keyframe);
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
            const std::size_t dense = boxes_.from(keyframes[i].frame);
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
        // Between its neighbours it is missed most.
        const std::size_t low = boxes_.from(keyframes[i - 1].frame);
        const std::size_t high = i + 1 < keyframes.size() ? boxes_.from(keyframes[i + 1].frame) : last;
        keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(i));
        if (!staysGood(low, high) || !staysGood(first, low) || !staysGood(high, last)) {
            keyframes.insert(keyframes.begin() + static_cast<std::ptrdiff_t>(i), kept);
            return false;
        }
        measure(first, last);
        return true;
    }

    /// Whether boxes that were within the tolerance are still.
    bool staysGood(std::size_t first, std::size_t last) const {
        BoxReader reader = shown();
        for (std::size_t k = first; k < last; ++k) {
            if (excess_[k] <= 1 && !given_up_[k] && boxes_.deviation(k, reader) > 1) return false;
        }
        return true;
    }

    /// The largest excess in a range; any that is no less than `enough` where there is one.
    double worstIn(std::size_t first, std::size_t last, double enough) {
        BoxReader reader = shown();
        double worst = 0;
        // What one place for a keyframe leaves far off, the next often does, too.
        if (suspect_ >= first && suspect_ < last) worst = boxes_.deviation(suspect_, reader);
        for (std::size_t i = first; i < last && worst < enough; ++i) {
            if (given_up_[i]) continue;
            const double excess = boxes_.deviation(i, reader);
            if (excess > worst) {
                worst = excess;
                suspect_ = i;
            }
        }
        return worst;
    }

    void tryShifted(std::size_t i) {
        auto& keyframes = object_.keyframes;
        const std::vector<std::size_t> places = placesBeside(i);
        if (places.empty()) return;
        const auto [first, last] = reachOf(i);
        Keyframe best = keyframes[i];
        double least = worstIn(first, last, std::numeric_limits<double>::max());
        for (const std::size_t there : places) {
            keyframes[i].frame = boxes_[there].frame;
            keyframes[i].box = boxes_[there].box;
            const double worst = worstIn(first, last, least);
            if (worst < least - 1e-9) {
                least = worst;
                best = keyframes[i];
            }
        }
        keyframes[i] = best;
        measure(first, last);
    }

    /// Boxes between its neighbours that a keyframe could be at instead.
    std::vector<std::size_t> placesBeside(std::size_t i) const {
        const auto& keyframes = object_.keyframes;
        const FrameIndex low = keyframes[i - 1].frame;
        const FrameIndex high = keyframes[i + 1].frame;
        const FrameIndex here = keyframes[i].frame;
        std::vector<std::size_t> places;
        constexpr int kPlaces = 8;
        for (int k = -kPlaces; k <= kPlaces; ++k) {
            const std::size_t there = boxes_.from(here + (k < 0 ? here - low : high - here) * k / (2 * kPlaces));
            if (there >= boxes_.size()) continue;
            const FrameIndex frame = boxes_[there].frame;
            const bool tried = !places.empty() && places.back() == there;
            if (frame > low && frame < high && frame != here && !tried) places.push_back(there);
        }
        return places;
    }

    LabelledObject object_;
    DenseBoxes boxes_;
    const CameraMotion& camera_;
    mutable CarriedBoxes carried_;
    const ReductionOptions& options_;
    bool set_headings_;
    Deviations excess_;
    std::vector<char> given_up_;  ///< boxes that the interpolation cannot be told any better
    bool all_within_ = true;      ///< there is none such
    std::size_t suspect_;         ///< box that was off most when a place was tried last
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
    BoxReader shown(object, camera, shape);
    for (const FrameBox& box : boxes) {
        const LabelledBox found = shown.at(box.frame);
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

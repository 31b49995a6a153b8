#include "annotation/keyframes/keyframe_thinning.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "annotation/keyframes/dense_boxes.h"

namespace eyrie {
namespace {

/// A search for one keyframe less.
class Thinner {
 public:
    Thinner(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
            const ReductionOptions& options)
        : object_(std::move(object)), boxes_(boxes, options), camera_(camera), options_(options) {}

    bool takeOneOut() {
        for (std::size_t i = object_.keyframes.size(); i-- > 1;) {
            if (tryWithout(i)) return true;
        }
        return false;
    }

    const LabelledObject& object() const { return object_; }

 private:
    using Keyframes = std::vector<Keyframe>;
    struct Range {
        std::size_t first = 0;
        std::size_t last = 0;
        std::size_t step = 1;
    };

    /// Boxes that the keyframes [low, high] can change.
    Range reachOf(std::size_t low, std::size_t high) const {
        const Keyframes& keyframes = object_.keyframes;
        Range range{0, boxes_.size(), 1};
        if (low > kKeyframeReach) range.first = boxes_.from(keyframes[low - kKeyframeReach].frame);
        if (high + kKeyframeReach < keyframes.size()) range.last = boxes_.from(keyframes[high + kKeyframeReach].frame);
        return range;
    }

    /// How much the tolerance is exceeded, over all boxes; looks no further once that is `enough`.
    double violation(const Range& range, double enough = std::numeric_limits<double>::max()) const {
        double sum = 0;
        BoxReader shown(object_, camera_, options_.shape);
        for (std::size_t i = range.first; i < range.last && sum < enough; i += range.step) {
            sum += std::max(0.0, std::min(boxes_.deviation(i, shown), 1e6) - 1);
        }
        return sum;
    }

    bool tryWithout(std::size_t i) {
        Keyframes& keyframes = object_.keyframes;
        const Keyframes kept = keyframes;
        keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(i));
        const std::size_t low = i > 2 ? i - 2 : 0;
        const std::size_t high = std::min(i + 1, keyframes.size() - 1);
        Range range = reachOf(low, high);
        constexpr std::size_t kLooks = 64;
        Range coarse = range;
        coarse.step = std::max<std::size_t>(1, (range.last - range.first) / kLooks);
        double left = violation(coarse);
        constexpr int kRounds = 6;
        for (int round = 0; round < kRounds && left > 0; ++round) {
            const double before = left;
            for (std::size_t k = low; k <= high && left > 0; ++k) left = place(k, round, coarse, left);
            // Slow progress does not get there.
            if (left > 0.9 * before) break;
        }
        if (left <= 0 && violation(range, 1e-12) <= 0) return true;
        keyframes = kept;
        return false;
    }

    /// Puts keyframe k where the tolerance is exceeded least; answers by how much.
    double place(std::size_t k, int round, const Range& range, double least) {
        Keyframes& keyframes = object_.keyframes;
        Keyframe best = keyframes[k];
        for (const Keyframe& offer : offersFor(k, round)) {
            keyframes[k] = offer;
            const double sum = violation(range, least);
            if (sum < least) {
                least = sum;
                best = offer;
            }
            if (least <= 0) break;
        }
        keyframes[k] = best;
        return least;
    }

    /// Other places for a keyframe, and its heading set or free; finer ones in later rounds.
    std::vector<Keyframe> offersFor(std::size_t k, int round) const {
        const Keyframes& keyframes = object_.keyframes;
        const Keyframe& now = keyframes[k];
        std::vector<Keyframe> offers;
        const std::size_t own = boxes_.from(now.frame);
        if (!options_.headings_set && own < boxes_.size() && boxes_[own].frame == now.frame) {
            Keyframe other = now;
            other.heading_set = !now.heading_set;
            other.box.heading = boxes_[own].box.heading;
            offers.push_back(other);
        }
        if (k == 0) return offers;
        const FrameIndex low = keyframes[k - 1].frame;
        const FrameIndex high = k + 1 < keyframes.size() ? keyframes[k + 1].frame : boxes_.back().frame + 1;
        std::set<std::size_t> places;
        constexpr int kPlaces = 8;
        for (int step = 1; step <= kPlaces; ++step) {
            // Half, quarter … of the way to the neighbours in later rounds.
            const double share = static_cast<double>(step) / kPlaces / std::max(1, round);
            places.insert(boxes_.from(now.frame + static_cast<FrameIndex>(std::lround((high - now.frame) * share))));
            places.insert(boxes_.from(now.frame - static_cast<FrameIndex>(std::lround((now.frame - low) * share))));
        }
        if (own > 0) places.insert(own - 1);
        places.insert(own + 1);
        for (const std::size_t there : places) {
            if (there >= boxes_.size() || boxes_[there].frame <= low || boxes_[there].frame >= high || there == own)
                continue;
            Keyframe offer = now;
            offer.frame = boxes_[there].frame;
            offer.box = boxes_[there].box;
            offers.push_back(offer);
        }
        return offers;
    }

    LabelledObject object_;
    DenseBoxes boxes_;
    const CameraMotion& camera_;
    const ReductionOptions& options_;
};

}  // namespace

LabelledObject thinned(LabelledObject object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const ReductionOptions& options) {
    Thinner thinner(std::move(object), boxes, camera, options);
    while (thinner.object().keyframes.size() > 1 && thinner.takeOneOut()) continue;
    return thinner.object();
}

}  // namespace eyrie

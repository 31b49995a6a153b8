#include "annotation/picture_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "annotation/interpolation.h"
#include "annotation/keyframe_reduction.h"
#include "core/angle.h"

namespace eyrie {
namespace {

/// How boxes are sampled: upright, each to the same number of samples, so that size does not matter.
struct Grid {
    cv::Size box;          ///< samples of the box and its margin
    cv::Size reach;        ///< samples that it may move to either side
    double margin = 1.15;  ///< around the box, so that its outline counts

    static Grid forBox(const OrientedBox& box, const PictureFitOptions& options) {
        constexpr double kLength = 32;
        constexpr double kLeast = 8;
        Grid grid;
        const double width = std::clamp(kLength * box.width / std::max(1.0, box.length), kLeast, 1.5 * kLength);
        const auto samples = [](double value) { return std::max(1, static_cast<int>(std::lround(value))); };
        grid.box = {samples(kLength * grid.margin), samples(width * grid.margin)};
        grid.reach = {samples(kLength * options.reach_along), samples(width * options.reach_across)};
        return grid;
    }

    /// Samples a box and as much around it as asked for.
    cv::Mat cut(const cv::Mat& picture, const OrientedBox& at, cv::Size around) const {
        const cv::Point2d x = at.direction() * (at.length * margin / box.width);
        const cv::Point2d y = cv::Point2d(-at.direction().y, at.direction().x) * (at.width * margin / box.height);
        const cv::Size size(box.width + 2 * around.width, box.height + 2 * around.height);
        const cv::Point2d corner = at.centre - x * ((size.width - 1) / 2.0) - y * ((size.height - 1) / 2.0);
        const cv::Matx23d image_from_cut(x.x, y.x, corner.x, x.y, y.y, corner.y);
        cv::Mat chip;
        cv::warpAffine(picture, chip, image_from_cut, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                       cv::BORDER_REPLICATE);
        return chip;
    }

    OrientedBox moved(OrientedBox at, cv::Point2d by_samples, double turned) const {
        at.heading = wrapPi(at.heading + turned);
        at.centre =
            at.toImage({by_samples.x * at.length * margin / box.width, by_samples.y * at.width * margin / box.height});
        return at;
    }
};

/// A frame of the object's life.
struct Place {
    FrameIndex frame = 0;
    OrientedBox box;
    bool by_hand = false;
    bool whole = true;   ///< not cut by the image's border
    cv::Mat picture;     ///< the part of it around the box; empty where it cannot be compared
    cv::Point2d corner;  ///< of that part
    cv::Mat wide;        ///< the box and around; empty where it cannot be compared
    cv::Mat likeness;    ///< for each way to move it, −1 … 1; CV_32F
    cv::Point step;      ///< chosen, samples
    cv::Point2d found;   ///< finer
    double turn = 0;     ///< of the box as it was, radians
};

cv::Mat likenessIn(const cv::Mat& wide, const cv::Mat& look) {
    cv::Mat likeness;
    cv::matchTemplate(wide, look, likeness, cv::TM_CCOEFF_NORMED);
    cv::patchNaNs(likeness, 0);
    return likeness;
}

class Fitter {
 public:
    Fitter(std::vector<Place> places, const Grid& grid) : places_(std::move(places)), grid_(grid) {
        for (const Place& place : places_)
            any_whole_ = any_whole_ || (place.by_hand && place.whole && !place.picture.empty());
    }

    void run() {
        findPlaces();
        constexpr int kRounds = 2;
        for (int round = 0; round < kRounds && !upright() && findTurns(); ++round) findPlaces();
        refine();
        smooth();
    }

    const std::vector<Place>& places() const { return places_; }

 private:
    /// Boxes drawn along the image's axes stay along them.
    bool upright() const {
        return std::all_of(places_.begin(), places_.end(), [](const Place& place) {
            const double quarters = place.box.heading / (kPi / 2);
            return std::abs(quarters - std::round(quarters)) < 1e-9;
        });
    }

    void findPlaces() {
        for (Place& place : places_)
            if (!place.picture.empty()) place.wide = cut(place, grid_.moved(place.box, {}, place.turn), grid_.reach);
        compareWithHands();
        findWay();
        // Once more with how it looks around each frame.
        compareWithNeighbours();
        findWay();
    }

    cv::Mat cut(const Place& place, OrientedBox box, cv::Size around) const {
        box.centre -= place.corner;
        return grid_.cut(place.picture, box, around);
    }

    /// Looks whether boxes fit better when turned; answers whether some do by more than a little.
    bool findTurns() {
        constexpr int kTurns = 15;  // to either side
        constexpr double kTurn = 2 * kPi / 180;
        constexpr float kStep = 0.01F;
        constexpr float kAway = 0.0015F;
        const auto count = static_cast<std::size_t>(2 * kTurns + 1);
        std::vector<std::vector<float>> cost(places_.size(), std::vector<float>(count, 0.F));
        std::vector<std::vector<std::size_t>> from(places_.size(), std::vector<std::size_t>(count, 0));
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const Place& place = places_[i];
            const cv::Mat look = handLook(i);
            for (std::size_t t = 0; t < count; ++t) {
                const int turn = static_cast<int>(t) - kTurns;
                cost[i][t] = kAway * static_cast<float>(turn * turn);
                if (place.by_hand && turn != 0) cost[i][t] = 1e9F;
                if (!place.wide.empty() && !look.empty()) {
                    OrientedBox box = grid_.moved(place.box, place.step, place.turn);
                    box.heading = wrapPi(place.box.heading + turn * kTurn);
                    cost[i][t] += 1 - likenessIn(cut(place, box, {}), look).at<float>(0, 0);
                }
                if (i == 0) continue;
                float least = std::numeric_limits<float>::max();
                for (std::size_t b = t > 0 ? t - 1 : 0; b <= std::min(t + 1, count - 1); ++b) {
                    const float sum = cost[i - 1][b] + (b == t ? 0.F : kStep);
                    if (sum >= least) continue;
                    least = sum;
                    from[i][t] = b;
                }
                cost[i][t] += least;
            }
        }
        auto at =
            static_cast<std::size_t>(std::min_element(cost.back().begin(), cost.back().end()) - cost.back().begin());
        bool any = false;
        for (std::size_t i = places_.size(); i-- > 0;) {
            places_[i].turn = (static_cast<int>(at) - kTurns) * kTurn;
            any = any || std::abs(places_[i].turn) > 1.5 * kTurn;
            at = from[i][at];
        }
        return any;
    }

    /// How it looks in the nearest box set by hand.
    cv::Mat handLook(std::size_t i) const {
        for (std::size_t away = 0; away < places_.size(); ++away)
            for (const std::size_t k : {i - away, i + away})
                if (k < places_.size() && isHand(k)) return places_[k].wide(middle());
        return {};
    }

    cv::Rect middle() const { return {grid_.reach.width, grid_.reach.height, grid_.box.width, grid_.box.height}; }

    /// Whether it shows how the object looks: what is cut by the border does only where nothing else is known.
    bool isHand(std::size_t i) const {
        return places_[i].by_hand && !places_[i].wide.empty() && (places_[i].whole || !any_whole_);
    }

    /// With the boxes set by hand before and after, the nearer the more.
    void compareWithHands() {
        std::vector<std::size_t> hands;
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (isHand(i)) hands.push_back(i);
        for (std::size_t i = 0; i < places_.size(); ++i) {
            Place& place = places_[i];
            if (place.wide.empty() || hands.empty()) continue;
            const auto after = std::lower_bound(hands.begin(), hands.end(), i);
            const std::size_t next = after == hands.end() ? hands.back() : *after;
            const std::size_t last = after == hands.begin() ? hands.front() : *(after - 1);
            place.likeness = likenessIn(place.wide, places_[next].wide(middle()));
            if (last == next) continue;
            const double share = static_cast<double>(i - last) / static_cast<double>(next - last);
            place.likeness =
                place.likeness * share + likenessIn(place.wide, places_[last].wide(middle())) * (1 - share);
        }
    }

    void compareWithNeighbours() {
        constexpr std::size_t kNeighbours = 12;
        std::vector<cv::Mat> looks(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (places_[i].wide.empty() || places_[i].likeness.empty()) continue;
            places_[i].wide(cv::Rect(places_[i].step + cv::Point(grid_.reach), grid_.box)).convertTo(looks[i], CV_32F);
        }
        for (std::size_t i = 0; i < places_.size(); ++i) {
            Place& place = places_[i];
            if (place.likeness.empty()) continue;
            cv::Mat sum = cv::Mat::zeros(grid_.box, CV_32F);
            for (std::size_t k = i > kNeighbours ? i - kNeighbours : 0; k <= i + kNeighbours && k < looks.size(); ++k)
                if (!looks[k].empty()) sum += looks[k];
            cv::Mat wide;
            place.wide.convertTo(wide, CV_32F);
            place.likeness = (place.likeness + likenessIn(wide, sum)) * 0.5;
        }
    }

    /// The way through all frames that looks best and changes least (dynamic programming).
    void findWay() {
        const int columns = 2 * grid_.reach.width + 1;
        const int rows = 2 * grid_.reach.height + 1;
        constexpr int kFarthest = 2;      // samples from frame to frame
        constexpr float kStep = 0.03F;    // costs of a change, per squared sample
        constexpr float kAway = 0.0015F;  // costs of being off the box as it was, twice that across
        constexpr float kNever = 1e9F;
        std::vector<cv::Mat> cost(places_.size());
        std::vector<cv::Mat> from(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            cost[i] = ownCost(places_[i], rows, columns, kAway, kNever);
            from[i] = cv::Mat(rows, columns, CV_16SC2, cv::Scalar::all(0));
            if (i == 0) continue;
            for (int y = 0; y < rows; ++y)
                for (int x = 0; x < columns; ++x) {
                    float least = std::numeric_limits<float>::max();
                    cv::Vec2s best(0, 0);
                    for (int dy = -kFarthest; dy <= kFarthest; ++dy)
                        for (int dx = -kFarthest; dx <= kFarthest; ++dx) {
                            if (y + dy < 0 || y + dy >= rows || x + dx < 0 || x + dx >= columns) continue;
                            const float sum =
                                cost[i - 1].at<float>(y + dy, x + dx) + kStep * static_cast<float>(dx * dx + dy * dy);
                            if (sum >= least) continue;
                            least = sum;
                            best = {static_cast<short>(x + dx), static_cast<short>(y + dy)};
                        }
                    cost[i].at<float>(y, x) += least;
                    from[i].at<cv::Vec2s>(y, x) = best;
                }
        }
        if (places_.empty()) return;
        cv::Point at;
        cv::minMaxLoc(cost.back(), nullptr, nullptr, &at);
        for (std::size_t i = places_.size(); i-- > 0;) {
            places_[i].step = at - cv::Point(grid_.reach);
            const cv::Vec2s before = from[i].at<cv::Vec2s>(at);
            at = {before[0], before[1]};
        }
    }

    cv::Mat ownCost(const Place& place, int rows, int columns, float away, float never) const {
        cv::Mat cost = cv::Mat::zeros(rows, columns, CV_32F);
        // What looks like nothing known tells nothing.
        if (!place.likeness.empty()) {
            const cv::Mat alike = cv::max(place.likeness, 0);
            cost = 1 - alike.mul(alike);
        }
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) {
                const int dx = x - grid_.reach.width;
                const int dy = y - grid_.reach.height;
                cost.at<float>(y, x) += away * static_cast<float>(dx * dx + 2 * dy * dy);
                if (place.by_hand && place.whole && (dx != 0 || dy != 0)) cost.at<float>(y, x) = never;
            }
        return cost;
    }

    /// To parts of a sample, by parabolas.
    void refine() {
        for (Place& place : places_) {
            place.found = place.step;
            if (place.by_hand || place.likeness.empty()) continue;
            const cv::Point at = place.step + cv::Point(grid_.reach);
            const auto vertex = [&](cv::Point way) {
                const cv::Rect all({}, place.likeness.size());
                if (!all.contains(at - way) || !all.contains(at + way)) return 0.0;
                const double before = static_cast<double>(place.likeness.at<float>(at - way));
                const double here = static_cast<double>(place.likeness.at<float>(at));
                const double after = static_cast<double>(place.likeness.at<float>(at + way));
                const double bend = before - 2 * here + after;
                return bend < -1e-6 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
            };
            place.found += cv::Point2d(vertex({1, 0}), vertex({0, 1}));
            constexpr double kNotAtAll = 0.3;
            constexpr double kWell = 0.55;
            const double trust = (static_cast<double>(place.likeness.at<float>(at)) - kNotAtAll) / (kWell - kNotAtAll);
            place.found *= std::clamp(trust, 0.0, 1.0);
        }
    }

    void smooth() {
        constexpr std::size_t kBeside = 3;
        std::vector<cv::Point2d> smoothed(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            const std::size_t beside = std::min({kBeside, i, places_.size() - 1 - i});
            for (std::size_t k = i - beside; k <= i + beside; ++k) smoothed[i] += places_[k].found;
            smoothed[i] *= 1.0 / static_cast<double>(2 * beside + 1);
        }
        for (std::size_t i = 0; i < places_.size(); ++i)
            if (!places_[i].by_hand) places_[i].found = smoothed[i];
    }

    std::vector<Place> places_;
    const Grid& grid_;
    bool any_whole_ = false;  ///< a box set by hand shows all of the object
};

/// All that boxes moved and turned within their reach can show.
cv::Rect partAround(const OrientedBox& box, cv::Size picture) {
    const double half = 1.2 * std::hypot(box.length, box.width) + 4;
    const cv::Point low(static_cast<int>(std::floor(box.centre.x - half)),
                        static_cast<int>(std::floor(box.centre.y - half)));
    const int side = static_cast<int>(std::ceil(2 * half));
    return cv::Rect(low, cv::Size(side, side)) & cv::Rect({}, picture);
}

std::vector<Place> placesOf(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                            const PictureFitOptions& options, const std::stop_token& stop) {
    std::vector<Place> places;
    for (FrameIndex frame = firstFrameOf(object); frame <= object.last_frame && !stop.stop_requested(); ++frame) {
        const LabelledBox shown = boxAt(object, frame, camera);
        if (!shown.visible()) continue;
        Place place;
        place.frame = frame;
        place.box = shown.box;
        const Keyframe* keyframe = keyframeAt(object, frame);
        place.by_hand = keyframe != nullptr && !keyframe->computed;
        const cv::Mat picture = gray(frame);
        const bool comparable = !picture.empty() && shown.occlusion != Occlusion::fully &&
                                areaInImage(place.box, picture.size()) >= options.min_in_image * place.box.area();
        place.whole = !isCutByBorder(place.box, picture.size());
        if (comparable) {
            const cv::Rect part = partAround(place.box, picture.size());
            place.picture = picture(part).clone();
            place.corner = part.tl();
        }
        places.push_back(std::move(place));
    }
    return places;
}

bool sameFlags(const Keyframe& a, const Keyframe& b) {
    return a.occlusion == b.occlusion && a.outside == b.outside && a.ignore == b.ignore;
}

/// Few keyframes along the boxes found; those set by hand and those at which flags change stay.
LabelledObject withWay(const LabelledObject& object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const PictureFitOptions& options) {
    ReductionOptions reduction;
    reduction.thorough = true;
    reduction.tolerance_px =
        std::max(options.min_tolerance_px, options.tolerance_of_length * boxes[boxes.size() / 2].box.length);
    LabelledObject changed = object;
    changed.keyframes.clear();
    for (std::size_t i = 0; i < object.keyframes.size(); ++i) {
        const Keyframe& keyframe = object.keyframes[i];
        const bool stays =
            !keyframe.computed || keyframe.outside || (i > 0 && !sameFlags(keyframe, object.keyframes[i - 1]));
        if (stays) changed.keyframes.push_back(keyframe);
    }
    for (Keyframe& keyframe : changed.keyframes) {
        if (!keyframe.computed || keyframe.outside) continue;
        for (const FrameBox& box : boxes)
            if (box.frame == keyframe.frame) keyframe.box = box.box;
    }
    for (Keyframe keyframe : reduceToKeyframes(boxes, camera, reduction)) {
        if (keyframeAt(changed, keyframe.frame) != nullptr) continue;
        const Keyframe* before = keyframeBefore(object, keyframe.frame);
        keyframe.occlusion = before->occlusion;
        keyframe.ignore = before->ignore;
        keyframe.computed = true;
        changed = withKeyframe(std::move(changed), keyframe);
    }
    changed.last_frame = object.last_frame;
    return changed;
}

}  // namespace

PictureFit fittedToPictures(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                            const PictureFitOptions& options, std::stop_token stop) {
    PictureFit fit;
    fit.object = object;
    const Keyframe* hand = nullptr;
    bool computed = false;
    for (const Keyframe& keyframe : object.keyframes) {
        if (!keyframe.computed && !keyframe.outside && hand == nullptr) hand = &keyframe;
        computed = computed || keyframe.computed;
    }
    if (hand == nullptr || !computed || hand->box.length < 2 || hand->box.width < 2) return fit;
    const Grid grid = Grid::forBox(hand->box, options);
    Fitter fitter(placesOf(object, camera, gray, options, stop), grid);
    if (stop.stop_requested() || fitter.places().empty()) return fit;
    fitter.run();
    std::vector<FrameBox> boxes;
    for (const Place& place : fitter.places()) {
        // A vehicle that the border cuts lies elsewhere than its box.
        if (!place.by_hand || place.whole)
            boxes.push_back({place.frame, grid.moved(place.box, place.found, place.turn)});
        if (place.likeness.empty()) continue;
        constexpr float kSure = 0.6F;
        ++fit.frames;
        fit.sure += place.likeness.at<float>(place.step + cv::Point(grid.reach)) >= kSure ? 1 : 0;
    }
    if (boxes.empty()) return fit;
    fit.object = withWay(object, boxes, camera, options);
    return fit;
}

}  // namespace eyrie

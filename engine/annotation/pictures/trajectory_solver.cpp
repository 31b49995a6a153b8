#include "annotation/pictures/trajectory_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "core/geometry/upright.h"

namespace eyrie {
namespace {

cv::Mat likenessIn(const cv::Mat& wide, const cv::Mat& look) {
    cv::Mat likeness;
    cv::matchTemplate(wide, look, likeness, cv::TM_CCOEFF_NORMED);
    cv::patchNaNs(likeness, 0);
    return likeness;
}

/// The work on one object.
class Fitter {
 public:
    Fitter(std::vector<PicturePlace>& places, const SampleGrid& grid) : places_(places), grid_(grid) {
        for (const PicturePlace& place : places_)
            any_whole_ = any_whole_ || (place.by_hand && place.whole && !place.picture.empty());
    }

    void run() {
        findPlaces();
        constexpr int kRounds = 2;
        for (int round = 0; round < kRounds && !upright() && findTurns(); ++round) findPlaces();
        refine();
        smooth();
    }

 private:
    /// Boxes drawn along the image's axes stay along them.
    bool upright() const {
        return std::all_of(places_.begin(), places_.end(),
                           [](const PicturePlace& place) { return isUpright(place.box); });
    }

    void findPlaces() {
        for (PicturePlace& place : places_)
            if (!place.picture.empty()) place.wide = cut(place, grid_.moved(place.box, {}, place.turn), grid_.reach);
        compareWithHands();
        findWay();
        // Once more with how it looks around each frame.
        compareWithNeighbours();
        findWay();
    }

    cv::Mat cut(const PicturePlace& place, OrientedBox box, cv::Size around) const {
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
            const PicturePlace& place = places_[i];
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
            PicturePlace& place = places_[i];
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
        constexpr std::size_t kPlacesAround = 12;
        std::vector<cv::Mat> looks(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if (places_[i].wide.empty() || places_[i].likeness.empty()) continue;
            places_[i].wide(cv::Rect(places_[i].step + cv::Point(grid_.reach), grid_.box)).convertTo(looks[i], CV_32F);
        }
        for (std::size_t i = 0; i < places_.size(); ++i) {
            PicturePlace& place = places_[i];
            if (place.likeness.empty()) continue;
            cv::Mat sum = cv::Mat::zeros(grid_.box, CV_32F);
            for (std::size_t k = i > kPlacesAround ? i - kPlacesAround : 0; k <= i + kPlacesAround && k < looks.size();
                 ++k)
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

    cv::Mat ownCost(const PicturePlace& place, int rows, int columns, float away, float never) const {
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
        for (PicturePlace& place : places_) {
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

    std::vector<PicturePlace>& places_;
    const SampleGrid& grid_;
    bool any_whole_ = false;  ///< a box set by hand shows all of the object
};

}  // namespace

SampleGrid SampleGrid::forBox(const OrientedBox& box, double reach_along, double reach_across) {
    constexpr double kLength = 32;
    constexpr double kLeast = 8;
    SampleGrid grid;
    const double width = std::clamp(kLength * box.width / std::max(1.0, box.length), kLeast, 1.5 * kLength);
    const auto samples = [](double value) { return std::max(1, static_cast<int>(std::lround(value))); };
    grid.box = {samples(kLength * grid.margin), samples(width * grid.margin)};
    grid.reach = {samples(kLength * reach_along), samples(width * reach_across)};
    return grid;
}

cv::Mat SampleGrid::cut(const cv::Mat& picture, const OrientedBox& at, cv::Size around) const {
    const cv::Point2d x = at.direction() * (at.length * margin / box.width);
    const cv::Point2d y = cv::Point2d(-at.direction().y, at.direction().x) * (at.width * margin / box.height);
    const cv::Size size(box.width + 2 * around.width, box.height + 2 * around.height);
    const cv::Point2d corner = at.centre - x * ((size.width - 1) / 2.0) - y * ((size.height - 1) / 2.0);
    const cv::Matx23d image_from_cut(x.x, y.x, corner.x, x.y, y.y, corner.y);
    cv::Mat chip;
    cv::warpAffine(picture, chip, image_from_cut, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
    return chip;
}

OrientedBox SampleGrid::moved(OrientedBox at, cv::Point2d by_samples, double turned) const {
    at.heading = wrapPi(at.heading + turned);
    at.centre =
        at.toImage({by_samples.x * at.length * margin / box.width, by_samples.y * at.width * margin / box.height});
    return at;
}

void findWayInPictures(std::vector<PicturePlace>& places, const SampleGrid& grid) {
    Fitter(places, grid).run();
}

}  // namespace eyrie

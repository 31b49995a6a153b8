#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "annotation/keyframes/interpolation.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/pictures/trajectory_refinement.h"
#include "annotation/pictures/trajectory_solver.h"
#include "annotation/scenes.h"
#include "core/geometry/angle.h"

/// The way of an object through its pictures against one found as its rules are told: what every place costs, and the
/// cheapest way from place to place.
namespace eyrie::slow_way_test {
namespace {

const cv::Size kPicture(240, 160);

struct Spot {
    int x = 0;
    int y = 0;
};

class SlowWay {
 public:
    SlowWay(std::vector<PicturePlace>& places, const SampleGrid& grid) : places_(places), grid_(grid) {}

    void find() {
        wayThroughAll();
        const bool upright = std::all_of(places_.begin(), places_.end(), [](const PicturePlace& place) {
            const double quarters = place.box.heading / (kPi / 2);
            return std::abs(quarters - std::round(quarters)) < 1e-9;
        });
        for (int round = 0; round < 2 && !upright; ++round) {
            if (!turn()) break;
            wayThroughAll();
        }
        betweenSamples();
    }

 private:
    std::size_t count() const { return places_.size(); }
    bool seen(std::size_t i) const { return !places_[i].picture.empty(); }
    /// Whether a place shows how the object looks.
    bool tells(std::size_t i) const {
        if (!places_[i].by_hand || !seen(i)) return false;
        if (places_[i].whole) return true;
        for (std::size_t k = 0; k < count(); ++k)
            if (places_[k].by_hand && places_[k].whole && seen(k)) return false;
        return true;
    }
    cv::Mat cutAt(std::size_t i, OrientedBox box, cv::Size around) const {
        box.centre.x -= places_[i].corner.x;
        box.centre.y -= places_[i].corner.y;
        return grid_.cut(places_[i].picture, box, around);
    }
    cv::Mat middle(std::size_t i) const {
        return wide_[i](cv::Rect(grid_.reach.width, grid_.reach.height, grid_.box.width, grid_.box.height));
    }
    static cv::Mat alike(const cv::Mat& wide, const cv::Mat& look) {
        cv::Mat result;
        cv::matchTemplate(wide, look, result, cv::TM_CCOEFF_NORMED);
        for (int y = 0; y < result.rows; ++y)
            for (int x = 0; x < result.cols; ++x)
                if (std::isnan(result.at<float>(y, x))) result.at<float>(y, x) = 0;
        return result;
    }

    void wayThroughAll() {
        wide_.assign(count(), {});
        likeness_.assign(count(), {});
        for (std::size_t i = 0; i < count(); ++i) {
            OrientedBox box = places_[i].box;
            box.heading = wrapPi(box.heading + places_[i].turn);
            if (seen(i)) wide_[i] = cutAt(i, box, grid_.reach);
        }
        for (std::size_t i = 0; i < count(); ++i) {
            std::optional<std::size_t> before, after;
            for (std::size_t k = 0; k < count(); ++k) {
                if (tells(k) && k < i) before = k;
                if (tells(k) && k >= i && !after) after = k;
            }
            if (!seen(i) || (!before && !after)) continue;
            likeness_[i] = alike(wide_[i], middle(after ? *after : *before));
            if (!before || !after) continue;
            const double share = static_cast<double>(i - *before) / static_cast<double>(*after - *before);
            likeness_[i] = likeness_[i] * share + alike(wide_[i], middle(*before)) * (1 - share);
        }
        cheapest();
        std::vector<cv::Mat> looks(count());
        for (std::size_t i = 0; i < count(); ++i)
            if (!likeness_[i].empty())
                wide_[i](cv::Rect(places_[i].step.x + grid_.reach.width, places_[i].step.y + grid_.reach.height,
                                  grid_.box.width, grid_.box.height))
                    .convertTo(looks[i], CV_32F);
        for (std::size_t i = 0; i < count(); ++i) {
            if (likeness_[i].empty()) continue;
            cv::Mat sum = cv::Mat::zeros(grid_.box, CV_32F), wide;
            for (std::size_t k = 0; k < count(); ++k)
                if (!looks[k].empty() && k + 12 >= i && k <= i + 12) sum += looks[k];
            wide_[i].convertTo(wide, CV_32F);
            likeness_[i] = (likeness_[i] + alike(wide, sum)) * 0.5;
        }
        cheapest();
    }

    float costOf(std::size_t i, Spot spot) const {
        const int dx = spot.x - grid_.reach.width, dy = spot.y - grid_.reach.height;
        if (places_[i].by_hand && places_[i].whole && (dx != 0 || dy != 0)) return 1e9F;
        float cost = 0;
        if (!likeness_[i].empty()) {
            const float like = std::max(0.F, likeness_[i].at<float>(spot.y, spot.x));
            cost = 1 - like * like;
        }
        return cost + 0.0015F * static_cast<float>(dx * dx + 2 * dy * dy);
    }

    void cheapest() {
        const int columns = 2 * grid_.reach.width + 1, rows = 2 * grid_.reach.height + 1;
        std::vector<Spot> spots;
        for (int y = 0; y < rows; ++y)
            for (int x = 0; x < columns; ++x) spots.push_back({x, y});
        std::vector<std::vector<float>> costs(count());
        std::vector<std::vector<std::size_t>> from(count());
        for (std::size_t i = 0; i < count(); ++i)
            for (const Spot& spot : spots) {
                float cost = costOf(i, spot), least = 0;
                std::size_t best = 0;
                bool any = false;
                for (std::size_t b = 0; i > 0 && b < spots.size(); ++b) {
                    const int dx = spots[b].x - spot.x, dy = spots[b].y - spot.y;
                    if (std::abs(dx) > 2 || std::abs(dy) > 2) continue;
                    const float sum = costs[i - 1][b] + 0.03F * static_cast<float>(dx * dx + dy * dy);
                    if (any && sum >= least) continue;
                    any = true;
                    least = sum;
                    best = b;
                }
                costs[i].push_back(cost + least);
                from[i].push_back(best);
            }
        std::size_t at = 0;
        for (std::size_t s = 1; s < spots.size(); ++s)
            if (costs.back()[s] < costs.back()[at]) at = s;
        for (std::size_t i = count(); i-- > 0;) {
            places_[i].step = {spots[at].x - grid_.reach.width, spots[at].y - grid_.reach.height};
            at = from[i][at];
        }
    }

    bool turn() {
        std::vector<std::array<float, 31>> costs(count());
        std::vector<std::array<std::size_t, 31>> from(count());
        for (std::size_t i = 0; i < count(); ++i) {
            // The nearest that tells, the earlier of two.
            std::optional<std::size_t> hand;
            for (std::size_t away = 0; away < count() && !hand; ++away) {
                if (away <= i && tells(i - away)) hand = i - away;
                if (!hand && i + away < count() && tells(i + away)) hand = i + away;
            }
            for (std::size_t t = 0; t < 31; ++t) {
                const int steps = static_cast<int>(t) - 15;
                float cost = places_[i].by_hand && steps != 0 ? 1e9F : 0.0015F * static_cast<float>(steps * steps);
                if (seen(i) && hand) {
                    OrientedBox box = grid_.moved(places_[i].box, places_[i].step, places_[i].turn);
                    box.heading = wrapPi(places_[i].box.heading + steps * (kPi / 90));
                    cost += 1 - alike(cutAt(i, box, {}), middle(*hand)).at<float>(0, 0);
                }
                costs[i][t] = cost;
                from[i][t] = 0;
                if (i == 0) continue;
                float least = 1e30F;
                for (std::size_t b = 0; b < 31; ++b) {
                    if (b + 1 < t || b > t + 1) continue;
                    const float sum = costs[i - 1][b] + (b == t ? 0.F : 0.01F);
                    if (sum >= least) continue;
                    least = sum;
                    from[i][t] = b;
                }
                costs[i][t] += least;
            }
        }
        std::size_t at = 0;
        for (std::size_t t = 1; t < 31; ++t)
            if (costs.back()[t] < costs.back()[at]) at = t;
        bool any = false;
        for (std::size_t i = count(); i-- > 0;) {
            const int steps = static_cast<int>(at) - 15;
            places_[i].turn = steps * (kPi / 90);
            any = any || std::abs(steps) >= 2;
            at = from[i][at];
        }
        return any;
    }

    void betweenSamples() {
        for (std::size_t i = 0; i < count(); ++i) {
            PicturePlace& place = places_[i];
            place.found = place.step;
            if (place.by_hand || likeness_[i].empty()) continue;
            const int x = place.step.x + grid_.reach.width, y = place.step.y + grid_.reach.height;
            const auto like = [&](int px, int py) { return static_cast<double>(likeness_[i].at<float>(py, px)); };
            const auto top = [](double before, double here, double after) {
                const double bend = before - 2 * here + after;
                if (bend >= -1e-6) return 0.0;
                return std::min(0.5, std::max(-0.5, (before - after) / (2 * bend)));
            };
            if (x > 0 && x + 1 < likeness_[i].cols) place.found.x += top(like(x - 1, y), like(x, y), like(x + 1, y));
            if (y > 0 && y + 1 < likeness_[i].rows) place.found.y += top(like(x, y - 1), like(x, y), like(x, y + 1));
            place.found *= std::min(1.0, std::max(0.0, (like(x, y) - 0.3) / 0.25));
        }
        std::vector<cv::Point2d> found;
        for (const PicturePlace& place : places_) found.push_back(place.found);
        for (std::size_t i = 0; i < count(); ++i) {
            if (places_[i].by_hand) continue;
            const std::size_t beside = std::min<std::size_t>({3, i, count() - 1 - i});
            cv::Point2d sum(0, 0);
            for (std::size_t k = i - beside; k <= i + beside; ++k) sum += found[k];
            places_[i].found = sum * (1.0 / (2 * static_cast<double>(beside) + 1));
        }
    }

    std::vector<PicturePlace>& places_;
    const SampleGrid& grid_;
    std::vector<cv::Mat> wide_;
    std::vector<cv::Mat> likeness_;
};

/// A car on the ground under noise; `look` tells apart cars.
cv::Mat drawn(const OrientedBox& box, int look, double noise, std::mt19937& dice) {
    static const cv::Mat ground = test::groundTexture(kPicture, 1, 2.5);
    const cv::Mat car =
        test::groundTexture({static_cast<int>(box.length) + 1, static_cast<int>(box.width) + 1}, look, 1.2);
    cv::Mat picture = ground.clone();
    const cv::Point2d d = box.direction();
    const cv::Point2d corner = box.toImage({-box.length / 2, -box.width / 2});
    cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), picture.size(), cv::INTER_LINEAR,
                   cv::BORDER_TRANSPARENT);
    cv::Mat grain(kPicture, CV_16SC1);
    cv::RNG(dice()).fill(grain, cv::RNG::NORMAL, 0, noise);
    cv::add(picture, grain, picture, cv::noArray(), CV_8U);
    return picture;
}

TEST(SlowWay, PlacesAreFoundAsTheRulesSay) {
    std::mt19937 dice(3);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(dice);
    };
    int turned = 0, moved = 0;
    for (int scene = 0; scene < 24; ++scene) {
        const bool upright = scene % 6 == 5;
        const double heading = upright ? kPi / 2 * (scene % 4) : between(-3, 3);
        OrientedBox car{{120, 80}, between(18, 34), between(8, 18), heading};
        const double speed = between(0, 2), noise = between(0, 1) < 0.3 ? 60 : 6;
        const double turn = upright ? 0 : between(-0.05, 0.05);
        const cv::Point2d drift(between(-0.6, 0.6), between(-0.4, 0.4));
        const int frames = scene == 0 ? 1 : 2 + scene;
        car.centre -= car.direction() * (speed * frames / 2.0);
        std::vector<PicturePlace> places(static_cast<std::size_t>(frames));
        for (std::size_t i = 0; i < places.size(); ++i) {
            PicturePlace& place = places[i];
            place.frame = static_cast<FrameIndex>(i);
            place.by_hand = between(0, 1) < 0.15 || (i == 0 && scene % 3 != 2);
            place.whole = between(0, 1) < 0.75;
            place.box = car;
            if (!place.by_hand) {
                place.box.centre = car.toImage(drift * static_cast<double>(i));
                place.box.heading -= turn * static_cast<double>(i);
            }
            if (between(0, 1) < 0.85) {
                const cv::Mat picture = drawn(car, 2 + (between(0, 1) < 0.1), noise, dice);
                const cv::Rect part = cv::Rect(30, 10, 190, 140) & cv::Rect({}, kPicture);
                place.picture = picture(part).clone();
                place.corner = part.tl();
            }
            car.centre += car.direction() * speed;
        }
        const SampleGrid grid = SampleGrid::forBox(car, between(0.1, 0.35), between(0.1, 0.4));
        std::vector<PicturePlace> slow = places;
        findWayInPictures(places, grid);
        SlowWay(slow, grid).find();
        for (std::size_t i = 0; i < places.size(); ++i) {
            ASSERT_EQ(places[i].step, slow[i].step) << scene << " " << i;
            ASSERT_NEAR(places[i].turn, slow[i].turn, 1e-12) << scene << " " << i;
            ASSERT_LT(cv::norm(places[i].found - slow[i].found), 1e-4) << scene << " " << i;
            turned += places[i].turn != 0;
            moved += places[i].step != cv::Point();
        }
    }
    EXPECT_GT(turned, 30);
    EXPECT_GT(moved, 60);
}

/// What is laid on its pictures: the places that are handed on, and the keyframes that are made of what is found.
PictureFit slowFit(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                   const PictureFitOptions& options) {
    PictureFit fit;
    fit.object = object;
    const auto hand = std::find_if(object.keyframes.begin(), object.keyframes.end(),
                                   [](const Keyframe& each) { return !each.computed && !each.outside; });
    const bool computed = std::any_of(object.keyframes.begin(), object.keyframes.end(),
                                      [](const Keyframe& each) { return each.computed; });
    if (hand == object.keyframes.end() || !computed || std::min(hand->box.length, hand->box.width) < 2) return fit;
    std::vector<PicturePlace> places;
    for (FrameIndex frame = object.keyframes.front().frame; frame <= object.last_frame; ++frame) {
        const LabelledBox shown = boxAt(object, frame, camera);
        if (shown.outside) continue;
        PicturePlace place;
        place.frame = frame;
        place.box = shown.box;
        for (const Keyframe& each : object.keyframes)
            place.by_hand = place.by_hand || (each.frame == frame && !each.computed);
        const cv::Mat picture = gray(frame);
        place.whole = !isCutByBorder(shown.box, picture.size());
        if (!picture.empty() && shown.occlusion != Occlusion::fully &&
            areaInImage(shown.box, picture.size()) >= options.min_in_image * shown.box.area()) {
            // The whole picture; but as what lies beyond its border is taken for its last pixels, the same as a part.
            place.picture = picture;
        }
        places.push_back(place);
    }
    const SampleGrid grid = SampleGrid::forBox(hand->box, options.reach_along, options.reach_across);
    findWayInPictures(places, grid);
    std::vector<FrameBox> boxes;
    for (const PicturePlace& place : places) {
        if (!(place.by_hand && !place.whole))
            boxes.push_back({place.frame, grid.moved(place.box, place.found, place.turn)});
        if (place.likeness.empty()) continue;
        ++fit.frames;
        if (place.likeness.at<float>(place.step.y + grid.reach.height, place.step.x + grid.reach.width) >= 0.6F)
            ++fit.sure;
    }
    if (boxes.empty()) return fit;
    ReductionOptions reduction;
    reduction.thorough = true;
    reduction.tolerance_px = options.tolerance_of_length * boxes[boxes.size() / 2].box.length;
    if (reduction.tolerance_px < options.min_tolerance_px) reduction.tolerance_px = options.min_tolerance_px;
    LabelledObject laid = object;
    laid.keyframes.clear();
    for (std::size_t i = 0; i < object.keyframes.size(); ++i) {
        Keyframe each = object.keyframes[i];
        const auto differs = [&](const Keyframe& before) {
            return before.occlusion != each.occlusion || before.outside != each.outside || before.ignore != each.ignore;
        };
        if (each.computed && !each.outside && (i == 0 || !differs(object.keyframes[i - 1]))) continue;
        const auto there =
            std::find_if(boxes.begin(), boxes.end(), [&](const FrameBox& box) { return box.frame == each.frame; });
        if (each.computed && !each.outside && there != boxes.end()) each.box = there->box;
        laid.keyframes.push_back(each);
    }
    for (Keyframe each : reduceToKeyframes(boxes, camera, reduction)) {
        if (keyframeAt(laid, each.frame) != nullptr) continue;
        for (const Keyframe& before : object.keyframes) {
            if (before.frame > each.frame) break;
            each.occlusion = before.occlusion;
            each.ignore = before.ignore;
        }
        each.computed = true;
        laid.keyframes.push_back(each);
        std::sort(laid.keyframes.begin(), laid.keyframes.end(),
                  [](const Keyframe& a, const Keyframe& b) { return a.frame < b.frame; });
    }
    fit.object = laid;
    return fit;
}

TEST(SlowWay, ObjectsAreLaidOnPicturesAsTheRulesSay) {
    std::mt19937 dice(8);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(dice);
    };
    for (int scene = 0; scene < 16; ++scene) {
        // Some drive out of the picture at one of its sides.
        const double heading = scene % 4 * kPi / 2 + between(-0.4, 0.4);
        const double length = scene == 7 ? 1.9 : between(14, 30);
        const OrientedBox first{{120, 80}, length, scene == 9 ? 1.9 : between(6, 14), heading};
        const double speed = scene % 3 == 0 ? between(4, 8) : between(0, 2);
        const auto truth = [&](FrameIndex frame) {
            OrientedBox box = first;
            box.centre += first.direction() * (speed * frame);
            return box;
        };
        std::vector<cv::Mat> pictures;
        for (FrameIndex frame = 0; frame <= 24; ++frame) pictures.push_back(drawn(truth(frame), 2, 8, dice));
        if (scene % 5 == 4) pictures[7].release();
        LabelledObject object = test::object(1, {}, 24);
        for (const FrameIndex frame : {0, 6, 12, 18, 22}) {
            Keyframe each = test::keyframe(frame, truth(frame), between(0, 1) < 0.7);
            each.computed = frame > 0 && between(0, 1) < 0.8;
            if (each.computed) each.box.centre += cv::Point2d(between(-3, 3), between(-3, 3));
            each.outside = frame > 0 && between(0, 1) < 0.1;
            each.ignore = between(0, 1) < 0.2;
            each.occlusion = static_cast<Occlusion>(between(0, 1) < 0.6 ? 0 : static_cast<int>(between(0, 3)));
            object.keyframes.push_back(each);
        }
        object.keyframes[1].computed = object.keyframes[1].computed || scene != 3;
        if (scene == 4) object.keyframes[0].outside = true;
        PictureFitOptions options;
        if (scene % 2 == 1) options.tolerance_of_length = 0.01;
        const CameraMotion camera = CameraMotion::standing(0, 24);
        const auto gray = [&](FrameIndex frame) { return pictures[static_cast<std::size_t>(frame)]; };
        const PictureFit fit = fittedToPictures(object, camera, gray, options);
        const PictureFit slow = slowFit(object, camera, gray, options);
        ASSERT_EQ(fit.frames, slow.frames) << scene;
        ASSERT_EQ(fit.sure, slow.sure) << scene;
        ASSERT_EQ(fit.object.last_frame, slow.object.last_frame) << scene;
        ASSERT_EQ(fit.object.keyframes.size(), slow.object.keyframes.size()) << scene;
        for (std::size_t i = 0; i < fit.object.keyframes.size(); ++i) {
            const Keyframe &a = fit.object.keyframes[i], &b = slow.object.keyframes[i];
            ASSERT_EQ(a.frame, b.frame) << scene;
            ASSERT_LT(test::cornerDistance(a.box, b.box), 1e-3) << scene;
            ASSERT_EQ(a.computed, b.computed) << scene;
            ASSERT_EQ(a.heading_set, b.heading_set) << scene;
            ASSERT_EQ(a.occlusion, b.occlusion) << scene;
            ASSERT_EQ(a.outside, b.outside) << scene;
            ASSERT_EQ(a.ignore, b.ignore) << scene;
        }
    }
}

}  // namespace
}  // namespace eyrie::slow_way_test

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <set>

#include "annotation/keyframes/dense_boxes.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/keyframes/keyframe_thinning.h"
#include "annotation/scenes.h"

/// Keyframes that are left of dense boxes against those of a search that remembers nothing: it compares all boxes anew
/// after every change.
namespace eyrie::slow_reduction_test {
namespace {

constexpr std::size_t kReach = 3;
constexpr double kNotThere = std::numeric_limits<double>::max();

class SlowSearch {
 public:
    SlowSearch(LabelledObject begin, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
               const ReductionOptions& options, bool sets)
        : object(std::move(begin)), boxes_(boxes), camera_(camera), options_(options), sets_(sets) {}

    double off(std::size_t i) const {
        const LabelledBox shown = boxAt(object, boxes_[i].frame, camera_, options_.shape);
        if (!shown.exists()) return kNotThere;
        double away = 0;
        if (options_.tolerance_px > 0) away = test::cornerDistance(shown.box, boxes_[i].box) / options_.tolerance_px;
        if (options_.min_overlap > 0)
            away = std::max(away, (1 - overlap(shown.box, boxes_[i].box)) / std::max(1e-9, 1 - options_.min_overlap));
        return away;
    }

    void insert() {
        for (;;) {
            std::size_t worst = 0;
            double most = -1;
            for (std::size_t i = 0; i < boxes_.size(); ++i) {
                const double each = hopeless.count(i) > 0 ? 0 : off(i);
                if (each > most) {
                    most = each;
                    worst = i;
                }
            }
            if (most <= 1) return;
            if (!tell(boxes_[worst])) hopeless.insert(worst);
        }
    }

    void takeOut() {
        bool any = true;
        while (any) {
            any = false;
            for (std::size_t i = object.keyframes.size() - 1; i >= 1; --i) {
                std::vector<std::size_t> good;
                for (std::size_t k = 0; k < boxes_.size(); ++k)
                    if (hopeless.count(k) == 0 && off(k) <= 1) good.push_back(k);
                const auto before = object.keyframes;
                object.keyframes.erase(object.keyframes.begin() + static_cast<std::ptrdiff_t>(i));
                if (std::all_of(good.begin(), good.end(), [&](std::size_t k) { return off(k) <= 1; }))
                    any = true;
                else
                    object.keyframes = before;
            }
        }
    }

    void move() {
        for (std::size_t i = 1; i + 1 < object.keyframes.size(); ++i) {
            auto& keyframes = object.keyframes;
            const FrameIndex here = keyframes[i].frame, low = keyframes[i - 1].frame, high = keyframes[i + 1].frame;
            const std::size_t first = i > kReach ? placeOf(keyframes[i - kReach].frame) : 0;
            const std::size_t last =
                i + kReach < keyframes.size() ? placeOf(keyframes[i + kReach].frame) : boxes_.size();
            const auto worst = [&] {
                double most = 0;
                for (std::size_t k = first; k < last; ++k)
                    if (hopeless.count(k) == 0) most = std::max(most, off(k));
                return most;
            };
            Keyframe best = keyframes[i];
            double least = worst();
            std::size_t before = boxes_.size();
            for (int step = -8; step <= 8; ++step) {
                const int way = step < 0 ? here - low : high - here;
                const std::size_t there = placeOf(here + way * step / 16);
                if (there == boxes_.size() || there == before) continue;
                const FrameIndex frame = boxes_[there].frame;
                if (frame <= low || frame >= high || frame == here) continue;
                before = there;
                keyframes[i].frame = frame;
                keyframes[i].box = boxes_[there].box;
                const double now = worst();
                if (now < least - 1e-9) {
                    least = now;
                    best = keyframes[i];
                }
            }
            keyframes[i] = best;
        }
    }

    std::size_t placeOf(FrameIndex frame) const {
        std::size_t i = 0;
        while (i < boxes_.size() && boxes_[i].frame < frame) ++i;
        return i;
    }

    LabelledObject object;
    std::set<std::size_t> hopeless;

 private:
    /// A keyframe for a box, or its heading set where there is one.
    bool tell(const FrameBox& box) {
        auto& keyframes = object.keyframes;
        std::size_t i = 0;
        while (i < keyframes.size() && keyframes[i].frame < box.frame) ++i;
        if (i < keyframes.size() && keyframes[i].frame == box.frame) {
            if (keyframes[i].heading_set) return false;
            keyframes[i].heading_set = true;
            keyframes[i].box.heading = box.box.heading;
            return true;
        }
        Keyframe fresh = keyframes[i == 0 ? 0 : i - 1];
        fresh.frame = box.frame;
        fresh.box = box.box;
        fresh.heading_set = sets_;
        keyframes.insert(keyframes.begin() + static_cast<std::ptrdiff_t>(i), fresh);
        for (std::size_t k = i == 0 ? 0 : i - 1; k < keyframes.size() && k <= i + 1; ++k) {
            const std::size_t dense = placeOf(keyframes[k].frame);
            if (dense == boxes_.size() || boxes_[dense].frame != keyframes[k].frame || off(dense) <= 1) continue;
            keyframes[k].heading_set = true;
            keyframes[k].box.heading = boxes_[dense].box.heading;
        }
        return true;
    }

    const std::vector<FrameBox>& boxes_;
    const CameraMotion& camera_;
    const ReductionOptions& options_;
    bool sets_;
};

/// One keyframe less, if those beside it can be moved so that it is not missed.
class SlowThinner {
 public:
    SlowThinner(SlowSearch& search, const std::vector<FrameBox>& boxes, const ReductionOptions& options)
        : search_(search), boxes_(boxes), options_(options) {}

    void run() {
        for (bool any = true; any;) {
            any = false;
            for (std::size_t i = search_.object.keyframes.size() - 1; i >= 1 && !any; --i) any = without(i);
        }
    }

 private:
    bool without(std::size_t i) {
        auto& keyframes = search_.object.keyframes;
        const auto before = keyframes;
        keyframes.erase(keyframes.begin() + static_cast<std::ptrdiff_t>(i));
        const std::size_t low = i < 2 ? 0 : i - 2;
        const std::size_t high = i + 1 < keyframes.size() ? i + 1 : keyframes.size() - 1;
        const std::size_t first = low > kReach ? search_.placeOf(keyframes[low - kReach].frame) : 0;
        const std::size_t last =
            high + kReach < keyframes.size() ? search_.placeOf(keyframes[high + kReach].frame) : boxes_.size();
        const std::size_t step = std::max<std::size_t>(1, (last - first) / 64);
        double left = excess(first, last, step);
        for (int round = 0; round < 6 && left > 0; ++round) {
            const double so_far = left;
            for (std::size_t k = low; k <= high && left > 0; ++k) {
                Keyframe best = keyframes[k];
                for (const Keyframe& offer : offersFor(k, round)) {
                    if (left <= 0) break;
                    keyframes[k] = offer;
                    const double now = excess(first, last, step);
                    if (now >= left) continue;
                    left = now;
                    best = offer;
                }
                keyframes[k] = best;
            }
            if (left > 0.9 * so_far) break;
        }
        if (left <= 0 && excess(first, last, 1) <= 0) return true;
        keyframes = before;
        return false;
    }

    double excess(std::size_t first, std::size_t last, std::size_t step) const {
        double sum = 0;
        for (std::size_t i = first; i < last; i += step) sum += std::max(0.0, std::min(search_.off(i), 1e6) - 1);
        return sum;
    }

    std::vector<Keyframe> offersFor(std::size_t k, int round) const {
        const auto& keyframes = search_.object.keyframes;
        const Keyframe& now = keyframes[k];
        std::vector<Keyframe> offers;
        const std::size_t own = search_.placeOf(now.frame);
        if (!options_.headings_set && own < boxes_.size() && boxes_[own].frame == now.frame) {
            offers.push_back(now);
            offers.back().heading_set = !now.heading_set;
            offers.back().box.heading = boxes_[own].box.heading;
        }
        if (k == 0) return offers;
        const FrameIndex low = keyframes[k - 1].frame;
        const FrameIndex high = k + 1 < keyframes.size() ? keyframes[k + 1].frame : boxes_.back().frame + 1;
        std::set<std::size_t> places{own + 1, own > 0 ? own - 1 : own};
        for (int step = 1; step <= 8; ++step) {
            const double share = step / 8.0 / (round < 2 ? 1 : round);
            places.insert(search_.placeOf(now.frame + static_cast<int>(std::lround((high - now.frame) * share))));
            places.insert(search_.placeOf(now.frame - static_cast<int>(std::lround((now.frame - low) * share))));
        }
        for (const std::size_t there : places) {
            if (there == own || there >= boxes_.size()) continue;
            if (boxes_[there].frame <= low || boxes_[there].frame >= high) continue;
            offers.push_back(now);
            offers.back().frame = boxes_[there].frame;
            offers.back().box = boxes_[there].box;
        }
        return offers;
    }

    SlowSearch& search_;
    const std::vector<FrameBox>& boxes_;
    const ReductionOptions& options_;
};

std::vector<Keyframe> slowlyReduced(const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                                    const ReductionOptions& options, bool sets) {
    SlowSearch search(
        test::object(0, {test::keyframe(boxes.front().frame, boxes.front().box, sets)}, boxes.back().frame), boxes,
        camera, options, sets);
    search.insert();
    search.takeOut();
    for (int round = 0; round < 4; ++round) {
        const std::size_t before = search.object.keyframes.size();
        search.move();
        search.insert();
        search.takeOut();
        if (search.object.keyframes.size() >= before) break;
    }
    if (options.thorough && search.hopeless.empty() && search.object.keyframes.size() <= 20)
        SlowThinner(search, boxes, options).run();
    return search.object.keyframes;
}

std::vector<Keyframe> slowlyReduced(const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                                    const ReductionOptions& options) {
    if (options.headings_set) return slowlyReduced(boxes, camera, options, true);
    auto free = slowlyReduced(boxes, camera, options, false);
    if (free.size() < 3) return free;
    auto headed = slowlyReduced(boxes, camera, options, true);
    return headed.size() < free.size() ? headed : free;
}

/// Something that drives, winds, stops, is measured with noise and is missing in some frames.
std::vector<FrameBox> drawnWay(std::mt19937& dice, int frames) {
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(dice);
    };
    const double noise = between(0, 1) < 0.5 ? 0 : between(0.05, 0.8);
    const double slip = between(0, 1) < 0.3 ? between(-1, 1) : 0;
    const double missing = between(0, 1) < 0.3 ? 0.15 : 0;
    std::vector<FrameBox> boxes;
    OrientedBox box{{between(60, 160), between(60, 160)}, between(14, 30), between(6, 12), between(-3, 3)};
    double speed = between(0, 4), turn = 0, heading = box.heading;
    const int first = static_cast<int>(between(0, 30));
    for (int i = 0; i < frames; ++i) {
        if (i % 17 == 5) turn = between(-0.07, 0.07);
        if (i % 23 == 7) speed = between(0, 1) < 0.3 ? 0 : between(0, 4);
        heading += speed > 0 ? turn : 0;
        box.centre += cv::Point2d(std::cos(heading), std::sin(heading)) * speed;
        box.heading = std::remainder(heading + slip, 2 * CV_PI);
        if (i > 0 && i + 1 < frames && between(0, 1) < missing) continue;
        FrameBox each{first + i, test::seen(box, test::flyingView(first + i))};
        each.box.centre += cv::Point2d(between(-noise, noise), between(-noise, noise));
        each.box.heading += between(-noise, noise) * 0.05;
        boxes.push_back(each);
    }
    return boxes;
}

void expectSame(const std::vector<Keyframe>& found, const std::vector<Keyframe>& slow, const std::string& where) {
    ASSERT_EQ(found.size(), slow.size()) << where;
    for (std::size_t i = 0; i < found.size(); ++i) {
        ASSERT_EQ(found[i].frame, slow[i].frame) << where;
        ASSERT_EQ(found[i].heading_set, slow[i].heading_set) << where;
        ASSERT_EQ(found[i].box.centre, slow[i].box.centre) << where;
        ASSERT_EQ(found[i].box.heading, slow[i].box.heading) << where;
        ASSERT_EQ(found[i].occlusion, slow[i].occlusion) << where;
    }
}

const CameraMotion& flying() {
    static const CameraMotion camera(test::stepsOf(test::flyingView, 200));
    return camera;
}

TEST(SlowReduction, KeyframesAreThoseThatASearchWithoutMemoryFinds) {
    std::mt19937 dice(5);
    for (int i = 0; i < 60; ++i) {
        ReductionOptions options;
        options.tolerance_px = i % 6 == 5 ? 0 : std::array{1.5, 0.7, 3.0}[static_cast<std::size_t>(i % 3)];
        options.min_overlap = i % 6 == 5 || i % 7 == 6 ? 0.75 : 0;
        options.headings_set = i % 5 == 4;
        options.shape = i % 8 == 7 ? PathShape::straight : PathShape::smooth;
        auto boxes = drawnWay(dice, i < 4 ? 1 + i : i < 20 ? 40 + i % 3 * 20 : 20 + i % 4 * 6);
        const CameraMotion none;
        const CameraMotion& camera = i % 9 == 8 ? none : flying();
        // What has no extent overlaps with nothing, whatever keyframes tell.
        if (options.min_overlap > 0)
            for (std::size_t k = 7; k < boxes.size(); k += 19) boxes[k].box.width = 0;
        expectSame(reduceToKeyframes(boxes, camera, options), slowlyReduced(boxes, camera, options), std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

TEST(SlowReduction, ThoroughOnesAreAsFewAsASearchWithoutMemoryMakesThem) {
    std::mt19937 dice(6);
    for (int i = 0; i < 14; ++i) {
        ReductionOptions options;
        options.thorough = true;
        options.tolerance_px = std::array{1.5, 1.0, 3.0}[static_cast<std::size_t>(i % 3)];
        options.headings_set = i % 5 == 4;
        const auto boxes = drawnWay(dice, i < 6 ? 40 + i % 3 * 25 : 35 + i % 3 * 8);
        expectSame(reduceToKeyframes(boxes, flying(), options), slowlyReduced(boxes, flying(), options),
                   std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

TEST(SlowReduction, WhatIsRefinedGetsTheKeyframesThatAreMissedMost) {
    std::mt19937 dice(7);
    for (int i = 0; i < 150; ++i) {
        ReductionOptions options;
        options.tolerance_px = 0.5 + i % 3;
        auto boxes = drawnWay(dice, 50);
        LabelledObject object = test::object(3, {}, boxes.back().frame);
        for (const std::size_t k : {std::size_t{0}, boxes.size() / 3, boxes.size() / 2}) {
            object.keyframes.push_back(
                test::keyframe(boxes[k].frame, boxes[k].box, (i + static_cast<int>(k)) % 2 == 0));
            object.keyframes.back().occlusion = k == 0 ? Occlusion::none : Occlusion::partly;
        }
        // Some are before its begin, some after its end.
        if (i % 4 == 3) object.last_frame -= 5;
        if (i % 4 == 2) object.keyframes.erase(object.keyframes.begin());
        if (i % 5 == 4) boxes.erase(boxes.begin() + 10, boxes.begin() + 25);
        SlowSearch slow(object, boxes, flying(), options, object.keyframes.front().heading_set);
        slow.insert();
        expectSame(refined(object, boxes, flying(), options).keyframes, slow.object.keyframes, std::to_string(i));
        if (HasFatalFailure()) return;
    }
}

}  // namespace
}  // namespace eyrie::slow_reduction_test

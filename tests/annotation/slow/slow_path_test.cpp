#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <random>

#include "annotation/edits/carried_boxes.h"
#include "annotation/keyframes/box_reader.h"
#include "annotation/keyframes/interpolation.h"
#include "annotation/keyframes/keyframe_path.h"
#include "annotation/scenes.h"
#include "core/geometry/angle.h"

/// Boxes between keyframes against those of a path that is written down as its rules are told and works nothing out
/// ahead, over objects of every kind and cameras that fly, stand, lose the ground and know nothing.
namespace eyrie::slow_path_test {
namespace {

struct Mark {
    double time = 0;
    OrientedBox box;
    bool set = false;
    bool upright = false;
};

double norm(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}
double angle(cv::Point2d v) {
    return std::atan2(v.y, v.x);
}
cv::Point2d along(double heading) {
    return {std::cos(heading), std::sin(heading)};
}
bool axial(double heading) {
    const double quarters = heading / (kPi / 2);
    return std::abs(quarters - std::round(quarters)) < 1e-9;
}
cv::Point2d noLongerThan(cv::Point2d v, double longest) {
    return norm(v) > longest ? v * (longest / norm(v)) : v;
}

/// The path through marks; piece i goes from mark i to the next.
struct SlowPath {
    std::vector<Mark> marks;
    bool smooth = true;
    bool on_ground = true;
    bool stands_after = false;

    std::size_t last() const { return marks.size() - 1; }
    cv::Point2d chord(std::size_t i) const { return marks[i + 1].box.centre - marks[i].box.centre; }
    double duration(std::size_t i) const { return marks[i + 1].time - marks[i].time; }
    cv::Point2d velocity(std::size_t i) const { return chord(i) * (1 / duration(i)); }
    bool moves(std::size_t i) const {
        const double half = (marks[i].box.length + marks[i + 1].box.length) / 4;
        return norm(chord(i)) >= 1 && norm(chord(i)) >= half;
    }
    bool steers(std::size_t i) const {
        if (!marks[i].set || !marks[i + 1].set || !moves(i)) return false;
        return !marks[i].upright || !marks[i + 1].upright;
    }

    /// Turns from the chord to the headings at both ends, for what is driven along them.
    std::optional<std::pair<double, double>> turns(std::size_t i) const {
        if (!smooth || !on_ground || !steers(i)) return std::nullopt;
        const double first = turnBetween(angle(chord(i)), marks[i].box.heading);
        const double second = turnBetween(angle(chord(i)), marks[i + 1].box.heading);
        if (std::abs(first) > 1.2 || std::abs(second) > 1.2) return std::nullopt;
        return std::pair(first, second);
    }
    double speed(std::size_t i) const {
        const auto both = turns(i);
        if (!both) return norm(velocity(i));
        const double half = std::abs(both->second - both->first) / 2;
        return half > 1e-3 ? norm(velocity(i)) * half / std::sin(half) : norm(velocity(i));
    }
    /// How much piece i believes the piece on the other side of mark k.
    double belief(std::size_t i, std::size_t k) const {
        const double other = k == i ? duration(i - 1) : duration(i + 1);
        return std::min(1.0, 3 * other / duration(i));
    }
    double speedAt(std::size_t i, std::size_t k) const {
        if (k > 0 && k < last()) {
            const double a = speed(k - 1), b = speed(k);
            const double mean = (a * duration(k) + b * duration(k - 1)) / (duration(k) + duration(k - 1));
            const double both = std::min(mean, 3 * std::min(a, b));
            return speed(i) + (both - speed(i)) * belief(i, k);
        }
        if (stands_after && k == last()) return 0;
        if (marks.size() == 2 && !stands_after) return speed(i);
        const double other_end = speedAt(i, k == 0 ? 1 : k - 1);
        return std::clamp(2 * speed(i) - other_end, 0.0, 3 * speed(i));
    }
    cv::Point2d parabola(std::size_t k) const {
        if (k == 0) return tangent(0, 0);
        if (k == last()) return tangent(k - 1, k);
        const cv::Point2d a = velocity(k - 1), b = velocity(k);
        const cv::Point2d mean = (a * duration(k) + b * duration(k - 1)) * (1 / (duration(k) + duration(k - 1)));
        return noLongerThan(mean, 3 * std::min(norm(a), norm(b)));
    }
    cv::Point2d tangent(std::size_t i, std::size_t k) const {
        const cv::Point2d own = velocity(i);
        if (k > 0 && k < last()) return own + (parabola(k) - own) * belief(i, k);
        if (stands_after && k == last()) return {0, 0};
        if (marks.size() == 2 && !stands_after) return own;
        const cv::Point2d end = own * 2 - tangent(i, k == 0 ? 1 : k - 1);
        return end.dot(own) <= 0 ? cv::Point2d(0, 0) : noLongerThan(end, 3 * norm(own));
    }
    cv::Point2d velocityAt(std::size_t i, std::size_t k) const {
        const cv::Point2d free = tangent(i, k);
        if (!on_ground || !steers(i) || norm(free) < 1e-9) return free;
        const double turn = std::abs(turnBetween(angle(free), marks[k].box.heading));
        if (turn <= 0.6) return along(marks[k].box.heading) * speedAt(i, k);
        if (turn >= kPi - 0.6) return along(marks[k].box.heading) * -speedAt(i, k);
        return free;
    }

    /// Place and direction a share of the way along a piece.
    std::pair<cv::Point2d, double> at(std::size_t i, double share) const {
        const cv::Point2d from = marks[i].box.centre;
        if (!smooth) return {from + chord(i) * share, angle(chord(i))};
        const auto both = turns(i);
        if (both && std::abs(both->second - both->first) >= 0.1) return driven(i, share, *both);
        const cv::Point2d v = velocityAt(i, i) * duration(i), w = velocityAt(i, i + 1) * duration(i);
        const auto place = [&](double s) {
            return chord(i) * (s * s * (3 - 2 * s)) + v * (s * (1 - s) * (1 - s)) - w * (s * s * (1 - s));
        };
        const double inside = std::min(1 - 1e-3, std::max(1e-3, share));
        const cv::Point2d way = chord(i) * (6 * inside * (1 - inside)) + v * ((1 - inside) * (1 - 3 * inside)) +
                                w * (inside * (3 * inside - 2));
        return {from + place(share), norm(way) > 1e-9 ? angle(way) : angle(chord(i))};
    }
    /// Along the cubic through both headings, at a speed that changes smoothly.
    std::pair<cv::Point2d, double> driven(std::size_t i, double share, std::pair<double, double> both) const {
        const double turn = both.second - both.first;
        const double pull = norm(chord(i)) / (std::cos(turn / 4) * std::cos(turn / 4));
        const cv::Point2d v = along(angle(chord(i)) + both.first) * pull;
        const cv::Point2d w = along(angle(chord(i)) + both.second) * pull;
        const auto place = [&](double s) {
            return chord(i) * (s * s * (3 - 2 * s)) + v * (s * (1 - s) * (1 - s)) - w * (s * s * (1 - s));
        };
        std::vector<double> way{0};
        for (int k = 1; k <= 16; ++k) way.push_back(way.back() + norm(place(k / 16.0) - place((k - 1) / 16.0)));
        const double whole = way.back();
        const double start = std::min(3 * whole, speedAt(i, i) * duration(i));
        const double end = std::min(3 * whole, speedAt(i, i + 1) * duration(i));
        const double t = share;
        const double gone =
            whole * (3 * t * t - 2 * t * t * t) + start * (t * (1 - t) * (1 - t)) - end * (t * t * (1 - t));
        std::size_t step = 1;
        while (step < 16 && way[step] <= gone) ++step;
        const double rest = (gone - way[step - 1]) / std::max(1e-9, way[step] - way[step - 1]);
        const double s = (static_cast<double>(step) - 1 + rest) / 16;
        const cv::Point2d to = chord(i) * (6 * s * (1 - s)) + v * ((1 - s) * (1 - 3 * s)) + w * (s * (3 * s - 2));
        return {from(i) + place(s), angle(to)};
    }
    cv::Point2d from(std::size_t i) const { return marks[i].box.centre; }

    std::optional<double> direction(std::size_t k) const {
        const bool before = k > 0 && moves(k - 1);
        if (k < last() && moves(k)) {
            if (smooth && before && norm(parabola(k)) > 1e-9) return angle(parabola(k));
            return at(k, 0).second;
        }
        if (before) return at(k - 1, 1).second;
        return std::nullopt;
    }
    double heading(std::size_t k) const {
        if (marks[k].set) return marks[k].box.heading;
        return direction(k).value_or(marks[k].box.heading);
    }
    double headingAlong(std::size_t i, double share) const {
        const double a = heading(i), b = heading(i + 1);
        const double first = turnBetween(at(i, 0).second, a);
        const double change = turnBetween(first, turnBetween(at(i, 1).second, b));
        const bool own_turn = marks[i].set && marks[i + 1].set && std::abs(change) > 0.3;
        if (!moves(i) || own_turn) return a + share * turnBetween(a, b);
        return at(i, share).second + first + share * change;
    }
};

struct SlowBox {
    OrientedBox box;
    bool from_path = false;
};

/// What a keyframe and those around it make of a frame, over the ground or in the image; nothing where that is not
/// connected.
std::optional<SlowBox> boxOver(const LabelledObject& object, std::size_t here, FrameIndex frame,
                               const CameraMotion* camera, bool smooth) {
    const auto& keyframes = object.keyframes;
    const FrameIndex reference = keyframes[here].frame;
    const auto markOf = [&](std::size_t k) -> std::optional<Mark> {
        std::optional<OrientedBox> box = keyframes[k].box;
        if (camera != nullptr) box = carriedBox(keyframes[k].box, keyframes[k].frame, reference, *camera);
        if (!box) return std::nullopt;
        return Mark{static_cast<double>(keyframes[k].frame - reference), *box, keyframes[k].heading_set,
                    keyframes[k].heading_set && axial(keyframes[k].box.heading)};
    };
    const auto pathOver = [&](std::size_t reach, std::size_t& own) {
        SlowPath path{{}, smooth, camera != nullptr, false};
        for (std::size_t k = here; k-- > 0 && here - k <= reach && !keyframes[k].outside;) {
            const auto mark = markOf(k);
            if (!mark) break;
            path.marks.insert(path.marks.begin(), *mark);
        }
        own = path.marks.size();
        path.marks.push_back(*markOf(here));
        for (std::size_t k = here + 1; k < keyframes.size() && k <= here + 1 + reach; ++k) {
            const bool gone = k > here + 1 && keyframes[k - 1].outside;
            const auto mark = gone ? std::nullopt : markOf(k);
            if (!mark) break;
            path.marks.push_back(*mark);
            const bool stays = !keyframes.back().outside && object.last_frame - keyframes.back().frame >= 10;
            path.stands_after = k + 1 == keyframes.size() && camera != nullptr && stays;
        }
        return path;
    };
    std::size_t own = 0;
    SlowPath path = pathOver(1, own);
    const bool cut_off = here + 1 < keyframes.size() && path.last() == own;
    if (path.last() == own || !path.moves(own)) path = pathOver(2, own);
    if (cut_off && frame > reference) return std::nullopt;
    SlowBox result;
    const Mark& a = path.marks[own];
    if (frame == reference || path.last() == own) {
        result.box = a.box;
        result.box.heading = path.heading(own);
        result.from_path = !a.set && path.direction(own);
    } else {
        const Mark& b = path.marks[own + 1];
        const double share = (frame - reference) / b.time;
        result.box.centre = path.at(own, share).first;
        result.box.length = (1 - share) * a.box.length + share * b.box.length;
        result.box.width = (1 - share) * a.box.width + share * b.box.width;
        result.box.heading = path.headingAlong(own, share);
        result.from_path = path.moves(own) && !a.set && !b.set;
    }
    if (camera != nullptr) {
        const auto carried = carriedBox(result.box, reference, frame, *camera);
        if (!carried) return std::nullopt;
        result.box = *carried;
    }
    if (keyframes.size() > 1) {
        const Keyframe& now = keyframes[here];
        const Keyframe& beside = keyframes[here + 1 < keyframes.size() ? here + 1 : here - 1];
        const bool both = now.heading_set && beside.heading_set && axial(now.box.heading) && axial(beside.box.heading);
        if (both && std::abs(turnBetween(now.box.heading, beside.box.heading)) < 1e-9)
            result.box.heading = now.box.heading;
    }
    result.box.heading = wrapPi(result.box.heading);
    return result;
}

LabelledBox slowBoxAt(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera, bool smooth) {
    LabelledBox result;
    const auto& keyframes = object.keyframes;
    if (keyframes.empty() || frame < keyframes.front().frame || frame > object.last_frame) return result;
    std::size_t here = 0;
    while (here + 1 < keyframes.size() && keyframes[here + 1].frame <= frame) ++here;
    const Keyframe& now = keyframes[here];
    result.occlusion = now.occlusion;
    result.outside = now.outside;
    result.ignore = now.ignore;
    const bool exact = now.frame == frame;
    const bool has_next = here + 1 < keyframes.size();
    const bool to_next = has_next && camera.connects(now.frame, keyframes[here + 1].frame);
    const bool to_last = here > 0 && camera.connects(now.frame, keyframes[here - 1].frame);
    std::optional<SlowBox> box;
    if (exact || (has_next ? to_next : camera.connects(now.frame, frame)))
        box = boxOver(object, here, frame, &camera, smooth);
    result.source = exact ? BoxSource::keyframe : box ? BoxSource::ground : BoxSource::image;
    const bool alone = !to_next && !to_last;
    if (!box || (exact && alone && !now.heading_set && !box->from_path && keyframes.size() > 1))
        box = boxOver(object, here, frame, nullptr, smooth);
    result.heading_from_path = box->from_path;
    if (!exact) {
        result.box = box->box;
        return result;
    }
    result.box = now.box;
    if (!now.heading_set && box->from_path) result.box.heading = box->box.heading;
    return result;
}

CameraMotion cameraNumber(int which) {
    auto steps = test::stepsOf(test::flyingView, 260);
    if (which == 0) return CameraMotion(steps);
    if (which == 1) return CameraMotion::standing(0, 260);
    if (which == 2) return {};
    for (const int lost : {200, 121, 90, 61, 30}) steps.erase(steps.begin() + lost);
    if (which == 3) return CameraMotion(steps);
    // One that looks to the horizon, over which boxes may come.
    return CameraMotion(
        test::stepsOf([](double frame) { return cv::Matx33d(1, 0, 0, 0, 1, 0, 0, 0.00001 * frame, 1); }, 260));
}

class Objects {
 public:
    explicit Objects(unsigned seed) : dice_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice_); }
    bool happens(double share) { return between(0, 1) < share; }
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(dice_); }

    LabelledObject next() {
        LabelledObject object;
        object.id = 1;
        const int count = number(1, 7);
        const double sets = happens(0.3) ? 1 : happens(0.5) ? 0 : 0.5;
        const bool all_upright = happens(0.15);
        const bool drives = happens(0.6);
        FrameIndex frame = number(0, 20);
        OrientedBox box{{between(50, 200), between(50, 200)}, between(8, 40), between(3, 15), between(-3.1, 3.1)};
        for (int i = 0; i < count; ++i) {
            Keyframe keyframe;
            keyframe.frame = frame;
            keyframe.box = box;
            if (all_upright || happens(0.1)) keyframe.box.heading = kPi / 2 * number(-1, 2) * (happens(0.3) ? 1 : 0);
            keyframe.heading_set = happens(sets);
            keyframe.outside = happens(0.08);
            keyframe.ignore = happens(0.3);
            keyframe.occlusion = static_cast<Occlusion>(number(0, 2));
            object.keyframes.push_back(keyframe);
            const int frames = happens(0.3) ? number(1, 4) : number(5, 40);
            const double way = happens(0.2) ? 0 : happens(0.3) ? between(0, 20) : between(0, 5) * frames;
            const double turn = drives ? between(-0.6, 0.6) : between(-3, 3);
            const double there = box.heading + turn / 2 + (happens(0.1) ? kPi : 0);
            box.centre += along(there) * way;
            box.heading = wrapPi(box.heading + turn);
            box.length *= between(0.9, 1.1);
            box.width *= between(0.9, 1.1);
            frame += frames;
        }
        object.last_frame = object.keyframes.back().frame + number(-2, 24);
        return object;
    }

 private:
    std::mt19937 dice_;
};

void expectSame(const LabelledBox& shown, const LabelledBox& slow, const std::string& where) {
    ASSERT_EQ(shown.source, slow.source) << where;
    ASSERT_EQ(shown.occlusion, slow.occlusion) << where;
    ASSERT_EQ(shown.outside, slow.outside) << where;
    ASSERT_EQ(shown.ignore, slow.ignore) << where;
    ASSERT_EQ(shown.heading_from_path, slow.heading_from_path) << where;
    ASSERT_NEAR(shown.box.centre.x, slow.box.centre.x, 1e-7) << where;
    ASSERT_NEAR(shown.box.centre.y, slow.box.centre.y, 1e-7) << where;
    ASSERT_NEAR(shown.box.length, slow.box.length, 1e-8) << where;
    ASSERT_NEAR(shown.box.width, slow.box.width, 1e-8) << where;
    ASSERT_NEAR(turnBetween(shown.box.heading, slow.box.heading), 0, 1e-7) << where;
    ASSERT_LE(std::abs(shown.box.heading), 2 * kPi) << where;
}

TEST(SlowPath, BoxesAreWhereTheRulesSay) {
    for (int which = 0; which < 5; ++which) {
        const CameraMotion camera = cameraNumber(which);
        Objects objects(static_cast<unsigned>(which) + 1);
        for (int i = 0; i < 300; ++i) {
            const LabelledObject object = objects.next();
            const bool smooth = !objects.happens(0.2);
            const PathShape shape = smooth ? PathShape::smooth : PathShape::straight;
            BoxReader reader(object, camera, shape);
            for (FrameIndex frame = firstFrameOf(object) - 1; frame <= object.last_frame + 1; ++frame) {
                const std::string where = std::to_string(which) + "/" + std::to_string(i) + "/" + std::to_string(frame);
                expectSame(reader.at(frame), slowBoxAt(object, frame, camera, smooth), where);
                if (::testing::Test::HasFatalFailure()) return;
            }
        }
    }
}

TEST(SlowPath, WholeWaysDecideExactly) {
    // Places on whole pixels in a camera that knows nothing, where limits are met to the last bit.
    for (int way = 0; way < 14; ++way)
        for (const double length : {2.0, 8.0, 20.0}) {
            std::vector<Keyframe> keyframes;
            keyframes.reserve(4);
            for (int i = 0; i < 4; ++i)
                keyframes.push_back(test::keyframe(10 * i, {{50.0 + way * i, 60}, length, 4, 1}, false));
            const LabelledObject object = test::object(1, keyframes, 40);
            for (FrameIndex frame = 0; frame <= 40; ++frame)
                expectSame(boxAt(object, frame, {}), slowBoxAt(object, frame, {}, true), std::to_string(way));
        }
}

TEST(SlowPath, WhatIsKnownOfCarriedBoxesIsWhatWasAskedFor) {
    const CameraMotion camera = cameraNumber(3);
    Objects objects(9);
    for (const std::size_t boxes : {std::size_t{0}, std::size_t{1}, std::size_t{300}, std::size_t{5000}}) {
        CarriedBoxes known(camera, boxes);
        for (int i = 0; i < 3000; ++i) {
            // Few different ones, so that most have been asked for before and many fall upon one another.
            const double which = objects.number(0, 1);
            OrientedBox box{{50, 60}, 20, 9, 0.3};
            const int part = objects.number(0, 4);
            if (part == 0) box.centre.x += which;
            if (part == 1) box.centre.y += which;
            if (part == 2) box.length += which;
            if (part == 3) box.width += which;
            if (part == 4) box.heading += which;
            const FrameIndex from = objects.number(0, 12), to = objects.number(0, 60);
            const auto shown = known.carried(box, from, to);
            const auto right = carriedBox(box, from, to, camera);
            ASSERT_EQ(shown.has_value(), right.has_value());
            if (!right) continue;
            ASSERT_EQ(shown->centre, right->centre);
            ASSERT_EQ(shown->length, right->length);
            ASSERT_EQ(shown->width, right->width);
            ASSERT_EQ(shown->heading, right->heading);
        }
    }
}

}  // namespace
}  // namespace eyrie::slow_path_test

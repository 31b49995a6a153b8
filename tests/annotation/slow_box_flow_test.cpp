#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"
#include "imaging/following/box_flow.h"

/// The motion of a box and of the camera around it against one that is written as its rules are told, with turns and
/// scales as complex numbers, over drawn pictures in which parts move otherwise.
namespace eyrie::slow_box_flow_test {
namespace {

using Place = std::complex<double>;

const cv::Size kPicture(240, 180);

Place placeOf(cv::Point2d point) {
    return {point.x, point.y};
}

/// place · turn + shift
struct Motion {
    Place turn = 1, shift = 0;
    Place of(Place place) const { return place * turn + shift; }
};

/// The middle one, the upper of two.
double middleOf(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// From the middle shift on, three times: whoever is not farther off than two and a half times the usual, between half
/// of `near` and twice, tells the motion; a shift alone where they are fewer than `for_turn`.
Motion robustMotion(const std::vector<Place>& from, const std::vector<Place>& to, int for_turn, double near,
                    int& agreeing) {
    std::vector<double> right, down;
    for (std::size_t i = 0; i < from.size(); ++i) {
        right.push_back((to[i] - from[i]).real());
        down.push_back((to[i] - from[i]).imag());
    }
    Motion motion{1, {middleOf(right), middleOf(down)}};
    for (int time = 0; time < 3; ++time) {
        std::vector<double> off;
        off.reserve(from.size());
        for (std::size_t i = 0; i < from.size(); ++i) off.push_back(std::abs(motion.of(from[i]) - to[i]));
        const double limit = std::min(2 * near, std::max(near / 2, 2.5 * middleOf(off)));
        Place mean_from = 0, mean_to = 0;
        agreeing = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (off[i] > limit) continue;
            mean_from += from[i];
            mean_to += to[i];
            ++agreeing;
        }
        motion = {};
        if (agreeing == 0) continue;
        mean_from /= agreeing;
        mean_to /= agreeing;
        Place product = 0;
        double spread = 0;
        for (std::size_t i = 0; i < from.size(); ++i) {
            if (off[i] > limit) continue;
            product += std::conj(from[i] - mean_from) * (to[i] - mean_to);
            spread += std::norm(from[i] - mean_from);
        }
        if (agreeing >= for_turn && spread > 1e-6) motion.turn = product / spread;
        motion.shift = mean_to - mean_from * motion.turn;
    }
    return motion;
}

/// The picture around two boxes with a margin, as far as it goes.
cv::Rect around(const OrientedBox& a, const OrientedBox& b, double margin) {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
    for (const OrientedBox& box : {a, b}) {
        for (const cv::Point2d& corner : box.corners()) {
            left = std::min(left, corner.x);
            right = std::max(right, corner.x);
            top = std::min(top, corner.y);
            bottom = std::max(bottom, corner.y);
        }
    }
    const cv::Rect whole(static_cast<int>(left - margin), static_cast<int>(top - margin),
                         static_cast<int>(right - left + 2 * margin), static_cast<int>(bottom - top + 2 * margin));
    return whole & cv::Rect({}, kPicture);
}

/// 255 in the box, in a part of the picture.
cv::Mat insideOf(const OrientedBox& box, const cv::Rect& part) {
    std::vector<cv::Point> outline;
    for (const cv::Point2d& corner : box.corners()) outline.emplace_back(cvRound(corner.x), cvRound(corner.y));
    for (cv::Point& corner : outline) corner -= part.tl();
    cv::Mat inside = cv::Mat::zeros(part.size(), CV_8UC1);
    cv::fillConvexPoly(inside, outline, 255);
    return inside;
}

/// Corners that are found there and, from there, back again: where they were and are.
struct Followed {
    std::vector<cv::Point2f> from, to;
};

Followed followed(const cv::Mat& current, const cv::Mat& next, const std::vector<cv::Point2f>& corners,
                  const std::vector<cv::Point2f>& guesses, double most_off) {
    Followed kept;
    if (corners.empty()) return kept;
    const auto search = [](const cv::Mat& in, const cv::Mat& other, const std::vector<cv::Point2f>& at,
                           std::vector<cv::Point2f>& there) {
        std::vector<unsigned char> found;
        std::vector<float> error;
        cv::calcOpticalFlowPyrLK(in, other, at, there, found, error, {9, 9}, 2, {3, 20, 0.01},
                                 cv::OPTFLOW_USE_INITIAL_FLOW);
        return found;
    };
    std::vector<cv::Point2f> there = guesses;
    const auto found = search(current, next, corners, there);
    std::vector<cv::Point2f> back = there;
    for (std::size_t i = 0; i < corners.size(); ++i) back[i] -= guesses[i] - corners[i];
    const auto found_back = search(next, current, there, back);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (!found[i] || !found_back[i]) continue;
        if (std::hypot(back[i].x - corners[i].x, back[i].y - corners[i].y) > static_cast<float>(most_off)) continue;
        kept.from.push_back(corners[i]);
        kept.to.push_back(there[i]);
    }
    return kept;
}

BoxFlow slowFlow(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box, const OrientedBox& predicted,
                 const BoxFlowOptions& options) {
    BoxFlow flow;
    flow.box = predicted;
    const cv::Rect part = around(box, predicted, 40);
    if (part.width < 16 || part.height < 16) return flow;
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(current(part), corners, options.max_corners, 0.02, 2,
                            insideOf(box.scaled(0.95, 0.95), part), 3);
    const cv::Point2d corner_of_part = part.tl();
    const auto predictedPlace = [&](cv::Point2d place) {
        return predicted.toImage(box.toBox(place + corner_of_part) * (predicted.length / box.length));
    };
    std::vector<cv::Point2f> guesses;
    guesses.reserve(corners.size());
    for (const cv::Point2f& corner : corners) guesses.emplace_back(predictedPlace(corner) - corner_of_part);
    const Followed kept = followed(current(part), next(part), corners, guesses, options.max_forward_backward_px);
    flow.corners = static_cast<int>(kept.from.size());
    if (kept.from.empty()) return flow;
    std::vector<Place> from, to;
    for (std::size_t i = 0; i < kept.from.size(); ++i) {
        from.push_back(placeOf(predictedPlace(kept.from[i])));
        to.push_back(placeOf(cv::Point2d(kept.to[i]) + corner_of_part));
    }
    const double near = std::max(1.0, 0.02 * std::sqrt(box.length * box.width));
    const Motion motion = robustMotion(from, to, 5, near, flow.agreeing);
    const Place centre = motion.of(placeOf(predicted.centre));
    flow.box.centre = {centre.real(), centre.imag()};
    flow.box.heading = predicted.heading + std::min(0.12, std::max(-0.12, std::arg(motion.turn)));
    flow.growth = std::abs(motion.turn);
    return flow;
}

Motion slowCamera(const cv::Mat& current, const cv::Mat& next, const OrientedBox& box) {
    const cv::Rect part = around(box, box, 80);
    if (part.width < 32 || part.height < 32) return {};
    std::vector<cv::Point2f> corners;
    cv::goodFeaturesToTrack(current(part), corners, 150, 0.02, 4, ~insideOf(box.scaled(1.3, 1.3), part), 3);
    const Followed kept = followed(current(part), next(part), corners, corners, 0.7);
    if (kept.from.size() < 12) return {};
    std::vector<Place> from, to;
    for (std::size_t i = 0; i < kept.from.size(); ++i) {
        from.push_back(placeOf(cv::Point2d(kept.from[i]) + cv::Point2d(part.tl())));
        to.push_back(placeOf(cv::Point2d(kept.to[i]) + cv::Point2d(part.tl())));
    }
    int agreeing = 0;
    return robustMotion(from, to, 12, 1, agreeing);
}

/// About a place: a turn, a scale and a shift.
cv::Mat moved(const cv::Mat& picture, cv::Point2d about, double turn, double scale, cv::Point2d shift) {
    const Motion motion{std::polar(scale, turn), placeOf(about + shift) - placeOf(about) * std::polar(scale, turn)};
    const cv::Matx23d map(motion.turn.real(), -motion.turn.imag(), motion.shift.real(), motion.turn.imag(),
                          motion.turn.real(), motion.shift.imag());
    cv::Mat result;
    cv::warpAffine(picture, result, map, picture.size(), cv::INTER_CUBIC, cv::BORDER_REFLECT);
    return result;
}

/// A box, its picture, and the next one, in which a part of the picture moves otherwise.
struct Pair {
    OrientedBox box, predicted;
    cv::Mat current, next;
};

Pair pairOf(cv::RNG& dice, std::uint64_t seed) {
    Pair pair;
    const double length = dice.uniform(12.0, 110.0);
    pair.box = {{dice.uniform(10.0, 230.0), dice.uniform(10.0, 170.0)},
                length,
                length * dice.uniform(0.3, 0.9),
                dice.uniform(-2.8, 2.8)};
    // Much of what turns, little that turns by more than a vehicle may, and some that does not.
    const double turn = dice.uniform(-0.16, 0.16) * dice.uniform(0, 2), scale = dice.uniform(0.93, 1.07);
    const cv::Point2d shift(dice.uniform(-5.0, 5.0), dice.uniform(-5.0, 5.0));
    pair.predicted = pair.box.scaled(dice.uniform(0.95, 1.05), 1);
    pair.predicted.width *= pair.predicted.length / pair.box.length;
    pair.predicted.centre += shift * 0.8 + cv::Point2d(dice.uniform(-2.0, 2.0), dice.uniform(-2.0, 2.0));
    pair.predicted.heading += dice.uniform(-0.08, 0.08);
    pair.current = test::groundTexture(kPicture, static_cast<int>(seed), dice.uniform(0.8, 3.0), 20, 235);
    pair.next = moved(pair.current, pair.box.centre, turn, scale, shift);
    const cv::Rect other = cv::Rect(static_cast<int>(pair.box.centre.x + dice.uniform(-0.4, 0.4) * length), 0,
                                    static_cast<int>(length), kPicture.height) &
                           cv::Rect({}, kPicture);
    const cv::Point2d otherwise = shift + cv::Point2d(dice.uniform(-2.5, 2.5), dice.uniform(-2.5, 2.5));
    if (!other.empty()) moved(pair.current, pair.box.centre, turn, scale, otherwise)(other).copyTo(pair.next(other));
    cv::Mat noise(kPicture, CV_16S);
    dice.fill(noise, cv::RNG::NORMAL, 0, dice.uniform(0.0, 12.0));
    cv::add(pair.next, noise, pair.next, {}, CV_8U);
    return pair;
}

}  // namespace

TEST(SlowBoxFlow, BoxesMoveAsTheRulesSay) {
    int fewer_agree = 0, cut_short = 0, few = 0;
    for (std::uint64_t seed = 1; seed <= 150; ++seed) {
        SCOPED_TRACE(seed);
        cv::RNG dice(seed);
        const Pair pair = pairOf(dice, seed);
        BoxFlowOptions options;
        if (seed % 3 == 0) options = {dice.uniform(1, 12), dice.uniform(0.05, 1.0)};
        const BoxFlow flow = flowOf(pair.current, pair.next, pair.box, pair.predicted, options);
        const BoxFlow slow = slowFlow(pair.current, pair.next, pair.box, pair.predicted, options);
        ASSERT_EQ(flow.corners, slow.corners);
        ASSERT_EQ(flow.agreeing, slow.agreeing);
        ASSERT_LT(cv::norm(flow.box.centre - slow.box.centre), 1e-6);
        ASSERT_NEAR(turnBetween(flow.box.heading, slow.box.heading), 0, 1e-9);
        ASSERT_NEAR(flow.growth, slow.growth, 1e-9);
        ASSERT_EQ(flow.box.length, pair.predicted.length);
        ASSERT_EQ(flow.box.width, pair.predicted.width);
        fewer_agree += flow.agreeing < flow.corners;
        cut_short += std::abs(std::abs(turnBetween(pair.predicted.heading, flow.box.heading)) - 0.12) < 1e-9;
        few += flow.corners > 0 && flow.corners < 6;
    }
    EXPECT_GE(fewer_agree, 50);
    EXPECT_GE(cut_short, 5);
    EXPECT_GE(few, 10);
}

TEST(SlowBoxFlow, TheCameraMovesAsTheRulesSay) {
    int told = 0;
    for (std::uint64_t seed = 1; seed <= 60; ++seed) {
        SCOPED_TRACE(seed);
        cv::RNG dice(seed);
        const Pair pair = pairOf(dice, seed);
        const Homography map = cameraAround(pair.current, pair.next, pair.box);
        const Motion slow = slowCamera(pair.current, pair.next, pair.box);
        for (const cv::Point2d place : {cv::Point2d(0, 0), {239, 0}, {100, 179}}) {
            const Place there = slow.of(placeOf(place));
            ASSERT_LT(cv::norm(map.apply(place) - cv::Point2d(there.real(), there.imag())), 1e-6);
        }
        told += map.matrix != cv::Matx33d::eye();
    }
    EXPECT_GE(told, 50);
}

}  // namespace eyrie::slow_box_flow_test

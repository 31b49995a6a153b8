/// The filter of SORT against its equations written anew for one number at a time; boxes and waiting of the peer
/// counted by hand.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "peer/difference_peer.h"
#include "support/moving_scene.h"

namespace eyrie::peer_by_hand_test {
namespace {

/// A number and its rate in a Kalman filter of their own: those of SORT do not depend on each other.
struct NumberWithRate {
    double value = 0;
    double noise_of_rate = 0;  ///< that a frame adds, variance
    double noise_of_box = 0;   ///< of a measurement, variance
    double rate = 0;
    double of_value = 10, of_both = 0, of_rate = 1e4;  ///< variances and covariance

    void predict() {
        value += rate;
        of_value += 2 * of_both + of_rate + 1;
        of_both += of_rate;
        of_rate += noise_of_rate;
    }
    void update(double measured) {
        const double whole = of_value + noise_of_box;
        const double off = measured - value;
        value += of_value / whole * off;
        rate += of_both / whole * off;
        of_rate -= of_both * of_both / whole;
        of_both -= of_both * of_value / whole;
        of_value -= of_value * of_value / whole;
    }
};

/// The four of a box; the proportion of its sides has no rate.
struct BoxInNumbers {
    explicit BoxInNumbers(const OrientedBox& first)
        : x{first.centre.x, 0.01, 1},
          y{first.centre.y, 0.01, 1},
          area{first.area(), 1e-4, 10},
          aspect{first.length / first.width, 0, 10} {
        aspect.of_rate = 0;
    }
    void predict() {
        if (area.value + area.rate < 1) area.rate = 0;
        for (NumberWithRate* number : {&x, &y, &area, &aspect}) number->predict();
    }
    void update(const OrientedBox& box) {
        x.update(box.centre.x);
        y.update(box.centre.y);
        area.update(box.area());
        aspect.update(box.length / box.width);
    }
    void expectThatOf(const SortFilter& filter, int frame) const {
        EXPECT_NEAR(filter.box().centre.x, x.value, 1e-6) << frame;
        EXPECT_NEAR(filter.box().centre.y, y.value, 1e-6) << frame;
        EXPECT_NEAR(filter.velocity().x, x.rate, 1e-6) << frame;
        EXPECT_NEAR(filter.velocity().y, y.rate, 1e-6) << frame;
        EXPECT_NEAR(filter.box().area(), area.value, 1e-6) << frame;
        EXPECT_NEAR(filter.box().length / filter.box().width, aspect.value, 1e-6) << frame;
        EXPECT_EQ(filter.box().heading, 0);
    }

    NumberWithRate x, y, area, aspect;
};

/// Drives, turns and grows unevenly.
OrientedBox boxIn(int frame) {
    return {{50 + 3.0 * frame + std::sin(frame), 80 - 2.0 * frame + std::cos(3 * frame)},
            20 + 0.5 * frame + std::sin(2 * frame),
            10 + std::cos(frame),
            0};
}

Homography enlarging(double factor) {
    Homography map;
    map.matrix(0, 0) = map.matrix(1, 1) = factor;
    return map;
}

Registration still(FrameIndex frame, double enlarged = 1) {
    Registration registration;
    registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
    registration.current_from_previous = enlarging(enlarged);
    registration.current_from_previous.from_frame = std::max<FrameIndex>(frame - 1, 0);
    registration.current_from_previous.to_frame = frame;
    return registration;
}

/// A plain ground with one brighter thing on it.
Frame pictureOf(FrameIndex index, cv::Rect thing) {
    Frame frame;
    frame.index = index;
    frame.gray = cv::Mat(240, 320, CV_8UC1, cv::Scalar(100));
    frame.gray(thing).setTo(140);
    return frame;
}

PeerOptions plain(int gap = 1) {
    PeerOptions options;
    options.gap = gap;
    options.joining = 0;
    return options;
}

FrameMotion motionOf(const Registration& registration) {
    FrameMotion motion;
    motion.registration = registration;
    return motion;
}

}  // namespace

TEST(PeerByHand, TheFilterIsThatOfTheAuthors) {
    SortFilter filter(boxIn(0));
    BoxInNumbers expected(boxIn(0));
    for (int frame = 1; frame < 30; ++frame) {
        filter.predict({});
        expected.predict();
        expected.expectThatOf(filter, frame);
        if (frame % 7 == 5 || frame % 7 == 6) continue;  // not found
        filter.update(boxIn(frame));
        expected.update(boxIn(frame));
        expected.expectThatOf(filter, frame);
    }
    EXPECT_GT(expected.area.rate, 1) << "it has grown";
}

TEST(PeerByHand, WhatShrinksStaysAtItsLastSizeBeforeItWouldBeGone) {
    SortFilter filter({{50, 40}, 40, 10, 0});
    BoxInNumbers expected({{50, 40}, 40, 10, 0});
    for (int frame = 1; frame < 4; ++frame) {
        const OrientedBox box{{50, 40}, 40 - 10.0 * frame, 10, 0};
        filter.predict({});
        expected.predict();
        filter.update(box);
        expected.update(box);
    }
    for (int frame = 4; frame < 9; ++frame) {
        filter.predict({});
        expected.predict();
        expected.expectThatOf(filter, frame);
    }
    EXPECT_NEAR(filter.box().area(), 100, 5);
}

TEST(PeerByHand, WhatIsKnownTurnsAndGrowsWithTheGround) {
    SortFilter filter(boxIn(0));
    BoxInNumbers expected(boxIn(0));
    for (int frame = 1; frame < 6; ++frame) {
        filter.predict({});
        expected.predict();
        filter.update(boxIn(frame));
        expected.update(boxIn(frame));
    }
    // A quarter turn to the right, 1.2 times as large, moved by (300, 5).
    Homography map;
    map.matrix = {0, -1.2, 300, 1.2, 0, 5, 0, 0, 1};
    const BoxInNumbers before = expected;
    expected.x.value = 300 - 1.2 * before.y.value;
    expected.y.value = 5 + 1.2 * before.x.value;
    expected.x.rate = -1.2 * before.y.rate;
    expected.y.rate = 1.2 * before.x.rate;
    expected.area.value *= 1.44;
    expected.area.rate *= 1.44;
    filter.predict(map);
    expected.predict();
    expected.expectThatOf(filter, 6);
}

TEST(PeerByHand, NoFrameEnlargesFiveTimes) {
    const auto seenAfter = [](const Homography& map) {
        SortFilter filter({{50, 40}, 20, 10, 0});
        filter.predict(map);
        return filter.box();
    };
    for (const double factor : {0.21, 0.5, 2.0, 4.9}) {
        EXPECT_NEAR(seenAfter(enlarging(factor)).centre.x, 50 * factor, 1e-9) << factor;
        EXPECT_NEAR(seenAfter(enlarging(factor)).length, 20 * factor, 1e-9) << factor;
    }
    for (const double factor : {0.0, 0.19, 5.0, 5.1}) {
        EXPECT_NEAR(seenAfter(enlarging(factor)).centre.x, 50, 1e-9) << factor;
        EXPECT_NEAR(seenAfter(enlarging(factor)).length, 20, 1e-9) << factor;
    }
    Homography nowhere;
    nowhere.matrix(0, 2) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(seenAfter(nowhere).centre, cv::Point2d(50, 40));
    nowhere.matrix(0, 2) = 0;
    nowhere.matrix(1, 2) = std::numeric_limits<double>::infinity();
    EXPECT_EQ(seenAfter(nowhere).centre, cv::Point2d(50, 40));
}

TEST(PeerByHand, BoxesKeepAPixelAndAHundredthOfTheirLength) {
    SortFilter small({{50, 40}, 4, 2, 0});
    small.predict(enlarging(0.25));
    EXPECT_NEAR(small.box().length, std::sqrt(2), 1e-9) << "half a pixel, taken as one";
    EXPECT_NEAR(small.box().width, std::sqrt(0.5), 1e-9);
    const SortFilter thin({{50, 40}, 0.5, 200, 0});
    EXPECT_NEAR(thin.box().length, 1, 1e-9);
    EXPECT_NEAR(thin.box().width, 100, 1e-9);
}

TEST(PeerByHand, OneHitConfirmsWhereOneIsAskedFor) {
    SortTracker tracker({0.3, 1, 2});
    const auto states = tracker.next({{{50, 40}, 20, 10, 0}}, {});
    ASSERT_EQ(states.size(), 1U);
    EXPECT_EQ(states[0].status, TrackStatus::confirmed);
    EXPECT_EQ(states[0].score, 1);
    EXPECT_EQ(tracker.next({}, {}).at(0).score, 0.5) << "found in one of two frames";
}

TEST(PeerByHand, ABoxHoldsItsAreaPixelByPixel) {
    const auto found = [](double threshold) {
        PeerOptions options = plain();
        options.threshold = threshold;
        ThreeFrameBoxes boxes(options);
        boxes.next(pictureOf(0, {20, 20, 21, 8}), still(0));
        boxes.next(pictureOf(1, {100, 60, 21, 8}), still(1));
        return boxes.next(pictureOf(2, {200, 120, 21, 8}), still(2)).value();
    };
    ASSERT_EQ(found(39).boxes.size(), 1U);
    EXPECT_EQ(found(39).frame, 1);
    EXPECT_EQ(found(39).boxes[0].centre, cv::Point2d(110, 63.5)) << "the columns 100 to 120, the rows 60 to 67";
    EXPECT_EQ(found(39).boxes[0].length, 21);
    EXPECT_EQ(found(39).boxes[0].width, 8);
    EXPECT_TRUE(found(40).boxes.empty()) << "the thing is brighter by 40, not by more";
}

TEST(PeerByHand, ABoxIsAsLargeAsThePictureInTheMiddleShowsIt) {
    // Each picture shows the ground half as large as the one before.
    ThreeFrameBoxes boxes(plain());
    boxes.next(pictureOf(0, {20, 160, 48, 24}), still(0));
    boxes.next(pictureOf(1, {100, 60, 32, 16}), still(1, 0.5));
    const auto found = boxes.next(pictureOf(2, {20, 10, 12, 6}), still(2, 0.5)).value();
    ASSERT_EQ(found.boxes.size(), 1U);
    EXPECT_NEAR(found.boxes[0].centre.x, 115.5, 1.5);
    EXPECT_NEAR(found.boxes[0].centre.y, 67.5, 1.5);
    EXPECT_NEAR(found.boxes[0].length, 32, 2.5);
    EXPECT_NEAR(found.boxes[0].width, 16, 2.5);
}

TEST(PeerByHand, WhatDiffersIsFoundWithoutDoubt) {
    DifferencePeer peer(plain());
    peer.next(pictureOf(0, {20, 20, 21, 8}), motionOf(still(0)));
    peer.next(pictureOf(1, {100, 60, 21, 8}), motionOf(still(1)));
    const auto done = peer.next(pictureOf(2, {200, 120, 21, 8}), motionOf(still(2)));
    ASSERT_EQ(done.size(), 2U);
    EXPECT_TRUE(done[0].second.detections.empty()) << "nothing lies before the first picture";
    ASSERT_EQ(done[1].second.detections.size(), 1U);
    EXPECT_EQ(done[1].second.detections[0].score, 1);
    EXPECT_EQ(done[1].second.detections[0].box.centre, cv::Point2d(110, 63.5));
    EXPECT_EQ(done[1].second.tracks.size(), 1U);
}

TEST(PeerByHand, FiftyFramesMoreThanTwoGapsWaitAtMost) {
    DifferencePeer peer(plain(10));
    std::size_t returned = 0;
    for (FrameIndex i = 0; i < 200; ++i) {
        Registration registration = still(i);
        if (i > 0) registration.state = RegistrationState::failed;
        returned += peer.next(pictureOf(i, {20, 20, 21, 8}), motionOf(registration)).size();
    }
    EXPECT_EQ(returned, 200U - 2 * 10 - 50);
    EXPECT_EQ(peer.finish().size(), 70U);
}

TEST(PeerByHand, NoTrackOutlivesACut) {
    PeerOptions options = plain();
    options.sort.max_age = 50;
    DifferencePeer peer(options);
    std::vector<DifferencePeer::Result> all;
    for (FrameIndex i = 0; i < 12; ++i) {
        Registration registration = still(i);
        if (i == 6) registration.state = RegistrationState::first;
        Frame blinking = pictureOf(i, {20, 20, 21, 8});
        if (i % 2 == 1) blinking.gray.setTo(100);
        for (auto& result : peer.next(blinking, motionOf(registration))) all.push_back(std::move(result));
    }
    const auto idsIn = [&](std::size_t frame) {
        std::vector<TrackId> ids;
        for (const TrackState& state : all.at(frame).second.tracks) ids.push_back(state.id);
        return ids;
    };
    EXPECT_THAT(idsIn(4), testing::ElementsAre(1));
    EXPECT_THAT(idsIn(5), testing::ElementsAre(1)) << "predicted";
    EXPECT_THAT(idsIn(6), testing::IsEmpty());
    EXPECT_THAT(idsIn(8), testing::ElementsAre(2));
}

}  // namespace eyrie::peer_by_hand_test

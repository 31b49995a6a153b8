#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/parameter.h"
#include "registration/flight.h"

namespace eyrie::stuck_corners_test {
namespace {

using test::Flight;
using test::kSize;
using test::Watch;

constexpr int kDirtyFrames = 60;
constexpr int kAfter = 30;  ///< frames after which dirt must be known

/// Specks on the lens, in a grid that keeps off the border.
std::vector<cv::Point> specks() {
    std::vector<cv::Point> places;
    for (int y = 30; y < kSize.height - 20; y += 36) {
        for (int x = 26 + y % 5; x < kSize.width - 20; x += 40) places.emplace_back(x, y);
    }
    return places;
}

cv::Mat dirty(cv::Mat picture) {
    picture = picture.clone();
    for (const cv::Point& speck : specks()) cv::rectangle(picture, cv::Rect(speck, cv::Size(6, 5)), cv::Scalar(12), -1);
    return picture;
}

cv::Matx33d step() {
    return test::cameraMotion(kSize, 1.6, 0.7, 0, 1);
}

/// What a camera sees that goes on by that step, drawn once for all.
const std::vector<cv::Mat>& pictures() {
    static const std::vector<cv::Mat> drawn = [] {
        Flight flight;
        std::vector<cv::Mat> seen;
        for (int i = 0; i < kDirtyFrames; ++i) {
            seen.push_back(flight.picture());
            flight.move(step());
        }
        return seen;
    }();
    return drawn;
}

struct DirtyFlight {
    double on_dirt = 0;  ///< corners a frame that keep their place in the picture, once dirt must be known
    double error = 0;    ///< px, mean of the registrations
    double corners = 0;  ///< a frame
};

DirtyFlight fly(const RegistrationOptions& options, bool with_dirt = true) {
    Watch watch(options);
    DirtyFlight result;
    int i = -1;
    for (const cv::Mat& picture : pictures()) {
        const RegisteredFrame frame = watch.seePicture(with_dirt ? dirty(picture) : picture);
        if (++i == 0) continue;
        EXPECT_EQ(frame.registration.state, RegistrationState::registered);
        result.error +=
            test::gridError(frame.registration.current_from_previous.matrix, step(), kSize) / (kDirtyFrames - 1);
        if (i < kAfter) continue;
        for (const Corner& corner : frame.corners) {
            const cv::Point2f shift = corner.current - corner.previous;
            result.on_dirt += corner.age >= kAfter && std::hypot(shift.x, shift.y) < 0.5 ? 1 : 0;
        }
        result.corners += static_cast<double>(frame.corners.size());
    }
    result.on_dirt /= kDirtyFrames - kAfter;
    result.corners /= kDirtyFrames - kAfter;
    return result;
}

RegistrationOptions with(const char* value) {
    RegistrationOptions options;
    setParameter(describeOf(options), "registration.leave_out_stuck", value);
    return options;
}

}  // namespace

TEST(StuckCorners, OnDirtAreFoundAndLeftOut) {
    const DirtyFlight kept = fly(with("false"));
    const DirtyFlight left_out = fly(with("true"));
    EXPECT_GT(kept.on_dirt, 10) << "the scene has dirt with corners";
    EXPECT_LT(left_out.on_dirt, 0.3 * kept.on_dirt);
    EXPECT_LT(left_out.error, std::max(0.03, 1.1 * kept.error));
    EXPECT_GT(left_out.corners, 0.5 * kept.corners) << "only those on dirt";
}

TEST(StuckCorners, AreNoneOnACleanLens) {
    EXPECT_EQ(fly(with("true"), false).corners, fly(with("false"), false).corners);
}

/// A camera that hovers: everything stays where it is in the picture, and it is the ground.
TEST(StuckCorners, NeedGroundThatMoves) {
    Watch watch(with("true"));
    Flight flight;
    std::size_t first = 0;
    RegisteredFrame frame;
    for (int i = 0; i < kDirtyFrames; ++i) {
        flight.move(test::cameraMotion(kSize, 0.01, 0, 0, 1));
        frame = watch.see(flight);
        if (i == 2) first = frame.corners.size();
    }
    EXPECT_GT(frame.corners.size(), 0.8 * static_cast<double>(first));
}

/// What the camera follows keeps its place only roughly.
TEST(StuckCorners, AVehicleThatTheCameraFollowsIsNone) {
    Watch watch(with("true"));
    int on_vehicle = 0;
    for (int i = 0; i < kDirtyFrames; ++i) {
        cv::Mat picture = pictures().at(std::size_t(i)).clone();
        const cv::Point at(150 + static_cast<int>(std::lround(2.5 * std::sin(0.35 * i))), 110);
        cv::rectangle(picture, cv::Rect(at, cv::Size(22, 11)), cv::Scalar(235), -1);
        cv::rectangle(picture, cv::Rect(at + cv::Point(6, 2), cv::Size(7, 7)), cv::Scalar(60), -1);
        const RegisteredFrame frame = watch.seePicture(picture);
        if (i < kAfter) continue;
        for (const Corner& corner : frame.corners)
            on_vehicle += corner.age > 2 && cv::Rect(at, cv::Size(22, 11)).contains(cv::Point(corner.current));
    }
    EXPECT_GT(on_vehicle, kDirtyFrames - kAfter);
}

namespace {

/// One corner, and how it is found again while the ground moves.
struct HeldCorner {
    explicit HeldCorner(bool leave_out = true) : tracker(optionsFor(leave_out), test::scaleOf(0.3)) {
        picture.build(test::TexturedGround(5).picture({160, 120}, cv::Matx33d::eye(), 0, 1));
        CornerId next_id = 1;
        tracker.add(set, {{80, 60}}, picture.smooth(), next_id);
    }
    /// How often `step` is called until the corner is stuck; 0: never in 60 times.
    int stepsUntilStuck(cv::Point2d ground, int frames = 1) {
        for (int count = 1; count <= 60; ++count)
            if (step(ground, {0, 0}, frames)) return count;
        return 0;
    }
    /// The ground moves, the corner is found beside where it was in the picture; whether it is stuck now.
    bool step(cv::Point2d ground, cv::Point2f beside = {0, 0}, int frames = 1) {
        EXPECT_EQ(set.size(), 1);
        if (set.size() != 1) return false;
        TrackedPosition found;
        found.found = true;
        found.contrast = 100;
        found.position = set.corners[0].position + beside;
        found.offset = set.corners[0].offset + beside;
        HomographyFit fit;
        fit.matrix = {1, 0, ground.x, 0, 1, ground.y, 0, 0, 1};
        fit.inlier_distance_px = 1;
        tracker.advance(set, {found}, fit, picture.smooth(), frames, 1);
        return set.size() == 1 && set.corners[0].sticks;
    }

    static TrackingOptions optionsFor(bool leave_out) {
        TrackingOptions options;
        options.leave_out_stuck = leave_out;
        options.max_jerk = 50;
        return options;
    }

    CornerTracker tracker;
    CornerSet set{tracker.window()};
    ImagePyramid picture;
};

}  // namespace

TEST(StuckCorners, AreKnownAfter24FramesOverMoreThan12PixelsOfGround) {
    EXPECT_EQ(HeldCorner().stepsUntilStuck({1, 0}), 24) << "24 px";
    EXPECT_EQ(HeldCorner().stepsUntilStuck({0, -0.5}), 25) << "12.5 px; 12 are not enough";
    EXPECT_EQ(HeldCorner().stepsUntilStuck({0.25, 0}), 49) << "12.25 px";
    EXPECT_EQ(HeldCorner().stepsUntilStuck({2, 0}, 2), 12) << "every other frame was lost";
    EXPECT_EQ(HeldCorner(false).stepsUntilStuck({1, 0}), 0) << "nobody asked";
}

TEST(StuckCorners, StaySoUntilTheyMoveByMoreThanAPixelAndAHalf) {
    HeldCorner corner;
    ASSERT_EQ(corner.stepsUntilStuck({1, 0}), 24);
    for (int i = 0; i < 24; ++i) EXPECT_TRUE(corner.step({-1, 0})) << "though the ground came back";
    EXPECT_TRUE(corner.step({1, 0}, {1.4F, 0}));
    EXPECT_FALSE(corner.step({1, 0}, {0.2F, 0})) << "1.6 px from where it stuck";
    EXPECT_EQ(corner.stepsUntilStuck({1, 0}), 24) << "and all begins anew";
}

}  // namespace eyrie::stuck_corners_test

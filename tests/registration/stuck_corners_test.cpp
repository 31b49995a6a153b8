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

struct DirtyFlight {
    double on_dirt = 0;  ///< corners a frame that keep their place in the picture, once dirt must be known
    double error = 0;    ///< px, mean of the registrations
    double corners = 0;  ///< a frame
};

DirtyFlight fly(const RegistrationOptions& options, bool with_dirt = true) {
    Watch watch(options);
    Flight flight;
    watch.seePicture(with_dirt ? dirty(flight.picture()) : flight.picture());
    DirtyFlight result;
    for (int i = 1; i < kDirtyFrames; ++i) {
        const cv::Matx33d step = test::cameraMotion(kSize, 1.6, 0.7, 0, 1);
        flight.move(step);
        const RegisteredFrame frame = watch.seePicture(with_dirt ? dirty(flight.picture()) : flight.picture());
        EXPECT_EQ(frame.registration.state, RegistrationState::registered);
        result.error +=
            test::gridError(frame.registration.current_from_previous.matrix, step, kSize) / (kDirtyFrames - 1);
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
    Flight flight;
    int on_vehicle = 0;
    for (int i = 0; i < kDirtyFrames; ++i) {
        flight.move(test::cameraMotion(kSize, 1.6, 0.7, 0, 1));
        cv::Mat picture = flight.picture().clone();
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

}  // namespace eyrie::stuck_corners_test

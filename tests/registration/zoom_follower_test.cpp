#include "registration/zoom_follower.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <string>

#include "core/state_archive.h"
#include "registration/flight.h"
#include "registration/registrar.h"

namespace eyrie::zoom_follower_test {
namespace {

const cv::Size kPicture(1024, 540);
const cv::Point2d kMiddle(511.5, 269.5);

/// Enlarges the middle of the picture along x and across it.
cv::Matx33d enlarging(double along, double across) {
    return {along, 0, kMiddle.x * (1 - along), 0, across, kMiddle.y * (1 - across), 0, 0, 1};
}

Registration by(const cv::Matx33d& matrix, RegistrationState state = RegistrationState::registered) {
    Registration registration;
    registration.state = state;
    registration.current_from_previous.matrix = matrix;
    return registration;
}

class ZoomFollowing : public testing::Test {
 protected:
    double after(int frames, const cv::Matx33d& each) {
        double zoom = follower.zoom();
        for (int i = 0; i < frames; ++i) zoom = follower.next(by(each), kPicture);
        return zoom;
    }
    double steady(int frames = 50) { return after(frames, cv::Matx33d::eye()); }

    ZoomFollower follower{SceneScale{0.2, 25}};
};

}  // namespace

TEST_F(ZoomFollowing, TellsHowFarTheCameraZoomedInAndOutAgain) {
    EXPECT_EQ(steady(), 1);
    after(30, enlarging(1.02, 1.02));
    EXPECT_NEAR(steady(), std::pow(1.02, 30), 1e-9);
    after(30, enlarging(1 / 1.02, 1 / 1.02));
    EXPECT_NEAR(steady(), 1, 1e-9);
}

TEST_F(ZoomFollowing, TakesNoFlightOverGroundAtAnAngleForAZoom) {
    // As it nears by 1 % a frame, ground is enlarged by that along the horizon and by its square across.
    EXPECT_EQ(after(100, enlarging(1.01, 1.01 * 1.01)), 1);
    EXPECT_EQ(after(100, enlarging(1 / 1.01, 1 / (1.01 * 1.01))), 1);
    // Both at once are told apart.
    EXPECT_NEAR(after(40, enlarging(1.02 * 1.01, 1.02 * 1.01 * 1.01)), std::pow(1.02, 40), 1e-6);
}

TEST_F(ZoomFollowing, KnowsTheHorizonOfATurnedViewFromTheSlopeOfItsScale) {
    SceneScale turned{0.2, 25};
    turned.slope = ScaleSlope::ofPicture(kPicture, 0.001, 0);  // the horizon stands upright in it
    follower = ZoomFollower(turned);
    EXPECT_EQ(after(100, enlarging(1.01 * 1.01, 1.01)), 1);
    EXPECT_NEAR(after(40, enlarging(1.02, 1.02)), std::pow(1.02, 40), 1e-9);
}

TEST_F(ZoomFollowing, LetsErrorsOfAnHourNotAddUp) {
    std::mt19937 random(5);
    std::normal_distribution<double> error(0.0003, 0.001);  // a share that goes on one way, too
    for (int i = 0; i < 90'000; ++i) {
        const double off = 1 + error(random);
        ASSERT_EQ(follower.next(by(enlarging(off, off)), kPicture), 1) << i;
    }
}

TEST_F(ZoomFollowing, TakesAStepAtOnceAndNoSmallOne) {
    follower.next(by(enlarging(1.05, 1.05)), kPicture);
    EXPECT_EQ(steady(), 1) << "one picture that is off is no zoom";
    EXPECT_NEAR(follower.next(by(enlarging(1.6, 1.6)), kPicture), 1.6, 1e-9) << "before anything is measured in it";
    EXPECT_NEAR(steady(), 1.6, 1e-9);
    after(4, cv::Matx33d::eye());
    EXPECT_NEAR(follower.next(by(enlarging(1 / 1.6, 1 / 1.6)), kPicture), 1, 1e-9);
}

TEST_F(ZoomFollowing, CountsNothingTwiceWhenAZoomEndsAndAnotherBegins) {
    double zoom = 1;
    for (int i = 0; i < 8; ++i) {
        after(14, enlarging(1.01, 1.01));
        after(9, cv::Matx33d::eye());
        zoom *= std::pow(1.01, 14);
    }
    EXPECT_NEAR(steady(), zoom, 0.02 * zoom);
}

TEST_F(ZoomFollowing, KeepsTheZoomThroughAFrozenPictureAFailedOneAndACut) {
    after(30, enlarging(1.02, 1.02));
    const double zoom = follower.zoom();
    EXPECT_EQ(follower.next(by(cv::Matx33d::eye(), RegistrationState::frozen), kPicture), zoom);
    // A guess that went on zooming, which the next homography takes back.
    follower.next(by(enlarging(1.02, 1.02), RegistrationState::failed), kPicture);
    EXPECT_NEAR(follower.next(by(enlarging(1 / 1.02, 1 / 1.02)), kPicture), zoom, 1e-9);
    Registration cut = by(enlarging(9, 9), RegistrationState::failed);
    cut.failure.fault = RegistrationFault::cut;
    EXPECT_NEAR(follower.next(cut, kPicture), zoom, 1e-9);
    EXPECT_NEAR(steady(), zoom, 1e-9);
}

TEST_F(ZoomFollowing, KeepsWithinWhatCamerasCanAndMakesNothingOfDamage) {
    EXPECT_LT(after(200, enlarging(1.5, 1.5)), 20);
    EXPECT_GT(after(400, enlarging(0.5, 0.5)), 0.05);
    follower.reset();
    EXPECT_EQ(after(30, cv::Matx33d::zeros()), 1);
    EXPECT_EQ(after(30, enlarging(std::nan(""), 1)), 1);
}

TEST(ZoomOfARegistrar, IsToldOfPicturesAndGoesOnWhenItIsTakenUpAgain) {
    test::Flight flight;
    const double each = 1.02;
    const cv::Point2d middle((test::kSize.width - 1) / 2.0, (test::kSize.height - 1) / 2.0);
    const cv::Matx33d zoom(each, 0, middle.x * (1 - each), 0, each, middle.y * (1 - each), 0, 0, 1);
    Registrar whole({}, test::scaleOf(0.3));
    Registrar taken_up({}, test::scaleOf(0.3));
    std::vector<cv::Mat> pictures;
    double told = 1;
    for (int i = 0; i < 40; ++i) {
        pictures.push_back(flight.picture());
        const RegisteredFrame frame = whole.next(test::frameOf(i, pictures.back()));
        told = frame.registration.zoom;
        if (i >= 21) {
            const RegisteredFrame same = taken_up.next(test::frameOf(i, pictures.back()));
            EXPECT_EQ(same.registration.zoom, told) << i;
            EXPECT_EQ(same.corners.size(), frame.corners.size()) << i;
        }
        if (i == 20) {
            StateWriter writer;
            writer(whole);
            const std::string bytes = writer.bytes();
            StateReader reader(bytes, [&](FrameIndex at) { return pictures.at(std::size_t(at)); });
            reader(taken_up);
        }
        flight.move(zoom);
    }
    EXPECT_NEAR(told, std::pow(each, 39), 0.03 * told);
}

TEST(ZoomOfARegistrar, IsCountedFromTheOneBefore) {
    Registrar later({}, test::scaleOf(0.3), 1.7);
    test::Flight flight;
    EXPECT_NEAR(later.next(test::frameOf(0, flight.picture())).registration.zoom, 1.7, 1e-9);
    later.reset();
    EXPECT_EQ(later.next(test::frameOf(9, flight.picture())).registration.zoom, 1);
}

}  // namespace eyrie::zoom_follower_test

// What a registrar does with frames whose motion and corners are known from how they were made.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "registration/flight.h"

namespace eyrie::registrar_by_hand_test {
namespace {

using test::Flight;
using test::gridError;
using test::Watch;

const cv::Size kSmall(160, 120);

cv::Matx33d shift(double x, double y) {
    return {1, 0, x, 0, 1, y, 0, 0, 1};
}

RegistrationOptions withoutFeatures() {
    RegistrationOptions options;
    options.feature_search = false;
    return options;
}

int cornersOf(const RegisteredFrame& frame) {
    return static_cast<int>(frame.corners.size());
}

}  // namespace

/// A quarter of the picture a frame: searches without a prediction reach two fifths.
TEST(RegistrarByHand, AfterAFrozenFrameACameraMayHaveGoneOnAsFarAsItWouldHave) {
    const cv::Size size(320, 160);
    const cv::Matx33d step = shift(80, 0);
    Watch watch(withoutFeatures());
    Flight flight(size);
    watch.see(flight);
    for (int i = 0; i < 2; ++i) {
        flight.move(step);
        const RegisteredFrame frame = watch.see(flight);
        ASSERT_EQ(frame.registration.state, RegistrationState::registered);
        EXPECT_LT(gridError(frame.registration.current_from_previous.matrix, step, size), 0.2);
    }
    flight.move(step);
    const cv::Mat gray = flight.picture();
    ASSERT_EQ(watch.seePicture(gray).registration.state, RegistrationState::registered);
    ASSERT_EQ(watch.seePicture(gray.clone()).registration.state, RegistrationState::frozen);
    flight.move(step);
    flight.move(step);
    const RegisteredFrame after = watch.see(flight);
    ASSERT_EQ(after.registration.state, RegistrationState::registered) << "half the picture in two steps";
    EXPECT_LT(gridError(after.registration.current_from_previous.matrix, shift(160, 0), size), 0.3);
    EXPECT_EQ(after.registration.current_from_previous.from_frame, 4);
    EXPECT_EQ(after.registration.current_from_previous.to_frame, 5);
    // What was gone in two frames is not the motion of one.
    const RegisteredFrame blank = watch.seePicture(cv::Mat(size, CV_8UC1, cv::Scalar(0)));
    ASSERT_EQ(blank.registration.state, RegistrationState::failed);
    EXPECT_LT(gridError(blank.registration.current_from_previous.matrix, step, size), 0.3);
}

/// What a camera is expected to do through a freeze has an end: 40 steps of 7 px would lead out of the picture.
TEST(RegistrarByHand, WhatACameraIsExpectedToDoThroughAFreezeHasAnEnd) {
    const cv::Size size(320, 160);
    const cv::Matx33d step = shift(7, 0);
    Watch watch(withoutFeatures());
    Flight flight(size);
    watch.see(flight);
    for (int i = 0; i < 2; ++i) {
        flight.move(step);
        ASSERT_EQ(watch.see(flight).registration.state, RegistrationState::registered);
    }
    flight.move(step);
    const cv::Mat gray = flight.picture();
    ASSERT_EQ(watch.seePicture(gray).registration.state, RegistrationState::registered);
    for (int i = 0; i < 40; ++i)
        ASSERT_EQ(watch.seePicture(gray.clone()).registration.state, RegistrationState::frozen);
    for (int i = 0; i < 21; ++i) flight.move(step);
    const RegisteredFrame after = watch.see(flight);
    ASSERT_EQ(after.registration.state, RegistrationState::registered);
    EXPECT_LT(gridError(after.registration.current_from_previous.matrix, shift(21 * 7, 0), size), 0.5);
}

TEST(RegistrarByHand, OfAsManyCornersAsAreNeededSomeAreLost) {
    Watch first;
    Flight flight(kSmall);
    const int all = cornersOf(first.see(flight));
    ASSERT_GT(all, 100);
    for (const int needed : {all, all + 1}) {
        RegistrationOptions options = withoutFeatures();
        options.homography.min_inliers = needed;
        Watch watch(options);
        Flight again(kSmall);  // the same pictures
        ASSERT_EQ(cornersOf(watch.see(again)), all);
        again.move(shift(8, 0));  // a twentieth leaves the picture
        const RegisteredFrame frame = watch.see(again);
        ASSERT_EQ(frame.registration.state, RegistrationState::failed);
        const RegistrationFailure& failure = frame.registration.failure;
        if (needed == all) {
            EXPECT_EQ(failure.fault, RegistrationFault::too_few_found_again) << describe(failure);
            EXPECT_EQ(failure.of, all);
            EXPECT_LT(failure.count, all);
            EXPECT_GT(failure.count, all / 2);
        } else {
            EXPECT_EQ(failure.fault, RegistrationFault::too_few_corners) << describe(failure);
            EXPECT_EQ(failure.count, all);
            EXPECT_EQ(failure.of, needed);
        }
    }
}

/// Five eighths of the picture stand, the rest goes 2 px to the right.
TEST(RegistrarByHand, CornersThatDoNotAgreeAreCounted) {
    const auto seen = [](double right, unsigned seed) {
        return test::TexturedGround(41, 1.5).picture(kSmall, shift(-right, 0), 2, seed);
    };
    for (const double needed : {0.95, 0.35}) {
        RegistrationOptions options = withoutFeatures();
        options.homography.min_inlier_share = needed;
        Watch watch(options);
        watch.seePicture(seen(0, 1));
        cv::Mat torn = seen(0, 2);
        const cv::Rect moving(100, 0, 60, 120);
        seen(2, 3)(moving).copyTo(torn(moving));
        const RegisteredFrame frame = watch.seePicture(torn);
        if (needed < 0.5) {
            EXPECT_EQ(frame.registration.state, RegistrationState::registered);
            continue;
        }
        ASSERT_EQ(frame.registration.state, RegistrationState::failed);
        const RegistrationFailure& failure = frame.registration.failure;
        EXPECT_EQ(failure.fault, RegistrationFault::too_few_agree) << describe(failure);
        EXPECT_EQ(failure.picture, PictureQuality::clear);
        EXPECT_GT(failure.count, failure.of / 2);
        EXPECT_LT(failure.count, 0.9 * failure.of);
        EXPECT_EQ(frame.registration.current_from_previous.matrix, cv::Matx33d::eye());
    }
}

/// Of other ground only a strip is seen, the rest is haze. The usual number is a mean that follows slowly.
TEST(RegistrarByHand, APictureIsBlurredThatHasLessThan35PercentOfTheUsualCorners) {
    const cv::Matx33d step = shift(3, 1);
    constexpr double kLimit = 0.35;
    int just_clear = 0, blurred = 0, blank = 0;
    for (const int strip : {0, 16, 32, 48, 64, 80}) {
        cv::Mat haze = test::TexturedGround(99, 0).picture(kSmall, cv::Matx33d::eye(), strip > 0 ? 2 : 0, 1);
        if (strip > 0)
            test::TexturedGround(99, 1.5)
                .picture(kSmall, cv::Matx33d::eye(), 2, 2)
                .colRange(40, 40 + strip)
                .copyTo(haze.colRange(40, 40 + strip));
        const int seen = cornersOf(Watch(withoutFeatures()).seePicture(haze));
        Watch watch(withoutFeatures());
        Flight flight(kSmall);
        double usual = cornersOf(watch.see(flight));
        for (int i = 0; i < 6; ++i) {
            flight.move(step);
            usual = 0.9 * usual + 0.1 * cornersOf(watch.see(flight));
        }
        const RegisteredFrame frame = watch.seePicture(haze);
        ASSERT_EQ(frame.registration.state, RegistrationState::failed);
        const RegistrationFailure& failure = frame.registration.failure;
        EXPECT_EQ(cornersOf(frame), seen);
        const cv::Matx33d& guess = frame.registration.current_from_previous.matrix;
        if (seen < RegistrationOptions().homography.min_inliers) {
            EXPECT_EQ(failure.picture, PictureQuality::blank) << strip;
            ++blank;
        } else if (std::abs(seen - kLimit * usual) < 0.02 * usual) {
            continue;  // a corner more or fewer decides
        } else if (seen < kLimit * usual) {
            EXPECT_EQ(failure.picture, PictureQuality::blurred) << strip;
            EXPECT_NE(failure.fault, RegistrationFault::cut);
            EXPECT_LT(gridError(guess, step, kSmall), 0.2) << "the camera goes on";
            ++blurred;
        } else {
            EXPECT_EQ(failure.picture, PictureQuality::clear) << strip;
            EXPECT_EQ(failure.fault, RegistrationFault::cut);
            EXPECT_EQ(guess, cv::Matx33d::eye());
            just_clear += seen < 0.5 * usual;
        }
    }
    EXPECT_GT(blank, 0);
    EXPECT_GT(blurred, 0);
    EXPECT_GT(just_clear, 0);
}

TEST(RegistrarByHand, CornersAreTwoFramesOlderAfterABlankOneAndWhereTheCameraWouldHaveTakenThem) {
    const cv::Matx33d step = shift(4, -2);
    Watch watch;
    Flight flight(kSmall);
    watch.see(flight);
    std::map<CornerId, Corner> before;
    for (int i = 0; i < 2; ++i) {
        flight.move(step);
        before.clear();
        for (const Corner& corner : watch.see(flight).corners) before[corner.id] = corner;
    }
    flight.move(step);
    watch.seePicture(cv::Mat(kSmall, CV_8UC1, cv::Scalar(0)));
    flight.move(step);
    const RegisteredFrame after = watch.see(flight);
    ASSERT_EQ(after.registration.state, RegistrationState::registered);
    int known = 0;
    for (const Corner& corner : after.corners) {
        const auto at = before.find(corner.id);
        if (at == before.end()) {
            EXPECT_EQ(corner.age, 0);
            EXPECT_EQ(corner.previous, corner.current);
            continue;
        }
        ++known;
        EXPECT_EQ(corner.age, at->second.age + 2);
        // One step was guessed.
        EXPECT_NEAR(corner.previous.x, at->second.current.x + 4, 0.2);
        EXPECT_NEAR(corner.previous.y, at->second.current.y - 2, 0.2);
    }
    EXPECT_GT(known, 50);
}

TEST(RegistrarByHand, TheThesisFavoursNoPlacesSearchesNoFeaturesAndForgetsAtOnce) {
    const RegistrationOptions thesis = RegistrationOptions::thesis();
    EXPECT_FALSE(thesis.corners.favour_movers);
    EXPECT_EQ(thesis.corners.max_corners, 50'000);
    EXPECT_FALSE(thesis.feature_search);
    EXPECT_EQ(thesis.recovery_frames, 0);
    Watch watch(thesis);
    Flight flight(kSmall);
    watch.see(flight);
    watch.seePicture(cv::Mat(kSmall, CV_8UC1, cv::Scalar(0)));
    EXPECT_EQ(watch.see(flight).registration.state, RegistrationState::failed) << "nothing from before the blank frame";
}

}  // namespace eyrie::registrar_by_hand_test

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "registration/flight.h"
#include "registration/search/feature_search.h"

namespace eyrie::registrar_trouble_test {
namespace {

using test::drift;
using test::expectWellFormed;
using test::Flight;
using test::kSize;
using test::Watch;

}  // namespace

TEST(RegistrarTrouble, survivesDroppedFramesAndJumps) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 5; ++i) {
        flight.move(test::cameraMotion(kSize, 4, 2, 0.3));
        watch.see(flight);
    }
    for (int i = 0; i < 12; ++i) flight.move(test::cameraMotion(kSize, 4, 2, 0.3));
    const RegisteredFrame jump = watch.see(flight);
    ASSERT_EQ(jump.registration.state, RegistrationState::registered) << describe(jump.registration.failure);
    EXPECT_LT(watch.error(jump), 0.06);
    // Nothing could predict this one.
    flight.move(test::cameraMotion(kSize, -75, 40, -6));
    const RegisteredFrame wild = watch.see(flight);
    ASSERT_EQ(wild.registration.state, RegistrationState::registered) << describe(wild.registration.failure);
    EXPECT_LT(watch.error(wild), 0.1);
}

TEST(RegistrarTrouble, findsItsWayAfterATurnByFeatures) {
    for (const double degrees : {35.0, -20.0}) {
        Watch watch;
        Flight flight;
        watch.see(flight);
        flight.move(drift());
        watch.see(flight);
        // Too far for predictions, and turned more than thumbnails are searched.
        flight.move(test::cameraMotion(kSize, 22, -15, degrees));
        const RegisteredFrame turned = watch.see(flight);
        ASSERT_EQ(turned.registration.state, RegistrationState::registered) << describe(turned.registration.failure);
        EXPECT_LT(watch.error(turned), 0.3) << degrees;
    }
}

TEST(RegistrarTrouble, followsASharpTurnNearTheGround) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 3; ++i) {
        flight.move(test::sharpTurn(kSize));
        const RegisteredFrame turned = watch.see(flight);
        ASSERT_EQ(turned.registration.state, RegistrationState::registered) << describe(turned.registration.failure);
        EXPECT_LT(watch.error(turned), 0.3);
    }
}

TEST(RegistrarTrouble, withoutFeaturesATurnIsACut) {
    RegistrationOptions options;
    options.feature_search = false;
    Watch watch(options);
    Flight flight;
    watch.see(flight);
    flight.move(drift());
    ASSERT_EQ(watch.see(flight).registration.state, RegistrationState::registered);
    flight.move(test::cameraMotion(kSize, 22, -15, 35));
    const RegisteredFrame turned = watch.see(flight);
    EXPECT_EQ(turned.registration.state, RegistrationState::failed);
    EXPECT_EQ(turned.registration.failure.fault, RegistrationFault::cut) << describe(turned.registration.failure);
}

TEST(RegistrarTrouble, featuresDoNotFindAWayBetweenDifferentPlaces) {
    const HomographyEstimator estimator({}, kSize);
    Flight here;
    Flight there;
    there.move(test::cameraMotion(kSize, 2000, 0, 0));
    ImagePyramid from;
    ImagePyramid to;
    from.build(here.picture());
    to.build(there.picture());
    EXPECT_FALSE(searchFeatures(from, to, estimator));
    const cv::Matx33d turn = test::cameraMotion(kSize, 30, 0, 40);
    here.move(turn);
    to.build(here.picture());
    const auto found = searchFeatures(from, to, estimator);
    ASSERT_TRUE(found);
    EXPECT_LT(test::gridError(found->matrix, turn, kSize), 2);
}

TEST(RegistrarTrouble, repeatedPicturesAreFrozenAndAStandingCameraIsNot) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 3; ++i) {
        flight.move(drift());
        watch.see(flight);
    }
    EXPECT_EQ(watch.see(flight).registration.state, RegistrationState::registered);  // stands, but noise is new
    flight.move(drift());
    const cv::Mat gray = flight.picture();
    const RegisteredFrame before = watch.seePicture(gray);
    for (int i = 0; i < 3; ++i) {
        const RegisteredFrame frozen = watch.seePicture(gray.clone());
        ASSERT_EQ(frozen.registration.state, RegistrationState::frozen);
        EXPECT_EQ(frozen.registration.current_from_previous.matrix, cv::Matx33d::eye());
        ASSERT_EQ(frozen.corners.size(), before.corners.size());
        EXPECT_EQ(frozen.corners[10].current, before.corners[10].current);
        EXPECT_EQ(frozen.corners[10].previous, before.corners[10].current);
        EXPECT_EQ(frozen.corners[10].age, before.corners[10].age) << "no time passes in it";
    }
    // The camera flew on meanwhile.
    for (int i = 0; i < 4; ++i) flight.move(drift());
    const RegisteredFrame after = watch.see(flight);
    EXPECT_EQ(after.registration.state, RegistrationState::registered) << describe(after.registration.failure);
}

/// 60 pictures a second of which every other repeats the one before, as many programs make them.
TEST(RegistrarTrouble, vehiclesAreFollowedWhereEveryPictureIsShownTwice) {
    Watch watch;
    Flight flight;
    int followed = 0;
    for (int i = 0; i < 20; ++i) {
        cv::Mat picture = flight.picture();
        const cv::Rect car(40 + 5 * i, 100, 24, 12);
        cv::rectangle(picture, car, cv::Scalar(235), -1);
        cv::rectangle(picture, cv::Rect(car.tl() + cv::Point(7, 2), cv::Size(7, 8)), cv::Scalar(60), -1);
        const RegisteredFrame shown = watch.seePicture(picture);
        EXPECT_EQ(watch.seePicture(picture.clone()).registration.state, RegistrationState::frozen);
        if (i < 10) continue;
        for (const Corner& corner : shown.corners)
            followed += corner.age >= 3 && car.contains(cv::Point(corner.current));
        flight.move(drift());
    }
    EXPECT_GE(followed, 30) << "three corners or more in each of the last ten";
}

TEST(RegistrarTrouble, blankFrameIsMarkedAndBridged) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 4; ++i) {
        flight.move(drift());
        watch.see(flight);
    }
    flight.move(drift());
    const RegisteredFrame blank = watch.seePicture(cv::Mat(kSize, CV_8UC1, cv::Scalar(0)));
    EXPECT_EQ(blank.registration.state, RegistrationState::failed);
    EXPECT_EQ(blank.registration.failure.picture, PictureQuality::blank) << describe(blank.registration.failure);
    EXPECT_TRUE(blank.corners.empty());
    const cv::Matx33d guess = blank.registration.current_from_previous.matrix;
    EXPECT_LT(test::gridError(guess, drift(), kSize), 0.1);  // the camera is assumed to go on
    flight.move(drift());
    const RegisteredFrame after = watch.see(flight);
    ASSERT_EQ(after.registration.state, RegistrationState::registered) << describe(after.registration.failure);
    // Over both frames the product is the truth, though the first half was a guess.
    EXPECT_LT(test::gridError(after.registration.current_from_previous.matrix * guess, drift() * drift(), kSize), 0.03);
    const auto old =
        std::count_if(after.corners.begin(), after.corners.end(), [](const Corner& c) { return c.age >= 5; });
    EXPECT_GT(old, 300);
    expectWellFormed(after, kSize);
}

TEST(RegistrarTrouble, blurredFrameIsBridged) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 4; ++i) {
        flight.move(drift());
        watch.see(flight);
    }
    flight.move(drift());
    cv::Mat blurred;
    cv::GaussianBlur(flight.picture(), blurred, {}, 9);
    const RegisteredFrame blur = watch.seePicture(blurred);
    EXPECT_EQ(blur.registration.state, RegistrationState::failed);
    flight.move(drift());
    const RegisteredFrame after = watch.see(flight);
    EXPECT_EQ(after.registration.state, RegistrationState::registered) << describe(after.registration.failure);
}

TEST(RegistrarTrouble, cutIsMarkedAndStartsAnew) {
    Watch watch;
    Flight flight;
    std::set<CornerId> used;
    watch.see(flight);
    for (int i = 0; i < 4; ++i) {
        flight.move(drift());
        for (const Corner& corner : watch.see(flight).corners) used.insert(corner.id);
    }
    const test::TexturedGround elsewhere(99);
    const auto seen = [&](int i) {
        return elsewhere.picture(kSize, test::cameraMotion(kSize, -1.1 * i, 0.4 * i, 0), 2, unsigned(i + 1));
    };
    const RegisteredFrame cut = watch.seePicture(seen(0));
    EXPECT_EQ(cut.registration.state, RegistrationState::failed);
    EXPECT_EQ(cut.registration.failure.fault, RegistrationFault::cut) << describe(cut.registration.failure);
    EXPECT_EQ(cut.registration.current_from_previous.matrix, cv::Matx33d::eye());
    EXPECT_GT(cut.corners.size(), 500U);
    for (const Corner& corner : cut.corners) {
        EXPECT_EQ(used.count(corner.id), 0U);
        EXPECT_EQ(corner.age, 0);
    }
    for (int i = 1; i < 4; ++i) {
        const RegisteredFrame after = watch.seePicture(seen(i));
        ASSERT_EQ(after.registration.state, RegistrationState::registered) << describe(after.registration.failure);
        EXPECT_LT(test::gridError(after.registration.current_from_previous.matrix,
                                  test::cameraMotion(kSize, 1.1, -0.4, 0), kSize),
                  0.04);
        for (const Corner& corner : after.corners) EXPECT_EQ(used.count(corner.id), 0U);
    }
}

TEST(RegistrarTrouble, oneSpoiledFrameDoesNotEndTheTracks) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    for (int i = 0; i < 4; ++i) {
        flight.move(drift());
        watch.see(flight);
    }
    flight.move(drift());
    const cv::Mat rubbish = test::TexturedGround(123).picture(kSize, cv::Matx33d::eye(), 20, 1);
    EXPECT_EQ(watch.seePicture(rubbish).registration.state, RegistrationState::failed);
    flight.move(drift());
    const RegisteredFrame after = watch.see(flight);
    ASSERT_EQ(after.registration.state, RegistrationState::registered) << describe(after.registration.failure);
    EXPECT_GT(std::count_if(after.corners.begin(), after.corners.end(), [](const Corner& c) { return c.age >= 5; }),
              300);
}

TEST(RegistrarTrouble, longBlankStretchEndsInAFreshStart) {
    Watch watch;
    Flight flight;
    watch.see(flight);
    flight.move(drift());
    watch.see(flight);
    for (int i = 0; i < 20; ++i) {
        EXPECT_NE(watch.seePicture(cv::Mat(kSize, CV_8UC1, cv::Scalar(i % 2))).registration.state,
                  RegistrationState::registered);
    }
    EXPECT_EQ(watch.see(flight).registration.state, RegistrationState::failed);  // nothing left to compare with
    flight.move(drift());
    EXPECT_EQ(watch.see(flight).registration.state, RegistrationState::registered);
}

}  // namespace eyrie::registrar_trouble_test

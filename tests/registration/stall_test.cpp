// A picture that stands, or is missing: whether the world went on meanwhile, as the camera or what moves by itself
// tells.
#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "registration/clock_follower.h"
#include "registration/flight.h"
#include "registration/registrar.h"

namespace eyrie::stall_test {
namespace {

constexpr int kBefore = 24;  ///< frames before the picture stands

/// A textured vehicle that drives to the right over what a camera sees.
cv::Mat withCar(const cv::Mat& picture, double driven) {
    cv::Mat body(14, 30, CV_8UC1);
    cv::RNG random(3);
    random.fill(body, cv::RNG::UNIFORM, 40, 250);
    cv::GaussianBlur(body, body, {}, 0.8);
    cv::Mat result = picture.clone();
    cv::warpAffine(body, result, cv::Matx23d(1, 0, 40 + driven, 0, 1, 110), picture.size(), cv::INTER_LINEAR,
                   cv::BORDER_TRANSPARENT);
    return result;
}

/// How a picture stands for `standing` frames, and what the next frame says.
struct Stall {
    cv::Matx33d camera = cv::Matx33d::eye();  ///< each frame
    double speed = 0;                         ///< of a car, px/frame; 0: none
    int standing = 1;
    bool goes_on = true;
    bool repeated = true;  ///< the picture that stands is shown; else it is missing
    bool hidden = false;   ///< the car, in the next frame
    bool told = false;     ///< the clock goes on while a picture is missing

    RegisteredFrame after() const {
        test::Flight flight;
        Registrar registrar({}, test::scaleOf(0.3));
        double driven = 0;
        int frame = 0;
        const auto show = [&] { return speed > 0 ? withCar(flight.picture(), driven) : flight.picture(); };
        const auto move = [&] {
            flight.move(camera);
            driven += speed;
        };
        cv::Mat shown;
        for (; frame < kBefore; ++frame) {
            shown = show();
            registrar.next(test::frameOf(frame, shown));
            move();
        }
        for (int i = 0; i < standing; ++i, ++frame) {
            if (goes_on) move();
            if (!repeated) continue;
            const RegisteredFrame same = registrar.next(test::frameOf(frame, shown));
            EXPECT_EQ(same.registration.state, RegistrationState::frozen);
            EXPECT_EQ(same.registration.framesPassed(), 0);
        }
        Frame next = test::frameOf(frame, hidden ? flight.picture() : show());
        if (!repeated) next.index -= standing;
        if (!told) next.time_us = test::frameOf(next.index, {}).time_us;
        return registrar.next(next);
    }
};

Registration registered(int frame, int elapsed) {
    Registration registration;
    registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
    registration.elapsed = elapsed;
    return registration;
}

Registration frozen() {
    Registration registration;
    registration.state = RegistrationState::frozen;
    return registration;
}

int passed(const Stall& stall) {
    const RegisteredFrame frame = stall.after();
    EXPECT_EQ(frame.registration.state, RegistrationState::registered);
    return frame.registration.framesPassed();
}

}  // namespace

TEST(Stall, OfACameraThatFliesIsToldByItsWay) {
    const cv::Matx33d flying = test::cameraMotion(test::kSize, 2.5, -1.2, 0.1);
    for (const int standing : {3, 6, 11}) {
        SCOPED_TRACE(standing);
        EXPECT_EQ(passed({flying, 0, standing, true}), standing + 1);
        EXPECT_EQ(passed({flying, 0, standing, false}), 1);
    }
}

TEST(Stall, UnderACameraAtRestIsToldByWhatDrives) {
    for (const int standing : {1, 2, 6}) {
        SCOPED_TRACE(standing);
        EXPECT_EQ(passed({cv::Matx33d::eye(), 4, standing, true}), standing + 1);
        EXPECT_EQ(passed({cv::Matx33d::eye(), 4, standing, false}), 1);
    }
}

TEST(Stall, OfWhichNothingTellsMeansLostPicturesWhenItIsLong) {
    EXPECT_EQ(passed({cv::Matx33d::eye(), 0, 8, true}), 9);
    EXPECT_EQ(passed({cv::Matx33d::eye(), 0, 1, true}), 1) << "single pictures are repeated to fill up a rate";
}

TEST(MissingPictures, AreToldByWhatDrives) {
    const cv::Matx33d flying = test::cameraMotion(test::kSize, 2.5, -1.2, 0.1);
    for (const int missing : {0, 1, 2, 3}) {
        SCOPED_TRACE(missing);
        EXPECT_EQ(passed({cv::Matx33d::eye(), 4, missing, true, false}), missing + 1);
        EXPECT_EQ(passed({flying, 8, missing, true, false}), missing + 1);
    }
}

TEST(MissingPictures, AreNotSupposedWhereAVehicleIsHidden) {
    EXPECT_EQ(passed({cv::Matx33d::eye(), 4, 0, true, false, true}), 1);
}

TEST(MissingPictures, AreToldByTheClockWhereNothingElseTells) {
    const auto missed = [](int missing, bool told) {
        return passed({.standing = missing, .goes_on = true, .repeated = false, .told = told});
    };
    for (const int missing : {1, 2, 7, 20}) {
        SCOPED_TRACE(missing);
        EXPECT_EQ(missed(missing, true), missing + 1);
        EXPECT_EQ(missed(missing, false), 1);
    }
}

TEST(MissingPictures, ToldByTheClockAreBelievedOnlyWhereTheWorldWentOn) {
    const cv::Matx33d flying = test::cameraMotion(test::kSize, 2.5, -1.2, 0.1);
    for (const bool goes_on : {true, false}) {
        SCOPED_TRACE(goes_on);
        Stall flight{.camera = flying, .standing = 9, .goes_on = goes_on, .repeated = false, .told = true};
        EXPECT_EQ(passed(flight), goes_on ? 10 : 1);
        Stall hovering{.speed = 4, .standing = 9, .goes_on = goes_on, .repeated = false, .told = true};
        EXPECT_EQ(passed(hovering), goes_on ? 10 : 1);
    }
}

TEST(MissingPictures, AreNotToldByAClockThatTicksInBursts) {
    test::Flight hovering;
    Registrar registrar({}, test::scaleOf(0.3));
    for (int i = 0; i < 40; ++i) {
        Frame frame = test::frameOf(i, hovering.picture());
        // Pictures arrive in pairs, or four at once.
        frame.time_us = i < 20 ? (i + i % 2) * 40'000 - i % 2 * 1000 : (i + 3) / 4 * 160'000 + i % 4;
        const int passed = registrar.next(frame).registration.framesPassed();
        if (i == 21) continue;  // the first of four at once, which nobody foresees
        EXPECT_LE(passed, 1) << i;
    }
}

TEST(Stall, LosesNoCornerOfWhatDroveOn) {
    const RegisteredFrame frame = Stall{cv::Matx33d::eye(), 4, 6, true}.after();
    const double driven = 4 * (kBefore + 6);
    const auto followed = std::count_if(frame.corners.begin(), frame.corners.end(), [&](const Corner& corner) {
        const bool on_car = std::abs(corner.current.x - (40 + driven + 15)) < 16;
        return on_car && corner.age > 0 && std::abs(corner.current.x - corner.previous.x - 28) < 0.5F;
    });
    EXPECT_GE(followed, 5);
}

TEST(ClockFollower, TellsFramesThatAreMissing) {
    ClockFollower clock(25);
    for (int frame = 0; frame < 5; ++frame) clock.next(frame * 40'000, registered(frame, 1), 0);
    EXPECT_EQ(clock.mostPassed(160'000, 200'000), 1);
    EXPECT_EQ(clock.mostPassed(160'000, 320'000), 4);
    clock.next(320'000, registered(5, 4), 0);
    EXPECT_EQ(clock.mostPassed(320'000, 360'000), 1) << "what was made good is no wait any more";
}

TEST(ClockFollower, TakesAWaitAfterABurstForNone) {
    ClockFollower clock(25);
    for (int frame = 0; frame < 4; ++frame) clock.next(frame * 1'000, registered(frame, 1), 0);
    EXPECT_EQ(clock.mostPassed(3'000, 160'000), 1) << "four pictures came at once, and the fifth when it should";
    clock.next(4'000, registered(0, 1), 0);
    EXPECT_EQ(clock.mostPassed(4'000, 164'000), 4) << "a video that begins anew is not ahead";
}

TEST(ClockFollower, CountsPicturesThatStoodStillOnce) {
    ClockFollower clock(25);
    clock.next(0, registered(0, 1), 0);
    for (int frame = 1; frame < 4; ++frame) clock.next(frame * 40'000, frozen(), frame - 1);
    clock.next(160'000, registered(4, 4), 3);
    EXPECT_EQ(clock.mostPassed(160'000, 320'000), 4) << "four frames in four frames' time are not ahead";
}

}  // namespace eyrie::stall_test

#include "evaluation/measures/registration_error.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"

namespace eyrie::registration_error_test {
namespace {

const cv::Size kImage(320, 240);

cv::Matx33d turned(double radians, double x, double y) {
    const double c = std::cos(radians);
    const double s = std::sin(radians);
    return {c, -s, x, s, c, y, 0, 0, 1};
}

Registration estimated(FrameIndex frame, const cv::Matx33d& current_from_previous,
                       RegistrationState state = RegistrationState::registered) {
    Registration registration;
    registration.state = state;
    registration.current_from_previous.matrix = current_from_previous;
    registration.current_from_previous.from_frame = frame - 1;
    registration.current_from_previous.to_frame = frame;
    return registration;
}

TEST(RegistrationError, ExactEstimatesHaveNone) {
    TrueHomographies first_from_frame;
    std::vector<Registration> registrations;
    for (int frame = 0; frame < 5; ++frame) {
        first_from_frame[frame] = turned(0.01 * frame, 2.0 * frame, -frame);
        if (frame > 0) {
            registrations.push_back(estimated(frame, first_from_frame[frame].inv() * first_from_frame[frame - 1]));
        }
    }
    const RegistrationError error = registrationError(registrations, first_from_frame, kImage);
    EXPECT_EQ(error.frames.size(), 4u);
    EXPECT_LT(error.max_px, 1e-9);
}

TEST(RegistrationError, AShiftIsMeasuredInPixels) {
    const TrueHomographies truth{{0, cv::Matx33d::eye()}, {1, cv::Matx33d::eye()}, {2, cv::Matx33d::eye()}};
    const RegistrationError error =
        registrationError({estimated(1, turned(0, 0.3, 0.4)), estimated(2, cv::Matx33d::eye())}, truth, kImage);
    EXPECT_NEAR(error.mean_px, 0.25, 1e-12);
    EXPECT_NEAR(error.rms_px, 0.5 / std::sqrt(2.0), 1e-12);
    EXPECT_NEAR(error.max_px, 0.5, 1e-12);
    EXPECT_EQ(error.frames[0].frame, 1);
}

TEST(RegistrationError, ATurnIsWorstInTheCorners) {
    Homography estimate;
    estimate.matrix = turned(0.001, 0, 0);  // about pixel (0, 0): the far corner moves by its distance times 0.001
    const FrameRegistrationError error = gridError(estimate, cv::Matx33d::eye(), kImage);
    EXPECT_NEAR(error.max_px, std::hypot(319, 239) * 0.001, 1e-6);
}

TEST(RegistrationError, IsMeasuredOnAGridOverTheWholeImage) {
    // The error grows with the column alone: 0.1 · x / 319 on three columns is 0, 0.05 and 0.1.
    Homography stretched;
    stretched.matrix = cv::Matx33d(1 + 0.1 / 319, 0, 0, 0, 1, 0, 0, 0, 1);
    const FrameRegistrationError by_column = gridError(stretched, cv::Matx33d::eye(), kImage, 3, 2);
    EXPECT_NEAR(by_column.mean_px, 0.05, 1e-12);
    EXPECT_NEAR(by_column.rms_px, std::sqrt((0.05 * 0.05 + 0.1 * 0.1) / 3), 1e-12);
    EXPECT_NEAR(by_column.max_px, 0.1, 1e-12);
    Homography raised;
    raised.matrix = cv::Matx33d(1, 0, 0, 0, 1 + 0.1 / 239, 0, 0, 0, 1);
    const FrameRegistrationError by_row = gridError(raised, cv::Matx33d::eye(), kImage, 2, 3);
    EXPECT_NEAR(by_row.mean_px, 0.05, 1e-12);
    EXPECT_NEAR(by_row.max_px, 0.1, 1e-12);
    EXPECT_NEAR(gridError(stretched, cv::Matx33d::eye(), kImage, 2, 1).max_px, 0.1, 1e-12);
    EXPECT_NEAR(gridError(raised, cv::Matx33d::eye(), kImage, 1, 2).max_px, 0.1, 1e-12);
    EXPECT_EQ(gridError(raised, cv::Matx33d::eye(), kImage, 1, 1).max_px, 0) << "one point is the first";
}

TEST(RegistrationError, FailedFramesAreCountedNotMeasured) {
    const TrueHomographies truth{{0, cv::Matx33d::eye()}, {1, cv::Matx33d::eye()}};
    const RegistrationError error = registrationError({estimated(0, turned(0, 9, 9), RegistrationState::first),
                                                       estimated(1, turned(0, 9, 9), RegistrationState::failed),
                                                       estimated(2, turned(0, 9, 9))},  // the truth ends before
                                                      truth, kImage);
    EXPECT_TRUE(error.frames.empty());
    EXPECT_EQ(error.unregistered, 1);
    EXPECT_EQ(error.mean_px, 0);
}

TEST(RegistrationError, ASingularTruthIsRefused) {
    const TrueHomographies truth{{0, cv::Matx33d::eye()}, {1, cv::Matx33d::zeros()}};
    EXPECT_THROW(registrationError({estimated(1, cv::Matx33d::eye())}, truth, kImage), Error);
}

}  // namespace
}  // namespace eyrie::registration_error_test

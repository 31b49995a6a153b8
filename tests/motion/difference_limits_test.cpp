#include <gtest/gtest.h>

#include "motion/differences/difference_motion.h"

namespace eyrie::difference_limits_test {
namespace {

/// A square of this side that leaps from picture to picture over plain ground, so much brighter than that.
struct LeapingSquare {
    int side;
    int brighter;
    int uneven = 0;  ///< every other column is so much brighter still, the others less
};

/// Pixels that the difference of two pictures says to move, all that moved being in view twice; one parameter set by
/// its name.
int movingWith(const std::string& name, const std::string& value, const std::vector<LeapingSquare>& squares,
               MotionMethod method = MotionMethod::two_frame_difference) {
    DifferenceOptions options;
    options.method = method;
    options.ghost_gradient = 255;
    options.gap = 1;
    options.blur = 0;
    options.min_contrast = 10;
    options.opening_m = options.closing_m = 0;
    options.min_area_px = 1;
    options.min_area_m2 = 0;
    setParameter(describeOf(options), name, value);
    DifferenceMotion difference(options, {0.2, 25, true});
    DifferenceResult result;
    for (int i = 0; i < 3; ++i) {
        Frame frame;
        frame.index = i;
        frame.gray = cv::Mat(100, 200, CV_8UC1, cv::Scalar(100));
        for (std::size_t k = 0; k < squares.size(); ++k) {
            const cv::Rect place(10 + 60 * i, 10 + 40 * static_cast<int>(k), squares[k].side, squares[k].side);
            for (int x = place.x; x < place.br().x; ++x) {
                const int uneven = x % 2 == 0 ? squares[k].uneven : -squares[k].uneven;
                frame.gray(cv::Rect(x, place.y, 1, place.height)).setTo(100 + squares[k].brighter + uneven);
            }
        }
        FrameMotion motion;
        motion.frame = i;
        motion.image_size = frame.gray.size();
        motion.registration.state = i == 0 ? RegistrationState::first : RegistrationState::registered;
        motion.registration.current_from_previous.from_frame = std::max(0, i - 1);
        motion.registration.current_from_previous.to_frame = i;
        result = difference.next(frame, motion);
    }
    return cv::countNonZero(result.moving);
}

}  // namespace

TEST(DifferenceLimits, BlurTakesAwaySpecks) {
    EXPECT_EQ(movingWith("difference.blur", "0", {{1, 60}}), 2) << "where it was and where it is";
    EXPECT_EQ(movingWith("difference.blur", "2", {{1, 60}}), 0) << "60 / (2π · 4) is less than 10";
}

TEST(DifferenceLimits, WhatAVehicleHasLeftIsEvenerThanAVehicle) {
    const auto left = [](const std::string& deviation) {
        return movingWith("difference.ghost_deviation", deviation, {{8, 50, 10}}, MotionMethod::difference_ghosts);
    };
    EXPECT_EQ(left("0"), 2 * 64) << "where it was and where it is";
    EXPECT_EQ(left("9.9"), 64);
    EXPECT_EQ(left("10.1"), 0) << "as even as the vehicle itself";
}

TEST(DifferenceLimits, StrongLimitIsUpToWhichOtsusThresholdIsFollowed) {
    // Otsu's threshold lies between 40 and 120; the lowest difference is 10.
    const std::vector<LeapingSquare> squares = {{8, 25}, {8, 40}, {8, 120}};
    EXPECT_EQ(movingWith("difference.strong_limit", "2.4", squares), 6 * 64);
    EXPECT_EQ(movingWith("difference.strong_limit", "2.6", squares), 4 * 64);
    EXPECT_EQ(movingWith("difference.strong_limit", "3.9", squares), 4 * 64);
}

}  // namespace eyrie::difference_limits_test

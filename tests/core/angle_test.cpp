#include "core/geometry/angle.h"

#include <gtest/gtest.h>

namespace eyrie::angle_test {

TEST(Angle, wrapsIntoHalfOpenInterval) {
    EXPECT_DOUBLE_EQ(wrapPi(kPi), kPi);
    EXPECT_DOUBLE_EQ(wrapPi(-kPi), kPi);
    EXPECT_NEAR(wrapPi(7 * kPi / 2), -kPi / 2, 1e-12);
}

TEST(Angle, turnsTheShortWayRound) {
    EXPECT_NEAR(turnBetween(radiansFromDegrees(350), radiansFromDegrees(10)), radiansFromDegrees(20), 1e-12);
    EXPECT_NEAR(axisTurnBetween(radiansFromDegrees(10), radiansFromDegrees(185)), radiansFromDegrees(-5), 1e-12);
}

TEST(Angle, degreesStayBelow360) {
    EXPECT_DOUBLE_EQ(degreesFromRadians(-1e-18), 0.0);
    EXPECT_NEAR(degreesFromRadians(-kPi / 2), 270.0, 1e-9);
}

}  // namespace eyrie::angle_test

#include "core/values/scene_scale.h"

#include <gmock/gmock.h>

#include <cmath>

namespace eyrie::scene_scale_test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(GroundSamplingDistance, IsRefusedWhereNoPixelCanBeMeant) {
    for (const double good : {0.001, 0.02, 0.3, 1.0, 2.25, 10.0}) EXPECT_EQ(whyNotAGsd(good), "") << good;
    for (const double bad : {0.0, -0.3, 0.0009, 10.1, 1e9, std::nan(""), HUGE_VAL, -HUGE_VAL})
        EXPECT_THAT(whyNotAGsd(bad), HasSubstr("metres on the ground per pixel, from 0.001 to 10")) << bad;
}

TEST(GroundSamplingDistance, InCentimetresIsToldInMetres) {
    EXPECT_THAT(whyNotAGsd(80), HasSubstr("if 80 is in cm, give 0.8"));
    EXPECT_THAT(doubtOfGsd(8), HasSubstr("if 8 is in cm, give 0.08"));
    EXPECT_THAT(whyNotAGsd(1e6), Not(HasSubstr("cm"))) << "which makes no sense of it";
    EXPECT_THAT(whyNotAGsd(-80), Not(HasSubstr("cm")));
}

TEST(GroundSamplingDistance, IsDoubtedWhereACarIsTooShortOrTooLongToBeFound) {
    for (const double good : {0.0046, 0.08, 0.345, 1.0, 2.25}) EXPECT_EQ(doubtOfGsd(good), "") << good;
    EXPECT_THAT(doubtOfGsd(2.5), HasSubstr("at 2.5 m/px a car is 1.8 px long, too short to be found"));
    EXPECT_THAT(doubtOfGsd(0.0044), HasSubstr("px long, too long to be found"));
    EXPECT_EQ(doubtOfGsd(80), "") << "it is refused";
}

}  // namespace
}  // namespace eyrie::scene_scale_test

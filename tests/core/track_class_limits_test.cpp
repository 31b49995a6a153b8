#include <gtest/gtest.h>

#include "core/labels/track_class.h"
#include "core/parameter.h"

namespace eyrie::track_class_limits_test {
namespace {

const SceneScale kScale{0.1, 25, true};

/// What a track of that size (m) and speed (m/s) is called with one limit set by its name.
TrackClass classWith(const char* name, const char* value, double length, double width, double speed) {
    TrackClassOptions options;
    setParameter(describeOf(options), name, value);
    constexpr int kTwoSeconds = 50;
    return classOf({kTwoSeconds, kScale.px(length), kScale.px(width), kScale.pxPerFrame(speed)}, kScale, options);
}

}  // namespace

TEST(TrackClassLimits, DecideOnEitherSideOfThem) {
    EXPECT_EQ(classWith("classes.person_size", "1.2", 1.1, 0.8, 1), TrackClass::person);
    EXPECT_EQ(classWith("classes.person_size", "1.0", 1.1, 0.8, 1), TrackClass::two_wheeler);
    EXPECT_EQ(classWith("classes.person_size", "1.0", 0.8, 1.1, 1), TrackClass::two_wheeler) << "wide counts as well";
    EXPECT_EQ(classWith("classes.person_speed", "3.5", 0.8, 0.8, 3), TrackClass::person);
    EXPECT_EQ(classWith("classes.person_speed", "2.5", 0.8, 0.8, 3), TrackClass::unknown);
    EXPECT_EQ(classWith("classes.two_wheeler_length", "2.5", 2.2, 0.8, 8), TrackClass::two_wheeler);
    EXPECT_EQ(classWith("classes.two_wheeler_length", "2.1", 2.2, 0.8, 8), TrackClass::vehicle);
    EXPECT_EQ(classWith("classes.two_wheeler_width", "1.3", 2.2, 1.25, 8), TrackClass::two_wheeler);
    EXPECT_EQ(classWith("classes.two_wheeler_width", "1.2", 2.2, 1.25, 8), TrackClass::vehicle);
    EXPECT_EQ(classWith("classes.min_life", "1.9", 2.2, 0.8, 8), TrackClass::two_wheeler);
    EXPECT_EQ(classWith("classes.min_life", "2.1", 2.2, 0.8, 8), TrackClass::unknown);
}

}  // namespace eyrie::track_class_limits_test

#include "core/measure_text.h"

#include <gtest/gtest.h>

namespace eyrie::measure_text_test {
namespace {

TEST(MeasureText, NumbersArePlain) {
    EXPECT_EQ(numberText(0.1234), "0.123");
    EXPECT_EQ(numberText(12345.6), "12346");
    EXPECT_EQ(numberText(2), "2");
    EXPECT_EQ(numberText(1000), "1000");
    EXPECT_EQ(numberText(999.6), "1000");
    EXPECT_EQ(numberText(999.4), "999");
    EXPECT_EQ(numberText(-12345.6), "-12346");
    EXPECT_EQ(countText(1, "corner", "corners"), "1 corner");
    EXPECT_EQ(countText(3, "corner", "corners"), "3 corners");
}

TEST(MeasureText, LengthsAreInMetresWhereTheScaleIsKnown) {
    EXPECT_EQ(pxText(12, {0.25, 25, true}), "12 px (3 m)");
    EXPECT_EQ(pxText(12, {0.25, 25, false}), "12 px");
}

}  // namespace
}  // namespace eyrie::measure_text_test

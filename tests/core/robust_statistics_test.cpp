#include <gtest/gtest.h>

#include "core/robust_statistics.h"

namespace eyrie::robust_statistics_test {

TEST(RobustStatistics, AQuantileIsTheSmallestValueThatSoManyDoNotExceed) {
    EXPECT_EQ(quantileOf({4, 1, 3, 2}, 0.75), 3);
    EXPECT_EQ(quantileOf({4, 1, 3, 2}, 0.76), 4);
    EXPECT_EQ(quantileOf({5, 4, 1, 3, 2}, 0.75), 4);
    EXPECT_EQ(quantileOf({3, 1, 2}, 0.75), 3);
    EXPECT_EQ(quantileOf({3, 1, 2}, 0), 1);
    EXPECT_EQ(quantileOf({3, 1, 2}, 1), 3);
    EXPECT_EQ(quantileOf({7}, 0.75), 7);
}

TEST(RobustStatistics, TheMiddleOfAnEvenNumberIsTheUpperOne) {
    EXPECT_EQ(medianOf({9, 1, 5}), 5);
    EXPECT_EQ(medianOf({9, 1, 5, 6}), 6);
}

TEST(RobustStatistics, ASpreadIsThatOfTheMiddleHalfWhateverLiesFarOff) {
    EXPECT_NEAR(spreadOf({1, 2, 3, 4, 1000}), 1.48, 1e-12);
}

}  // namespace eyrie::robust_statistics_test

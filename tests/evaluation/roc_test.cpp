#include "evaluation/measures/roc.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/error.h"

namespace eyrie::roc_test {
namespace {

TEST(Roc, HandWorked) {
    // Positives 0.9, 0.6, 0.4; negatives 0.7, 0.1: of six pairs four are in order.
    const RocCurve curve = rocCurve({{0.4, true}, {0.9, true}, {0.7, false}, {0.1, false}, {0.6, true}});
    EXPECT_NEAR(curve.area, 4.0 / 6, 1e-12);
    ASSERT_EQ(curve.points.size(), 6u);
    EXPECT_EQ(curve.points[1].threshold, 0.9);
    EXPECT_NEAR(curve.points[1].true_positive_rate, 1.0 / 3, 1e-12);
    EXPECT_EQ(curve.points[1].false_positive_rate, 0);
    EXPECT_EQ(curve.points.back().true_positive_rate, 1);
    EXPECT_EQ(curve.points.back().false_positive_rate, 1);
}

TEST(Roc, AreaIsTheChanceOfTheRightOrder) {
    std::mt19937 random(3);
    std::vector<ScoredSample> samples;
    for (int k = 0; k < 200; ++k) {
        const bool positive = k % 3 == 0;
        samples.push_back({static_cast<double>(random() % 12) + (positive ? 3 : 0), positive});
    }
    double in_order = 0;
    double pairs = 0;
    for (const auto& p : samples) {
        for (const auto& n : samples) {
            if (!p.positive || n.positive) continue;
            pairs += 1;
            in_order += p.score > n.score ? 1 : p.score == n.score ? 0.5 : 0;
        }
    }
    EXPECT_NEAR(rocCurve(samples).area, in_order / pairs, 1e-12);
}

TEST(Roc, EqualScoresAreOnePoint) {
    const RocCurve curve = rocCurve({{0.9, true}, {0.1, true}, {0.1, false}});
    EXPECT_EQ(curve.points.size(), 3u);
    EXPECT_NEAR(curve.area, 0.75, 1e-12) << "one pair in order, one equal";
}

TEST(Roc, TurnedScoresMirrorTheArea) {
    const RocCurve curve = rocCurve({{1, true}, {2, false}, {3, true}, {4, false}});
    const RocCurve turned = rocCurve({{-1, true}, {-2, false}, {-3, true}, {-4, false}});
    EXPECT_NEAR(curve.area + turned.area, 1, 1e-12);
}

TEST(Roc, NeedsBothKinds) {
    EXPECT_THROW(rocCurve({}), Error);
    EXPECT_THROW(rocCurve({{1, true}, {2, true}}), Error);
    EXPECT_THROW(rocCurve({{1, true}, {std::nan(""), false}}), Error);
}

}  // namespace
}  // namespace eyrie::roc_test

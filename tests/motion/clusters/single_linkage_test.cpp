#include "motion/clusters/single_linkage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <random>

namespace eyrie::single_linkage_test {
namespace {

MotionVector vector(float x, float y, float vx, float vy) {
    return {0, {x, y}, {vx, vy}, 9};
}

/// Grows clusters by asking every pair, until nothing changes.
std::vector<int> slowLinkage(const std::vector<MotionVector>& vectors, const Linkage& linkage) {
    std::vector<int> label(vectors.size());
    std::iota(label.begin(), label.end(), 0);
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < vectors.size(); ++i) {
            for (std::size_t j = 0; j < vectors.size(); ++j) {
                if (label[j] <= label[i] || !linkage.joins(vectors[i], vectors[j])) continue;
                label[j] = label[i];
                changed = true;
            }
        }
    }
    int count = 0;
    std::vector<int> renamed(vectors.size(), -1);
    std::vector<int> result;
    for (const int l : label) {
        if (renamed[static_cast<std::size_t>(l)] < 0) renamed[static_cast<std::size_t>(l)] = count++;
        result.push_back(renamed[static_cast<std::size_t>(l)]);
    }
    return result;
}

TEST(SingleLinkage, EqualsTheNaiveVersion) {
    for (unsigned seed = 1; seed <= 12; ++seed) {
        std::mt19937 random(seed);
        std::uniform_real_distribution<float> x(-20, 300);
        std::normal_distribution<float> jitter(0, 6);
        std::normal_distribution<float> speed(0, 0.06F);
        std::vector<MotionVector> vectors;
        for (int k = 0; k < 12; ++k) {
            const float cx = x(random);
            const float cy = x(random);
            const float vx = speed(random) * 30;
            const float vy = speed(random) * 30;
            for (int i = 0; i < 20; ++i)
                vectors.push_back(
                    vector(cx + jitter(random), cy + jitter(random), vx + speed(random), vy + speed(random)));
        }
        for (int i = 0; i < 60; ++i) vectors.push_back(vector(x(random), x(random), speed(random), speed(random)));
        std::shuffle(vectors.begin(), vectors.end(), random);
        const Linkage linkage{8.0 + seed, 4.0, 0.04, 0.05};
        EXPECT_EQ(singleLinkage(vectors, linkage), slowLinkage(vectors, linkage)) << "seed " << seed;
    }
}

TEST(SingleLinkage, ConditionIsSymmetricAndTurnsWithTheScene) {
    std::mt19937 random(4);
    std::uniform_real_distribution<float> x(-8, 8);
    std::uniform_real_distribution<float> v(0.8F, 1.2F);
    const Linkage linkage{9, 4, 0.03, 0.08};
    int joined = 0;
    for (int i = 0; i < 2000; ++i) {
        const MotionVector a = vector(x(random), x(random), v(random), 0.02F);
        const MotionVector b = vector(x(random), x(random), v(random), 0.0F);
        EXPECT_EQ(linkage.joins(a, b), linkage.joins(b, a));
        const auto turned = [](const MotionVector& m) {
            return vector(-m.position.y, m.position.x, -m.velocity.y, m.velocity.x);
        };
        EXPECT_EQ(linkage.joins(a, b), linkage.joins(turned(a), turned(b)));
        joined += linkage.joins(a, b);
    }
    EXPECT_GT(joined, 20);
    EXPECT_LT(joined, 1980);
}

TEST(SingleLinkage, ReachesFartherAlongTheMotion) {
    const Linkage linkage{10, 4, 0.03, 0.05};
    EXPECT_TRUE(linkage.joins(vector(0, 0, 1, 0), vector(9.9F, 0, 1, 0)));
    EXPECT_FALSE(linkage.joins(vector(0, 0, 0, 1), vector(9.9F, 0, 0, 1)));
    EXPECT_TRUE(linkage.joins(vector(0, 0, 0, 1), vector(3.9F, 0, 0, 1)));
    EXPECT_FALSE(linkage.joins(vector(0, 0, 1, 0), vector(8, 3, 1, 0)));  // 0.64 + 0.5625 > 1
}

TEST(SingleLinkage, TheEllipseTurnsWithTheMotion) {
    const Linkage linkage{10, 4, 0.03, 0.05};
    for (const double heading : {0.5, 0.785, 2.2, -0.9, -2.7}) {
        const auto joins = [&](double ahead, double aside) {
            const double c = std::cos(heading), s = std::sin(heading);
            return linkage.joins(
                vector(5, 7, float(2 * c), float(2 * s)),
                vector(float(5 + c * ahead - s * aside), float(7 + s * ahead + c * aside), float(2 * c), float(2 * s)));
        };
        for (const double side : {-1.0, 1.0}) {
            EXPECT_TRUE(joins(side * 9.9, 0)) << heading;
            EXPECT_FALSE(joins(side * 10.1, 0)) << heading;
            EXPECT_TRUE(joins(0, side * 3.9)) << heading;
            EXPECT_FALSE(joins(0, side * 4.1)) << heading;
            EXPECT_TRUE(joins(6, side * 3.1)) << heading;  // 0.36 + 0.60
            EXPECT_FALSE(joins(6, side * 3.3)) << heading;
        }
    }
}

TEST(SingleLinkage, AllowsAShareOfTheSpeedOrTheFloor) {
    const Linkage linkage{10, 4, 0.03, 0.05};
    EXPECT_TRUE(linkage.joins(vector(0, 0, 2, 0), vector(1, 0, 2.09F, 0)));
    EXPECT_FALSE(linkage.joins(vector(0, 0, 2, 0), vector(1, 0, 2.12F, 0)));
    EXPECT_TRUE(linkage.joins(vector(0, 0, 0.2F, 0), vector(1, 0, 0.228F, 0)));
    EXPECT_FALSE(linkage.joins(vector(0, 0, 0.2F, 0), vector(1, 0, 0.235F, 0)));
}

TEST(SingleLinkage, TakesDegenerateInput) {
    EXPECT_TRUE(singleLinkage({}, {}).empty());
    EXPECT_EQ(singleLinkage({vector(3, 3, 1, 0)}, {}), std::vector<int>{0});
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float far = 1e9F;
    const std::vector<MotionVector> odd = {vector(0, 0, 1, 0),      vector(nan, 0, 1, 0), vector(1, 0, 1, 0),
                                           vector(far, -far, 1, 0), vector(0, 0, 0, 0),   vector(0, 0, 0, 0)};
    EXPECT_EQ(singleLinkage(odd, {}), (std::vector<int>{0, 1, 0, 2, 3, 3}));
}

TEST(SingleLinkage, HoldsForThousandsInOnePlace) {
    std::vector<MotionVector> vectors(3000, vector(100, 100, 1, 0));
    const std::vector<int> numbers = singleLinkage(vectors, {});
    EXPECT_EQ(*std::max_element(numbers.begin(), numbers.end()), 0);
}

}  // namespace
}  // namespace eyrie::single_linkage_test

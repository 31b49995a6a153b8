#include "removal/vector_support.h"

#include <gtest/gtest.h>

#include "core/geometry/angle.h"
#include "removal/vectors_in_boxes.h"

namespace eyrie::vector_support_test {
namespace {

using namespace test;

/// How many of the vectors that lie and move like this count as inside.
std::size_t inside(const Detection& detection, cv::Point2f position, cv::Point2f velocity, const SupportRule& rule) {
    FrameMotion motion;
    motion.motion_vectors.push_back({1, position, velocity, 9});
    Detection measured = detection;
    measureSupport(measured, motion, rule);
    return measured.vectors.size();
}

TEST(SimilarVelocity, ByAFloorOrAShareOfTheFasterInEveryDirection) {
    const auto turned = [](double x, double y, double angle) {
        return cv::Point2d(std::cos(angle) * x - std::sin(angle) * y, std::sin(angle) * x + std::cos(angle) * y);
    };
    for (const double angle : {0.0, kPi / 2, kPi, -kPi / 2, 0.7, 2.3}) {
        const auto similar = [&](cv::Point2d a, cv::Point2d b) {
            const cv::Point2d p = turned(a.x, a.y, angle);
            const cv::Point2d q = turned(b.x, b.y, angle);
            EXPECT_EQ(similarVelocity(p, q, 0.1, 0.2), similarVelocity(q, p, 0.1, 0.2));
            return similarVelocity(p, q, 0.1, 0.2);
        };
        EXPECT_TRUE(similar({4, 0}, {4.9, 0})) << "0.9 of 0.98";
        EXPECT_FALSE(similar({4, 0}, {5.1, 0})) << "1.1 of 1.02";
        EXPECT_TRUE(similar({4, 0}, {4, 0.8})) << "to the side, too";
        EXPECT_FALSE(similar({4, 0}, {4, 0.85})) << "0.85 of 0.82";
        EXPECT_FALSE(similar({4, 0}, {-4, 0}));
        EXPECT_TRUE(similar({0, 0}, {0.09, 0})) << "below the floor";
        EXPECT_FALSE(similar({0, 0}, {0.11, 0}));
    }
    EXPECT_TRUE(similarVelocity({0, 0}, {0.25, 0}, 0.25, 0)) << "the limit itself is similar";
}

TEST(VectorSupport, TheBoxIsGrownByTheMarginOnEverySide) {
    SupportRule rule;
    rule.margin_px = 3;
    const Detection along = detection(100, 100, 18, 2);
    const Detection across = [&] {
        Detection turned = along;
        turned.box.heading = kPi / 2;
        return turned;
    }();
    for (const float side : {-1.F, 1.F}) {
        EXPECT_EQ(inside(along, {100 + side * 11.9F, 100}, {1, 0}, rule), 1U);
        EXPECT_EQ(inside(along, {100 + side * 12.1F, 100}, {1, 0}, rule), 0U);
        EXPECT_EQ(inside(along, {100, 100 + side * 3.9F}, {1, 0}, rule), 1U);
        EXPECT_EQ(inside(along, {100, 100 + side * 4.1F}, {1, 0}, rule), 0U);
        EXPECT_EQ(inside(across, {100, 100 + side * 11.9F}, {1, 0}, rule), 1U);
        EXPECT_EQ(inside(across, {100, 100 + side * 12.1F}, {1, 0}, rule), 0U);
    }
}

TEST(VectorSupport, CountsVectorsThatDifferByTheFloorOrByAShareOfTheSpeed) {
    const SupportRule rule;  // 0.1 px/frame or a fifth
    for (const double angle : {0.0, kPi / 2, kPi, -kPi / 2}) {
        const cv::Point2d ahead(std::cos(angle), std::sin(angle));
        const cv::Point2d aside(-ahead.y, ahead.x);
        const auto counts = [&](double speed, cv::Point2d difference) {
            const Detection moving = detection(100, 100, 18, 7, ahead * speed);
            const cv::Point2d velocity = moving.velocity + difference;
            return inside(moving, {100, 100}, {static_cast<float>(velocity.x), static_cast<float>(velocity.y)}, rule);
        };
        EXPECT_EQ(counts(3, ahead * 0.59), 1U);
        EXPECT_EQ(counts(3, ahead * -0.59), 1U);
        EXPECT_EQ(counts(3, ahead * 0.61), 0U);
        EXPECT_EQ(counts(3, aside * 0.59), 1U);
        EXPECT_EQ(counts(3, aside * 0.61), 0U);
        EXPECT_EQ(counts(0.2, ahead * 0.09), 1U);
        EXPECT_EQ(counts(0.2, ahead * 0.11), 0U);
    }
}

TEST(VectorSupport, VelocityIsTheMeanOfThoseInside) {
    FrameMotion motion;
    motion.motion_vectors = {{1, {98, 100}, {1, 0.5F}, 9}, {2, {300, 100}, {1, 0}, 9}, {3, {102, 100}, {1.25F, 0}, 9}};
    Detection measured = detection(100, 100, 18, 7, {1.1, 0.2});
    measured.vectors = {1};
    SupportRule any;
    any.compare_velocity = false;
    measureSupport(measured, motion, any);
    EXPECT_EQ(measured.vectors, (std::vector<int>{0, 2}));
    EXPECT_EQ(measured.velocity, cv::Point2d(1.125, 0.25));
    measureSupport(measured, {}, any);
    EXPECT_TRUE(measured.vectors.empty());
    EXPECT_EQ(measured.velocity, cv::Point2d(1.125, 0.25)) << "with none inside the velocity stays";
}

}  // namespace
}  // namespace eyrie::vector_support_test

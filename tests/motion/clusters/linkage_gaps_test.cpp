#include "motion/clusters/linkage_gaps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

namespace eyrie::linkage_gaps_test {
namespace {

const Linkage kLinkage{10, 5, 0.1, 0.05};

std::vector<MotionVector> scattered(unsigned seed, int count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> place(0, 60);
    std::normal_distribution<float> speed(0, 0.06F);
    std::vector<MotionVector> vectors;
    for (int i = 0; i < count; ++i)
        vectors.push_back({0, {place(random), place(random)}, {1.2F + speed(random), -0.9F + speed(random)}, 9});
    return vectors;
}

}  // namespace

TEST(LinkageGaps, AreMeasuredAlongTheMeanMotionWhateverItsDirection) {
    for (const double heading : {0.0, 0.6, 1.571, 2.5, -2.0}) {
        const auto turned = [&](double x, double y) {
            return cv::Point2f(float(x * std::cos(heading) - y * std::sin(heading)),
                               float(x * std::sin(heading) + y * std::cos(heading)));
        };
        const MotionVector a{0, turned(2, 1), turned(4, 0), 9};
        const MotionVector b{0, turned(8, -2), turned(4.16, 0.12), 9};
        const LinkageGap gap = gapBetween(a, b, kLinkage);
        const double lean = std::atan2(0.06, 4.08);
        const double ahead = 6 * std::cos(lean) - 3 * std::sin(lean), aside = 6 * std::sin(lean) + 3 * std::cos(lean);
        EXPECT_NEAR(gap.ahead, ahead, 1e-5);
        EXPECT_NEAR(gap.aside, aside, 1e-5);
        EXPECT_NEAR(gap.difference, 0.2, 1e-5);
        EXPECT_NEAR(gap.allowed, 0.05 * std::hypot(4.08, 0.06), 1e-5);
        EXPECT_NEAR(gap.distance, std::hypot(ahead / 10, aside / 5), 1e-5);
        EXPECT_TRUE(gap.joined);
        EXPECT_FALSE(gapBetween(a, {0, turned(8, -4), turned(4, 0), 9}, kLinkage).joined);
        EXPECT_FALSE(gapBetween(a, {0, turned(8, -2), turned(4.3, 0), 9}, kLinkage).joined);
    }
    const LinkageGap still = gapBetween({0, {0, 0}, {0, 0}, 9}, {0, {3, 4}, {0, 0}, 9}, kLinkage);
    EXPECT_DOUBLE_EQ(still.ahead, 5) << "what stands has no direction";
    EXPECT_DOUBLE_EQ(still.aside, 0);
    EXPECT_DOUBLE_EQ(still.allowed, 0.1);
}

TEST(LinkageGaps, JoinedIsWhatIsNearAndAlike) {
    for (unsigned seed = 1; seed <= 3; ++seed) {
        const auto vectors = scattered(seed, 60);
        int joined = 0;
        for (const MotionVector& a : vectors) {
            for (const MotionVector& b : vectors) {
                const LinkageGap gap = gapBetween(a, b, kLinkage);
                if (std::abs(gap.distance - 1) < 1e-4 || std::abs(gap.difference - gap.allowed) < 1e-4) continue;
                EXPECT_EQ(gap.joined, gap.distance < 1 && gap.difference < gap.allowed);
                joined += gap.joined;
            }
        }
        EXPECT_GT(joined, 100);
    }
}

TEST(LinkageGaps, TheSmallestOutsideIsThatOfAllPairs) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        const auto vectors = scattered(seed, 40);
        std::vector<int> group(10);
        std::iota(group.begin(), group.end(), int(seed));
        double smallest = 1e9;
        int nearest = -1;
        for (const int member : group) {
            for (int i = 0; i < 40; ++i) {
                if (std::find(group.begin(), group.end(), i) != group.end()) continue;
                const LinkageGap gap = gapBetween(vectors[std::size_t(member)], vectors[std::size_t(i)], kLinkage);
                const double cost = std::max(gap.distance, gap.difference / gap.allowed);
                if (cost < smallest) nearest = i;
                smallest = std::min(smallest, cost);
            }
        }
        const LinkageGap found = smallestGapOutside(vectors, group, kLinkage);
        EXPECT_EQ(found.other, nearest);
        EXPECT_DOUBLE_EQ(std::max(found.distance, found.difference / found.allowed), smallest);
    }
    EXPECT_EQ(smallestGapOutside(scattered(1, 2), {0, 1}, kLinkage).other, -1);
}

TEST(LinkageGaps, TheLargestInsideIsTheReachWithWhichTheGroupHoldsTogether) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        auto vectors = scattered(seed, 25);
        for (MotionVector& v : vectors) v.velocity = {1.2F, -0.9F};  // alike, so that the distance alone decides
        std::vector<int> group;
        for (int i = 24; i > 2; i -= 2) group.push_back(i);
        const double largest = largestGapInside(vectors, group, kLinkage).distance;
        const auto holds = [&](double reach) {
            std::vector<MotionVector> chosen;
            for (const int member : group) chosen.push_back(vectors[std::size_t(member)]);
            const auto numbers = singleLinkage(chosen, {10 * reach, 5 * reach, 0.1, 0.05});
            return *std::max_element(numbers.begin(), numbers.end()) == 0;
        };
        EXPECT_TRUE(holds(largest + 1e-4)) << seed;
        EXPECT_FALSE(holds(largest - 1e-4)) << seed;
    }
    EXPECT_EQ(largestGapInside(scattered(1, 3), {1}, kLinkage).other, -1);
    // Alike in place but not in motion: no link holds them together.
    const std::vector<MotionVector> unlike{{0, {0, 0}, {1, 0}, 9}, {0, {1, 0}, {3, 0}, 9}};
    EXPECT_EQ(largestGapInside(unlike, {0, 1}, kLinkage).other, -1);
}

}  // namespace eyrie::linkage_gaps_test

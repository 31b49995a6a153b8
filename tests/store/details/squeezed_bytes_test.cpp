#include "store/details/squeezed_bytes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "store/samples.h"

namespace eyrie::squeezed_bytes_test {
namespace {

TEST(SqueezedBytes, ComeBackAsTheyWere) {
    const std::vector<MotionVector> vectors = test::sampleFrame(3).motion.motion_vectors;
    for (const std::span<const MotionVector> part :
         {std::span(vectors), std::span(vectors).first(1), std::span(vectors).first(0)}) {
        const auto read = unsqueezeMotionVectors(squeezeMotionVectors(part));
        ASSERT_TRUE(read.has_value());
        EXPECT_EQ(packMotionVectors(*read), packMotionVectors(part));
    }
    const std::vector<ClassifiedBox> boxes{{{{1.25, -1e-300}, 20, 10, 3.14}, true, -2.5}, {{{1e300, 7}, 0.1, 0.2, -3}}};
    const auto read = unsqueezeBoxes(squeezeBoxes(boxes));
    ASSERT_TRUE(read.has_value());
    ASSERT_EQ(read->size(), 2U);
    for (std::size_t i = 0; i < boxes.size(); ++i) EXPECT_EQ((*read)[i].box.centre, boxes[i].box.centre);
    EXPECT_EQ((*read)[1].box.heading, -3);
    EXPECT_TRUE((*read)[0].whole);
    EXPECT_FALSE((*read)[1].whole);
    EXPECT_EQ((*read)[0].decision, -2.5);
    EXPECT_TRUE(std::isnan((*read)[1].decision));
    EXPECT_TRUE(unsqueezeBoxes(squeezeBoxes({}))->empty());
}

TEST(SqueezedBytes, BoxesOfBeforeDecisionsWereKnownAreThoseOfWholeVehicles) {
    const std::vector<double> numbers{1, 2, 20, 10, 0.5, 3, 4, 30, 15, -0.5};
    const auto read = unsqueezeBoxes(squeezed(std::as_bytes(std::span(numbers)), 5 * sizeof(double)));
    ASSERT_TRUE(read.has_value());
    ASSERT_EQ(read->size(), 2U);
    EXPECT_EQ((*read)[1].box.centre, cv::Point2d(3, 4));
    EXPECT_EQ((*read)[1].box.heading, -0.5);
    EXPECT_TRUE((*read)[0].whole && (*read)[1].whole);
    EXPECT_TRUE(std::isnan((*read)[0].decision));
}

TEST(SqueezedBytes, VectorsThatMoveAlikeTakeHalfTheirBytesAtMost) {
    std::vector<MotionVector> vectors;
    for (int i = 0; i < 500; ++i)
        vectors.push_back(
            {1000 + 3 * i, {static_cast<float>(i % 30) * 7.13F, static_cast<float>(i) * 0.77F}, {1.5F, 0.25F}, 12});
    EXPECT_LT(squeezeMotionVectors(vectors).size() * 2, packMotionVectors(vectors).size());
}

TEST(SqueezedBytes, WhatNoSqueezingYieldsIsRefused) {
    const Bytes good = squeezeMotionVectors(test::sampleFrame(2).motion.motion_vectors);
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(unsqueezed(ByteView(good).first(size)).has_value()) << size;
    const auto changed = [&](std::size_t at, int value) {
        Bytes bytes = good;
        bytes[at] = static_cast<std::byte>(value);
        return unsqueezed(bytes);
    };
    EXPECT_FALSE(changed(0, 2).has_value()) << "another format";
    EXPECT_FALSE(changed(5, 0).has_value()) << "records of no length";
    EXPECT_FALSE(changed(4, 0x7f).has_value()) << "gigabytes promised by some hundred bytes";
    EXPECT_FALSE(changed(1, 3).has_value()) << "another length than comes out";
    EXPECT_FALSE(unsqueezeBoxes(good).has_value()) << "vectors are no boxes";
    EXPECT_FALSE(unsqueezed(good, 28).has_value()) << "more than may come out";
    std::mt19937 dice(7);
    for (int i = 0; i < 2000; ++i) {
        Bytes bytes = good;
        bytes[dice() % bytes.size()] = static_cast<std::byte>(dice());
        unsqueezeMotionVectors(bytes);  // refused or read, nothing else
    }
}

}  // namespace
}  // namespace eyrie::squeezed_bytes_test

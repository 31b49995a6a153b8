#include "core/geometry/homography.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace eyrie::homography_test {
namespace {

Homography example(FrameIndex from, FrameIndex to) {
    Homography h;
    h.matrix = {1.01, 0.02, 3, -0.01, 0.99, -2, 1e-5, -2e-5, 1};
    h.from_frame = from;
    h.to_frame = to;
    return h;
}

}  // namespace

TEST(Homography, inverseUndoesTheMap) {
    const Homography h = example(3, 4);
    const cv::Point2d p = h.inverse().apply(h.apply({120, 80}));
    EXPECT_NEAR(p.x, 120, 1e-9);
    EXPECT_NEAR(p.y, 80, 1e-9);
    EXPECT_EQ(h.inverse().from_frame, 4);
}

TEST(Homography, productsMustMeet) {
    const Homography product = example(4, 5) * example(3, 4);
    EXPECT_EQ(product.from_frame, 3);
    EXPECT_EQ(product.to_frame, 5);
    EXPECT_THROW(example(3, 4) * example(3, 4), Error);
}

TEST(Homography, localMapAgreesWithFiniteDifferences) {
    const Homography h = example(0, 1);
    const cv::Point2d p{200, 100};
    const cv::Point2d step = (h.apply(p + cv::Point2d(1e-4, 0)) - h.apply(p)) * 1e4;
    const cv::Point2d mapped = h.applyToVector(p, {1, 0});
    EXPECT_NEAR(mapped.x, step.x, 1e-5);
    EXPECT_NEAR(mapped.y, step.y, 1e-5);
}

}  // namespace eyrie::homography_test

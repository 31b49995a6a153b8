#include "registration/corners/patch_alignment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/every_target.h"
#include "support/textured_ground.h"

namespace eyrie::patch_alignment_test {
namespace {

const cv::Size kSize(64, 60);

PaddedPicture padded(const cv::Mat& gray) {
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

double interpolate(const PaddedPicture& p, double x, double y) {
    const int ix = int(std::floor(x));
    const int iy = int(std::floor(y));
    const double fx = x - ix;
    const double fy = y - iy;
    const auto at = [&](int dx, int dy) { return double(p.row(iy + dy)[ix + dx]); };
    return (1 - fy) * ((1 - fx) * at(0, 0) + fx * at(1, 0)) + fy * ((1 - fx) * at(0, 1) + fx * at(1, 1));
}

struct SlowResult {
    cv::Point2d position;
    double residual = 0;
};

/// The same minimum in double precision, by brute Gauss–Newton steps with the same weights, run to convergence.
SlowResult slowAlign(const PatchTemplate& weights, const PaddedPicture& from, cv::Point centre, const PaddedPicture& to,
                     cv::Point2d start) {
    const int half = weights.window() / 2;
    SlowResult result{start, 0};
    for (int step = 0; step < 60; ++step) {
        double w_sum = 0, gx_sum = 0, gy_sum = 0, d_sum = 0, xx = 0, xy = 0, yy = 0, bx = 0, by = 0, dd = 0;
        for (int j = -half; j <= half; ++j) {
            for (int i = -half; i <= half; ++i) {
                const double w = double(weights.weights_[(j + half) * PatchTemplate::kPitch + i + half]);
                const auto g = [&](int dx, int dy) { return double(from.row(centre.y + j + dy)[centre.x + i + dx]); };
                const double gx = (g(1, 0) - g(-1, 0)) / 2;
                const double gy = (g(0, 1) - g(0, -1)) / 2;
                const double d = interpolate(to, result.position.x + i, result.position.y + j) - g(0, 0);
                w_sum += w;
                gx_sum += w * gx;
                gy_sum += w * gy;
                d_sum += w * d;
                xx += w * gx * gx;
                xy += w * gx * gy;
                yy += w * gy * gy;
                bx += w * gx * d;
                by += w * gy * d;
                dd += w * d * d;
            }
        }
        EXPECT_NEAR(w_sum, 1, 1e-5);
        xx -= gx_sum * gx_sum;
        xy -= gx_sum * gy_sum;
        yy -= gy_sum * gy_sum;
        bx -= gx_sum * d_sum;
        by -= gy_sum * d_sum;
        const double determinant = xx * yy - xy * xy;
        result.position.x -= (yy * bx - xy * by) / determinant;
        result.position.y -= (xx * by - xy * bx) / determinant;
        result.residual = dd - d_sum * d_sum;
    }
    return result;
}

}  // namespace

TEST(PatchAlignment, everyInstructionSetReachesTheSlowReference) {
    const test::TexturedGround ground(21);
    const PaddedPicture from = padded(ground.picture(kSize, cv::Matx33d::eye(), 1, 1));
    const PaddedPicture to = padded(ground.picture(kSize, {1, 0, -0.62, 0, 1, 0.37, 0, 0, 1}, 1, 2));
    for (int window = kSmallestWindow; window <= kLargestWindow; window += 2) {
        PatchTemplate patch(window);
        std::vector<std::int16_t> samples(std::size_t(patchSamples(window)));
        int compared = 0;
        for (int y = 12; y < kSize.height - 12; y += 6) {
            for (int x = 12; x < kSize.width - 12; x += 6) {
                const cv::Point2f centre{float(x), float(y)};
                cutPatch(from, centre, window, samples.data());
                AlignmentLimits limits;
                limits.max_iterations = 40;
                limits.converged_px = 1e-4F;
                if (!patch.prepare(samples.data()) || patch.positionVariance() > 0.02F) continue;
                const SlowResult slow = slowAlign(patch, from, {x, y}, to, {x + 0.62, y - 0.37});
                test::forEveryTarget([&](const std::string& name) {
                    ASSERT_TRUE(patch.prepare(samples.data())) << name;
                    const Alignment found = align(patch, to, {float(x) + 0.6F, float(y) - 0.4F}, limits);
                    ASSERT_TRUE(found.found) << name << " window " << window;
                    EXPECT_NEAR(double(found.position.x), slow.position.x, 2e-3) << name << " window " << window;
                    EXPECT_NEAR(double(found.position.y), slow.position.y, 2e-3) << name << " window " << window;
                    EXPECT_NEAR(double(found.residual), slow.residual, 0.01 + 0.01 * slow.residual) << name;
                });
                ++compared;
            }
        }
        EXPECT_GT(compared, 10) << window;
    }
}

TEST(PatchAlignment, brightnessOffsetDoesNotMatter) {
    const test::TexturedGround ground(22);
    const cv::Mat gray = ground.picture(kSize, cv::Matx33d::eye(), 0, 1) / 2;
    const PaddedPicture dark = padded(gray);
    const PaddedPicture bright = padded(gray + 70);
    PatchTemplate patch(9);
    std::vector<std::int16_t> samples(std::size_t(patchSamples(9)));
    cutPatch(dark, {30, 30}, 9, samples.data());
    ASSERT_TRUE(patch.prepare(samples.data()));
    const Alignment found = align(patch, bright, {30.8F, 29.5F}, {});
    ASSERT_TRUE(found.found);
    EXPECT_NEAR(found.position.x, 30, 0.01);
    EXPECT_NEAR(found.position.y, 30, 0.01);
    EXPECT_LT(found.residual, 0.01F);
}

TEST(PatchAlignment, expectedScatterIsThatOfNoise) {
    // Many noisy pictures of one place: the scatter of the positions must be what positionVariance says. The noise is
    // in the new picture only; interpolation at nearly whole positions hardly smoothes it.
    const test::TexturedGround ground(23);
    const PaddedPicture from = padded(ground.picture(kSize, cv::Matx33d::eye(), 0, 1));
    PatchTemplate patch(9);
    std::vector<std::int16_t> samples(std::size_t(patchSamples(9)));
    cutPatch(from, {30, 30}, 9, samples.data());
    ASSERT_TRUE(patch.prepare(samples.data()));
    double sum = 0;
    constexpr int kPictures = 120;
    for (int i = 0; i < kPictures; ++i) {
        const Alignment found =
            align(patch, padded(ground.picture(kSize, cv::Matx33d::eye(), 3, unsigned(i + 2))), {30, 30}, {});
        ASSERT_TRUE(found.found);
        const cv::Point2f error = found.position - cv::Point2f(30, 30);
        sum += double(error.dot(error));
    }
    EXPECT_NEAR(sum / kPictures / (9 * double(patch.positionVariance())), 1, 0.45);
}

TEST(PatchAlignment, refusesWhatCannotBeLocated) {
    PatchTemplate patch(7);
    std::vector<std::int16_t> samples(std::size_t(patchSamples(7)));
    const PaddedPicture flat = padded(cv::Mat(40, 40, CV_8UC1, cv::Scalar(99)));
    cutPatch(flat, {20, 20}, 7, samples.data());
    EXPECT_FALSE(patch.prepare(samples.data()));
    cv::Mat edge(40, 40, CV_8UC1, cv::Scalar(50));
    edge.colRange(20, 40) = 150;
    cutPatch(padded(edge), {20, 20}, 7, samples.data());
    EXPECT_FALSE(patch.prepare(samples.data()));
}

TEST(PatchAlignment, doesNotLeaveThePicture) {
    const PaddedPicture picture = padded(test::TexturedGround(24).picture(kSize, cv::Matx33d::eye(), 0, 1));
    PatchTemplate patch(11);
    std::vector<std::int16_t> samples(std::size_t(patchSamples(11)));
    cutPatch(picture, {30, 30}, 11, samples.data());
    ASSERT_TRUE(patch.prepare(samples.data()));
    const float far = std::numeric_limits<float>::infinity();
    const float undefined = std::numeric_limits<float>::quiet_NaN();
    for (const cv::Point2f start : {cv::Point2f(-5, 20), cv::Point2f(2, 2), cv::Point2f(63, 30), cv::Point2f(30, 59),
                                    cv::Point2f(far, 20), cv::Point2f(20, undefined)}) {
        EXPECT_FALSE(align(patch, picture, start, {}).found) << start;
        EXPECT_FALSE(patchFits(picture, start, 11)) << start;
    }
}

TEST(PatchAlignment, wholePositionsCopyThePixels) {
    const PaddedPicture picture = padded(test::TexturedGround(25).picture(kSize, cv::Matx33d::eye(), 0, 1));
    std::vector<std::int16_t> samples(std::size_t(patchSamples(5)));
    cutPatch(picture, {20, 31}, 5, samples.data());
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 7; ++x) EXPECT_EQ(samples[std::size_t(y * 7 + x)], 64 * picture.row(28 + y)[17 + x]);
    }
}

TEST(PatchAlignment, turnedPatchesAreThoseOfATurnedPicture) {
    const test::TexturedGround ground(26);
    const PaddedPicture before = padded(ground.picture(kSize, cv::Matx33d::eye(), 0, 1));
    for (const int window : {5, 9, 15}) {
        std::vector<std::int16_t> surrounding(std::size_t(surroundingSamples(window)));
        std::vector<std::int16_t> turned(std::size_t(patchSamples(window)));
        std::vector<std::int16_t> expected(turned.size());
        cutSurrounding(before, {31, 29}, window, surrounding.data());
        for (const double degrees : {0.0, 3.0, -40.0, 90.0, 170.0}) {
            const double zoom = 1.03;
            const double c = zoom * std::cos(degrees * CV_PI / 180);
            const double s = zoom * std::sin(degrees * CV_PI / 180);
            const cv::Matx33d after_from_before(c, -s, 31 - c * 31 + s * 29, s, c, 29 - s * 31 - c * 29, 0, 0, 1);
            const PaddedPicture after = padded(ground.picture(kSize, after_from_before.inv(), 0, 1));
            ASSERT_TRUE(
                turnPatch(surrounding.data(), window, {float(c), float(-s), float(s), float(c)}, turned.data()));
            cutPatch(after, {31, 29}, window, expected.data());
            double sum = 0;
            const int count = (window + 2) * (window + 2);
            for (int i = 0; i < count; ++i) sum += std::abs(turned[std::size_t(i)] - expected[std::size_t(i)]) / 64.0;
            EXPECT_LT(sum / count, 1.5) << window << " px, " << degrees << "°";  // interpolation and rounding
        }
    }
}

TEST(PatchAlignment, surroundingsDoNotReachForEver) {
    std::vector<std::int16_t> surrounding(std::size_t(surroundingSamples(7)), 64);
    std::vector<std::int16_t> turned(std::size_t(patchSamples(7)));
    const float undefined = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(turnPatch(surrounding.data(), 7, {0.55F, 0, 0, 0.55F}, turned.data()));
    EXPECT_FALSE(turnPatch(surrounding.data(), 7, {0, 0, 0, 0}, turned.data()));
    EXPECT_FALSE(turnPatch(surrounding.data(), 7, {undefined, 0, 0, 1}, turned.data()));
    // At the picture's border the outermost pixels repeat.
    const PaddedPicture picture = padded(test::TexturedGround(25).picture(kSize, cv::Matx33d::eye(), 0, 1));
    cutSurrounding(picture, {4, 4}, 7, surrounding.data());
    EXPECT_EQ(surrounding[0], 64 * picture.row(0)[0]);
}

namespace {

/// 10 grey levels and the square of the distance from a point: there each step of the alignment is exact, as the
/// difference to the patch is 2 d · u and a constant.
PaddedPicture bowl(cv::Size size, cv::Point centre) {
    cv::Mat gray(size, CV_8UC1);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const cv::Point u = cv::Point(x, y) - centre;
            gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(10 + u.dot(u));
        }
    }
    return padded(gray);
}

PatchTemplate patchOfBowl() {
    std::vector<std::int16_t> samples(std::size_t(patchSamples(5)));
    cutPatch(bowl({21, 21}, {10, 10}), {10, 10}, 5, samples.data());
    PatchTemplate patch(5);
    EXPECT_TRUE(patch.prepare(samples.data()));
    return patch;
}

}  // namespace

TEST(PatchAlignment, ofABowlAllIsKnown) {
    // Weights of columns and rows exp(-1.5 (u / 3)²): 1, 0.8465, 0.5134, together 3.7198. The mean of u² is
    // (2 · 0.8465 + 2 · 4 · 0.5134) / 3.7198 = 1.5593, that of u⁴ 4.8719.
    const PatchTemplate patch = patchOfBowl();
    EXPECT_NEAR(patch.contrast(), 2 * (4.8719 - 1.5593 * 1.5593), 2e-3);
    // Gradients of 2 u; the weights are worth (3.7198² / 2.9603)² = 21.85 pixels.
    EXPECT_NEAR(patch.positionVariance(), 2 / (4 * 1.5593) / 21.85, 2e-5);
    const PaddedPicture to = bowl({17, 17}, {6, 8});
    AlignmentLimits limits;
    limits.max_iterations = 1;
    const Alignment once = align(patch, to, {5, 8}, limits);
    EXPECT_TRUE(once.found);
    EXPECT_EQ(once.iterations, 1);
    EXPECT_NEAR(once.position.x, 6, 1e-3);
    EXPECT_NEAR(once.position.y, 8, 1e-3);
    EXPECT_NEAR(once.residual, 4 * 1.5593, 2e-3) << "of the place it came from: (2 u)²";
    const Alignment whole = align(patch, to, {7.25F, 6.5F}, {});
    EXPECT_TRUE(whole.found);
    EXPECT_EQ(whole.iterations, 2) << "the second only finds that all is well";
    EXPECT_NEAR(whole.position.x, 6, 1e-3);
    EXPECT_NEAR(whole.position.y, 8, 1e-3);
    EXPECT_NEAR(whole.residual, 0, 1e-3);
}

TEST(PatchAlignment, aLastStepOutOfThePictureIsNotFound) {
    // Half a window are 2 px; the bowl's middle is a pixel from the border, the start 2.2 px.
    const PatchTemplate patch = patchOfBowl();
    AlignmentLimits limits;
    limits.max_iterations = 1;
    const auto ends = [&](cv::Size size, cv::Point centre, cv::Point2f start) {
        const Alignment ended = align(patch, bowl(size, centre), start, limits);
        EXPECT_EQ(ended.iterations, 1) << centre;
        EXPECT_NEAR(ended.position.x, centre.x, 2e-3);
        EXPECT_NEAR(ended.position.y, centre.y, 2e-3);
        return ended.found;
    };
    EXPECT_FALSE(ends({13, 17}, {1, 8}, {2.2F, 8}));
    EXPECT_FALSE(ends({13, 17}, {11, 8}, {9.8F, 8}));
    EXPECT_FALSE(ends({17, 13}, {8, 1}, {8, 2.2F}));
    EXPECT_FALSE(ends({17, 13}, {8, 11}, {8, 9.8F}));
    EXPECT_TRUE(ends({13, 17}, {3, 8}, {2.2F, 8}));
    EXPECT_TRUE(ends({17, 13}, {8, 9}, {8, 9.8F}));
}

}  // namespace eyrie::patch_alignment_test

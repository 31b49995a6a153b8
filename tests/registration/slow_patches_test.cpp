// Patches and corner positions against slow ones that follow the words of their descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

#include "registration/corners/corner_strength.h"
#include "registration/corners/patch_alignment.h"
#include "support/every_target.h"
#include "support/textured_ground.h"

namespace eyrie::slow_patches_test {
namespace {

const cv::Size kScene(61, 53);

PaddedPicture scene(unsigned seed, double shift_x = 0, double shift_y = 0, double noise = 1) {
    PaddedPicture picture;
    picture.copyFrom(
        test::TexturedGround(seed, 1.3).picture(kScene, {1, 0, shift_x, 0, 1, shift_y, 0, 0, 1}, noise, seed));
    return picture;
}

std::vector<std::int16_t> cut(const PaddedPicture& picture, cv::Point2f centre, int window) {
    std::vector<std::int16_t> samples(std::size_t(patchSamples(window)), 77);
    cutPatch(picture, centre, window, samples.data());
    return samples;
}

double bilinear(const std::function<double(int, int)>& value, double x, double y) {
    const int ix = int(std::floor(x));
    const int iy = int(std::floor(y));
    const double fx = x - ix;
    const double fy = y - iy;
    return (1 - fy) * ((1 - fx) * value(ix, iy) + fx * value(ix + 1, iy)) +
           fy * ((1 - fx) * value(ix, iy + 1) + fx * value(ix + 1, iy + 1));
}

/// What a template knows of its patch, in double precision.
struct SlowTemplate {
    double contrast = 0, position_variance = 0, determinant = 0, determinant_share = 0;

    SlowTemplate(const std::vector<std::int16_t>& samples, int window) {
        const int half = window / 2;
        double total = 0, squares = 0, mean = 0, square = 0, mx = 0, my = 0, xx = 0, xy = 0, yy = 0;
        for (int pass = 0; pass < 2; ++pass) {
            for (int j = -half; j <= half; ++j) {
                for (int i = -half; i <= half; ++i) {
                    const double w = std::exp(-1.5 * (i * i + j * j) / ((half + 1.0) * (half + 1.0)));
                    if (pass == 0) {
                        total += w;
                        squares += w * w;
                        continue;
                    }
                    const auto at = [&](int dx, int dy) {
                        return samples[std::size_t((j + dy + half + 1) * (window + 2) + i + dx + half + 1)] / 64.0;
                    };
                    const double gx = (at(1, 0) - at(-1, 0)) / 2;
                    const double gy = (at(0, 1) - at(0, -1)) / 2;
                    const double share = w / total;
                    mean += share * at(0, 0);
                    square += share * at(0, 0) * at(0, 0);
                    mx += share * gx;
                    my += share * gy;
                    xx += share * gx * gx;
                    xy += share * gx * gy;
                    yy += share * gy * gy;
                }
            }
        }
        contrast = square - mean * mean;
        const double a = xx - mx * mx, b = xy - mx * my, c = yy - my * my;
        determinant = a * c - b * b;
        determinant_share = (a * c - b * b) / (a * c);
        position_variance = (a + c) / (a * c - b * b) / (total * total / squares);
    }
};

}  // namespace

TEST(SlowPatches, CutsAreInterpolatedToASixtyFourth) {
    const PaddedPicture picture = scene(61);
    for (const int window : {5, 9, 15}) {
        for (const cv::Point2f offset : {cv::Point2f(0, 0), cv::Point2f(0.25F, 0.5F), cv::Point2f(0.703125F, 0.015625F),
                                         cv::Point2f(0.984375F, 0.984375F)}) {
            const cv::Point2f centre = cv::Point2f(25, 21) + offset;
            const auto samples = cut(picture, centre, window);
            const int half = window / 2 + 1;
            for (int j = -half; j <= half; ++j) {
                for (int i = -half; i <= half; ++i) {
                    const double expected = bilinear([&](int x, int y) { return double(picture.row(y)[x]); },
                                                     double(centre.x) + i, double(centre.y) + j);
                    const int found = samples[std::size_t((j + half) * (window + 2) + i + half)];
                    ASSERT_EQ(found, int(std::floor(64 * expected + 0.5))) << centre << " " << i << " " << j;
                }
            }
            for (std::size_t i = std::size_t((window + 2) * (window + 2)); i < samples.size(); ++i)
                EXPECT_EQ(samples[i], 0) << "room for whole vectors is empty";
        }
    }
}

TEST(SlowPatches, FitWhereAllThatIsReadLiesInside) {
    const PaddedPicture picture = scene(61);
    // A window of 7 reads 4 px and the one after: whole centres from 4 to the last but 5.
    EXPECT_TRUE(patchFits(picture, {4, 20}, 7));
    EXPECT_FALSE(patchFits(picture, {3.99F, 20}, 7));
    EXPECT_TRUE(patchFits(picture, {20, 4}, 7));
    EXPECT_FALSE(patchFits(picture, {20, 3.99F}, 7));
    EXPECT_TRUE(patchFits(picture, {55.99F, 20}, 7));
    EXPECT_FALSE(patchFits(picture, {56, 20}, 7));
    EXPECT_TRUE(patchFits(picture, {20, 47.99F}, 7));
    EXPECT_FALSE(patchFits(picture, {20, 48}, 7));
    EXPECT_TRUE(patchFits(picture, {3, 3}, 5));
}

TEST(SlowPatches, SurroundingsRepeatTheBorder) {
    const PaddedPicture picture = scene(62);
    for (const int window : {5, 7, 15}) {
        for (const cv::Point centre : {cv::Point(30, 25), cv::Point(2, 50), cv::Point(59, 1)}) {
            std::vector<std::int16_t> samples(std::size_t(surroundingSamples(window)));
            cutSurrounding(picture, centre, window, samples.data());
            const int reach = (window / 2 + 1) * 3 / 2 + 1;
            ASSERT_EQ(samples.size(), std::size_t((2 * reach + 1) * (2 * reach + 1)));
            std::size_t next = 0;
            for (int y = centre.y - reach; y <= centre.y + reach; ++y) {
                for (int x = centre.x - reach; x <= centre.x + reach; ++x)
                    ASSERT_EQ(samples[next++], 64 * picture.row(std::clamp(y, 0, 52))[std::clamp(x, 0, 60)]);
            }
        }
    }
}

TEST(SlowPatches, TurnedPatchesLookEachPixelUpInTheSurrounding) {
    const PaddedPicture picture = scene(63);
    for (const int window : {5, 7, 11, 15}) {
        const int reach = surroundingReach(window);
        std::vector<std::int16_t> surrounding(std::size_t(surroundingSamples(window)));
        cutSurrounding(picture, {30, 26}, window, surrounding.data());
        for (const LocalTurn turn : {LocalTurn{1, 0, 0, 1}, LocalTurn{0.95F, -0.2F, 0.25F, 1.05F},
                                     LocalTurn{1.7F, 0.3F, -0.2F, 1.4F}, LocalTurn{0, -1, 1, 0}}) {
            std::vector<std::int16_t> turned(std::size_t(patchSamples(window)), 77);
            ASSERT_TRUE(turnPatch(surrounding.data(), window, turn, turned.data())) << window;
            const cv::Matx22d back = cv::Matx22d(turn.xx, turn.xy, turn.yx, turn.yy).inv();
            const int half = window / 2 + 1;
            for (int j = -half; j <= half; ++j) {
                for (int i = -half; i <= half; ++i) {
                    const cv::Vec2d from = back * cv::Vec2d(i, j);
                    const double expected = bilinear(
                        [&](int x, int y) {
                            const int column = std::min(x + reach, 2 * reach), line = std::min(y + reach, 2 * reach);
                            return double(surrounding[std::size_t(line * (2 * reach + 1) + column)]);
                        },
                        from[0], from[1]);
                    EXPECT_NEAR(turned[std::size_t((j + half) * (window + 2) + i + half)], expected, 0.52)
                        << window << " " << i << " " << j;
                }
            }
            for (std::size_t i = std::size_t((window + 2) * (window + 2)); i < turned.size(); ++i)
                EXPECT_EQ(turned[i], 0);
        }
        std::vector<std::int16_t> turned(std::size_t(patchSamples(window)));
        const auto turns = [&](LocalTurn turn) { return turnPatch(surrounding.data(), window, turn, turned.data()); };
        // Areas from a quarter to four times, as far as the surrounding reaches.
        EXPECT_TRUE(turns({1.99F, 0, 0, 2}));
        EXPECT_FALSE(turns({2.01F, 0, 0, 2}));
        EXPECT_FALSE(turns({-1, 0, 0, 1})) << "a mirror image";
        const float least = float(window / 2 + 1) / float(reach);
        EXPECT_TRUE(turns({least * 1.01F, 0, 0, 1}));
        EXPECT_FALSE(turns({least * 0.99F, 0, 0, 1}));
        EXPECT_TRUE(turns({1, 0, 0, least * 1.01F}));
        EXPECT_FALSE(turns({1, 0, 0, least * 0.99F}));
        // Shear takes the corners of the patch farther: by 1 + s.
        const float most = 1 / least - 1;
        EXPECT_TRUE(turns({1, most * 0.98F, 0, 1}));
        EXPECT_FALSE(turns({1, most * 1.02F, 0, 1}));
        EXPECT_TRUE(turns({1, 0, -most * 0.98F, 1}));
        EXPECT_FALSE(turns({1, 0, -most * 1.02F, 1}));
    }
    std::vector<std::int16_t> surrounding(std::size_t(surroundingSamples(5)), 64);
    std::vector<std::int16_t> turned(std::size_t(patchSamples(5)));
    EXPECT_FALSE(turnPatch(surrounding.data(), 5, {0.7F, 0, 0, 0.35F}, turned.data())) << "a quarter of the area";
}

TEST(SlowPatches, ATemplateKnowsContrastAndHowWellItIsLocated) {
    const PaddedPicture picture = scene(64);
    for (int window = kSmallestWindow; window <= kLargestWindow; window += 2) {
        PatchTemplate patch(window);
        EXPECT_EQ(patch.window(), window);
        int prepared = 0;
        for (int y = 12; y < kScene.height - 12; y += 3) {
            for (int x = 12; x < kScene.width - 12; x += 3) {
                const auto samples = cut(picture, {float(x) + 0.5F, float(y) + 0.25F}, window);
                const SlowTemplate slow(samples, window);
                test::forEveryTarget([&](const std::string& name) {
                    if (!patch.prepare(samples.data())) return;
                    ++prepared;
                    EXPECT_NEAR(double(patch.contrast()), slow.contrast, 1e-3 * slow.contrast) << name;
                    EXPECT_NEAR(double(patch.positionVariance()), slow.position_variance,
                                1e-2 * slow.position_variance / slow.determinant_share)
                        << name;
                });
            }
        }
        EXPECT_GT(prepared, 50);
    }
}

TEST(SlowPatches, ATemplateNeedsStructureInTwoDirections) {
    // Waves along x and, weaker, along y: a, b = 0, c; the determinant must exceed a ten-thousandth.
    const auto prepares = [](double along_x, double along_y, double shared) {
        std::vector<std::int16_t> samples(std::size_t(patchSamples(9)));
        for (int j = 0; j < 11; ++j) {
            for (int i = 0; i < 11; ++i) {
                const double x = (i - 5) * (i - 5), y = (j - 5) * (j - 5), both = (i + j - 10) * (i + j - 10);
                samples[std::size_t(j * 11 + i)] = std::int16_t(std::lround(along_x * x + along_y * y + shared * both));
            }
        }
        PatchTemplate patch(9);
        const bool ready = patch.prepare(samples.data());
        const SlowTemplate slow(samples, 9);
        return std::pair(ready, slow.determinant_share);
    };
    EXPECT_TRUE(prepares(64, 64, 0).first);
    EXPECT_FALSE(prepares(64, 0, 0).first);
    EXPECT_FALSE(prepares(0, 0, 64).first) << "an edge that is neither upright nor level";
    // One part in a thousand of what two independent directions would have.
    int refused = 0, ready = 0;
    for (int weak = 0; weak < 40; ++weak) {
        const auto [good, share] = prepares(weak * 0.5, 0, 64);
        if (std::abs(share - 1e-3) < 2e-4) continue;
        EXPECT_EQ(good, share > 1e-3) << weak << " " << share;
        ++(good ? ready : refused);
    }
    EXPECT_GT(refused, 2);
    EXPECT_GT(ready, 2);
    // Two weak directions: the determinant must exceed a ten-thousandth.
    EXPECT_FALSE(prepares(0, 0, 0).first);
    for (double scale = 0.2; scale < 4; scale *= 1.08) {
        std::vector<std::int16_t> samples(std::size_t(patchSamples(9)));
        std::mt19937 random(4);
        for (std::size_t i = 0; i < 121; ++i) samples[i] = std::int16_t(scale * double(random() % 64));
        PatchTemplate patch(9);
        const double determinant = SlowTemplate(samples, 9).determinant;
        if (std::abs(determinant / 1e-4 - 1) > 0.05) {
            EXPECT_EQ(patch.prepare(samples.data()), determinant > 1e-4) << scale;
        }
    }
}

TEST(SlowPatches, AlignmentEndsWhereItIsToldTo) {
    const PaddedPicture from = scene(65, 0, 0, 0);
    const PaddedPicture to = scene(65, -1.5, 0.75, 0);
    for (const int window : {7, 11}) {
        PatchTemplate patch(window);
        const auto samples = cut(from, {30, 26}, window);
        ASSERT_TRUE(patch.prepare(samples.data()));
        AlignmentLimits limits;
        const Alignment whole = align(patch, to, {31, 25.5F}, limits);
        ASSERT_TRUE(whole.found);
        EXPECT_NEAR(whole.position.x, 31.5, 0.1);
        EXPECT_NEAR(whole.position.y, 25.25, 0.1);
        EXPECT_GT(whole.iterations, 2);
        // Fewer iterations end on the way; that counts as found. None are none.
        AlignmentLimits one = limits;
        one.max_iterations = 1;
        const Alignment begun = align(patch, to, {31, 25.5F}, one);
        EXPECT_TRUE(begun.found);
        EXPECT_EQ(begun.iterations, 1);
        EXPECT_NE(begun.position, whole.position);
        one.max_iterations = 0;
        EXPECT_FALSE(align(patch, to, {31, 25.5F}, one).found);
        // The first step alone converges where steps may be that large.
        const double step = cv::norm(begun.position - cv::Point2f(31, 25.5F));
        AlignmentLimits coarse = limits;
        coarse.converged_px = float(step * 1.01);
        EXPECT_EQ(align(patch, to, {31, 25.5F}, coarse).iterations, 1);
        coarse.converged_px = float(step * 0.99);
        EXPECT_GT(align(patch, to, {31, 25.5F}, coarse).iterations, 1);
        // Farther than allowed is not found, as the crow flies.
        AlignmentLimits near = limits;
        const double away = cv::norm(whole.position - cv::Point2f(31, 25.5F));
        near.max_shift_px = float(std::max(away, step) * 1.2);
        EXPECT_TRUE(align(patch, to, {31, 25.5F}, near).found);
        near.max_shift_px = float(away * 0.9);
        EXPECT_FALSE(align(patch, to, {31, 25.5F}, near).found);
    }
}

TEST(SlowPatches, AlignmentStaysWithinHalfAWindowOfTheBorder) {
    // A picture aligned with itself, at the outermost places: half a window must lie inside, and one more on two sides.
    const PaddedPicture picture = scene(66, 0, 0, 0);
    for (const int window : {5, 9}) {
        const auto half = float(window / 2);
        const float right = float(kScene.width - 1) - half, bottom = float(kScene.height - 1) - half;
        PatchTemplate patch(window);
        const auto samples = cut(picture, {30, 26}, window);
        ASSERT_TRUE(patch.prepare(samples.data()));
        AlignmentLimits limits;
        limits.max_iterations = 1;
        limits.max_shift_px = 1000;
        const auto looked = [&](float x, float y) { return align(patch, picture, {x, y}, limits).iterations == 1; };
        EXPECT_TRUE(looked(half, half));
        EXPECT_FALSE(looked(half - 0.01F, half));
        EXPECT_FALSE(looked(half, half - 0.01F));
        EXPECT_TRUE(looked(right - 0.01F, bottom - 0.01F));
        EXPECT_FALSE(looked(right, 20));
        EXPECT_FALSE(looked(20, bottom));
    }
}

TEST(SlowPatches, CornersAreNearestToAllEdgesAroundThem) {
    const PaddedPicture picture = scene(67);
    int moved = 0, stayed = 0;
    for (int y = 4; y < kScene.height - 4; ++y) {
        for (int x = 4; x < kScene.width - 4; ++x) {
            // Σ g gᵀ (p − q) = 0 over the pixels q of 7×7, g by Sobel.
            double xx = 0, xy = 0, yy = 0, bx = 0, by = 0;
            for (int j = -3; j <= 3; ++j) {
                for (int i = -3; i <= 3; ++i) {
                    double gx = 0, gy = 0;
                    for (int k = -1; k <= 1; ++k) {
                        gx +=
                            (2 - std::abs(k)) * (picture.row(y + j + k)[x + i + 1] - picture.row(y + j + k)[x + i - 1]);
                        gy +=
                            (2 - std::abs(k)) * (picture.row(y + j + 1)[x + i + k] - picture.row(y + j - 1)[x + i + k]);
                    }
                    xx += gx * gx;
                    xy += gx * gy;
                    yy += gy * gy;
                    bx += gx * (gx * i + gy * j);
                    by += gy * (gx * i + gy * j);
                }
            }
            const cv::Matx22d tensor(xx, xy, xy, yy);
            const cv::Vec2d shift = tensor.inv() * cv::Vec2d(bx, by);
            const bool near = std::abs(shift[0]) <= 1.5 && std::abs(shift[1]) <= 1.5;
            const cv::Point2f found = refineCorner(picture, x, y);
            EXPECT_NEAR(double(found.x), near ? x + shift[0] : x, 1e-5);
            EXPECT_NEAR(double(found.y), near ? y + shift[1] : y, 1e-5);
            ++(near ? moved : stayed);
        }
    }
    EXPECT_GT(moved, 300);
    EXPECT_GT(stayed, 300);
    // Along an edge there is no such place.
    cv::Mat edge(20, 20, CV_8UC1, cv::Scalar(10));
    edge.colRange(10, 20) = 200;
    PaddedPicture straight;
    straight.copyFrom(edge);
    EXPECT_EQ(refineCorner(straight, 9, 9), cv::Point2f(9, 9));
    straight.copyFrom(cv::Mat(20, 20, CV_8UC1, cv::Scalar(10)));
    EXPECT_EQ(refineCorner(straight, 9, 9), cv::Point2f(9, 9));
}

}  // namespace eyrie::slow_patches_test

#include "registration/corners/corner_strength.h"

#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "support/every_target.h"
#include "support/textured_ground.h"

namespace eyrie::corner_strength_test {
namespace {

PaddedPicture padded(const cv::Mat& gray) {
    PaddedPicture picture;
    picture.copyFrom(gray);
    return picture;
}

/// Strength by the definition, pixel by pixel in double precision.
double slowStrength(const PaddedPicture& p, int x, int y, int radius, double min_roundness) {
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (int j = y - radius; j <= y + radius; ++j) {
        for (int i = x - radius; i <= x + radius; ++i) {
            const auto g = [&](int dx, int dy) { return double(p.row(j + dy)[i + dx]); };
            const double gx = (g(1, -1) + 2 * g(1, 0) + g(1, 1) - g(-1, -1) - 2 * g(-1, 0) - g(-1, 1)) / 8;
            const double gy = (g(-1, 1) + 2 * g(0, 1) + g(1, 1) - g(-1, -1) - 2 * g(0, -1) - g(1, -1)) / 8;
            xx += gx * gx;
            xy += gx * gy;
            yy += gy * gy;
        }
    }
    const double trace = xx + yy;
    const double determinant = xx * yy - xy * xy;
    if (trace <= 0 || 4 * determinant < min_roundness * trace * trace) return 0;
    return determinant / trace;
}

}  // namespace

TEST(CornerStrength, everyInstructionSetFollowsTheDefinition) {
    // A width that is no multiple of any vector length.
    const PaddedPicture picture = padded(test::TexturedGround(3).picture({93, 61}, cv::Matx33d::eye(), 2, 5));
    for (const int radius : {1, 2, 3}) {
        StrengthLimits limits;
        limits.window_radius = radius;
        limits.min_strength = 30;
        limits.min_roundness = 0.1F;
        limits.margin = radius + 2;
        std::map<std::pair<int, int>, double> expected;
        for (int y = limits.margin; y < 61 - limits.margin; ++y) {
            for (int x = limits.margin; x < 93 - limits.margin; ++x) {
                const double here = slowStrength(picture, x, y, radius, 0.1);
                bool peak = here > 30;
                for (int dy = -1; dy <= 1 && peak; ++dy) {
                    for (int dx = -1; dx <= 1; ++dx) {
                        if (dx == 0 && dy == 0) continue;
                        peak = peak && here > slowStrength(picture, x + dx, y + dy, radius, 0.1);
                    }
                }
                if (peak) expected[{y, x}] = here;
            }
        }
        ASSERT_GT(expected.size(), 20U);
        test::forEveryTarget([&](const std::string& name) {
            std::vector<StrengthPeak> peaks;
            findStrengthPeaks(picture, 0, 61, limits, peaks);
            ASSERT_EQ(peaks.size(), expected.size()) << name;
            auto at = expected.begin();
            for (const StrengthPeak& peak : peaks) {
                EXPECT_EQ(std::make_pair(peak.y, peak.x), at->first) << name;
                EXPECT_NEAR(double(peak.strength), at->second, 1e-4 * at->second) << name;
                ++at;
            }
        });
    }
}

TEST(CornerStrength, stripsJoinWithoutSeam) {
    const PaddedPicture picture = padded(test::TexturedGround(4).picture({80, 70}, cv::Matx33d::eye(), 2, 6));
    StrengthLimits limits;
    limits.min_strength = 10;
    std::vector<StrengthPeak> whole;
    findStrengthPeaks(picture, 0, 70, limits, whole);
    std::vector<StrengthPeak> strips;
    for (int y = 0; y < 70; y += 13) findStrengthPeaks(picture, y, std::min(70, y + 13), limits, strips);
    ASSERT_EQ(whole.size(), strips.size());
    for (std::size_t i = 0; i < whole.size(); ++i) {
        EXPECT_EQ(whole[i].x, strips[i].x);
        EXPECT_EQ(whole[i].y, strips[i].y);
        EXPECT_EQ(whole[i].strength, strips[i].strength);
    }
}

TEST(CornerStrength, peaksKeepTheirMarginOnEverySide) {
    const cv::Size size(70, 50);
    const PaddedPicture picture = padded(test::TexturedGround(6).picture(size, cv::Matx33d::eye(), 2, 7));
    for (const int radius : {1, 3}) {
        const auto peaksWith = [&](int margin) {
            StrengthLimits limits;
            limits.window_radius = radius;
            limits.margin = margin;
            std::vector<StrengthPeak> peaks;
            findStrengthPeaks(picture, 0, size.height, limits, peaks);
            std::vector<std::pair<int, int>> places;
            for (const StrengthPeak& peak : peaks) places.emplace_back(peak.x, peak.y);
            return places;
        };
        // The window, the gradient's pixel and a neighbour must be inside in any case.
        const auto all = peaksWith(0);
        ASSERT_GT(all.size(), 15U);
        const int least = radius + 2;
        for (const int margin : {1, least - 1, least, least + 1, 9, 20}) {
            const int kept = std::max(margin, least);
            std::vector<std::pair<int, int>> expected;
            for (const auto& [x, y] : all)
                if (x >= kept && y >= kept && x < size.width - kept && y < size.height - kept)
                    expected.emplace_back(x, y);
            EXPECT_EQ(peaksWith(margin), expected) << radius << " " << margin;
        }
        int left = size.width, right = 0, top = size.height, bottom = 0;
        for (const auto& [x, y] : all) {
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
        EXPECT_GE(left, least);
        EXPECT_LT(right, size.width - least);
        EXPECT_GE(top, least);
        EXPECT_LT(bottom, size.height - least);
    }
}

TEST(CornerStrength, picturesTooSmallForTheWindowHaveNone) {
    for (const cv::Size size : {cv::Size(1, 1), cv::Size(7, 3), cv::Size(8, 8), cv::Size(40, 5)}) {
        const PaddedPicture picture = padded(test::TexturedGround(4).picture(size, cv::Matx33d::eye(), 9, 6));
        StrengthLimits limits;
        std::vector<StrengthPeak> peaks;
        findStrengthPeaks(picture, 0, size.height, limits, peaks);
        EXPECT_TRUE(peaks.empty()) << size;
    }
}

TEST(CornerStrength, refinementFindsWhereEdgesCross) {
    // Quadrants of a checkerboard that meet at a known fraction of a pixel, each pixel the mean over its area.
    for (const double fx : {-0.4, -0.15, 0.0, 0.3}) {
        for (const double fy : {-0.35, 0.1, 0.45}) {
            cv::Mat gray(21, 21, CV_8UC1);
            const auto covered = [](double pixel, double edge) { return std::clamp(edge - (pixel - 0.5), 0.0, 1.0); };
            for (int y = 0; y < 21; ++y) {
                for (int x = 0; x < 21; ++x) {
                    const double left = covered(x, 10 + fx);
                    const double top = covered(y, 10 + fy);
                    const double bright = left * top + (1 - left) * (1 - top);
                    gray.at<std::uint8_t>(y, x) = cv::saturate_cast<std::uint8_t>(40 + 160 * bright);
                }
            }
            const cv::Point2f found = refineCorner(padded(gray), 10, 10);
            EXPECT_NEAR(found.x, 10 + fx, 0.06);
            EXPECT_NEAR(found.y, 10 + fy, 0.06);
        }
    }
}

}  // namespace eyrie::corner_strength_test

// Contours beside the same formulas written down pixel by pixel, and turned with their picture.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <numbers>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "imaging/contours/boundary_cues.h"
#include "imaging/contours/contour_hierarchy.h"
#include "imaging/contours/spectral_contours.h"
#include "imaging/fixed_random.h"

namespace eyrie::contour_reference_test {
namespace {

constexpr double kPi = std::numbers::pi;

/// Blocks and noise, so that every place differs.
cv::Mat scene(cv::Size size, std::uint64_t seed = 4) {
    cv::Mat gray(size, CV_8UC1, cv::Scalar(90));
    cv::rectangle(gray, cv::Rect(size.width / 5, size.height / 4, size.width / 3, size.height / 5), 190, cv::FILLED);
    cv::circle(gray, {2 * size.width / 3, 2 * size.height / 3}, size.height / 6, 30, cv::FILLED);
    cv::Mat noise(size, CV_8UC1);
    cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 25);
    return gray + noise;
}

/// A mirrored border: pixel −1 is pixel 0 (OpenCV's BORDER_REFLECT).
template <class Value>
double mirrored(const cv::Mat& picture, int x, int y) {
    const auto inside = [](int at, int count) {
        while (at < 0 || at >= count) at = at < 0 ? -1 - at : 2 * count - 1 - at;
        return at;
    };
    return picture.at<Value>(inside(y, picture.rows), inside(x, picture.cols));
}

/// χ² distance of both halves' histograms, then the middle of a parabola fitted across the line.
double differencePlainly(const cv::Mat& values, int bins, double blur, double radius, int direction, cv::Point at) {
    const double angle = direction * kPi / 8;
    const auto chi = [&](cv::Point centre) {
        std::vector<double> halves[2] = {std::vector<double>(std::size_t(bins)),
                                         std::vector<double>(std::size_t(bins))};
        double counted[2] = {};
        const int reach = int(radius);
        for (int dy = -reach; dy <= reach; ++dy) {
            for (int dx = -reach; dx <= reach; ++dx) {
                const double across = std::cos(angle) * dy - std::sin(angle) * dx;
                if (std::hypot(dx, dy) > radius || std::abs(across) < 1e-6) continue;
                const int half = across > 0;
                ++halves[half][std::size_t(mirrored<uchar>(values, centre.x + dx, centre.y + dy))];
                ++counted[half];
            }
        }
        const int steps = blur > 0 ? int(std::ceil(2 * blur)) : 0;
        double weights = 0;
        for (int s = -steps; s <= steps; ++s) weights += blur > 0 ? std::exp(-s * s / (2 * blur * blur)) : 1;
        double sum = 0;
        for (int bin = 0; bin < bins; ++bin) {
            double smooth[2] = {};
            for (int s = -steps; s <= steps; ++s) {
                const double weight = (blur > 0 ? std::exp(-s * s / (2 * blur * blur)) : 1) / weights;
                for (const int half : {0, 1})
                    smooth[half] +=
                        weight * halves[half][std::size_t(std::clamp(bin + s, 0, bins - 1))] / counted[half];
            }
            const double both = smooth[0] + smooth[1];
            if (both > 0) sum += std::pow(smooth[0] - smooth[1], 2) / both / 2;
        }
        return sum;
    };
    const int reach = std::max(2, int(std::nearbyint(radius)));
    const double wide = std::max(2.0, radius / 4);
    std::vector<std::array<double, 2>> samples;
    for (int dy = -reach; dy <= reach; ++dy) {
        for (int dx = -reach; dx <= reach; ++dx) {
            const double along = std::cos(angle) * dx + std::sin(angle) * dy;
            const double across = std::cos(angle) * dy - std::sin(angle) * dx;
            if (std::pow(along / reach, 2) + std::pow(across / wide, 2) > 1 + 1e-9) continue;
            // Beyond the picture the distances are mirrored, too.
            const auto inside = [](int p, int count) { return p < 0 ? -1 - p : p >= count ? 2 * count - 1 - p : p; };
            samples.push_back({across, chi({inside(at.x + dx, values.cols), inside(at.y + dy, values.rows)})});
        }
    }
    cv::Mat1d powers(int(samples.size()), 3);
    cv::Mat1d heights(int(samples.size()), 1);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        for (int power = 0; power < 3; ++power) powers(int(i), power) = std::pow(samples[i][0], power);
        heights(int(i)) = samples[i][1];
    }
    cv::Mat1d fit;
    cv::solve(powers, heights, fit, cv::DECOMP_SVD);
    return std::max(0.0, fit(0));
}

DirectedPictures empty(cv::Size size) {
    DirectedPictures pictures;
    for (cv::Mat& picture : pictures) picture = cv::Mat::zeros(size, CV_32F);
    return pictures;
}

/// A quarter turn clockwise: direction k becomes k + 4.
DirectedPictures turned(const DirectedPictures& pictures) {
    DirectedPictures result;
    for (std::size_t k = 0; k < 8; ++k) cv::rotate(pictures[k], result[(k + 4) % 8], cv::ROTATE_90_CLOCKWISE);
    return result;
}

void expectSame(const DirectedPictures& a, const DirectedPictures& b, double tolerance) {
    for (std::size_t k = 0; k < 8; ++k) {
        ASSERT_EQ(a[k].size(), b[k].size());
        EXPECT_LT(cv::norm(a[k], b[k], cv::NORM_INF), tolerance) << "direction " << k;
    }
}

}  // namespace

TEST(ContourReference, HalfDiscsArePlainHistograms) {
    const cv::Mat values = scene({34, 30}) / 16;
    for (const auto& [blur, radius] : {std::pair(0.0, 5.0), {2.5, 2.5}, {1.0, 7.5}, {0.7, 10.0}}) {
        for (const int direction : {0, 1, 3, 4, 6}) {
            const cv::Mat difference = halfDiscDifference(values, 16, blur, radius, direction);
            for (const cv::Point at : {cv::Point(13, 9), {8, 17}, {20, 20}, {0, 14}, {33, 2}, {17, 29}})
                EXPECT_NEAR(difference.at<float>(at), differencePlainly(values, 16, blur, radius, direction, at), 2e-4)
                    << blur << ", " << radius << ", " << direction << ", " << at;
        }
    }
}

TEST(ContourReference, CuesAreTheMeanOverThreeRadiiOfBrightnessAndOfTexture) {
    const cv::Mat gray = scene({30, 26});
    cv::Mat brightness(gray.size(), CV_8UC1);
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) brightness.at<uchar>(y, x) = uchar(gray.at<uchar>(y, x) * 25 / 256);
    }
    const cv::Mat texture = textures(gray, 32);
    DirectedPictures expected = empty(gray.size());
    for (int k = 0; k < 8; ++k) {
        cv::Mat& sum = expected[std::size_t(k)];
        for (const double radius : {2.5, 5.0, 10.0}) sum += halfDiscDifference(brightness, 25, 2.5, radius, k);
        for (const double radius : {5.0, 10.0, 20.0}) sum += halfDiscDifference(texture, 32, 0, radius, k);
        sum /= 6;
    }
    expectSame(boundaryCues(gray), expected, 1e-5);
}

TEST(ContourReference, TexturesAreTheNearestMeansOfFilterResponses) {
    const cv::Mat gray = scene({26, 22});
    constexpr int kReach = 6;
    std::vector<cv::Mat> filters;
    for (int k = 0; k < 8; ++k) {
        for (const bool even : {true, false}) {
            cv::Mat1d filter(2 * kReach + 1, 2 * kReach + 1);
            for (int y = -kReach; y <= kReach; ++y) {
                for (int x = -kReach; x <= kReach; ++x) {
                    // 2 px long and 1 px wide.
                    const double u = (std::cos(k * kPi / 8) * x + std::sin(k * kPi / 8) * y) / 2;
                    const double v = -std::sin(k * kPi / 8) * x + std::cos(k * kPi / 8) * y;
                    filter(y + kReach, x + kReach) = (even ? v * v - 1 : v) * std::exp(-(u * u + v * v) / 2);
                }
            }
            filters.push_back(filter);
        }
    }
    cv::Mat1d surround(2 * kReach + 1, 2 * kReach + 1);
    for (int y = -kReach; y <= kReach; ++y) {
        for (int x = -kReach; x <= kReach; ++x) {
            // Both bells add up to one over the filter's square.
            double narrow = 0, wide = 0;
            for (int i = -kReach; i <= kReach; ++i) {
                narrow += std::exp(-i * i / 4.0);
                wide += std::exp(-i * i / 8.0);
            }
            surround(y + kReach, x + kReach) =
                std::exp(-(x * x + y * y) / 4.0) / (narrow * narrow) - std::exp(-(x * x + y * y) / 8.0) / (wide * wide);
        }
    }
    filters.push_back(surround);
    cv::Mat samples(gray.rows * gray.cols, 17, CV_32F);
    for (int f = 0; f < 17; ++f) {
        cv::Mat1d filter = filters[std::size_t(f)];
        filter -= cv::mean(filter)[0];
        filter /= cv::norm(filter);
        for (int y = 0; y < gray.rows; ++y) {
            for (int x = 0; x < gray.cols; ++x) {
                double sum = 0;
                for (int dy = -kReach; dy <= kReach; ++dy) {
                    for (int dx = -kReach; dx <= kReach; ++dx)
                        sum += filter(dy + kReach, dx + kReach) * mirrored<uchar>(gray, x + dx, y + dy);
                }
                samples.at<float>(y * gray.cols + x, f) = float(std::nearbyint(64 * sum));
            }
        }
    }
    cv::Mat unused, centres;
    {
        const FixedRandom fixed;
        cv::kmeans(samples, 7, unused, {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-2}, 1,
                   cv::KMEANS_PP_CENTERS, centres);
    }
    const cv::Mat numbers = textures(gray, 7);
    int different = 0;
    for (int i = 0; i < samples.rows; ++i) {
        int best = 0;
        for (int k = 1; k < 7; ++k) {
            if (cv::norm(samples.row(i), centres.row(k)) < cv::norm(samples.row(i), centres.row(best))) best = k;
        }
        different += numbers.at<uchar>(i / gray.cols, i % gray.cols) != best;
    }
    EXPECT_LE(different, samples.rows / 20) << "but for what rounding of a step moves";
}

TEST(ContourReference, VibrationsAreThoseOfTheWholeMatrix) {
    cv::Mat contours(11, 13, CV_32F);
    cv::RNG(5).fill(contours, cv::RNG::UNIFORM, 0, 0.4);
    contours.row(6) = 0.8;
    const int pixels = 11 * 13;
    Eigen::MatrixXd w = Eigen::MatrixXd::Zero(pixels, pixels);
    for (int a = 0; a < pixels; ++a) {
        for (int b = 0; b < a; ++b) {
            const cv::Point p(a % 13, a / 13), q(b % 13, b / 13);
            if (std::hypot(p.x - q.x, p.y - q.y) > 5) continue;
            const int steps = std::max(std::abs(p.x - q.x), std::abs(p.y - q.y));
            double strongest = 0;
            // Pixels are numbered from the upper one on, of one row from the left one on.
            for (int s = 0; s <= steps; ++s) {
                const double part = double(s) / steps;
                strongest = std::max(strongest, double(contours.at<float>(cvRound(q.y + part * (p.y - q.y)),
                                                                          cvRound(q.x + part * (p.x - q.x)))));
            }
            w(a, b) = w(b, a) = std::exp(-strongest / 0.1);
        }
    }
    const Eigen::VectorXd d = w.rowwise().sum();
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(d.asDiagonal()) - w,
                                                                           Eigen::MatrixXd(d.asDiagonal()));
    const auto vibrations = slowestVibrations(contours, 6);
    ASSERT_EQ(vibrations.size(), 6U);
    for (int i = 0; i < 6; ++i) {
        EXPECT_NEAR(vibrations[std::size_t(i)].eigenvalue, solver.eigenvalues()(i + 1), 1e-6) << i;
        const Eigen::VectorXd vector = solver.eigenvectors().col(i + 1).normalized();
        double dot = 0;
        for (int a = 0; a < pixels; ++a)
            dot += vector(a) * vibrations[std::size_t(i)].picture.at<float>(a / 13, a % 13);
        EXPECT_NEAR(std::abs(dot), 1, 1e-3) << i;
    }
    EXPECT_EQ(slowestVibrations((cv::Mat_<float>(1, 3) << 0, 0.1, 0.3), 9).size(), 2U);
    EXPECT_TRUE(slowestVibrations(cv::Mat::zeros(1, 2, CV_32F), 9).empty());
    EXPECT_EQ(slowestVibrations((cv::Mat_<float>(2, 2) << 0, 0.1, 0.3, 0.2), 9).size(), 3U)
        << "but for the constant one";
}

TEST(ContourReference, SpectralCuesAddSlopesOfSixteenVibrationsByTheirPeriods) {
    cv::Mat contours(18, 22, CV_32F);
    cv::RNG(6).fill(contours, cv::RNG::UNIFORM, 0, 0.4);
    DirectedPictures expected = empty(contours.size());
    for (const Vibration& vibration : slowestVibrations(contours, 16)) {
        for (int k = 0; k < 8; ++k) {
            double kernel[7][7], norm = 0;
            for (int y = -3; y <= 3; ++y) {
                for (int x = -3; x <= 3; ++x) {
                    const double across = std::cos(k * kPi / 8) * y - std::sin(k * kPi / 8) * x;
                    kernel[y + 3][x + 3] = across * std::exp(-(x * x + y * y) / 2.0);
                    norm += std::abs(kernel[y + 3][x + 3]);
                }
            }
            for (int y = 0; y < 18; ++y) {
                for (int x = 0; x < 22; ++x) {
                    double slope = 0;
                    for (int dy = -3; dy <= 3; ++dy) {
                        for (int dx = -3; dx <= 3; ++dx)
                            slope += kernel[dy + 3][dx + 3] / norm * mirrored<float>(vibration.picture, x + dx, y + dy);
                    }
                    expected[std::size_t(k)].at<float>(y, x) +=
                        float(std::abs(slope) / std::sqrt(vibration.eigenvalue));
                }
            }
        }
    }
    expectSame(spectralCues(contours), expected, 1e-4);
}

TEST(ContourReference, LargePicturesAreHalvedByTheirStrongestContours) {
    // 12,000 pixels at most: 130 × 100 are halved once.
    cv::Mat contours(100, 130, CV_32F);
    cv::RNG(7).fill(contours, cv::RNG::UNIFORM, 0, 0.2);
    contours.col(61) = 0.9;
    cv::Mat small(50, 65, CV_32F);
    for (int y = 0; y < 50; ++y) {
        for (int x = 0; x < 65; ++x) {
            float strongest = 0;
            for (int k = 0; k < 4; ++k)
                strongest = std::max(strongest, contours.at<float>(2 * y + k / 2, 2 * x + k % 2));
            small.at<float>(y, x) = strongest;
        }
    }
    const DirectedPictures cues = spectralCues(contours);
    const auto vibrations = slowestVibrations(small, 16);
    cv::Mat first;
    cv::resize(vibrations[0].picture, first, contours.size(), 0, 0, cv::INTER_LINEAR);
    // The first parts the picture at its column; there the cue of its direction is strongest.
    cv::Point peak;
    cv::Mat columns;
    cv::reduce(cues[4], columns, 0, cv::REDUCE_AVG);
    cv::minMaxLoc(columns.colRange(8, 122), nullptr, nullptr, nullptr, &peak);
    EXPECT_NEAR(peak.x + 8, 61, 3);
    EXPECT_LT(first.at<float>(50, 40) * first.at<float>(50, 90), 0);
    // A line of one pixel parts as well in the smaller picture as it would in the large one.
    EXPECT_LT(vibrations[0].eigenvalue, 0.02);
}

TEST(ContourReference, APictureThatIsTurnedHasTurnedContours) {
    const cv::Mat gray = scene({36, 28});
    cv::Mat turned_gray;
    cv::rotate(gray, turned_gray, cv::ROTATE_90_CLOCKWISE);
    for (int k = 0; k < 8; ++k) {
        cv::Mat expected;
        cv::rotate(halfDiscDifference(gray / 12, 22, 2, 5, k), expected, cv::ROTATE_90_CLOCKWISE);
        EXPECT_LT(cv::norm(halfDiscDifference(turned_gray / 12, 22, 2, 5, (k + 4) % 8), expected, cv::NORM_INF), 1e-4);
    }
    DirectedPictures contours = boundaryCues(gray);
    cv::Mat map;
    cv::rotate(ContourHierarchy(contours).contourMap() > 0.3, map, cv::ROTATE_90_CLOCKWISE);
    EXPECT_GT(cv::countNonZero(map), 10);
    // Lines lie to the left of and above a border, so that they move by a pixel when turned.
    cv::dilate(ContourHierarchy(turned(contours)).contourMap() > 0.3, turned_gray, cv::Mat::ones(3, 3, CV_8U));
    EXPECT_EQ(cv::countNonZero(map & ~turned_gray), 0);
}

TEST(ContourReference, ASegmentsBorderIsAsStrongAsTheMeanAlongIt) {
    // Two basins of 5 columns each; the border between columns 4 and 5 has strengths 1 … 8 down the rows, on either
    // side the stronger pixel counts.
    DirectedPictures contours = empty({10, 8});
    for (int y = 0; y < 8; ++y) {
        contours[4].at<float>(y, 4) = float(y + 1);
        contours[4].at<float>(y, 5) = float(y % 2 == 0 ? y + 2 : y);
        contours[0].at<float>(y, 4) = 0.5F;  // of another direction
    }
    double mean = 0;
    for (int y = 0; y < 8; ++y) mean += (y % 2 == 0 ? y + 2 : y + 1) / 8.0;
    const ContourHierarchy hierarchy(contours);
    const cv::Mat map = hierarchy.contourMap();
    double strongest = 0;
    cv::minMaxLoc(map, nullptr, &strongest);
    EXPECT_NEAR(strongest, mean, 1e-5);
    EXPECT_EQ(cv::countNonZero(map), 8);
    EXPECT_EQ(hierarchy.segmentsAt(mean - 1e-3).at<int>(3, 1), 0);
    EXPECT_NE(hierarchy.segmentsAt(mean - 1e-3).at<int>(3, 8), 0);
    EXPECT_EQ(hierarchy.segmentsAt(mean + 1e-3).at<int>(3, 8), 0);
}

TEST(ContourReference, ABorderTakesTheStrengthOfItsOwnDirection) {
    // Two pixels down for each across, 63 degrees: of the eight directions 67.5 is the nearest; downwards the one way
    // or the other.
    for (const bool leans : {false, true}) {
        for (int direction = 0; direction < 8; ++direction) {
            DirectedPictures contours = empty({30, 24});
            for (int y = 0; y < 24; ++y)
                contours[std::size_t(direction)].at<float>(y, leans ? 21 - y / 2 : 9 + y / 2) = 1;
            double strongest = 0;
            cv::minMaxLoc(ContourHierarchy(contours).contourMap(), nullptr, &strongest);
            const bool its_own = direction == (leans ? 5 : 3);
            EXPECT_EQ(strongest > 0.6, its_own) << direction << ", " << leans << ": " << strongest;
        }
    }
}

TEST(ContourReference, JoinedBordersAddUp) {
    // Three basins side by side of a 15 × 6 picture, the lower half of the right one apart: strengths 1, 3 and 2.
    DirectedPictures contours = empty({15, 6});
    contours[4].col(4) = 1;
    contours[4].col(9) = 3;
    contours[0].row(2).colRange(10, 15) = 2;
    const ContourHierarchy hierarchy(contours);
    const auto count = [&](double level) {
        double highest = 0;
        cv::minMaxLoc(hierarchy.segmentsAt(level), nullptr, &highest);
        return int(highest) + 1;
    };
    EXPECT_EQ(count(0.5), 4);
    EXPECT_EQ(count(1.1), 3);
    EXPECT_EQ(count(2.1), 2);
    EXPECT_EQ(count(2.9), 2) << "the border of both on the right is as strong as its parts";
    EXPECT_EQ(count(3.1), 1);
}

TEST(ContourReference, BoundariesAreHalfLocalAndHalfSpectral) {
    const cv::Mat gray = scene({40, 34});
    DirectedPictures local = boundaryCues(gray);
    const auto strongest = [](const DirectedPictures& pictures) {
        cv::Mat result = pictures[0].clone();
        for (const cv::Mat& picture : pictures) result = cv::max(result, picture);
        return result;
    };
    const auto hundredth = [](const cv::Mat& picture) {
        std::vector<float> values(picture.begin<float>(), picture.end<float>());
        std::sort(values.begin(), values.end());
        return double(values[values.size() * 99 / 100]);
    };
    const DirectedPictures spectral = spectralCues(strongest(local));
    const double share = hundredth(strongest(local)) / hundredth(strongest(spectral));
    for (std::size_t k = 0; k < 8; ++k) {
        local[k] = (local[k] + spectral[k] * share) / 2;
        local[k].setTo(0, local[k] <= 1e-3);
    }
    expectSame(probabilityOfBoundary(gray), local, 1e-5);
}

}  // namespace eyrie::contour_reference_test

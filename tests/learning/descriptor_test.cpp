#include "learning/descriptors/descriptor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "learning/descriptors/channel_features.h"
#include "learning/descriptors/haralick.h"
#include "learning/descriptors/multi_lbp_descriptor.h"
#include "learning/drawn_windows.h"

namespace eyrie::descriptor_test {
namespace {

std::vector<float> valuesOf(DescriptorKind kind, const cv::Mat& window) {
    const auto descriptor = makeDescriptor(kind, 7);
    std::vector<float> values(static_cast<std::size_t>(descriptor->dimension()));
    descriptor->compute(window, values);
    return values;
}

double at(const cv::Mat& image, int x, int y) {
    return image.at<uchar>(std::clamp(y, 0, image.rows - 1), std::clamp(x, 0, image.cols - 1));
}

void expectNear(const std::vector<float>& values, const std::vector<double>& expected, double tolerance) {
    ASSERT_EQ(values.size(), expected.size());
    for (std::size_t i = 0; i < values.size(); ++i) {
        ASSERT_NEAR(values[i], expected[i], tolerance * (1 + std::abs(expected[i]))) << "value " << i;
    }
}

}  // namespace

TEST(Descriptor, hasTheDimensionsOfTheThesis) {
    const std::map<DescriptorKind, int> dimensions{{DescriptorKind::moments, 178},
                                                   {DescriptorKind::dct, 441},
                                                   {DescriptorKind::hog, 756},
                                                   {DescriptorKind::channel_features, 2000},
                                                   {DescriptorKind::multi_lbp, 8192}};
    for (const DescriptorKind kind : allDescriptors()) {
        EXPECT_EQ(makeDescriptor(kind, 1)->dimension(), dimensions.at(kind)) << nameOf(kind);
        EXPECT_EQ(makeDescriptor(kind, 1)->kind(), kind);
        EXPECT_EQ(descriptorFromName(nameOf(kind)), kind);
    }
    EXPECT_THROW(descriptorFromName("hogg"), Error);
}

TEST(Descriptor, isCalledByNoAbbreviationOfTheCommandLineBeforePeople) {
    std::set<std::string> titles;
    for (const DescriptorKind kind : allDescriptors()) titles.insert(titleOf(kind));
    EXPECT_EQ(titles, (std::set<std::string>{"moments", "DCT", "HOG", "channel features", "Multi-LBP"}));
}

TEST(Descriptor, isFiniteOnFlatAndExtremeWindows) {
    cv::Mat split(kWindowHeight, kWindowWidth, CV_8UC1, cv::Scalar(0));
    split.colRange(8, 16).setTo(255);
    const cv::Mat flat(kWindowHeight, kWindowWidth, CV_8UC1, cv::Scalar(93));
    for (const DescriptorKind kind : allDescriptors()) {
        for (const cv::Mat& window : {flat, split, test::noiseWindow(3)}) {
            for (const float value : valuesOf(kind, window)) ASSERT_TRUE(std::isfinite(value)) << nameOf(kind);
        }
    }
}

TEST(Descriptor, refusesWhatIsNoWindow) {
    for (const DescriptorKind kind : allDescriptors()) {
        const auto descriptor = makeDescriptor(kind, 1);
        std::vector<float> values(static_cast<std::size_t>(descriptor->dimension()));
        EXPECT_THROW(descriptor->compute(cv::Mat(16, 32, CV_8UC1), values), Error) << nameOf(kind);
        EXPECT_THROW(descriptor->compute(cv::Mat(32, 16, CV_32FC1), values), Error) << nameOf(kind);
    }
}

TEST(Descriptor, dctEqualsTheDoubleSum) {
    const cv::Mat window = test::noiseWindow(1);
    // Zigzag as everybody writes it down: (column frequency, row frequency).
    const int zigzag[21][2] = {{0, 0}, {1, 0}, {0, 1}, {0, 2}, {1, 1}, {2, 0}, {3, 0}, {2, 1}, {1, 2}, {0, 3}, {0, 4},
                               {1, 3}, {2, 2}, {3, 1}, {4, 0}, {5, 0}, {4, 1}, {3, 2}, {2, 3}, {1, 4}, {0, 5}};
    std::vector<double> expected;
    for (int top = 0; top <= 24; top += 4) {
        for (int left = 0; left <= 8; left += 4) {
            for (const auto& [u, v] : zigzag) {
                double sum = 0;
                for (int y = 0; y < 8; ++y) {
                    for (int x = 0; x < 8; ++x) {
                        sum += at(window, left + x, top + y) * std::cos((2 * x + 1) * u * kPi / 16) *
                               std::cos((2 * y + 1) * v * kPi / 16);
                    }
                }
                expected.push_back(sum / 4 * (u == 0 ? std::sqrt(0.5) : 1) * (v == 0 ? std::sqrt(0.5) : 1));
            }
        }
    }
    expectNear(valuesOf(DescriptorKind::dct, window), expected, 1e-4);
}

TEST(Descriptor, hogEqualsTheObviousLoops) {
    const cv::Mat window = test::noiseWindow(2);
    std::vector<double> expected;
    for (int top = 0; top <= 24; top += 4) {
        for (int left = 0; left <= 8; left += 4) {
            std::vector<double> block;
            for (const cv::Point cell : {cv::Point(0, 0), cv::Point(4, 0), cv::Point(0, 4), cv::Point(4, 4)}) {
                for (int bin = 0; bin < 9; ++bin) {
                    double sum = 0;
                    for (int y = top + cell.y; y < top + cell.y + 4; ++y) {
                        for (int x = left + cell.x; x < left + cell.x + 4; ++x) {
                            const double gx = at(window, x + 1, y) - at(window, x - 1, y);
                            const double gy = at(window, x, y + 1) - at(window, x, y - 1);
                            // Share of this bin: a triangle of 20° to both sides of its centre.
                            const double angle = std::atan2(gy, gx) * 180 / kPi;
                            const double off = std::abs(std::remainder(angle - (10 + 20 * bin), 180.0));
                            sum += std::hypot(gx, gy) * std::max(0.0, 1 - off / 20);
                        }
                    }
                    block.push_back(sum);
                }
            }
            double length = 1;
            for (const double v : block) length += v * v;
            for (double& v : block) v = std::min(0.2, v / std::sqrt(length));
            length = 1e-12;
            for (const double v : block) length += v * v;
            for (const double v : block) expected.push_back(v / std::sqrt(length));
        }
    }
    expectNear(valuesOf(DescriptorKind::hog, window), expected, 1e-4);
}

TEST(Descriptor, multiLbpEqualsCountingBitByBit) {
    cv::Mat window = test::noiseWindow(4);
    window /= 16;  // so that differences around the threshold and ties occur
    window *= 3;
    const int t = MultiLbpDescriptor::kThreshold;
    const cv::Point neighbours[8] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    std::vector<double> expected(8192, 0);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 16; ++x) {
            for (int quantisation = 0; quantisation < 4; ++quantisation) {
                int pattern = 0;
                for (int p = 0; p < 8; ++p) {
                    const double d = at(window, x + neighbours[p].x, y + neighbours[p].y) - at(window, x, y);
                    const bool bits[4] = {d >= 0, d >= t, d >= -t, std::abs(d) >= t};
                    if (bits[quantisation]) pattern += 1 << p;
                }
                const int block = (y / 8) * 2 + x / 8;
                expected[static_cast<std::size_t>((block * 4 + quantisation) * 256 + pattern)] += 1.0 / 64;
            }
        }
    }
    const auto values = valuesOf(DescriptorKind::multi_lbp, window);
    expectNear(values, expected, 1e-6);
    double total = 0;
    for (const float v : values) total += v;
    EXPECT_NEAR(total, 32, 1e-4) << "eight blocks, four histograms of sum 1 each";
}

TEST(Descriptor, channelFeaturesEqualSumsOverPixels) {
    const cv::Mat window = test::noiseWindow(5);
    cv::Mat1i channels[7];
    for (auto& channel : channels) channel = cv::Mat1i::zeros(window.size());
    for (int y = 1; y < 31; ++y) {
        for (int x = 1; x < 15; ++x) {
            const double gx = at(window, x + 1, y) - at(window, x - 1, y);
            const double gy = at(window, x, y + 1) - at(window, x, y - 1);
            const int magnitude = static_cast<int>(std::min(127.0, std::nearbyint(std::hypot(gx, gy) / 2)));
            const double axis = std::fmod(std::atan2(gy, gx) * 180 / kPi + 360, 180.0);
            channels[0](y, x) = magnitude;
            if (magnitude == 0) continue;
            const double turns = axis / 30;
            // On a border both bins are as near; the one towards the horizontal is taken.
            const bool tie = std::abs(turns - std::floor(turns) - 0.5) < 1e-9;
            const int bin = tie ? (axis < 90 ? static_cast<int>(turns) : static_cast<int>(turns) + 1)
                                : static_cast<int>(std::lround(turns));
            channels[1 + bin % 6](y, x) = magnitude;
        }
    }
    const auto rectangles = randomRectangles(7);
    const auto values = valuesOf(DescriptorKind::channel_features, window);
    for (std::size_t i = 0; i < rectangles.size(); ++i) {
        int expected = 0;
        const auto& [channel, area] = rectangles[i];
        for (int y = area.y; y < area.y + area.height; ++y) {
            for (int x = area.x; x < area.x + area.width; ++x) expected += channels[channel](y, x);
        }
        ASSERT_EQ(values[i], expected) << "feature " << i;
    }
}

TEST(Descriptor, channelRectanglesAreThoseOfTheSeedAndKeepOffTheOuterRing) {
    const auto rectangles = randomRectangles(11);
    EXPECT_EQ(rectangles.size(), 2000U);
    EXPECT_EQ(rectangles, randomRectangles(11));
    EXPECT_NE(rectangles, randomRectangles(12));
    std::set<int> channels;
    for (const auto& r : rectangles) {
        EXPECT_TRUE(isAllowed(r));
        channels.insert(r.channel);
    }
    EXPECT_EQ(channels.size(), 7U);
    EXPECT_THROW(ChannelFeatures({{0, cv::Rect(0, 1, 3, 3)}}), Error);
    EXPECT_THROW(ChannelFeatures({{7, cv::Rect(1, 1, 3, 3)}}), Error);
    EXPECT_THROW(ChannelFeatures({{0, cv::Rect(1, 20, 3, 12)}}), Error);
}

TEST(Descriptor, mirroringAWindowMirrorsItsChannels) {
    const cv::Mat window = test::noiseWindow(6);
    const IntegralChannels plain(window);
    const IntegralChannels mirrored(mirroredAcross(window));
    const int mirror_of[7] = {0, 1, 6, 5, 4, 3, 2};
    for (int c = 0; c < 7; ++c) {
        for (int x = 1; x < 15; ++x) {
            for (int y = 1; y < 31; ++y) {
                ASSERT_EQ(plain.sum(c, {x, y, 1, 1}), mirrored.sum(mirror_of[c], {15 - x, y, 1, 1})) << c;
            }
        }
    }
}

TEST(Descriptor, integralChannelsOfLargeImagesStayExactForWindows) {
    // Strongest gradients everywhere, so that the running sums wrap around many times.
    cv::Mat image(200, 333, CV_8UC1);
    for (int y = 0; y < image.rows; ++y) {
        for (int x = 0; x < image.cols; ++x) image.at<uchar>(y, x) = (x / 2) % 2 == 0 ? 0 : 255;
    }
    const IntegralChannels channels(image);
    EXPECT_EQ(channels.sum(0, {300, 160, 14, 30}), 127 * 14 * 30);
    EXPECT_EQ(channels.sum(1, {300, 160, 14, 30}), 127 * 14 * 30);
    EXPECT_EQ(channels.sum(4, {300, 160, 14, 30}), 0);
    EXPECT_EQ(channels.sum(0, {0, 0, 1, 200}), 0) << "the outermost ring has no gradient";
}

TEST(Descriptor, haralickFeaturesOfSmallTexturesByHand) {
    // Columns 0 1 0 1 …: every horizontal pair is (0, 1) or (1, 0).
    cv::Mat stripes(4, 8, CV_8UC1);
    for (int x = 0; x < 8; ++x) stripes.col(x).setTo(x % 2);
    const auto across = haralickFeatures(stripes, {1, 0});
    EXPECT_NEAR(across[0], 0.5, 1e-6) << "angular second moment: two equal shares";
    EXPECT_NEAR(across[1], 1, 1e-6) << "contrast";
    EXPECT_NEAR(across[2], -1, 1e-6) << "correlation";
    EXPECT_NEAR(across[3], 0.25, 1e-6) << "variance";
    EXPECT_NEAR(across[4], 0.5, 1e-6) << "inverse difference moment";
    EXPECT_NEAR(across[5], 1, 1e-6) << "sum average";
    EXPECT_NEAR(across[6], 0, 1e-6) << "sum variance";
    EXPECT_NEAR(across[7], 0, 1e-6) << "sum entropy";
    EXPECT_NEAR(across[8], 1, 1e-6) << "entropy, bits";
    EXPECT_NEAR(across[9], 0, 1e-6) << "difference variance";
    EXPECT_NEAR(across[11], -1, 1e-6) << "each neighbour tells the other: all information is shared";
    EXPECT_NEAR(across[12], std::sqrt(1 - std::exp(-2.0)), 1e-6);
    const auto down = haralickFeatures(stripes, {0, -1});
    EXPECT_NEAR(down[1], 0, 1e-6) << "along the stripes there is no contrast";
    EXPECT_NEAR(down[2], 1, 1e-6);
}

TEST(Descriptor, momentsEqualSlowSumsAndIgnoreThePolarity) {
    cv::Mat window(32, 16, CV_8UC1, cv::Scalar(100));
    cv::rectangle(window, cv::Rect(4, 8, 6, 14), cv::Scalar(150), cv::FILLED);
    const auto values = valuesOf(DescriptorKind::moments, window);
    const double mass = 50.0 * 6 * 14;
    EXPECT_NEAR(values[7], mass / 512, 1e-4);
    EXPECT_NEAR(values[8], 6.5 - 7.5, 1e-5) << "centroid";
    EXPECT_NEAR(values[9], 14.5 - 15.5, 1e-5);
    const auto scaled = [](double v) { return std::copysign(std::log10(1 + 1e6 * std::abs(v)), v); };
    double m[5][5] = {};
    for (int y = 8; y < 22; ++y) {
        for (int x = 4; x < 10; ++x) {
            for (int p = 0; p < 5; ++p) {
                for (int q = 0; q < 5; ++q) m[p][q] += 50 * std::pow(x - 6.5, p) * std::pow(y - 14.5, q);
            }
        }
    }
    std::size_t next = 10;
    for (int order = 2; order <= 4; ++order) {
        for (int p = order; p >= 0; --p) {
            EXPECT_NEAR(values[next++], scaled(m[p][order - p] / std::pow(mass, 1 + order / 2.0)), 1e-4) << p;
        }
    }
    EXPECT_NEAR(values[0], scaled((m[2][0] + m[0][2]) / (mass * mass)), 1e-4) << "Hu's first invariant";
    cv::Mat dark;
    cv::subtract(cv::Scalar(200), window, dark);  // ground 100, vehicle 50
    const auto dark_values = valuesOf(DescriptorKind::moments, dark);
    for (std::size_t i = 0; i < 22; ++i) EXPECT_NEAR(values[i], dark_values[i], 1e-4) << i;
}

TEST(Descriptor, aPlainWindowHasItsMassNowhere) {
    const auto values =
        valuesOf(DescriptorKind::moments, cv::Mat(kWindowHeight, kWindowWidth, CV_8UC1, cv::Scalar(77)));
    // Hu's invariants, the mass, its middle from that of the window, and moments of order 2 to 4.
    for (std::size_t i = 0; i < 7 + 3 + 12; ++i) EXPECT_EQ(values[i], 0) << i;
}

TEST(Descriptor, huInvariantsAreThoseOfComplexMoments) {
    // c_pq = Σ (x + iy)^p (x − iy)^q f: the seven of Hu (1962) are c11, |c20|², |c30|², |c21|², Re(c30 c12³),
    // Re(c20 c12²) and Im(c30 c12³).
    cv::Mat window(32, 16, CV_8UC1, cv::Scalar(60));
    for (const cv::Point p : {cv::Point(4, 10), {5, 10}, {6, 10}, {4, 11}, {4, 12}, {4, 13}, {5, 13}, {7, 14}, {9, 15}})
        window.at<uchar>(p) = static_cast<uchar>(150 + 7 * p.x);
    double mass = 0;
    cv::Point2d centre(0, 0);
    const auto each = [&](const auto& take) {
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 16; ++x) take(x, y, window.at<uchar>(y, x) - 60.0);
        }
    };
    each([&](int x, int y, double f) {
        mass += f;
        centre += cv::Point2d(x * f, y * f);
    });
    centre /= mass;
    const auto c = [&](int p, int q) {
        std::complex<double> sum = 0;
        each([&](int x, int y, double f) {
            const std::complex<double> z(x - centre.x, y - centre.y);
            sum += std::pow(z, p) * std::pow(std::conj(z), q) * f;
        });
        return sum / std::pow(mass, 1 + (p + q) / 2.0);
    };
    const std::complex<double> c12 = c(1, 2);
    const double expected[7] = {c(1, 1).real(),
                                std::norm(c(2, 0)),
                                std::norm(c(3, 0)),
                                std::norm(c(2, 1)),
                                (c(3, 0) * c12 * c12 * c12).real(),
                                (c(2, 0) * c12 * c12).real(),
                                (c(3, 0) * c12 * c12 * c12).imag()};
    const auto values = valuesOf(DescriptorKind::moments, window);
    for (std::size_t i = 0; i < 7; ++i) {
        const double scaled = std::copysign(std::log10(1 + 1e6 * std::abs(expected[i])), expected[i]);
        EXPECT_NEAR(values[i], scaled, 1e-4 * (1 + std::abs(scaled))) << i;
    }
}

TEST(Descriptor, groundIsTheMedianOfTheOutermostPixels) {
    // Two of the four sides are 150, all others 100; the larger pair decides.
    for (const bool sides : {true, false}) {
        cv::Mat window(32, 16, CV_8UC1, cv::Scalar(100));
        window.rowRange(1, 31).col(0).setTo(150);
        window.rowRange(1, 31).col(15).setTo(150);
        if (!sides) window.colRange(0, 16).rowRange(2, 31).setTo(100);  // one row of two pixels is left
        // 60 of 92 pixels are 150, or 2: all others differ by 50.
        const double different = sides ? 32 * 16 - 60 : 2;
        EXPECT_NEAR(valuesOf(DescriptorKind::moments, window)[7], different * 50 / 512, 1e-4) << sides;
    }
}

TEST(Descriptor, everyOutermostPixelCountsOnceForTheGround) {
    // Half of the 92 are 100: upper and lower row and 14 of the sides. Of as many of both the brighter is the median.
    cv::Mat window(32, 16, CV_8UC1, cv::Scalar(150));
    window.row(0).setTo(100);
    window.row(31).setTo(100);
    window.rowRange(1, 8).col(0).setTo(100);
    window.rowRange(1, 8).col(15).setTo(100);
    EXPECT_NEAR(valuesOf(DescriptorKind::moments, window)[7], 46 * 50 / 512., 1e-4);
}

TEST(Descriptor, huInvariantsDoNotChangeWhenTheBlobIsTurnedByARightAngle) {
    cv::Mat window(32, 16, CV_8UC1, cv::Scalar(60));
    cv::Mat turned = window.clone();
    const std::vector<cv::Point> blob{{4, 10}, {5, 10}, {6, 10}, {4, 11}, {4, 12}, {4, 13}, {5, 13}, {7, 14}};
    for (const cv::Point p : blob) {
        window.at<uchar>(p) = 200;
        turned.at<uchar>(p.x + 8, 20 - p.y) = 200;  // turned by 90°
    }
    const auto a = valuesOf(DescriptorKind::moments, window);
    const auto b = valuesOf(DescriptorKind::moments, turned);
    for (std::size_t i = 0; i < 7; ++i) EXPECT_NEAR(a[i], b[i], 1e-3) << i;
}

}  // namespace eyrie::descriptor_test

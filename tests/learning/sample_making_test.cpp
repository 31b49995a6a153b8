// What training makes of samples and pictures, window by window, with the same random numbers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "learning/descriptors/haralick.h"
#include "learning/drawn_windows.h"
#include "learning/training/labelled_frames.h"
#include "learning/training/trainer.h"

namespace eyrie::sample_making_test {
namespace {

/// Grey value between pixels; beyond the picture its border is repeated.
double sampledAt(const cv::Mat& gray, cv::Point2d p) {
    const auto at = [&](int x, int y) {
        return double(gray.at<uchar>(std::clamp(y, 0, gray.rows - 1), std::clamp(x, 0, gray.cols - 1)));
    };
    const int x = int(std::floor(p.x)), y = int(std::floor(p.y));
    const double fx = p.x - x, fy = p.y - y;
    return (1 - fy) * ((1 - fx) * at(x, y) + fx * at(x + 1, y)) +
           fy * ((1 - fx) * at(x, y + 1) + fx * at(x + 1, y + 1));
}

/// A smooth pattern in which every place and direction looks different.
cv::Mat pattern(cv::Size size, std::uint64_t seed = 3) {
    cv::Mat noise(size, CV_8UC1), smooth;
    cv::RNG(seed).fill(noise, cv::RNG::UNIFORM, 0, 256);
    cv::GaussianBlur(noise, smooth, {}, 2.5);
    cv::normalize(smooth, smooth, 0, 255, cv::NORM_MINMAX);
    return smooth;
}

bool isOneOf(const cv::Mat& window, const SampleSet& samples) {
    return std::any_of(samples.begin(), samples.end(),
                       [&](const Sample& sample) { return cv::norm(sample.window, window, cv::NORM_INF) == 0; });
}

/// Means and inverse deviations of all features that a Random Naïve Bayes was trained on: they come first in its bytes.
std::vector<std::vector<float>> momentsOf(const VehicleModel& model) {
    ByteWriter out;
    model.classifier->write(out);
    ByteReader in(out.bytes(), "memory");
    return {in.getAll<float>(100000, "means"), in.getAll<float>(100000, "scales")};
}

/// A training that tells what it was trained on.
TrainingOptions telling() {
    TrainingOptions options;
    options.descriptor = DescriptorKind::dct;
    options.classifier = ClassifierKind::random_naive_bayes;
    options.classifier_options.weak_classifiers = 1;
    options.classifier_options.max_weak_error = 1;
    options.hard_negative_rounds = 0;
    options.seed = 5;
    return options;
}

void expectTrainedOn(const std::vector<cv::Mat>& windows, const VehicleModel& model) {
    cv::Mat1f features(0, 441);
    for (const cv::Mat& window : windows) {
        cv::Mat1f row(1, 441);
        makeDescriptor(DescriptorKind::dct, 1)->compute(window, {row[0], 441});
        features.push_back(row);
    }
    const auto moments = momentsOf(model);
    for (int f = 0; f < 441; ++f) {
        double mean = 0, square = 0;
        for (int i = 0; i < features.rows; ++i) mean += features(i, f) / double(features.rows);
        for (int i = 0; i < features.rows; ++i) square += std::pow(features(i, f) - mean, 2) / features.rows;
        ASSERT_NEAR(moments[0][std::size_t(f)], mean, 1e-3) << f;
        ASSERT_NEAR(1 / moments[1][std::size_t(f)], std::sqrt(square), 1e-3 + 1e-3 * std::sqrt(square)) << f;
    }
}

/// The same window moved; what comes in repeats its border.
cv::Mat moved(const cv::Mat& window, int across, int along) {
    cv::Mat result(window.size(), CV_8UC1);
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 16; ++x)
            result.at<uchar>(y, x) = window.at<uchar>(std::clamp(y + along, 0, 31), std::clamp(x + across, 0, 15));
    }
    return result;
}

/// The windows of a training without hard negatives, in no order.
std::vector<cv::Mat> preparedPlainly(const SampleSet& samples, const TrainingOptions& options) {
    SeededRandom random(static_cast<std::uint64_t>(options.seed));
    std::vector<cv::Mat> vehicles, misfits, pool;
    for (const Sample& sample : samples) {
        if (!sample.vehicle) {
            pool.push_back(sample.window);
            continue;
        }
        std::vector<cv::Mat> versions{sample.window};
        if (options.mirrored) {
            for (const int how : {1, 0, -1}) cv::flip(sample.window, versions.emplace_back(), how);
        }
        vehicles.insert(vehicles.end(), versions.begin(), versions.end());
        for (int copy = 0; copy < options.varied_copies; ++copy) {
            const cv::Mat from = versions[std::size_t(random.below(int(versions.size())))];
            const double factor = random.between(1 - options.contrast_change, 1 + options.contrast_change);
            const double mean = cv::mean(from)[0];
            cv::Mat varied = from.clone();
            for (uchar& pixel : cv::Mat1b(varied)) pixel = cv::saturate_cast<uchar>(mean + factor * (pixel - mean));
            vehicles.push_back(varied);
        }
        for (int copy = 0; copy < options.misfit_copies; ++copy) {
            const int kind = random.below(5);
            const auto side = [&] { return random.below(2) == 0 ? -1 : 1; };
            if (kind == 0) {
                // 20 … 23 of 32 rows fill the window.
                const int rows = 20 + random.below(4);
                cv::Mat stretched;
                const cv::Mat middle = sample.window.rowRange((32 - rows) / 2, (32 + rows) / 2);
                cv::resize(middle, stretched, {16, 32}, 0, 0, cv::INTER_LINEAR);
                misfits.push_back(stretched);
                continue;
            }
            int across = 0, along = 0;
            if (kind == 1) {
                const int direction = side();
                across = direction * (4 + random.below(5));
                along = random.below(7) - 3;
            } else if (kind == 2) {
                const int first = side();
                across = first * (3 + random.below(4));
                const int second = side();
                along = second * (5 + random.below(7));
            } else {
                across = random.below(3) - 1;
                const int direction = side();
                along = direction * (7 + random.below(7));
            }
            misfits.push_back(moved(sample.window, across, along));
        }
    }
    random.shuffle(pool);
    const auto wanted = std::size_t(std::lround(options.others_per_vehicle * double(vehicles.size())));
    std::vector<cv::Mat> all = vehicles;
    all.insert(all.end(), misfits.begin(), misfits.end());
    all.insert(all.end(), pool.end() - std::ptrdiff_t(std::min(wanted, pool.size())), pool.end());
    return all;
}

SampleSet patternSamples(int vehicles, int others) {
    SampleSet samples;
    for (int i = 0; i < vehicles + others; ++i)
        samples.push_back({pattern({16, 32}, std::uint64_t(i + 1)), i < vehicles, "drawn", "", false});
    return samples;
}

}  // namespace

TEST(SampleMaking, VehiclesAreMirroredAndVariedAndOthersDrawnFromThePool) {
    TrainingOptions options = telling();
    options.misfit_copies = 0;
    options.others_per_vehicle = 0.7;
    const SampleSet samples = patternSamples(12, 80);
    for (const bool mirrored : {true, false}) {
        for (const int copies : {0, 3}) {
            options.mirrored = mirrored;
            options.varied_copies = copies;
            expectTrainedOn(preparedPlainly(samples, options), *trainModel(samples, options, {}));
        }
    }
    options.others_per_vehicle = 90;
    expectTrainedOn(preparedPlainly(samples, options), *trainModel(samples, options, {}));
}

TEST(SampleMaking, MisfitsAreMovedOrStretched) {
    TrainingOptions options = telling();
    options.varied_copies = 0;
    options.misfit_copies = 6;
    options.mirrored = false;
    for (const int seed : {5, 6, 7}) {
        options.seed = seed;
        const SampleSet samples = patternSamples(12, 30);
        expectTrainedOn(preparedPlainly(samples, options), *trainModel(samples, options, {}));
    }
}

TEST(SampleMaking, HardNegativesAreTheOthersThatLookMostLikeVehicles) {
    // Of the pool the first round takes some; the second one those of the rest that the first model rates highest.
    const SampleSet samples = test::drawnSamples(20, 90, 3);
    TrainingOptions options = telling();
    options.misfit_copies = 0;
    options.varied_copies = 0;
    options.mirrored = false;
    const auto first = trainModel(samples, options, {});
    std::vector<cv::Mat> windows = preparedPlainly(samples, options);
    std::vector<std::pair<double, cv::Mat>> rest;
    for (const Sample& sample : samples) {
        const bool used = std::any_of(windows.begin(), windows.end(), [&](const cv::Mat& window) {
            return cv::norm(window, sample.window, cv::NORM_INF) == 0;
        });
        if (!used) rest.emplace_back(first->decide(sample.window), sample.window);
    }
    ASSERT_EQ(rest.size(), 70U);
    std::sort(rest.begin(), rest.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    options.hard_others_per_vehicle = 1.3;
    options.hard_negative_rounds = 1;
    for (std::size_t i = 0; i < 26; ++i) windows.push_back(rest[i].second);
    expectTrainedOn(windows, *trainModel(samples, options, {}));
    // What another source finds is added, too.
    const cv::Mat found = pattern({16, 32}, 99);
    int asked_for = 0;
    const auto more = [&](const VehicleModel&, int wanted) {
        asked_for = wanted;
        return SampleSet{{found, false, "", "", false}};
    };
    windows.push_back(found);
    expectTrainedOn(windows, *trainModel(samples, options, {}, {}, more));
    EXPECT_EQ(asked_for, 26);
}

TEST(SampleMaking, AWindowIsSampledInTheVehiclesAxes) {
    const cv::Mat gray = pattern({200, 160});
    for (const OrientedBox& box : {OrientedBox{{90.3, 70.6}, 21.5, 10, -kPi / 2},
                                   {{60, 90}, 15, 8, 0.7},
                                   {{100.2, 80}, 26.7, 12.4, -2.1},
                                   {{100, 80}, 60, 14, 2.4},
                                   {{90, 70}, 28, 31, 0.2}}) {
        const double across = box.width / 10, along = box.length / 21.5;
        // So many samples a pixel and direction that they lie at most 1.25 px apart.
        const int finer = std::max(1, int(std::ceil(std::max(across, along) - 0.25)));
        const cv::Mat window = cutWindow(gray, box);
        double off = 0;
        for (int y = 0; y < 32; ++y) {
            for (int x = 0; x < 16; ++x) {
                double mean = 0;
                for (int k = 0; k < finer * finer; ++k) {
                    const double dx = x - 7.5 + (k % finer + 0.5) / finer - 0.5;
                    const double dy = y - 15.5 + (k / finer + 0.5) / finer - 0.5;
                    mean += sampledAt(gray, box.toImage({-dy * along, dx * across})) / (finer * finer);
                }
                off = std::max(off, std::abs(mean - window.at<uchar>(y, x)));
            }
        }
        EXPECT_LT(off, 3) << box.length << ", " << box.heading;
    }
    // As fine as sixteen samples a pixel at most, for boxes of up to 100,000 px.
    const cv::Mat wide = cutWindow(pattern({900, 900}), {{450, 450}, 600, 500, 0.3});
    EXPECT_EQ(wide.size(), cv::Size(16, 32));
    EXPECT_NO_THROW(cutWindow(gray, {{0, 0}, 99999, 10, 0}));
    EXPECT_ANY_THROW(cutWindow(gray, {{0, 0}, 100001, 10, 0}));
    EXPECT_ANY_THROW(cutWindow(gray, {{0, 0}, 10, 100001, 0}));
    EXPECT_ANY_THROW(cutWindow(gray, {{0, -100001}, 10, 10, 0}));
    EXPECT_ANY_THROW(cutWindow(gray, {{100001, 0}, 10, 10, 0}));
    EXPECT_ANY_THROW(cutWindow(gray, {{0, 0}, 10, 10, NAN}));
}

TEST(SampleMaking, OthersLieBesideEveryFourthTimeAndAnywhereOtherwise) {
    LabelledImage image;
    image.gray = pattern({240, 200});
    image.vehicles = {{{60, 60}, 24, 11, 0.4}, {{150, 120}, 20, 10, -1.2}, {{190, 50}, 30, 13, 2}};
    image.unclear = {{{100, 160}, 60, 30, 0.2}};
    constexpr std::uint64_t kSeed = 8;
    constexpr int kOthers = 60;
    SampleSet expected;
    for (const OrientedBox& box : image.vehicles) expected.push_back({cutWindow(image.gray, box), true, "", "", false});
    SeededRandom random(kSeed);
    const OrientedBox typical{{0, 0}, 24, 11, 0};  // the medians
    const auto insideBy = [&](const OrientedBox& box, const OrientedBox& other) {
        return intersectionArea(box, other) / box.area();
    };
    int taken = 0;
    for (int attempt = 0; attempt < 40 * kOthers && taken < kOthers; ++attempt) {
        OrientedBox box = typical;
        bool good = true;
        if (taken % 4 == 0) {
            box = image.vehicles[std::size_t(random.below(3))];
            const bool along = random.below(2) == 0;
            const double side = random.below(2) == 0 ? 1 : -1;
            const double share = side * random.between(0.4, 0.9);
            const double slip = random.between(-0.2, 0.2);
            box.centre = box.toImage({(along ? share : slip) * box.length, (along ? slip : share) * box.width});
            for (const OrientedBox& vehicle : image.vehicles) good = good && overlap(box, vehicle) <= 0.45;
        } else {
            const double x = random.uniform(), y = random.uniform();
            box.centre = {240 * x, 200 * y};
            box.heading = random.between(-kPi, kPi);
            for (const OrientedBox& vehicle : image.vehicles) good = good && insideBy(box, vehicle) <= 0.05;
        }
        good = good && insideBy(box, image.unclear[0]) <= 0.05 && areaInImage(box, {240, 200}) > 0.95 * box.area();
        if (!good) continue;
        expected.push_back({cutWindow(image.gray, box), false, "", "", false});
        ++taken;
    }
    const SampleSet samples = samplesFromImage(image, kOthers, {{0, 0}, 99, 99, 0}, kSeed);
    ASSERT_EQ(samples.size(), expected.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        EXPECT_EQ(cv::norm(samples[i].window, expected[i].window, cv::NORM_INF), 0) << i;
        EXPECT_EQ(samples[i].vehicle, expected[i].vehicle);
    }
}

TEST(SampleMaking, AsTheThesisCutsThemVehiclesFillTheWindow) {
    // Heading up, twice as long and wide as the window: each window pixel is the mean of 2 × 2 pixels of the box.
    const cv::Mat gray = pattern({80, 100});
    const cv::Mat window = cutWindow(gray, {{40, 50}, 64, 32, -kPi / 2}, WindowFit::filled());
    ASSERT_EQ(window.size(), cv::Size(16, 32));
    cv::Mat expected;
    // Pixel centres of the box lie half a pixel beside those of the picture: its middle is that of a pixel.
    cv::Mat half;
    cv::warpAffine(gray, half, cv::Matx23d(1, 0, 24.5, 0, 1, 18.5), {32, 64}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    cv::resize(half, expected, {16, 32}, 0, 0, cv::INTER_AREA);
    EXPECT_LE(cv::norm(window, expected, cv::NORM_INF), 3);
    // A box of the window's size is the window.
    const cv::Mat same = cutWindow(gray, {{40.5, 50.5}, 32, 16, -kPi / 2}, WindowFit::filled());
    EXPECT_LE(cv::norm(same, gray(cv::Rect(33, 35, 16, 32)), cv::NORM_INF), 1);
}

TEST(SampleMaking, AsTheThesisCutsThemNoVehicleIsVisibleInOthers) {
    LabelledImage image;
    image.gray = cv::Mat(200, 200, CV_8UC1, cv::Scalar(60));
    image.vehicles = {{{60, 60}, 30, 14, 0}, {{140, 60}, 30, 14, kPi / 2}};
    image.unclear = {{{100, 150}, 40, 20, 0}};
    for (const auto& boxes : {image.vehicles, image.unclear}) {
        for (const OrientedBox& box : boxes) {
            const bool lying = box.heading == 0;
            const cv::Size size(int(lying ? box.length : box.width), int(lying ? box.width : box.length));
            cv::rectangle(image.gray, cv::Rect(cv::Point(box.centre) - cv::Point(size) / 2, size), cv::Scalar(220),
                          cv::FILLED);
        }
    }
    const SampleSet samples = samplesFromImage(image, 80, {}, 5, SampleCutting::thesis());
    EXPECT_EQ(countOf(samples, true), 2);
    EXPECT_EQ(countOf(samples, false), 80);
    for (const Sample& sample : samples) {
        const double mean = cv::mean(sample.window)[0];
        if (sample.vehicle) {
            EXPECT_GT(mean, 200) << "the box and nothing around it";
        } else {
            EXPECT_LT(mean, 68) << "but for what interpolation draws in at the edge";
        }
    }
}

TEST(SampleMaking, AVehicleIsCutWhereNineteenTwentiethsOfItAreInThePicture) {
    LabelledImage image;
    image.gray = pattern({100, 100});
    // 20 px long, of which 1 may be missing: from x = −1.5 on.
    image.vehicles = {{{8.6, 20}, 20, 8, 0}, {{8.4, 50}, 20, 8, 0}, {{80, 95.8}, 20, 8, 0}, {{50, 96}, 20, 8, 0}};
    const SampleSet samples = samplesFromImage(image, 0, {}, 1);
    ASSERT_EQ(samples.size(), 2U);
    EXPECT_TRUE(isOneOf(cutWindow(image.gray, image.vehicles[0]), samples));
    EXPECT_TRUE(isOneOf(cutWindow(image.gray, image.vehicles[2]), samples));
}

TEST(SampleMaking, EveryPictureHasASeedOfItsOwnAndFourOthersAtLeast) {
    std::vector<LabelledImage> images(3);
    for (auto& image : images) image.gray = pattern({120, 100});
    images[1].vehicles = {{{50, 50}, 20, 10, 0.3}, {{90, 70}, 22, 10, 0.1}};
    const SampleSet samples = samplesFromImages(images, 30);
    SampleSet expected;
    for (std::size_t i = 0; i < 3; ++i) {
        for (const Sample& sample : samplesFromImage(images[i], i == 1 ? 8 : 4, {{0, 0}, 21.5, 10, 0}, 30 + i))
            expected.push_back(sample);
    }
    ASSERT_EQ(samples.size(), expected.size());
    for (std::size_t i = 0; i < samples.size(); ++i)
        EXPECT_EQ(cv::norm(samples[i].window, expected[i].window, cv::NORM_INF), 0) << i;
}

namespace {

/// Haralick's features as he writes them down, with p(i, j) of pairs counted both ways.
std::vector<double> haralickPlainly(const cv::Mat& levels, cv::Point step) {
    double p[16][16] = {}, pairs = 0;
    for (int y = 0; y < levels.rows; ++y) {
        for (int x = 0; x < levels.cols; ++x) {
            const cv::Point other(x + step.x, y + step.y);
            if (!cv::Rect({}, levels.size()).contains(other)) continue;
            ++p[levels.at<uchar>(y, x)][levels.at<uchar>(other)];
            ++p[levels.at<uchar>(other)][levels.at<uchar>(y, x)];
            pairs += 2;
        }
    }
    double px[16] = {}, sum[31] = {}, difference[16] = {};
    double f1 = 0, f5 = 0, f9 = 0, mean = 0, product = 0;
    const auto bits = [](double value) { return value > 0 ? -value * std::log2(value) : 0; };
    for (int i = 0; i < 16; ++i) {
        for (int j = 0; j < 16; ++j) {
            p[i][j] /= pairs;
            px[i] += p[i][j];
            sum[i + j] += p[i][j];
            difference[std::abs(i - j)] += p[i][j];
            f1 += p[i][j] * p[i][j];
            f5 += p[i][j] / (1 + (i - j) * (i - j));
            f9 += bits(p[i][j]);
            mean += i * p[i][j];
            product += i * j * p[i][j];
        }
    }
    double f2 = 0, f4 = 0, f6 = 0, f7 = 0, f8 = 0, f10 = 0, f11 = 0, own = 0, hxy = 0, apart = 0;
    for (int k = 0; k < 16; ++k) {
        f2 += k * k * difference[k];
        f4 += (k - mean) * (k - mean) * px[k];
        f11 += bits(difference[k]);
        apart += k * difference[k];
        own += bits(px[k]);
        for (int j = 0; j < 16; ++j) hxy += bits(px[k] * px[j]);
    }
    for (int k = 0; k < 16; ++k) f10 += (k - apart) * (k - apart) * difference[k];
    for (int k = 0; k < 31; ++k) {
        f6 += k * sum[k];
        f8 += bits(sum[k]);
    }
    for (int k = 0; k < 31; ++k) f7 += (k - f6) * (k - f6) * sum[k];
    return {f1,
            f2,
            (product - mean * mean) / f4,
            f4,
            f5,
            f6,
            f7,
            f8,
            f9,
            f10,
            f11,
            (f9 - hxy) / own,
            std::sqrt(1 - std::exp(-2 * (hxy - f9)))};
}

}  // namespace

TEST(SampleMaking, HaralickFeaturesAreThoseOfThePaper) {
    const cv::Mat levels = pattern({16, 32}) / 17;
    for (const cv::Point step : {cv::Point(1, 0), {1, -1}, {0, -1}, {-1, -1}, {3, -3}, {-2, -2}, {0, -3}, {2, 0}}) {
        const auto features = haralickFeatures(levels, step);
        const auto expected = haralickPlainly(levels, step);
        for (std::size_t i = 0; i < 13; ++i) EXPECT_NEAR(features[i], expected[i], 1e-4) << step << ", feature " << i;
    }
    // Of one level nothing is told.
    const auto flat = haralickFeatures(cv::Mat(8, 8, CV_8UC1, cv::Scalar(5)), {1, 0});
    const double told[13] = {1, 0, 1, 0, 1, 10, 0, 0, 0, 0, 0, 0, 0};
    for (std::size_t i = 0; i < 13; ++i) EXPECT_NEAR(flat[i], told[i], 1e-6) << i;
    // No pair fits.
    for (const float value : haralickFeatures(cv::Mat(1, 1, CV_8UC1, cv::Scalar(5)), {1, 0}))
        EXPECT_TRUE(std::isfinite(value));
    // The moments' last values are those of the window in 16 levels of its range, in four directions and three
    // distances.
    cv::Mat window = pattern({16, 32}, 4) / 2 + 40;
    std::vector<float> values(178);
    makeDescriptor(DescriptorKind::moments, 1)->compute(window, values);
    double low = 0, high = 0;
    cv::minMaxLoc(window, &low, &high);
    cv::Mat sixteen(window.size(), CV_8UC1);
    for (int i = 0; i < 512; ++i)
        sixteen.at<uchar>(i / 16, i % 16) =
            uchar((window.at<uchar>(i / 16, i % 16) - int(low)) * 16 / int(high - low + 1));
    std::size_t at = 22;
    for (const int distance : {1, 2, 3}) {
        for (const cv::Point direction : {cv::Point(1, 0), {1, -1}, {0, -1}, {-1, -1}}) {
            for (const double value : haralickPlainly(sixteen, distance * direction))
                EXPECT_NEAR(values[at++], value, 1e-4) << distance << direction;
        }
    }
}

}  // namespace eyrie::sample_making_test

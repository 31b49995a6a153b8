#include "learning/classifiers/feature_bins.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "core/error.h"
#include "core/parameter.h"
#include "learning/classifiers/classifier.h"
#include "learning/classifiers/random_forest.h"
#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/classifiers/standardisation.h"

namespace eyrie::classifier_facts_test {
namespace {

TEST(FeatureBins, BordersLieInTheMiddleOfNeighbouringValues) {
    const cv::Mat1f features = (cv::Mat1f(5, 2) << 0, 7, 10, 7, 40, 7, 0, 7, 10, 7);
    const FeatureBins bins(features);
    EXPECT_EQ(bins.borders(0), (std::vector<float>{5, 25}));
    EXPECT_TRUE(bins.borders(1).empty()) << "a feature that never varies";
    const auto codes = bins.codes(0);
    EXPECT_EQ(std::vector<int>(codes.begin(), codes.end()), (std::vector<int>{0, 1, 2, 0, 1}));
    // A number and the next have no middle: the larger value itself is the border.
    const float next = std::nextafter(1.F, 2.F);
    EXPECT_EQ(FeatureBins((cv::Mat1f(2, 1) << 1, next)).borders(0), std::vector<float>{next});
}

TEST(FeatureBins, ManyValuesFillTheBinsEvenly) {
    constexpr int kSamples = 25600;
    cv::Mat1f features(kSamples, 1);
    for (int i = 0; i < kSamples; ++i) features(i, 0) = static_cast<float>((7919LL * i) % kSamples);
    const FeatureBins bins(features);
    ASSERT_EQ(bins.borders(0).size(), static_cast<std::size_t>(FeatureBins::kBins - 1));
    std::map<int, int> counts;
    for (const auto code : bins.codes(0)) ++counts[code];
    EXPECT_EQ(counts.size(), static_cast<std::size_t>(FeatureBins::kBins));
    for (const auto& [code, count] : counts) EXPECT_NEAR(count, kSamples / FeatureBins::kBins, 1) << code;
}

TEST(FeatureBins, AValueThatFillsBinsIsPartedFromTheLargerOnes) {
    constexpr int kSamples = 2000;
    cv::Mat1f features(kSamples, 1, 0.F);
    for (int i = 0; i < 1000; ++i) features(i, 0) = static_cast<float>(1 + i);
    const FeatureBins bins(features);
    const auto codes = bins.codes(0);
    for (int i = 1000; i < kSamples; ++i) ASSERT_EQ(codes[std::size_t(i)], 0);
    EXPECT_GE(codes[0], 1) << "no other value shares its bin";
    EXPECT_GT(codes[999], FeatureBins::kBins / 2 - 2);
    for (std::size_t i = 1; i < bins.borders(0).size(); ++i) EXPECT_GT(bins.borders(0)[i], bins.borders(0)[i - 1]);
}

TEST(RandomForest, OneBorderTakesOneSplit) {
    TrainingSet set{cv::Mat1f(200, 1), {}};
    for (int i = 0; i < 200; ++i) {
        set.features(i, 0) = static_cast<float>(i);
        set.vehicle.push_back(i >= 100 ? 1 : 0);
    }
    const auto forest = trainRandomForest(set, 20, 1, {});
    ByteWriter out;
    forest->write(out);
    EXPECT_EQ(out.bytes().size(), 4U + 20 * (4 + 3 * 12)) << "a root and two leaves, 12 bytes each";
    const float below[1] = {70};
    const float above[1] = {130};
    EXPECT_EQ(forest->decide(below), -0.5);
    EXPECT_EQ(forest->decide(above), 0.5);
}

TEST(RandomForest, TreesAreNoDeeperThanTheirLimit) {
    // Each feature parts one sample from all others, so that a tree without a limit would be as deep as there are
    // samples.
    constexpr int kSamples = 160;
    TrainingSet set{cv::Mat1f(kSamples, kSamples, 0.F), {}};
    for (int i = 0; i < kSamples; ++i) {
        set.features(i, i) = 1;
        set.vehicle.push_back(i % 2);
    }
    const auto forest = trainRandomForest(set, 5, 1, {});
    ByteWriter out;
    forest->write(out);
    EXPECT_LE(out.bytes().size(), 4U + 5 * (4 + 12 * (2 * 32 + 1)));
    EXPECT_GE(out.bytes().size(), 4U + 5 * (4 + 12 * (2 * 28 + 1))) << "and they do get deep";
}

TEST(RandomForest, LeavesSayTheShareOfVehiclesWhereNothingCanBeSplit) {
    // Three of four samples at 1 are vehicles, one of four at 0.
    TrainingSet set{cv::Mat1f(4000, 1), {}};
    for (int i = 0; i < 4000; ++i) {
        const int at = i % 2;
        set.features(i, 0) = static_cast<float>(at);
        set.vehicle.push_back(i / 2 % 4 == 0 ? 1 - at : at);
    }
    const auto forest = trainRandomForest(set, 20, 1, {});
    const float zero[1] = {0};
    const float one[1] = {1};
    EXPECT_NEAR(forest->decide(zero), -0.25, 0.02);
    EXPECT_NEAR(forest->decide(one), 0.25, 0.02);
}

TEST(Standardisation, TakesOffTheMeanAndDividesByTheDeviation) {
    const cv::Mat1f features = (cv::Mat1f(4, 2) << 1, 10, 3, 10, 5, 10, 7, 10);
    const Standardisation standard = standardisationOf(features);
    EXPECT_FLOAT_EQ(standard.mean[0], 4);
    EXPECT_NEAR(standard.scale[0], 1 / std::sqrt(5.0), 1e-6) << "squares 9, 1, 1 and 9";
    EXPECT_EQ(standard.scale[1], 0) << "a feature that never varies";
}

TEST(Standardisation, WhatIsAlwaysZeroStaysZero) {
    const Standardisation standard = standardisationOf((cv::Mat1f(3, 2) << 0, -1, 0, 0, 0, 1));
    EXPECT_EQ(standard.mean[0], 0);
    EXPECT_EQ(standard.scale[0], 0);
    EXPECT_NEAR(standard.scale[1], std::sqrt(1.5), 1e-6);
}

TEST(LikelihoodHistogram, FallsByOneForEachHalfRangeBeyondItsEndsButByNoMoreThanTen) {
    LikelihoodHistogram histogram;
    histogram.low = 2;
    histogram.high = 6;
    for (std::size_t bin = 0; bin < LikelihoodHistogram::kBins; ++bin) histogram.log_density[bin] = -float(bin);
    EXPECT_NEAR(histogram.logDensityOf(2.01), 0, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(4.01), -12, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(5.99), -23, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(9), -23 - 1.5, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(-1), -1.5, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(1e6), -23 - 10, 1e-6);
    EXPECT_NEAR(histogram.logDensityOf(-1e6), -10, 1e-6);
}

TEST(Svm, NeedsASampleOfEachClassInEveryFold) {
    TrainingSet set{cv::Mat1f(12, 1), {}};
    for (int i = 0; i < 12; ++i) {
        set.features(i, 0) = static_cast<float>(i);
        set.vehicle.push_back(i < 4 ? 1 : 0);
    }
    ClassifierOptions options;
    setParameter(describeOf(options), "training.folds", "4");
    EXPECT_TRUE(trainClassifier(ClassifierKind::svm, set, options, 1));
    setParameter(describeOf(options), "training.folds", "5");
    EXPECT_THROW(trainClassifier(ClassifierKind::svm, set, options, 1), Error);
}

TEST(GentleAdaBoost, WeightTrimmingIsAParameter) {
    TrainingSet set{cv::Mat1f(200, 1), {}};
    SeededRandom random(3);
    for (int i = 0; i < 200; ++i) {
        set.features(i, 0) = static_cast<float>(random.between(0, 1) + 0.4 * (i % 2));
        set.vehicle.push_back(i % 2);
    }
    ClassifierOptions options;
    options.trees = 30;
    options.feature_share = 1;
    const auto bytes = [&](const char* trimming) {
        setParameter(describeOf(options), "training.weight_trimming", trimming);
        ByteWriter out;
        trainClassifier(ClassifierKind::adaboost, set, options, 1)->write(out);
        return out.bytes();
    };
    EXPECT_NE(bytes("0"), bytes("0.4"));
}

}  // namespace
}  // namespace eyrie::classifier_facts_test

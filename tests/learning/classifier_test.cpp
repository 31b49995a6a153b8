#include "learning/classifiers/classifier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <set>

#include "core/error.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/classifiers/svm.h"

namespace eyrie::classifier_test {
namespace {

ClassifierOptions smallOptions() {
    ClassifierOptions options;
    options.trees = 60;
    options.feature_share = 1;
    options.weak_classifiers = 40;
    options.weak_features = 2;
    return options;
}

/// Two features; a vehicle lies in a ring around the origin that no straight line cuts off.
TrainingSet ring(int count, std::uint64_t seed) {
    SeededRandom random(seed);
    TrainingSet set;
    set.features = cv::Mat1f(count, 2);
    for (int i = 0; i < count; ++i) {
        const bool vehicle = i % 2 == 0;
        const double radius = vehicle ? random.between(0, 1) : random.between(1.6, 3);
        const double angle = random.between(0, 6.2831853);
        set.features(i, 0) = static_cast<float>(radius * std::cos(angle));
        set.features(i, 1) = static_cast<float>(50 + 20 * radius * std::sin(angle));
        set.vehicle.push_back(vehicle ? 1 : 0);
    }
    return set;
}

double correct(const Classifier& classifier, const TrainingSet& set, double border = 0) {
    const auto values = classifier.decideAll(set.features);
    double right = 0;
    for (std::size_t i = 0; i < values.size(); ++i) right += (values[i] > border) == (set.vehicle[i] != 0) ? 1 : 0;
    return right / static_cast<double>(values.size());
}

class EveryClassifier : public testing::TestWithParam<ClassifierKind> {};

std::string nameOfTest(const testing::TestParamInfo<ClassifierKind>& info) {
    return nameOf(info.param);
}

}  // namespace

TEST_P(EveryClassifier, tellsTheInsideOfARingFromItsOutside) {
    const auto classifier = trainClassifier(GetParam(), ring(400, 1), smallOptions(), 1);
    ASSERT_TRUE(classifier);
    EXPECT_EQ(classifier->kind(), GetParam());
    EXPECT_EQ(classifier->dimension(), 2);
    EXPECT_GT(correct(*classifier, ring(400, 2)), 0.95) << "samples it has not seen";
    const float inside[2] = {0, 50};
    const float outside[2] = {2.2F, 50};
    EXPECT_GT(classifier->decide(inside), classifier->decide(outside));
}

TEST_P(EveryClassifier, isTheSameForTheSameSeed) {
    const TrainingSet set = ring(120, 3);
    ByteWriter first;
    ByteWriter again;
    trainClassifier(GetParam(), set, smallOptions(), 5)->write(first);
    trainClassifier(GetParam(), set, smallOptions(), 5)->write(again);
    EXPECT_EQ(first.bytes(), again.bytes());
}

TEST_P(EveryClassifier, decidesTheSameAfterWritingAndReading) {
    const TrainingSet set = ring(120, 3);
    const auto classifier = trainClassifier(GetParam(), set, smallOptions(), 5);
    ByteWriter out;
    classifier->write(out);
    ByteReader in(out.bytes(), "memory");
    const auto copy = readClassifier(GetParam(), 2, in);
    EXPECT_EQ(in.left(), 0U);
    const auto values = classifier->decideAll(set.features);
    const auto copied = copy->decideAll(set.features);
    for (std::size_t i = 0; i < values.size(); ++i) EXPECT_NEAR(values[i], copied[i], 1e-6);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(copy->decide({set.features[i], 2}), copied[std::size_t(i)], 1e-6);
}

TEST_P(EveryClassifier, refusesEveryShortenedFile) {
    const auto classifier = trainClassifier(GetParam(), ring(40, 3), smallOptions(), 5);
    ByteWriter out;
    classifier->write(out);
    for (std::size_t size = 0; size < out.bytes().size(); size += 1 + out.bytes().size() / 97) {
        ByteReader in(std::string_view(out.bytes()).substr(0, size), "memory");
        EXPECT_THROW(readClassifier(GetParam(), 2, in), Error) << size;
    }
}

TEST_P(EveryClassifier, refusesSetsItCannotLearnFrom) {
    TrainingSet one_class = ring(40, 3);
    std::fill(one_class.vehicle.begin(), one_class.vehicle.end(), std::uint8_t{1});
    EXPECT_THROW(trainClassifier(GetParam(), one_class, smallOptions(), 1), Error);
    TrainingSet not_finite = ring(40, 3);
    not_finite.features(3, 1) = std::numeric_limits<float>::quiet_NaN();
    EXPECT_THROW(trainClassifier(GetParam(), not_finite, smallOptions(), 1), Error);
    EXPECT_THROW(trainClassifier(GetParam(), {}, smallOptions(), 1), Error);
}

TEST_P(EveryClassifier, standsFeaturesThatNeverVary) {
    TrainingSet set = ring(120, 3);
    TrainingSet wider{cv::Mat1f(set.count(), 4, 7.F), set.vehicle};
    set.features.copyTo(wider.features.colRange(1, 3));
    const auto classifier = trainClassifier(GetParam(), wider, smallOptions(), 1);
    for (const double value : classifier->decideAll(wider.features)) ASSERT_TRUE(std::isfinite(value));
}

TEST_P(EveryClassifier, canBeStopped) {
    std::stop_source stop;
    TrainingWatch watch;
    watch.stop = stop.get_token();
    watch.progress = [&](const TrainingProgress& progress) {
        EXPECT_GE(progress.share, 0);
        EXPECT_LE(progress.share, 1);
        stop.request_stop();
    };
    EXPECT_EQ(trainClassifier(GetParam(), ring(60, 3), smallOptions(), 1, watch), nullptr);
}

INSTANTIATE_TEST_SUITE_P(Classifiers, EveryClassifier, testing::ValuesIn(allClassifiers()), nameOfTest);

TEST(Classifier, namesAreKnown) {
    for (const ClassifierKind kind : allClassifiers()) EXPECT_EQ(classifierFromName(nameOf(kind)), kind);
    EXPECT_THROW(classifierFromName("boost"), Error);
    std::set<std::string> titles;
    for (const ClassifierKind kind : allClassifiers()) titles.insert(titleOf(kind));
    EXPECT_EQ(titles.size(), allClassifiers().size()) << "people can tell them apart";
    EXPECT_STREQ(titleOf(ClassifierKind::random_forest), "Random Forest");
}

TEST(GentleAdaBoost, oneTreeOnFourPointsIsTheOneOnPaper) {
    // Exclusive or, with one corner heavier so that the first split has a gain.
    TrainingSet set;
    set.features = (cv::Mat1f(5, 2) << 0, 0, 0, 0, 0, 1, 1, 0, 1, 1);
    set.vehicle = {1, 1, 0, 0, 1};
    const auto boosted = trainGentleAdaBoost(set, 1, 1, 0.01, 1, {});
    ASSERT_EQ(boosted->trees().size(), 1U);
    const float corners[4][2] = {{0, 0}, {0, 1}, {1, 0}, {1, 1}};
    const double expected[4] = {1, -1, -1, 1};
    for (int i = 0; i < 4; ++i) EXPECT_EQ(boosted->decide(corners[i]), expected[i]) << i;
    EXPECT_EQ(boosted->leastSums()[0], 1) << "the accepted vehicles have the sum 1";
}

TEST(GentleAdaBoost, traceIsTheLowestSumOfAcceptedVehicles) {
    const TrainingSet set = ring(200, 9);
    const auto boosted = trainGentleAdaBoost(set, 30, 1, 0.01, 1, {});
    ASSERT_EQ(boosted->leastSums().size(), 30U);
    std::vector<double> least(30, 1e9);
    for (int i = 0; i < set.count(); ++i) {
        if (!set.vehicle[std::size_t(i)] || boosted->decide({set.features[i], 2}) < 0) continue;
        double sum = 0;
        for (std::size_t t = 0; t < 30; ++t) {
            const GentleAdaBoost one(2, {boosted->trees()[t]}, {0.F});
            sum += one.decide({set.features[i], 2});
            least[t] = std::min(least[t], sum);
        }
    }
    for (std::size_t t = 0; t < 30; ++t) EXPECT_NEAR(boosted->leastSums()[t], least[t], 1e-5) << t;
}

TEST(GentleAdaBoost, moreTreesLowerTheTrainingLoss) {
    const TrainingSet set = ring(300, 4);
    double before = 1;
    for (const int trees : {1, 4, 16, 64}) {
        const auto boosted = trainGentleAdaBoost(set, trees, 1, 0.01, 1, {});
        double loss = 0;
        for (int i = 0; i < set.count(); ++i) {
            const double label = set.vehicle[std::size_t(i)] ? 1 : -1;
            loss += std::exp(-label * boosted->decide({set.features[i], 2})) / set.count();
        }
        EXPECT_LT(loss, before) << trees;
        before = loss;
    }
}

/// Gentle AdaBoost by the book (Friedman, Hastie, Tibshirani 2000): every tree looks at all features, all samples and
/// all borders between values. Returns the sums after each tree, in leaf units, for each sample.
std::vector<std::vector<int>> plainBoosting(const TrainingSet& set, int trees) {
    const auto count = static_cast<std::size_t>(set.count());
    const auto label = [&](std::size_t i) { return set.vehicle[i] ? 1.0 : -1.0; };
    const auto value = [&](std::size_t i, int feature) { return set.features(static_cast<int>(i), feature); };
    struct Stump {
        int feature = 0;
        float border = std::numeric_limits<float>::max();
    };
    std::vector<double> weights(count);
    double vehicles = 0;
    for (const std::uint8_t v : set.vehicle) vehicles += v;
    for (std::size_t i = 0; i < count; ++i)
        weights[i] = 0.5 / (set.vehicle[i] ? vehicles : static_cast<double>(count) - vehicles);
    const auto bestStump = [&](const std::vector<std::size_t>& samples) {
        Stump best;
        double most = -1;
        for (int feature = 0; feature < set.dimension(); ++feature) {
            std::set<float> values;
            for (std::size_t i = 0; i < count; ++i) values.insert(value(i, feature));
            for (auto low = values.begin(); std::next(low) != values.end(); ++low) {
                const float border = *low + (*std::next(low) - *low) / 2;
                double weight[2] = {};
                double sum[2] = {};
                for (const std::size_t i : samples) {
                    const int side = value(i, feature) >= border ? 1 : 0;
                    weight[side] += weights[i];
                    sum[side] += weights[i] * label(i);
                }
                if (weight[0] <= 0 || weight[1] <= 0) continue;
                const double gain = sum[0] * sum[0] / weight[0] + sum[1] * sum[1] / weight[1];
                if (gain > most * (1 + 1e-9)) {
                    most = gain;
                    best = {feature, border};
                }
            }
        }
        return best;
    };
    std::vector<std::size_t> all(count);
    std::iota(all.begin(), all.end(), std::size_t{0});
    std::vector<int> sums(count, 0);
    std::vector<std::vector<int>> after_each;
    for (int t = 0; t < trees; ++t) {
        const Stump root = bestStump(all);
        std::vector<std::size_t> below[2];
        for (const std::size_t i : all) below[value(i, root.feature) >= root.border ? 1 : 0].push_back(i);
        double total = 0;
        for (const auto& side : below) {
            const Stump node = bestStump(side);
            std::vector<std::size_t> leaves[2];
            for (const std::size_t i : side) leaves[value(i, node.feature) >= node.border ? 1 : 0].push_back(i);
            for (const auto& leaf : leaves) {
                double weight = 0;
                double sum = 0;
                for (const std::size_t i : leaf) {
                    weight += weights[i];
                    sum += weights[i] * label(i);
                }
                const auto units = weight > 0 ? std::lround(sum / weight * GentleAdaBoost::kLeafUnit) : 0;
                for (const std::size_t i : leaf) {
                    sums[i] += static_cast<int>(units);
                    weights[i] *= std::exp(-label(i) * static_cast<double>(units) / GentleAdaBoost::kLeafUnit);
                }
            }
        }
        for (const double w : weights) total += w;
        for (double& w : weights) w /= total;
        after_each.push_back(sums);
    }
    return after_each;
}

/// The same of a trained model.
std::vector<std::vector<int>> sumsOf(const GentleAdaBoost& boosted, const TrainingSet& set) {
    std::vector<std::vector<int>> after_each;
    std::vector<int> sums(static_cast<std::size_t>(set.count()), 0);
    for (const BoostedTree& tree : boosted.trees()) {
        const GentleAdaBoost one(set.dimension(), {tree}, {0.F});
        for (std::size_t i = 0; i < sums.size(); ++i) {
            const float* row = set.features[static_cast<int>(i)];
            const double leaf = one.decide({row, static_cast<std::size_t>(set.dimension())});
            sums[i] += static_cast<int>(std::lround(leaf * GentleAdaBoost::kLeafUnit));
        }
        after_each.push_back(sums);
    }
    return after_each;
}

TEST(GentleAdaBoost, withTheThesisSettingsItIsTheOneOfTheBook) {
    const ClassifierOptions thesis = ClassifierOptions::thesis();
    EXPECT_EQ(thesis.trees, 1000);
    // No more values than bins, so that all borders between them are looked at; no two splits are equally good.
    TrainingSet set{cv::Mat1f(28, 2), {}};
    for (int i = 0; i < 28; ++i) {
        const int x = (37 * i + 11) % 101;
        const int y = (53 * i + 29) % 103;
        set.features(i, 0) = static_cast<float>(x);
        set.features(i, 1) = static_cast<float>(y);
        set.vehicle.push_back((x - 50) * (x - 50) + (y - 50) * (y - 50) < 900 ? 1 : 0);
    }
    const auto plain = plainBoosting(set, 5);
    const auto boosted = trainGentleAdaBoost(set, 5, thesis.feature_share, thesis.weight_trimming, 1, {});
    EXPECT_EQ(sumsOf(*boosted, set), plain);
}

TEST(GentleAdaBoost, trimmingLeavesTheSurestSamplesOut) {
    const TrainingSet set = ring(200, 12);
    const auto all = sumsOf(*trainGentleAdaBoost(set, 40, 1, 0, 1, {}), set);
    const auto trimmed = sumsOf(*trainGentleAdaBoost(set, 40, 1, 0.3, 1, {}), set);
    EXPECT_EQ(all[0], sumsOf(*trainGentleAdaBoost(set, 1, 1, 0.001, 1, {}), set)[0]) << "all weigh the same at first";
    EXPECT_NE(all, trimmed);
}

TEST(RandomNaiveBayes, posteriorIsBayesRule) {
    // One feature; the vehicle's density is 0.3 where the other's is 0.1: P = 0.3 / 0.4.
    WeakBayes weak;
    weak.features = {0};
    for (std::size_t c = 0; c < 2; ++c) {
        LikelihoodHistogram h;
        h.low = 0;
        h.high = 10;
        h.log_density.fill(std::log(c == 1 ? 0.3F : 0.1F));
        weak.likelihoods[c] = {h};
    }
    EXPECT_NEAR(weak.posterior(Eigen::VectorXd::Constant(1, 5)), 0.75, 1e-6);
    // Class-conditional unmixing that stretches by e counts e times the density.
    weak.unmixing[1] = {Eigen::MatrixXd::Constant(1, 1, std::exp(1.0)), Eigen::VectorXd::Zero(1), 1};
    EXPECT_NEAR(weak.posterior(Eigen::VectorXd::Constant(1, 2)), 0.3 * std::exp(1) / (0.3 * std::exp(1) + 0.1), 1e-6);
}

/// A weak classifier of one feature that says the same of every value.
WeakBayes sayingAlways(double posterior, double weight) {
    WeakBayes weak;
    weak.weight = weight;
    weak.features = {0};
    for (std::size_t c = 0; c < 2; ++c) {
        LikelihoodHistogram h;
        h.low = 0;
        h.high = 10;
        h.log_density.fill(static_cast<float>(std::log(c == 1 ? posterior : 1 - posterior)));
        weak.likelihoods[c] = {h};
    }
    return weak;
}

TEST(RandomNaiveBayes, addsUpPosteriorsByWeightAndNotVotes) {
    const float value[1] = {5};
    const auto decide = [&](const std::vector<WeakBayes>& weak) {
        return RandomNaiveBayes(ClassifierKind::random_naive_bayes, {0.F}, {1.F}, weak).decide(value);
    };
    // Two of three are against, but one is sure: (0.4 − 0.1 − 0.1) / 3.
    EXPECT_NEAR(decide({sayingAlways(0.9, 1), sayingAlways(0.4, 1), sayingAlways(0.4, 1)}), 0.2 / 3, 1e-6);
    EXPECT_NEAR(decide({sayingAlways(0.9, 1), sayingAlways(0.4, 3), sayingAlways(0.4, 3)}), -0.2 / 7, 1e-6);
    // One that is wrong more often than right counts the other way round.
    EXPECT_NEAR(decide({sayingAlways(0.9, -1), sayingAlways(0.6, 1)}), -0.3 / 2, 1e-6);
}

TEST(RandomNaiveBayes, weightIsHalfTheLogarithmOfTheOdds) {
    // A feature that is wrong about every fifth sample, whichever are left out of the bag: ½ ln(0.8 / 0.2).
    TrainingSet set{cv::Mat1f(2000, 1), {}};
    for (int i = 0; i < 2000; ++i) {
        const int vehicle = i % 2;
        const bool wrong = i / 2 % 5 == 0;
        set.vehicle.push_back(static_cast<std::uint8_t>(vehicle));
        set.features(i, 0) = static_cast<float>(wrong ? 1 - vehicle : vehicle);
    }
    ClassifierOptions options = smallOptions();
    options.weak_features = 1;
    const auto model = trainRandomNaiveBayes(set, ClassifierKind::random_naive_bayes, options, 1, {});
    double mean = 0;
    for (const WeakBayes& weak : model->weak()) mean += weak.weight / static_cast<double>(model->weak().size());
    EXPECT_NEAR(mean, 0.5 * std::log(4.0), 0.04);
}

TEST(RandomNaiveBayes, weighsByTheOutOfBagErrorAndRefusesWhenNothingIsGoodEnough) {
    ClassifierOptions options = smallOptions();
    options.weak_features = 1;
    // One feature separates well, one is noise.
    SeededRandom random(8);
    TrainingSet set{cv::Mat1f(300, 2), {}};
    for (int i = 0; i < 300; ++i) {
        set.vehicle.push_back(static_cast<std::uint8_t>(i % 2));
        set.features(i, 0) = static_cast<float>(random.between(-1, 1) + 4 * (i % 2));
        set.features(i, 1) = static_cast<float>(random.between(-1, 1));
    }
    const auto model = trainRandomNaiveBayes(set, ClassifierKind::random_naive_bayes, options, 1, {});
    ASSERT_EQ(model->weak().size(), 40U);
    for (const WeakBayes& weak : model->weak()) {
        if (weak.features[0] == 0) {
            EXPECT_GT(weak.weight, 1.5);
        } else {
            EXPECT_LT(std::abs(weak.weight), 0.4);
        }
    }
    options.max_weak_error = 0.01;
    TrainingSet noise{set.features.col(1).clone(), set.vehicle};
    EXPECT_THROW(trainRandomNaiveBayes(noise, ClassifierKind::random_naive_bayes, options, 1, {}), Error);
}

TEST(RandomNaiveBayes, classConditionalIcaSeesWhatPlainBayesCannot) {
    // Both classes have the same histograms of each feature; only how the features go together differs.
    SeededRandom random(8);
    TrainingSet set{cv::Mat1f(800, 2), {}};
    for (int i = 0; i < 800; ++i) {
        const int vehicle = i % 2;
        const double along = random.between(-2, 2);
        const double across = random.between(-0.2, 0.2);
        set.vehicle.push_back(static_cast<std::uint8_t>(vehicle));
        set.features(i, 0) = static_cast<float>(along + across);
        set.features(i, 1) = static_cast<float>((vehicle ? 1 : -1) * (along - across));
    }
    const auto plain = trainClassifier(ClassifierKind::random_naive_bayes, set, smallOptions(), 1);
    const auto conditional = trainClassifier(ClassifierKind::cc_ica_random_naive_bayes, set, smallOptions(), 1);
    EXPECT_LT(correct(*plain, set), 0.7);
    EXPECT_GT(correct(*conditional, set), 0.9);
}

TEST(Svm, needsFewVectorsWhereClassesLieApart) {
    TrainingSet set{cv::Mat1f(100, 1), {}};
    SeededRandom random(2);
    for (int i = 0; i < 100; ++i) {
        set.vehicle.push_back(static_cast<std::uint8_t>(i % 2));
        set.features(i, 0) = static_cast<float>(10 * (i % 2) + random.uniform());
    }
    const auto machine = trainSvm(set, 3, 1, {});
    EXPECT_LT(machine->vectors(), 20);
    EXPECT_EQ(correct(*machine, set), 1);
    const float middle[1] = {5.5F};
    EXPECT_NEAR(machine->decide(middle), 0, 0.3);
}

}  // namespace eyrie::classifier_test

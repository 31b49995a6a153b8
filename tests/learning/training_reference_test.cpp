// The classifiers' trainings beside the same done plainly, with the same random numbers.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <numeric>

#include "learning/classifiers/fast_ica.h"
#include "learning/classifiers/feature_bins.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/classifiers/random_forest.h"
#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/classifiers/smo_solver.h"
#include "learning/classifiers/standardisation.h"
#include "learning/classifiers/svm.h"

namespace eyrie {
namespace {

/// Six features of which the first two tell the classes apart, with noise; `vehicles` of `count` samples are vehicles.
TrainingSet noisySet(int count, int vehicles, std::uint64_t seed, int features = 6) {
    SeededRandom random(seed);
    TrainingSet set{cv::Mat1f(count, features), {}};
    for (int i = 0; i < count; ++i) {
        const int label = static_cast<int>((static_cast<long>(i) * 7919) % count) < vehicles ? 1 : 0;
        set.vehicle.push_back(static_cast<std::uint8_t>(label));
        for (int f = 0; f < features; ++f) {
            const double signal = f == 0 ? 1.1 * label : f == 1 ? -0.6 * label : 0;
            set.features(i, f) = static_cast<float>((f + 1) * (signal + random.between(-1, 1)) + 3 * f);
        }
        if (features > 3) set.features(i, 3) = std::floor(set.features(i, 3));  // few values, with ties
    }
    return set;
}

std::string bytesOf(const Classifier& classifier) {
    ByteWriter out;
    classifier.write(out);
    return out.bytes();
}

/// A forest's tree by the book: the best of √n random features at every node, full-grown.
void growPlainly(const TrainingSet& set, const FeatureBins& bins, SeededRandom& random, const std::vector<int>& samples,
                 std::vector<ForestNode>& nodes) {
    const std::size_t here = nodes.size();
    nodes.emplace_back();
    double vehicles = 0;
    for (const int i : samples) vehicles += set.vehicle[std::size_t(i)];
    const double count = double(samples.size());
    nodes[here].vehicles = float(vehicles / count);
    if (vehicles == 0 || vehicles == count) return;
    const int tried = std::max(1, int(std::sqrt(set.dimension())));
    double most = 0;
    int best_feature = -1;
    float border = 0;
    int varying = 0;
    for (int attempt = 0; attempt < 10 * tried && varying < tried; ++attempt) {
        const int feature = random.below(set.dimension());
        bool varies = false;
        for (const float candidate : bins.borders(feature)) {
            double left[2] = {}, right[2] = {};
            for (const int i : samples)
                ++(set.features(i, feature) < candidate ? left : right)[set.vehicle[std::size_t(i)]];
            const double lefts = left[0] + left[1], rights = right[0] + right[1];
            if (lefts == 0 || rights == 0) continue;
            varies = true;
            const double purity =
                (left[0] * left[0] + left[1] * left[1]) / lefts + (right[0] * right[0] + right[1] * right[1]) / rights;
            if (purity > most) {
                most = purity;
                best_feature = feature;
                border = candidate;
            }
        }
        varying += varies;
    }
    if (best_feature < 0) return;
    std::vector<int> left, right;
    for (const int i : samples) (set.features(i, best_feature) < border ? left : right).push_back(i);
    nodes[here].feature = best_feature;
    nodes[here].threshold = border;
    growPlainly(set, bins, random, left, nodes);
    nodes[here].right = int(nodes.size());
    growPlainly(set, bins, random, right, nodes);
}

/// The borders and sums of Gentle AdaBoost whose trees see a share of the features and the heaviest samples.
std::vector<BoostedTree> boostedPlainly(const TrainingSet& set, int trees, double share, double trimming,
                                        std::uint64_t seed) {
    const FeatureBins bins(set.features);
    SeededRandom random(seed);
    const auto count = std::size_t(set.count());
    std::vector<int> order(std::size_t(set.dimension()));
    std::iota(order.begin(), order.end(), 0);
    const auto chosen = std::size_t(std::max(1.0, std::round(share * set.dimension())));
    const double vehicles = std::accumulate(set.vehicle.begin(), set.vehicle.end(), 0.0);
    std::vector<double> weights;
    for (const auto v : set.vehicle) weights.push_back(0.5 / (v ? vehicles : double(count) - vehicles));
    std::vector<BoostedTree> result;
    for (int t = 0; t < trees; ++t) {
        for (std::size_t i = 0; i < chosen; ++i)
            std::swap(order[i], order[i + std::size_t(random.below(int(order.size() - i)))]);
        // The lightest samples that hold no more than the share together choose nothing.
        std::vector<double> sorted = weights;
        std::sort(sorted.begin(), sorted.end());
        double total = 0, light = 0, least = 0;
        for (const double w : sorted) total += w;
        for (const double w : sorted) {
            light += w;
            if (light > trimming * total) {
                least = w;
                break;
            }
        }
        const auto split = [&](const std::vector<std::size_t>& samples) {
            std::pair<int, float> best{order[0], std::numeric_limits<float>::max()};
            double most = -1, all = 0;
            for (const std::size_t i : samples) all += weights[i];
            for (std::size_t k = 0; k < chosen; ++k) {
                for (const float border : bins.borders(order[k])) {
                    double weight[2] = {}, label[2] = {};
                    for (const std::size_t i : samples) {
                        const int side = set.features(int(i), order[k]) >= border;
                        weight[side] += weights[i];
                        label[side] += set.vehicle[i] ? weights[i] : -weights[i];
                    }
                    if (weight[0] <= 1e-7 * all || weight[1] <= 1e-7 * all) continue;
                    const double gain = label[0] * label[0] / weight[0] + label[1] * label[1] / weight[1];
                    if (gain > most) {
                        most = gain;
                        best = {order[k], border};
                    }
                }
            }
            return best;
        };
        std::vector<std::size_t> heavy;
        for (std::size_t i = 0; i < count; ++i) {
            if (weights[i] >= least) heavy.push_back(i);
        }
        BoostedTree tree;
        std::tie(tree.feature[0], tree.threshold[0]) = split(heavy);
        const auto sideOf = [&](std::size_t i, std::size_t node) {
            return std::size_t(set.features(int(i), tree.feature[node]) >= tree.threshold[node]);
        };
        for (const std::size_t side : {0U, 1U}) {
            std::vector<std::size_t> there;
            for (const std::size_t i : heavy) {
                if (sideOf(i, 0) == side) there.push_back(i);
            }
            std::tie(tree.feature[1 + side], tree.threshold[1 + side]) = split(there);
        }
        double weight[4] = {}, label[4] = {};
        const auto leafOf = [&](std::size_t i) { return 2 * sideOf(i, 0) + sideOf(i, 1 + sideOf(i, 0)); };
        for (std::size_t i = 0; i < count; ++i) {
            weight[leafOf(i)] += weights[i];
            label[leafOf(i)] += set.vehicle[i] ? weights[i] : -weights[i];
        }
        for (std::size_t leaf = 0; leaf < 4; ++leaf)
            tree.leaf[leaf] = std::int16_t(weight[leaf] > 0 ? std::lround(512 * label[leaf] / weight[leaf]) : 0);
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += weights[i] *= std::exp((set.vehicle[i] ? -1.0 : 1.0) * tree.leaf[leafOf(i)] / 512);
        for (double& w : weights) w /= sum;
        result.push_back(tree);
    }
    return result;
}

/// ICA as the formulas have it, one component and sample at a time.
Eigen::MatrixXd icaPlainly(const Eigen::MatrixXd& samples, std::uint64_t seed, double least_variance) {
    const int d = int(samples.cols()), n = int(samples.rows());
    Eigen::VectorXd mean = Eigen::VectorXd::Zero(d);
    for (int i = 0; i < n; ++i) mean += samples.row(i).transpose() / n;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(d, d);
    for (int i = 0; i < n; ++i) {
        const Eigen::VectorXd off = samples.row(i).transpose() - mean;
        covariance += off * off.transpose() / n;
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> directions(covariance);
    double mean_variance = 0;
    for (int k = 0; k < d; ++k) mean_variance += directions.eigenvalues()(k) / d;
    Eigen::MatrixXd whitening(d, d);
    for (int k = 0; k < d; ++k) {
        const double variance = std::max(directions.eigenvalues()(k), least_variance * mean_variance);
        whitening.row(k) = directions.eigenvectors().col(k).transpose() / std::sqrt(variance);
    }
    const auto orthogonal = [](const Eigen::MatrixXd& w) -> Eigen::MatrixXd {
        const Eigen::JacobiSVD<Eigen::MatrixXd> svd(w, Eigen::ComputeFullU | Eigen::ComputeFullV);
        return svd.matrixU() * svd.matrixV().transpose();
    };
    SeededRandom random(seed);
    Eigen::MatrixXd w(d, d);
    for (int i = 0; i < d; ++i) {
        for (int j = 0; j < d; ++j) w(i, j) = random.between(-1, 1);
    }
    w = orthogonal(w);
    for (int step = 0; step < 100; ++step) {
        Eigen::MatrixXd next = Eigen::MatrixXd::Zero(d, d);
        for (int i = 0; i < n; ++i) {
            const Eigen::VectorXd white = whitening * (samples.row(i).transpose() - mean);
            for (int k = 0; k < d; ++k) {
                const double g = std::tanh(w.row(k).dot(white));
                next.row(k) += (g * white.transpose() - (1 - g * g) * w.row(k)) / n;
            }
        }
        next = orthogonal(next);
        double change = 0;
        for (int k = 0; k < d; ++k) change = std::max(change, std::abs(std::abs(next.row(k).dot(w.row(k))) - 1));
        w = next;
        if (change < 1e-5) break;
    }
    return w * whitening;
}

/// What a weak classifier of Random Naïve Bayes is made of, drawn and counted plainly.
struct PlainBayes {
    std::vector<int> features;
    std::array<Eigen::MatrixXd, 2> values;  ///< standardised, of the bag, per class
    std::array<std::vector<int>, 2> left_out;
    std::uint64_t next = 0;  ///< what the random numbers go on with
};

PlainBayes drawnPlainly(const TrainingSet& set, const Standardisation& standard, int features, std::uint64_t seed) {
    // The seeds of the k-th classifier come from a generator of its own.
    SeededRandom random(SeededRandom(seed + 0x51ed2701ULL).next());
    PlainBayes plain;
    std::array<std::vector<int>, 2> bag;
    std::vector<bool> in_bag(set.vehicle.size());
    for (std::size_t k = 0; k < set.vehicle.size(); ++k) {
        const int i = random.below(set.count());
        in_bag[std::size_t(i)] = true;
        bag[set.vehicle[std::size_t(i)]].push_back(i);
    }
    while (int(plain.features.size()) < features) {
        const int feature = random.below(set.dimension());
        if (std::count(plain.features.begin(), plain.features.end(), feature) == 0) plain.features.push_back(feature);
    }
    plain.next = random.next();
    for (std::size_t c = 0; c < 2; ++c) {
        plain.values[c].resize(Eigen::Index(bag[c].size()), features);
        for (std::size_t r = 0; r < bag[c].size(); ++r) {
            for (int j = 0; j < features; ++j) {
                const auto f = std::size_t(plain.features[std::size_t(j)]);
                plain.values[c](Eigen::Index(r), j) =
                    (set.features(bag[c][r], int(f)) - standard.mean[f]) * standard.scale[f];
            }
        }
        for (std::size_t i = 0; i < set.vehicle.size(); ++i) {
            if (set.vehicle[i] == c && !in_bag[i]) plain.left_out[c].push_back(int(i));
        }
    }
    return plain;
}

/// Histogram of 24 bins over the range and a twentieth of it on either side, smoothed by 1 2 1 and half a count.
void expectHistogram(const LikelihoodHistogram& histogram, const Eigen::VectorXd& values, double low, double high) {
    const double margin = 0.05 * (high - low);
    ASSERT_NEAR(histogram.low, low - margin, 1e-5);
    ASSERT_NEAR(histogram.high, high + margin, 1e-5);
    std::vector<double> counts(26);
    const double width = (double(histogram.high) - histogram.low) / 24;
    for (const double value : values) ++counts[std::size_t(1 + std::floor((value - histogram.low) / width))];
    counts[0] = counts[1];
    counts[25] = counts[24];
    for (std::size_t k = 1; k <= 24; ++k) {
        const double smooth = (counts[k - 1] + 2 * counts[k] + counts[k + 1]) / 4 + 0.5;
        ASSERT_NEAR(histogram.log_density[k - 1], std::log(smooth / (double(values.size()) + 12) / width), 1e-4) << k;
    }
}

/// Mean of both classes' shares of samples outside the bag that are taken wrongly, half an error more each.
double weightPlainly(const TrainingSet& set, const Standardisation& standard, const WeakBayes& weak,
                     const PlainBayes& plain) {
    double error = 0;
    for (std::size_t c = 0; c < 2; ++c) {
        double wrong = 0.5;
        for (const int i : plain.left_out[c]) {
            Eigen::VectorXd values(Eigen::Index(weak.features.size()));
            for (std::size_t j = 0; j < weak.features.size(); ++j) {
                const auto f = std::size_t(weak.features[j]);
                values[Eigen::Index(j)] = (set.features(i, int(f)) - standard.mean[f]) * standard.scale[f];
            }
            wrong += (weak.posterior(values) > 0.5) != (c == 1);
        }
        error += wrong / double(plain.left_out[c].size() + 1) / 2;
    }
    return 0.5 * std::log((1 - error) / error);
}

}  // namespace

TEST(TrainingReference, aForestIsGrownNodeByNodeAsInTheBook) {
    for (const int features : {1, 6, 17}) {
        const TrainingSet set = noisySet(90, 40, 5, features);
        const FeatureBins bins(set.features);
        std::vector<std::vector<ForestNode>> trees;
        constexpr std::uint64_t kSeed = 11;
        for (std::uint64_t t = 0; t < 6; ++t) {
            SeededRandom random(SeededRandom(kSeed + t).next());
            std::vector<int> samples(90);
            for (int& sample : samples) sample = random.below(90);
            growPlainly(set, bins, random, samples, trees.emplace_back());
        }
        EXPECT_EQ(bytesOf(*trainRandomForest(set, 6, kSeed, {})), bytesOf(RandomForest(features, trees))) << features;
    }
}

TEST(TrainingReference, boostedTreesSeeAShareOfTheFeaturesAndTheHeaviestSamples) {
    const TrainingSet set = noisySet(120, 40, 6, 9);
    for (const auto& [share, trimming] : {std::pair(0.3, 0.0), {1.0, 0.2}, {0.5, 0.1}, {0.01, 0.05}}) {
        const auto boosted = trainGentleAdaBoost(set, 25, share, trimming, 4, {});
        const auto plain = boostedPlainly(set, 25, share, trimming, 4);
        ASSERT_EQ(boosted->trees().size(), plain.size());
        for (std::size_t t = 0; t < plain.size(); ++t) {
            ASSERT_EQ(boosted->trees()[t].feature, plain[t].feature) << share << ", tree " << t;
            ASSERT_EQ(boosted->trees()[t].threshold, plain[t].threshold) << share << ", tree " << t;
            ASSERT_EQ(boosted->trees()[t].leaf, plain[t].leaf) << share << ", tree " << t;
        }
    }
}

TEST(TrainingReference, theTraceLeavesOutTheLeastSureHundredthOfTheAcceptedVehicles) {
    // 700 vehicles; about 690 are accepted, so that the six least sure of them have no say.
    const TrainingSet set = noisySet(1400, 700, 7, 3);
    const auto boosted = trainGentleAdaBoost(set, 12, 1, 0.01, 1, {});
    std::vector<std::vector<double>> sums;
    for (int i = 0; i < set.count(); ++i) {
        if (!set.vehicle[std::size_t(i)]) continue;
        auto& own = sums.emplace_back();
        double sum = 0;
        for (const BoostedTree& tree : boosted->trees())
            own.push_back(sum += GentleAdaBoost(3, {tree}, {0.F}).decide({set.features[i], 3}));
    }
    std::erase_if(sums, [](const std::vector<double>& own) { return own.back() < 0; });
    std::sort(sums.begin(), sums.end(), [](const auto& a, const auto& b) { return a.back() < b.back(); });
    const double limit = sums[sums.size() / 100].back();
    ASSERT_GT(sums.size() / 100, 3U);
    for (std::size_t t = 0; t < 12; ++t) {
        double least = 1e9;
        for (const auto& own : sums) {
            if (own.back() >= limit) least = std::min(least, own[t]);
        }
        EXPECT_NEAR(boosted->leastSums()[t], least, 1e-5) << t;
    }
}

TEST(TrainingReference, icaIsTheFixedPointIteration) {
    SeededRandom random(9);
    Eigen::MatrixXd samples(300, 4);
    for (int i = 0; i < 300; ++i) {
        const double a = random.between(-1, 1), b = std::pow(random.between(-1, 1), 3);
        samples.row(i) << a + b, 2 * a - b, random.between(-1, 1) + 0.2 * a, 0.01 * random.between(-1, 1) + 5;
    }
    for (const double least : {1e-6, 0.05}) {
        for (const std::uint64_t seed : {1, 2, 3}) {
            const Unmixing u = fastIca(samples, seed, least);
            EXPECT_LT((u.unmixing - icaPlainly(samples, seed, least)).cwiseAbs().maxCoeff(), 1e-6) << seed;
            EXPECT_NEAR(u.log_volume, std::log(std::abs(u.unmixing.determinant())), 1e-9);
        }
    }
    // Without variance nothing is divided by 0: its deviation counts as a millionth.
    const Unmixing flat = fastIca(Eigen::MatrixXd::Constant(9, 1, 3), 1, 1);
    EXPECT_NEAR(std::abs(flat.unmixing(0, 0)), 1e6, 1);
}

TEST(TrainingReference, aWeakBayesCountsItsBagAndIsWeighedByTheRest) {
    const TrainingSet set = noisySet(200, 90, 3);
    const Standardisation standard = standardisationOf(set.features);
    ClassifierOptions options;
    options.weak_classifiers = 1;
    options.weak_features = 3;
    options.max_weak_error = 1;
    const auto model = trainRandomNaiveBayes(set, ClassifierKind::random_naive_bayes, options, 21, {});
    const WeakBayes& weak = model->weak()[0];
    const PlainBayes plain = drawnPlainly(set, standard, 3, 21);
    EXPECT_EQ(weak.features, plain.features);
    for (Eigen::Index j = 0; j < 3; ++j) {
        // Both classes are counted over the range of both.
        const double low = std::min(plain.values[0].col(j).minCoeff(), plain.values[1].col(j).minCoeff());
        const double high = std::max(plain.values[0].col(j).maxCoeff(), plain.values[1].col(j).maxCoeff());
        for (std::size_t c = 0; c < 2; ++c)
            expectHistogram(weak.likelihoods[c][std::size_t(j)], plain.values[c].col(j), low, high);
    }
    EXPECT_NEAR(weak.weight, weightPlainly(set, standard, weak, plain), 1e-9);
}

TEST(TrainingReference, aMixedBayesCountsComponentsOfEachClassOverItsOwnRange) {
    // More than 400 of a class: every second sample of its bag is looked at for the components.
    const TrainingSet set = noisySet(1000, 550, 3);
    const Standardisation standard = standardisationOf(set.features);
    ClassifierOptions options;
    options.weak_classifiers = 1;
    options.weak_features = 3;
    options.max_weak_error = 1;
    const auto thinned = [](const Eigen::MatrixXd& values) {
        const Eigen::Index step = (values.rows() + 399) / 400;
        Eigen::MatrixXd some((values.rows() + step - 1) / step, values.cols());
        for (Eigen::Index r = 0; r < some.rows(); ++r) some.row(r) = values.row(r * step);
        return some;
    };
    for (const ClassifierKind kind :
         {ClassifierKind::ica_random_naive_bayes, ClassifierKind::cc_ica_random_naive_bayes}) {
        const bool own = kind == ClassifierKind::cc_ica_random_naive_bayes;
        const auto model = trainRandomNaiveBayes(set, kind, options, 21, {});
        const WeakBayes& weak = model->weak()[0];
        const PlainBayes plain = drawnPlainly(set, standard, 3, 21);
        ASSERT_EQ(weak.features, plain.features);
        std::array<Eigen::MatrixXd, 2> components;
        Eigen::MatrixXd both(plain.values[0].rows() + plain.values[1].rows(), 3);
        both << plain.values[0], plain.values[1];
        const Unmixing first = fastIca(thinned(own ? plain.values[0] : both), plain.next, 0.05);
        EXPECT_LT((weak.unmixing[0].unmixing - first.unmixing).cwiseAbs().maxCoeff(), 1e-9);
        if (!own) {
            EXPECT_EQ(weak.unmixing[0].unmixing, weak.unmixing[1].unmixing);
        }
        for (std::size_t c = 0; c < 2; ++c) {
            components[c].resize(plain.values[c].rows(), 3);
            for (Eigen::Index r = 0; r < components[c].rows(); ++r)
                components[c].row(r) = weak.unmixing[c].apply(plain.values[c].row(r).transpose()).transpose();
        }
        for (Eigen::Index j = 0; j < 3; ++j) {
            for (std::size_t c = 0; c < 2; ++c) {
                double low = components[c].col(j).minCoeff(), high = components[c].col(j).maxCoeff();
                if (!own) {
                    low = std::min(low, components[1 - c].col(j).minCoeff());
                    high = std::max(high, components[1 - c].col(j).maxCoeff());
                }
                expectHistogram(weak.likelihoods[c][std::size_t(j)], components[c].col(j), low, high);
            }
        }
        EXPECT_NEAR(weak.weight, weightPlainly(set, standard, weak, plain), 1e-9);
    }
}

TEST(TrainingReference, aFeatureThatHardlyVariesHasAHistogramOfAThousandth) {
    TrainingSet set = noisySet(60, 30, 3, 1);
    set.features = 2.F;
    ClassifierOptions options;
    options.weak_classifiers = 1;
    options.weak_features = 5;  // there is but one
    options.max_weak_error = 1;
    const auto model = trainRandomNaiveBayes(set, ClassifierKind::random_naive_bayes, options, 1, {});
    ASSERT_EQ(model->weak()[0].features.size(), 1U);
    EXPECT_NEAR(model->weak()[0].likelihoods[0][0].low, -0.001, 1e-7);
    EXPECT_NEAR(model->weak()[0].likelihoods[0][0].high, 0.001, 1e-7);
}

TEST(TrainingReference, aMachineIsTheBestOfTheGridByCrossValidation) {
    constexpr int kFolds = 3;
    constexpr std::uint64_t kSeed = 4;
    for (const std::uint64_t which : {1, 2, 3}) {
        const TrainingSet set = noisySet(70, 28, which, 4);
        const Standardisation standard = standardisationOf(set.features);
        cv::Mat1f x(set.features.size());
        for (int i = 0; i < x.rows; ++i) {
            for (int f = 0; f < x.cols; ++f) {
                const float value =
                    (set.features(i, f) - standard.mean[std::size_t(f)]) * standard.scale[std::size_t(f)];
                x(i, f) = std::clamp(value, -4.F, 4.F);
            }
        }
        cv::Mat1f distances(x.rows, x.rows);
        std::vector<float> apart;
        for (int i = 0; i < x.rows; ++i) {
            for (int j = 0; j < x.rows; ++j) {
                distances(i, j) = static_cast<float>(std::pow(cv::norm(x.row(i), x.row(j)), 2));
                if (j < i) apart.push_back(distances(i, j));
            }
        }
        std::sort(apart.begin(), apart.end());
        const double median = apart[apart.size() / 2];
        std::vector<int> labels, order(70), fold(70);
        for (const auto v : set.vehicle) labels.push_back(v ? 1 : -1);
        std::iota(order.begin(), order.end(), 0);
        SeededRandom random(kSeed);
        random.shuffle(order);
        std::map<int, int> dealt;
        for (const int i : order) fold[std::size_t(i)] = dealt[labels[std::size_t(i)]]++ % kFolds;
        const auto kernelOf = [&](double gamma, const std::vector<int>& samples) {
            cv::Mat1f kernel(int(samples.size()), int(samples.size()));
            for (int a = 0; a < kernel.rows; ++a) {
                for (int b = 0; b < kernel.cols; ++b)
                    kernel(a, b) =
                        float(std::exp(-gamma * distances(samples[std::size_t(a)], samples[std::size_t(b)])));
            }
            return kernel;
        };
        double most = 0, best_c = 0, best_gamma = 0;
        for (const double c : {1., 4., 16., 64.}) {
            for (const double width : {0.25, 0.5, 1., 2., 4.}) {
                std::map<int, double> right, all;
                for (int out = 0; out < kFolds; ++out) {
                    std::vector<int> train, train_labels;
                    for (int i = 0; i < 70; ++i) {
                        if (fold[std::size_t(i)] == out) continue;
                        train.push_back(i);
                        train_labels.push_back(labels[std::size_t(i)]);
                    }
                    const SmoSolution solved = solveSmo(kernelOf(width / median, train), train_labels, c);
                    for (int i = 0; i < 70; ++i) {
                        if (fold[std::size_t(i)] != out) continue;
                        double decision = solved.bias;
                        for (std::size_t k = 0; k < train.size(); ++k)
                            decision +=
                                solved.alpha[k] * train_labels[k] * std::exp(-width / median * distances(i, train[k]));
                        ++all[labels[std::size_t(i)]];
                        right[labels[std::size_t(i)]] += (decision > 0) == (labels[std::size_t(i)] > 0);
                    }
                }
                const double score = (right[1] / all[1] + right[-1] / all[-1]) / 2;
                if (score > most + 1e-12) {
                    most = score;
                    best_c = c;
                    best_gamma = width / median;
                }
            }
        }
        const auto machine = trainSvm(set, kFolds, kSeed, {});
        EXPECT_EQ(machine->c(), best_c) << which;
        EXPECT_NEAR(machine->gamma(), best_gamma, 1e-4 * best_gamma) << which;
        std::vector<int> everyone(70);
        std::iota(everyone.begin(), everyone.end(), 0);
        const SmoSolution solved = solveSmo(kernelOf(best_gamma, everyone), labels, best_c);
        int vectors = 0;
        for (int i = 0; i < 70; ++i) {
            double decision = solved.bias;
            for (int k = 0; k < 70; ++k)
                decision +=
                    solved.alpha[std::size_t(k)] * labels[std::size_t(k)] * std::exp(-best_gamma * distances(i, k));
            vectors += solved.alpha[std::size_t(i)] > 0;
            EXPECT_NEAR(machine->decide({set.features[i], 4}), decision, 0.02 * best_c) << i;
        }
        EXPECT_EQ(machine->vectors(), vectors);
    }
}

}  // namespace eyrie

// The classifiers' trainings beside the same done plainly, with the same random numbers.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <opencv2/core.hpp>

#include "learning/classifiers/fast_ica.h"
#include "learning/classifiers/feature_bins.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/classifiers/random_forest.h"
#include "learning/classifiers/seeded_random.h"
#include "learning/noisy_set.h"

namespace eyrie::training_reference_test {
namespace {

using test::noisySet;

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

/// Goes through trained trees as Gentle AdaBoost has it, whose trees see a share of the features and the heaviest
/// samples: each split must be as good as the best one there is (equally good ones differ by rounding), each leaf the
/// mean label.
void expectBoosted(const TrainingSet& set, const std::vector<BoostedTree>& trees, double share, double trimming,
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
    for (const BoostedTree& tree : trees) {
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
        const auto expectBest = [&](const std::vector<std::size_t>& samples, std::size_t node) {
            double most = -1, own = -1, all = 0;
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
                    most = std::max(most, gain);
                    if (tree.feature[node] == order[k] && tree.threshold[node] == border) own = gain;
                }
            }
            EXPECT_GE(own, most - 1e-5 * std::abs(most)) << "share " << share << ", node " << node;
        };
        std::vector<std::size_t> heavy;
        for (std::size_t i = 0; i < count; ++i) {
            if (weights[i] >= least) heavy.push_back(i);
        }
        const auto sideOf = [&](std::size_t i, std::size_t node) {
            return std::size_t(set.features(int(i), tree.feature[node]) >= tree.threshold[node]);
        };
        expectBest(heavy, 0);
        for (const std::size_t side : {0U, 1U}) {
            std::vector<std::size_t> there;
            for (const std::size_t i : heavy) {
                if (sideOf(i, 0) == side) there.push_back(i);
            }
            expectBest(there, 1 + side);
        }
        double weight[4] = {}, label[4] = {};
        const auto leafOf = [&](std::size_t i) { return 2 * sideOf(i, 0) + sideOf(i, 1 + sideOf(i, 0)); };
        for (std::size_t i = 0; i < count; ++i) {
            weight[leafOf(i)] += weights[i];
            label[leafOf(i)] += set.vehicle[i] ? weights[i] : -weights[i];
        }
        for (std::size_t leaf = 0; leaf < 4; ++leaf)
            EXPECT_NEAR(tree.leaf[leaf], weight[leaf] > 0 ? 512 * label[leaf] / weight[leaf] : 0, 0.51) << leaf;
        double sum = 0;
        for (std::size_t i = 0; i < count; ++i)
            sum += weights[i] *= std::exp((set.vehicle[i] ? -1.0 : 1.0) * tree.leaf[leafOf(i)] / 512);
        for (double& w : weights) w /= sum;
    }
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
        Eigen::MatrixXd nearest = w;
        const cv::Mat columns(int(w.cols()), int(w.rows()), CV_64F, nearest.data());  // transposed, as its result is
        const cv::SVD svd(columns.clone());
        cv::Mat(svd.u * svd.vt).copyTo(columns);
        return nearest;
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
        ASSERT_EQ(boosted->trees().size(), 25U);
        expectBoosted(set, boosted->trees(), share, trimming, 4);
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

}  // namespace eyrie::training_reference_test

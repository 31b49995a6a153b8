// Random Naïve Bayes and the support vector machine beside the same trained plainly, with the same random numbers.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/smo_solver.h"
#include "learning/classifiers/standardisation.h"
#include "learning/classifiers/svm.h"
#include "learning/noisy_set.h"

namespace eyrie::bayes_reference_test {
namespace {

using test::noisySet;

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

}  // namespace eyrie::bayes_reference_test

#include "learning/classifiers/classifier.h"

#include <cmath>
#include <opencv2/core/utility.hpp>

#include "core/error.h"
#include "learning/classifiers/gentle_adaboost.h"
#include "learning/classifiers/random_forest.h"
#include "learning/classifiers/random_naive_bayes.h"
#include "learning/classifiers/svm.h"

namespace eyrie {

const std::vector<ClassifierKind>& allClassifiers() {
    static const std::vector<ClassifierKind> kinds{ClassifierKind::svm,
                                                   ClassifierKind::adaboost,
                                                   ClassifierKind::random_forest,
                                                   ClassifierKind::random_naive_bayes,
                                                   ClassifierKind::ica_random_naive_bayes,
                                                   ClassifierKind::cc_ica_random_naive_bayes};
    return kinds;
}

const char* nameOf(ClassifierKind kind) {
    switch (kind) {
        case ClassifierKind::svm:
            return "svm";
        case ClassifierKind::adaboost:
            return "adaboost";
        case ClassifierKind::random_forest:
            return "rf";
        case ClassifierKind::random_naive_bayes:
            return "rnb";
        case ClassifierKind::ica_random_naive_bayes:
            return "ica_rnb";
        case ClassifierKind::cc_ica_random_naive_bayes:
            return "cc_ica_rnb";
    }
    throw Error(ErrorKind::internal, "unknown classifier");
}

const char* titleOf(ClassifierKind kind) {
    switch (kind) {
        case ClassifierKind::svm:
            return "SVM";
        case ClassifierKind::adaboost:
            return "AdaBoost";
        case ClassifierKind::random_forest:
            return "Random Forest";
        case ClassifierKind::random_naive_bayes:
            return "Random Naïve Bayes";
        case ClassifierKind::ica_random_naive_bayes:
            return "Random Naïve Bayes after ICA";
        case ClassifierKind::cc_ica_random_naive_bayes:
            return "Random Naïve Bayes after class-conditional ICA";
    }
    throw Error(ErrorKind::internal, "unknown classifier");
}

ClassifierKind classifierFromName(const std::string& name) {
    std::string known;
    for (const ClassifierKind kind : allClassifiers()) {
        if (name == nameOf(kind)) return kind;
        known += (known.empty() ? "" : ", ") + std::string(nameOf(kind));
    }
    throw Error(ErrorKind::parameter, "unknown classifier \"" + name + "\"; known are " + known);
}

ClassifierOptions ClassifierOptions::thesis() {
    ClassifierOptions options;
    options.feature_share = 1;
    options.weight_trimming = 0;
    return options;
}

void ClassifierOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::none);
    declare.integer(
        "training.trees", trees, 1, 10000,
        {"trees", "Trees of AdaBoost and Random Forest. More are slower and rarely worse.", "Teutsch §7.3.3"});
    declare.real("training.feature_share", feature_share, 0.001, 1,
                 {"",
                  "Share of the features, drawn again for each tree, that AdaBoost may choose from. Less trains "
                  "faster and makes the trees more different.",
                  ""});
    declare.real("training.weight_trimming", weight_trimming, 0, 0.5,
                 {"",
                  "Samples with the smallest weights choose no splits of AdaBoost's trees as long as they hold no more "
                  "than this share of the whole weight together. 0: all samples choose.",
                  ""});
    declare.integer("training.weak_classifiers", weak_classifiers, 1, 10000,
                    {"", "Weak classifiers K of Random Naïve Bayes.", "Teutsch §5.4.3, algorithm 2"});
    declare.integer(
        "training.weak_features", weak_features, 1, 64,
        {"", "Features F that each weak classifier of Random Naïve Bayes sees.", "Teutsch §5.4.3, algorithm 2"});
    declare.real(
        "training.max_weak_error", max_weak_error, 0.01, 1,
        {"", "Weak classifiers with a larger out-of-bag error are rejected (T_a).", "Teutsch §5.4.3, algorithm 2"});
    declare.integer("training.folds", folds, 2, 10,
                    {"", "Parts of the cross validation that chooses the SVM's C and gamma.", "Teutsch §7.3.3"});
}

void requireTrainable(const TrainingSet& set, int least) {
    if (static_cast<std::size_t>(set.features.rows) != set.vehicle.size()) {
        throw Error(ErrorKind::internal, "training set: as many labels as feature vectors are needed");
    }
    int vehicles = 0;
    for (const std::uint8_t label : set.vehicle) vehicles += label != 0 ? 1 : 0;
    const int others = set.count() - vehicles;
    if (vehicles < least || others < least) {
        throw Error(ErrorKind::input, "training set: " + std::to_string(vehicles) + " vehicles and " +
                                          std::to_string(others) + " other samples, but at least " +
                                          std::to_string(least) + " of each are needed");
    }
    if (!cv::checkRange(set.features)) throw Error(ErrorKind::input, "training set: a feature is not a finite number");
}

std::vector<double> Classifier::decideAll(const cv::Mat1f& features) const {
    std::vector<double> values(static_cast<std::size_t>(features.rows));
    cv::parallel_for_(cv::Range(0, features.rows), [&](const cv::Range& range) {
        for (int i = range.start; i < range.end; ++i) {
            values[static_cast<std::size_t>(i)] = decide({features[i], static_cast<std::size_t>(features.cols)});
        }
    });
    return values;
}

std::unique_ptr<Classifier> trainClassifier(ClassifierKind kind, const TrainingSet& set,
                                            const ClassifierOptions& options, std::uint64_t seed,
                                            const TrainingWatch& watch) {
    requireTrainable(set, 2);
    switch (kind) {
        case ClassifierKind::svm:
            return trainSvm(set, options.folds, seed, watch);
        case ClassifierKind::adaboost:
            return trainGentleAdaBoost(set, options.trees, options.feature_share, options.weight_trimming, seed, watch);
        case ClassifierKind::random_forest:
            return trainRandomForest(set, options.trees, seed, watch);
        case ClassifierKind::random_naive_bayes:
        case ClassifierKind::ica_random_naive_bayes:
        case ClassifierKind::cc_ica_random_naive_bayes:
            return trainRandomNaiveBayes(set, kind, options, seed, watch);
    }
    throw Error(ErrorKind::internal, "unknown classifier");
}

std::unique_ptr<Classifier> readClassifier(ClassifierKind kind, int dimension, ByteReader& in) {
    switch (kind) {
        case ClassifierKind::svm:
            return Svm::read(dimension, in);
        case ClassifierKind::adaboost:
            return GentleAdaBoost::read(dimension, in);
        case ClassifierKind::random_forest:
            return RandomForest::read(dimension, in);
        case ClassifierKind::random_naive_bayes:
        case ClassifierKind::ica_random_naive_bayes:
        case ClassifierKind::cc_ica_random_naive_bayes:
            return RandomNaiveBayes::read(kind, dimension, in);
    }
    throw Error(ErrorKind::internal, "unknown classifier");
}

}  // namespace eyrie

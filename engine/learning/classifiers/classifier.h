#pragma once

#include <cstdint>
#include <memory>
#include <opencv2/core/mat.hpp>
#include <span>
#include <string>
#include <vector>

#include "core/parameter.h"
#include "learning/models/byte_stream.h"
#include "learning/training/training_set.h"

namespace eyrie {

/// The classifiers of Teutsch §7.3.3. The numbers are stored in model files: never change them.
enum class ClassifierKind {
    svm = 0,
    adaboost = 1,
    random_forest = 2,
    random_naive_bayes = 3,
    ica_random_naive_bayes = 4,
    cc_ica_random_naive_bayes = 5
};

/// All kinds, in the order of table 7.4.
const std::vector<ClassifierKind>& allClassifiers();
/// The word on the command line: svm, adaboost, rf, rnb, ica_rnb, cc_ica_rnb.
const char* nameOf(ClassifierKind kind);
/// What people call it: SVM, AdaBoost, Random Forest, Random Naïve Bayes, after ICA, after CC-ICA.
const char* titleOf(ClassifierKind kind);
/// Throws Error(parameter) naming the known ones.
ClassifierKind classifierFromName(const std::string& name);

/// Tells vehicles from everything else by their feature vectors. Immutable: may be used by several threads.
class Classifier {
 public:
    virtual ~Classifier() = default;
    virtual ClassifierKind kind() const = 0;
    /// Length of the feature vectors.
    virtual int dimension() const = 0;
    /// Decision value; higher is surer to be a vehicle, and 0 is the classifier's own border. Its scale depends on the
    /// kind.
    virtual double decide(std::span<const float> features) const = 0;
    /// One decision value per row.
    virtual std::vector<double> decideAll(const cv::Mat1f& features) const;
    /// What `readClassifier` takes.
    virtual void write(ByteWriter& out) const = 0;
};

/// Settings of all classifiers.
struct ClassifierOptions {
    int trees = 1000;               ///< AdaBoost, Random Forest
    double feature_share = 0.25;    ///< AdaBoost: share of the features that each tree may choose from
    double weight_trimming = 0.01;  ///< AdaBoost: samples that hold together no more than this share of the weight
                                    ///< choose no splits; 0: all choose
    int weak_classifiers = 1000;    ///< Random Naïve Bayes: K
    int weak_features = 10;         ///< F
    double max_weak_error = 0.6;    ///< T_a
    int folds = 3;                  ///< SVM: cross validation

    /// As published (§7.3.3): AdaBoost sees all features and all samples for every tree.
    static ClassifierOptions thesis();
    /// Group "training".
    void describe(ParameterVisitor& visitor);
};

/// Trains a classifier; the same set, options and seed give the same one. Returns nothing when it was stopped. Throws
/// Error(input) when the set cannot be learnt from.
std::unique_ptr<Classifier> trainClassifier(ClassifierKind kind, const TrainingSet& set,
                                            const ClassifierOptions& options, std::uint64_t seed,
                                            const TrainingWatch& watch = {});

/// Reads what Classifier::write wrote. Throws Error(input) on damage.
std::unique_ptr<Classifier> readClassifier(ClassifierKind kind, int dimension, ByteReader& in);

}  // namespace eyrie

#pragma once

#include <vector>

#include "learning/classifiers/classifier.h"

namespace eyrie {

/// A node of a decision tree; leaves have no children.
struct ForestNode {
    int feature = -1;     ///< −1: leaf
    float threshold = 0;  ///< a value ≥ the threshold goes to `right`, others to the next node
    int right = 0;        ///< index in the tree's nodes
    float vehicles = 0;   ///< leaf: share of vehicles, 0 … 1
};

/// Random Forest (Breiman 2001; Teutsch §7.3.3): bootstraps, √n random features per node, full-grown trees. The
/// decision value is the mean share of vehicles in the leaves − 0.5.
class RandomForest : public Classifier {
 public:
    RandomForest(int dimension, std::vector<std::vector<ForestNode>> trees);

    ClassifierKind kind() const override { return ClassifierKind::random_forest; }
    int dimension() const override { return dimension_; }
    double decide(std::span<const float> features) const override;
    void write(ByteWriter& out) const override;
    static std::unique_ptr<RandomForest> read(int dimension, ByteReader& in);

 private:
    int dimension_;
    std::vector<std::vector<ForestNode>> trees_;
};

/// Null when stopped.
std::unique_ptr<RandomForest> trainRandomForest(const TrainingSet& set, int trees, std::uint64_t seed,
                                                const TrainingWatch& watch);

}  // namespace eyrie

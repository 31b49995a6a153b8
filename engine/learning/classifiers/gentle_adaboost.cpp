#include "learning/classifiers/gentle_adaboost.h"

#include <cmath>
#include <utility>

namespace eyrie {

GentleAdaBoost::GentleAdaBoost(int dimension, std::vector<BoostedTree> trees, std::vector<float> least_sums)
    : dimension_(dimension), trees_(std::move(trees)), least_sums_(std::move(least_sums)) {}

double GentleAdaBoost::decide(std::span<const float> features) const {
    int sum = 0;
    const auto reaches = [&](const BoostedTree& tree, std::size_t node) -> std::size_t {
        return features[static_cast<std::size_t>(tree.feature[node])] >= tree.threshold[node] ? 1 : 0;
    };
    for (const BoostedTree& tree : trees_) {
        const std::size_t side = reaches(tree, 0);
        sum += tree.leaf[2 * side + reaches(tree, 1 + side)];
    }
    return static_cast<double>(sum) / kLeafUnit;
}

void GentleAdaBoost::write(ByteWriter& out) const {
    out.put(static_cast<std::int32_t>(trees_.size()));
    for (std::size_t t = 0; t < trees_.size(); ++t) {
        for (const int feature : trees_[t].feature) out.put(static_cast<std::int32_t>(feature));
        for (const float threshold : trees_[t].threshold) out.put(threshold);
        for (const std::int16_t leaf : trees_[t].leaf) out.put(leaf);
        out.put(least_sums_[t]);
    }
}

std::unique_ptr<GentleAdaBoost> GentleAdaBoost::read(int dimension, ByteReader& in) {
    const int count = in.getInt(1, 100000, "the number of trees");
    std::vector<BoostedTree> trees;
    std::vector<float> least_sums;
    for (int t = 0; t < count; ++t) {
        BoostedTree tree;
        for (int& feature : tree.feature) feature = in.getInt(0, dimension - 1, "a tree's feature");
        for (float& threshold : tree.threshold) threshold = in.getFinite();
        for (std::int16_t& leaf : tree.leaf) {
            leaf = in.get<std::int16_t>();
            if (std::abs(leaf) > kLeafUnit) in.damaged("a leaf is out of range");
        }
        trees.push_back(tree);
        least_sums.push_back(in.getFinite());
    }
    return std::make_unique<GentleAdaBoost>(dimension, std::move(trees), std::move(least_sums));
}

}  // namespace eyrie

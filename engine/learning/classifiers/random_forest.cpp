#include "learning/classifiers/random_forest.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <mutex>
#include <opencv2/core/utility.hpp>
#include <utility>

#include "learning/classifiers/feature_bins.h"
#include "learning/classifiers/seeded_random.h"

namespace eyrie {
namespace {

constexpr int kLargestDepth = 32;

class TreeGrower {
 public:
    TreeGrower(const TrainingSet& set, const FeatureBins& bins, std::uint64_t seed)
        : set_(set), bins_(bins), random_(seed), tried_(std::max(1, static_cast<int>(std::sqrt(set.dimension())))) {}

    std::vector<ForestNode> grow() {
        std::vector<int> samples(set_.vehicle.size());
        for (int& sample : samples) sample = random_.below(set_.count());
        addNode(samples, 0);
        return std::move(nodes_);
    }

 private:
    struct Split {
        int feature = -1;
        int bin = 0;
        double purity = 0;  // Σ over both sides of (vehicles² + others²) / samples
    };

    void addNode(const std::vector<int>& samples, int depth) {
        const std::size_t at = nodes_.size();
        nodes_.emplace_back();
        double vehicles = 0;
        for (const int sample : samples) vehicles += set_.vehicle[static_cast<std::size_t>(sample)];
        const auto count = static_cast<double>(samples.size());
        nodes_[at].vehicles = static_cast<float>(vehicles / count);
        if (vehicles == 0 || vehicles == count || depth == kLargestDepth) return;
        const Split split = bestSplit(samples);
        if (split.feature < 0) return;
        std::vector<int> sides[2];
        const auto codes = bins_.codes(split.feature);
        for (const int sample : samples) {
            sides[codes[static_cast<std::size_t>(sample)] >= split.bin ? 1 : 0].push_back(sample);
        }
        nodes_[at].feature = split.feature;
        nodes_[at].threshold = bins_.borders(split.feature)[static_cast<std::size_t>(split.bin - 1)];
        addNode(sides[0], depth + 1);
        nodes_[at].right = static_cast<int>(nodes_.size());
        addNode(sides[1], depth + 1);
    }

    Split bestSplit(const std::vector<int>& samples) {
        Split best;
        // Features that are constant here do not count as tried, up to a limit.
        int useful = 0;
        for (int attempt = 0; attempt < 10 * tried_ && useful < tried_; ++attempt) {
            const int feature = random_.below(bins_.features());
            const auto codes = bins_.codes(feature);
            int counts[2][FeatureBins::kBins] = {};
            int totals[2] = {};
            for (const int sample : samples) {
                const auto i = static_cast<std::size_t>(sample);
                ++counts[set_.vehicle[i]][codes[i]];
                ++totals[set_.vehicle[i]];
            }
            bool varies = false;
            int left[2] = {};
            for (int bin = 1; bin < FeatureBins::kBins; ++bin) {
                for (int c = 0; c < 2; ++c) left[c] += counts[c][bin - 1];
                const double right[2] = {double(totals[0] - left[0]), double(totals[1] - left[1])};
                const double left_count = left[0] + left[1];
                const double right_count = right[0] + right[1];
                if (left_count == 0 || right_count == 0) continue;
                varies = true;
                const double purity = (double(left[0]) * left[0] + double(left[1]) * left[1]) / left_count +
                                      (right[0] * right[0] + right[1] * right[1]) / right_count;
                if (purity > best.purity) best = {feature, bin, purity};
            }
            useful += varies ? 1 : 0;
        }
        return best;
    }

    const TrainingSet& set_;
    const FeatureBins& bins_;
    SeededRandom random_;
    int tried_;
    std::vector<ForestNode> nodes_;
};

}  // namespace

RandomForest::RandomForest(int dimension, std::vector<std::vector<ForestNode>> trees)
    : dimension_(dimension), trees_(std::move(trees)) {}

double RandomForest::decide(std::span<const float> features) const {
    double sum = 0;
    for (const auto& tree : trees_) {
        std::size_t at = 0;
        while (tree[at].feature >= 0) {
            const bool right = features[static_cast<std::size_t>(tree[at].feature)] >= tree[at].threshold;
            at = right ? static_cast<std::size_t>(tree[at].right) : at + 1;
        }
        sum += tree[at].vehicles;
    }
    return sum / static_cast<double>(trees_.size()) - 0.5;
}

void RandomForest::write(ByteWriter& out) const {
    out.put(static_cast<std::int32_t>(trees_.size()));
    for (const auto& tree : trees_) {
        out.put(static_cast<std::int32_t>(tree.size()));
        for (const ForestNode& node : tree) {
            out.put(static_cast<std::int32_t>(node.feature));
            out.put(node.feature < 0 ? node.vehicles : node.threshold);
            out.put(static_cast<std::int32_t>(node.right));
        }
    }
}

std::unique_ptr<RandomForest> RandomForest::read(int dimension, ByteReader& in) {
    const int count = in.getInt(1, 100000, "the number of trees");
    std::vector<std::vector<ForestNode>> trees;
    for (int t = 0; t < count; ++t) {
        const int nodes = in.getInt(1, 10'000'000, "the number of nodes");
        std::vector<ForestNode> tree;
        for (int n = 0; n < nodes; ++n) {
            ForestNode node;
            node.feature = in.getInt(-1, dimension - 1, "a node's feature");
            const float value = in.getFinite();
            node.right = in.getInt(0, nodes - 1, "a node's child");
            // Children come after their parent, so that every walk ends.
            if (node.feature >= 0 && (node.right <= n + 1 || n + 1 >= nodes)) in.damaged("a tree has a loop");
            (node.feature < 0 ? node.vehicles : node.threshold) = value;
            tree.push_back(node);
        }
        trees.push_back(std::move(tree));
    }
    return std::make_unique<RandomForest>(dimension, std::move(trees));
}

std::unique_ptr<RandomForest> trainRandomForest(const TrainingSet& set, int trees, std::uint64_t seed,
                                                const TrainingWatch& watch) {
    const FeatureBins bins(set.features);
    std::vector<std::vector<ForestNode>> grown(static_cast<std::size_t>(trees));
    int done = 0;
    std::mutex mutex;
    cv::parallel_for_(cv::Range(0, trees), [&](const cv::Range& range) {
        for (int t = range.start; t < range.end; ++t) {
            if (watch.stopped()) return;
            const std::uint64_t tree_seed = SeededRandom(seed + static_cast<std::uint64_t>(t)).next();
            grown[static_cast<std::size_t>(t)] = TreeGrower(set, bins, tree_seed).grow();
            const std::lock_guard lock(mutex);
            watch.show("growing trees", static_cast<double>(++done) / trees);
        }
    });
    if (watch.stopped()) return nullptr;
    return std::make_unique<RandomForest>(set.dimension(), std::move(grown));
}

}  // namespace eyrie

#include "learning/models/window_scan_kernel.h"

#include <algorithm>
#include <limits>

#include "learning/classifiers/gentle_adaboost.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "learning/models/window_scan_kernel.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace eyrie::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kTreesPerCount = 32;  // how often vectors look whether it still pays to go on together

std::size_t leafOf(const std::uint16_t* window, const ScanTree& tree) {
    const auto reaches = [&](std::size_t node) -> std::size_t {
        const auto& at = tree.offset[node];
        const int sum = window[at[3]] - window[at[2]] - window[at[1]] + window[at[0]];
        return static_cast<std::uint16_t>(sum) >= tree.threshold[node] ? 1 : 0;
    };
    const std::size_t side = reaches(0);
    return 2 * side + reaches(1 + side);
}

/// Goes on with one window from tree `t`, at a multiple of kTreesPerCheck.
float finishAlone(const std::uint16_t* window, const ScanTree* trees, std::size_t tree_count, std::size_t t,
                  std::int32_t sum, std::int64_t& evaluated) {
    while (t < tree_count) {
        const std::size_t end = std::min(t + kTreesPerCheck, tree_count);
        evaluated += static_cast<std::int64_t>(end - t);
        for (; t < end; ++t) sum += trees[t].leaf[leafOf(window, trees[t])];
        if (sum < trees[t - 1].rejection_line) return -std::numeric_limits<float>::infinity();
    }
    return static_cast<float>(sum) / GentleAdaBoost::kLeafUnit;
}

#if HWY_TARGET == HWY_SCALAR
std::int64_t scanNeighbours(const std::uint16_t* row, int count, const ScanTree* trees, std::size_t tree_count,
                            float* decision) {
    std::int64_t evaluated = 0;
    for (int x = 0; x < count; ++x) decision[x] = finishAlone(row + x, trees, tree_count, 0, 0, evaluated);
    return evaluated;
}
#else
std::int64_t scanNeighbours(const std::uint16_t* row, int count, const ScanTree* trees, std::size_t tree_count,
                            float* decision) {
    const hn::ScalableTag<std::uint16_t> words;
    const hn::RebindToSigned<decltype(words)> leaves;
    const hn::Half<decltype(leaves)> half_leaves;
    const hn::RepartitionToWide<decltype(leaves)> sums;
    const auto lanes = static_cast<int>(hn::Lanes(words));
    const auto half = static_cast<std::size_t>(lanes / 2);
    HWY_ALIGN std::int32_t totals[hn::MaxLanes(words)];
    HWY_ALIGN std::int32_t lives[hn::MaxLanes(words)];
    std::int64_t evaluated = 0;
    for (int x = 0; x < count; x += lanes) {
        const std::uint16_t* window = row + x;
        const int wanted = std::min(lanes, count - x);
        auto total_low = hn::Zero(sums);
        auto total_high = hn::Zero(sums);
        // Lanes beyond the last window are dead from the start.
        const auto limit = hn::Set(sums, wanted);
        auto alive_low = hn::VecFromMask(sums, hn::Lt(hn::Iota(sums, 0), limit));
        auto alive_high = hn::VecFromMask(sums, hn::Lt(hn::Iota(sums, static_cast<std::int32_t>(half)), limit));
        std::size_t t = 0;
        int alive = wanted;
        while (t < tree_count && alive > lanes / 8) {
            const std::size_t pause = std::min(t + kTreesPerCount, tree_count);
            while (t < pause && !hn::AllTrue(sums, hn::Eq(hn::Or(alive_low, alive_high), hn::Zero(sums)))) {
                const std::size_t end = std::min(t + kTreesPerCheck, tree_count);
                evaluated += static_cast<std::int64_t>(wanted) * static_cast<std::int64_t>(end - t);
                auto added = hn::Zero(words);
                for (; t < end; ++t) {
                    const ScanTree& tree = trees[t];
                    const auto below = [&](std::size_t node) {
                        const auto& at = tree.offset[node];
                        const auto sum =
                            hn::Add(hn::Sub(hn::LoadU(words, window + at[3]), hn::LoadU(words, window + at[2])),
                                    hn::Sub(hn::LoadU(words, window + at[0]), hn::LoadU(words, window + at[1])));
                        return hn::Lt(sum, hn::Set(words, tree.threshold[node]));
                    };
                    const auto leaf = [&](std::size_t k) {
                        return hn::Set(words, static_cast<std::uint16_t>(tree.leaf[k]));
                    };
                    const auto left = hn::IfThenElse(below(1), leaf(0), leaf(1));
                    const auto right = hn::IfThenElse(below(2), leaf(2), leaf(3));
                    added = hn::Add(added, hn::IfThenElse(below(0), left, right));
                }
                const auto by = hn::BitCast(leaves, added);
                total_low = hn::Add(total_low, hn::PromoteTo(sums, hn::LowerHalf(half_leaves, by)));
                total_high = hn::Add(total_high, hn::PromoteTo(sums, hn::UpperHalf(half_leaves, by)));
                const auto line = hn::Set(sums, trees[t - 1].rejection_line);
                alive_low = hn::AndNot(hn::VecFromMask(sums, hn::Lt(total_low, line)), alive_low);
                alive_high = hn::AndNot(hn::VecFromMask(sums, hn::Lt(total_high, line)), alive_high);
            }
            hn::Store(alive_low, sums, lives);
            hn::Store(alive_high, sums, lives + half);
            alive = static_cast<int>(std::count_if(lives, lives + lanes, [](std::int32_t life) { return life != 0; }));
            if (alive == 0) break;
        }
        hn::Store(total_low, sums, totals);
        hn::Store(total_high, sums, totals + half);
        hn::Store(alive_low, sums, lives);
        hn::Store(alive_high, sums, lives + half);
        for (int i = 0; i < wanted; ++i) {
            decision[x + i] = lives[i] == 0 ? -std::numeric_limits<float>::infinity()
                                            : finishAlone(window + i, trees, tree_count, t, totals[i], evaluated);
        }
    }
    return evaluated;
}
#endif

}  // namespace eyrie::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

namespace eyrie {

HWY_EXPORT(scanNeighbours);

std::int64_t scanRow(const std::uint16_t* row, int count, const std::vector<ScanTree>& trees, float* decision) {
    return HWY_DYNAMIC_DISPATCH(scanNeighbours)(row, count, trees.data(), trees.size(), decision);
}

}  // namespace eyrie
#endif

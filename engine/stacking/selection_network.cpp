#include "stacking/selection_network.h"

#include <algorithm>

namespace eyrie {
namespace {

/// All comparators of the odd-even merge sort for `padded` (a power of two) places, in order.
std::vector<Comparator> oddEvenMergeSort(int padded) {
    std::vector<Comparator> network;
    for (int run = 1; run < padded; run *= 2) {
        for (int reach = run; reach >= 1; reach /= 2) {
            for (int start = reach % run; start + reach < padded; start += 2 * reach) {
                for (int i = 0; i < std::min(reach, padded - start - reach); ++i) {
                    const int low = start + i;
                    const int high = low + reach;
                    if (low / (2 * run) != high / (2 * run)) continue;
                    network.push_back({static_cast<std::uint16_t>(low), static_cast<std::uint16_t>(high)});
                }
            }
        }
    }
    return network;
}

}  // namespace

std::vector<Comparator> selectionNetwork(int count, int rank) {
    int padded = 1;
    while (padded < count) padded *= 2;
    // The padding counts as larger than everything, so a comparator that reaches into it changes nothing.
    std::vector<Comparator> network = oddEvenMergeSort(padded);
    std::erase_if(network, [&](const Comparator& c) { return c.high >= count; });

    std::vector<bool> needed(static_cast<std::size_t>(padded), false);
    needed[static_cast<std::size_t>(rank)] = true;
    std::vector<Comparator> kept;
    for (auto at = network.rbegin(); at != network.rend(); ++at) {
        Comparator comparator = *at;
        comparator.keep_low = needed[comparator.low];
        comparator.keep_high = needed[comparator.high];
        if (!comparator.keep_low && !comparator.keep_high) continue;
        needed[comparator.low] = needed[comparator.high] = true;
        kept.push_back(comparator);
    }
    std::reverse(kept.begin(), kept.end());
    return kept;
}

}  // namespace eyrie

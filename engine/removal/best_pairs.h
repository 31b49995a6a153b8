#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <vector>

namespace eyrie {

/// Of all pairs of so many things the one that is worth most, time after time, while things change: what every pair is
/// worth is asked once, and again only for those of a thing that changed.
class BestPairs {
 public:
    struct Pair {
        std::size_t first = 0;  ///< lower than `second`
        std::size_t second = 0;
        double worth = 0;
    };

    /// `worth(i, k)` with i < k answers std::optional<double>; nothing for things that make no pair.
    template <class Worth>
    BestPairs(std::size_t count, const Worth& worth) : count_(count) {
        for (std::size_t i = 0; i < count; ++i) {
            for (std::size_t k = i + 1; k < count; ++k) ask(i, k, worth);
        }
    }

    /// Of pairs that are worth the same the first by their numbers.
    std::optional<Pair> best() const {
        const auto found = std::min_element(pairs_.begin(), pairs_.end(), [](const Pair& a, const Pair& b) {
            if (a.worth != b.worth) return a.worth > b.worth;
            return a.first != b.first ? a.first < b.first : a.second < b.second;
        });
        return found == pairs_.end() ? std::nullopt : std::optional(*found);
    }

    /// To be told when a thing changed or takes part no more.
    template <class Worth>
    void changed(std::size_t thing, const Worth& worth) {
        std::erase_if(pairs_, [&](const Pair& pair) { return pair.first == thing || pair.second == thing; });
        for (std::size_t other = 0; other < count_; ++other) {
            if (other != thing) ask(std::min(other, thing), std::max(other, thing), worth);
        }
    }

 private:
    template <class Worth>
    void ask(std::size_t i, std::size_t k, const Worth& worth) {
        if (const std::optional<double> found = worth(i, k)) pairs_.push_back({i, k, *found});
    }

    std::size_t count_;
    std::vector<Pair> pairs_;
};

}  // namespace eyrie

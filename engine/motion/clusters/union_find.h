#pragma once

#include <numeric>
#include <vector>

namespace eyrie {

/// Sets of numbers that grow together.
class UnionFind {
 public:
    explicit UnionFind(std::size_t count) : parents_(count) { std::iota(parents_.begin(), parents_.end(), 0); }

    int root(int i) {
        while (parent(i) != i) {
            parent(i) = parent(parent(i));
            i = parent(i);
        }
        return i;
    }
    void join(int a, int b) {
        a = root(a);
        b = root(b);
        // The smaller number stays root, so that the outcome does not depend on the order of the pairs.
        if (a != b) parent(a > b ? a : b) = a > b ? b : a;
    }
    /// For every number that of its set; sets are numbered from 0 in the order of their first member.
    std::vector<int> numbers() {
        std::vector<int> result(parents_.size(), -1);
        int count = 0;
        for (std::size_t i = 0; i < result.size(); ++i) {
            const auto first = static_cast<std::size_t>(root(static_cast<int>(i)));
            if (result[first] < 0) result[first] = count++;
            result[i] = result[first];
        }
        return result;
    }

 private:
    int& parent(int i) { return parents_[static_cast<std::size_t>(i)]; }
    std::vector<int> parents_;
};

}  // namespace eyrie

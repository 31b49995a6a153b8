#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace eyrie {

/// Random numbers that are the same on every machine and with every standard library (splitmix64).
class SeededRandom {
 public:
    explicit SeededRandom(std::uint64_t seed) : state_(seed) {}

    std::uint64_t next() {
        state_ += 0x9e3779b97f4a7c15ULL;
        std::uint64_t z = state_;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    }
    /// Evenly distributed in 0 … count − 1; `count` > 0. The bias is below count / 2³².
    int below(int count) {
        return static_cast<int>((static_cast<std::uint64_t>(static_cast<std::uint32_t>(next() >> 32)) *
                                 static_cast<std::uint64_t>(count)) >>
                                32);
    }
    /// Evenly distributed in [0, 1).
    double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }
    double between(double low, double high) { return low + (high - low) * uniform(); }

    template <class T>
    void shuffle(std::vector<T>& values) {
        for (std::size_t i = values.size(); i > 1; --i) {
            std::swap(values[i - 1], values[static_cast<std::size_t>(below(static_cast<int>(i)))]);
        }
    }

 private:
    std::uint64_t state_;
};

}  // namespace eyrie

#pragma once

#include <random>

namespace eyrie::test {

/// What tests throw dice for; the same throws for the same seed.
class Dice {
 public:
    explicit Dice(unsigned seed) : dice_(seed) {}
    double between(double low, double high) { return std::uniform_real_distribution<double>(low, high)(dice_); }
    /// Both included.
    int number(int low, int high) { return std::uniform_int_distribution<int>(low, high)(dice_); }
    bool happens(double share) { return between(0, 1) < share; }

 private:
    std::mt19937 dice_;
};

}  // namespace eyrie::test

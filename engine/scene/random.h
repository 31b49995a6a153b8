#pragma once

#include <cstdint>
#include <random>

namespace eyrie {

/// Random numbers that are the same everywhere for the same seed: the generator is prescribed by the language, the
/// distributions are ours (those of the standard library may differ between implementations).
class Random {
 public:
    explicit Random(std::uint32_t seed) : engine_(seed) {}

    /// Uniform in [0, 1).
    double uniform() { return engine_() * (1.0 / 4294967296.0); }
    /// Uniform in [low, high).
    double uniform(double low, double high) { return low + (high - low) * uniform(); }
    /// Nearly normal with mean 0 and deviation 1: a sum of twelve uniform numbers.
    double normal();
    /// Whole number in [0, count); `count` > 0.
    int below(int count) { return static_cast<int>(uniform() * count); }
    bool chance(double probability) { return uniform() < probability; }
    std::uint32_t bits() { return engine_(); }

 private:
    std::mt19937 engine_;
};

/// A well mixed number for each triple: random numbers at any place, in any order.
inline std::uint32_t hashOf(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    std::uint32_t h = a * 0x9E3779B1U ^ (b * 0x85EBCA77U + 0x165667B1U) ^ (c * 0xC2B2AE3DU);
    h ^= h >> 15;
    h *= 0x2C1B3C6DU;
    h ^= h >> 12;
    h *= 0x297A2D39U;
    h ^= h >> 15;
    return h;
}

/// Value noise in [−1, 1]: random numbers on the integer grid, smoothly joined.
float valueNoise(double x, double y, std::uint32_t seed);

/// Value noise summed over octaves, each of half the wavelength and `persistence` times the height; in [−1, 1].
float fractalNoise(double x, double y, std::uint32_t seed, int octaves, float persistence = 0.5F);

}  // namespace eyrie

#include "scene/random.h"

#include <cmath>

namespace eyrie {

double Random::normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
}

float valueNoise(double x, double y, std::uint32_t seed) {
    const double floor_x = std::floor(x);
    const double floor_y = std::floor(y);
    const float fx = static_cast<float>(x - floor_x);
    const float fy = static_cast<float>(y - floor_y);
    const auto ix = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_x));
    const auto iy = static_cast<std::uint32_t>(static_cast<std::int32_t>(floor_y));
    const auto at = [&](std::uint32_t cx, std::uint32_t cy) {
        return static_cast<float>(hashOf(cx, cy, seed) >> 8) * (2.0F / 16777215.0F) - 1.0F;
    };
    const float wx = fx * fx * (3 - 2 * fx);
    const float wy = fy * fy * (3 - 2 * fy);
    const float top = at(ix, iy) * (1 - wx) + at(ix + 1, iy) * wx;
    const float bottom = at(ix, iy + 1) * (1 - wx) + at(ix + 1, iy + 1) * wx;
    return top * (1 - wy) + bottom * wy;
}

float fractalNoise(double x, double y, std::uint32_t seed, int octaves, float persistence) {
    float sum = 0;
    float height = 1;
    float total = 0;
    for (int octave = 0; octave < octaves; ++octave) {
        // Each octave is turned (by the 3-4-5 triangle) so that the grids do not line up.
        sum += height * valueNoise(x, y, seed + static_cast<std::uint32_t>(octave) * 131U);
        total += height;
        height *= persistence;
        const double turned_x = 2 * (0.8 * x - 0.6 * y);
        y = 2 * (0.6 * x + 0.8 * y);
        x = turned_x;
    }
    return sum / total;
}

}  // namespace eyrie

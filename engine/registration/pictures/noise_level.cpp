#include "registration/pictures/noise_level.h"

#include <algorithm>
#include <array>
#include <cstdlib>

namespace eyrie {

double noiseLevel(const PaddedPicture& picture) {
    // The mask [1 −2 1; −2 4 −2; 1 −2 1] turns white noise σ into 6σ.
    std::array<int, 512> histogram{};
    int samples = 0;
    const int row_step = std::clamp(picture.height() / 160, 1, 16);
    const int column_step = picture.width() > 320 ? 2 : 1;
    for (int y = 1; y + 1 < picture.height(); y += row_step) {
        const std::uint8_t* a = picture.row(y - 1);
        const std::uint8_t* b = picture.row(y);
        const std::uint8_t* c = picture.row(y + 1);
        for (int x = 1; x + 1 < picture.width(); x += column_step) {
            const int response =
                a[x - 1] - 2 * a[x] + a[x + 1] - 2 * (b[x - 1] - 2 * b[x] + b[x + 1]) + c[x - 1] - 2 * c[x] + c[x + 1];
            ++histogram[std::size_t(std::min(std::abs(response), 511))];
            ++samples;
        }
    }
    if (samples == 0) return kQuietest;
    const int wanted = samples / 4;
    int below = 0;
    int bin = 0;
    while (bin < 511 && below + histogram[std::size_t(bin)] <= wanted) below += histogram[std::size_t(bin++)];
    // |response| of a whole-numbered bin b covers [b − ½, b + ½); interpolate within it.
    const double inside = double(wanted - below) / std::max(1, histogram[std::size_t(bin)]);
    const double quartile = bin == 0 ? 0.5 * inside : bin - 0.5 + inside;
    constexpr double kLowerQuartileOfAbsoluteNormal = 0.3186;
    return std::max(kQuietest, quartile / (6 * kLowerQuartileOfAbsoluteNormal));
}

}  // namespace eyrie

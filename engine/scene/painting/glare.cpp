#include "scene/painting/glare.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace eyrie {
namespace {

struct Halo {
    int radius;    ///< px, of each of three boxes laid over each other
    double share;  ///< of the lamp's light, many times what the sensor's range can show
};
constexpr std::array<Halo, 3> kHalos{{{1, 2.5}, {5, 6.0}, {19, 16.0}}};

/// Running mean over 2 · radius + 1 values, beyond the ends 0; in whole numbers, which are the same on every machine.
void meanAlong(std::int64_t* values, std::size_t count, std::size_t stride, int radius,
               std::vector<std::int64_t>& row) {
    row.resize(count);
    for (std::size_t i = 0; i < count; ++i) row[i] = values[i * stride];
    const auto reach = static_cast<std::size_t>(radius);
    std::int64_t sum = 0;
    for (std::size_t i = 0; i < std::min(reach, count); ++i) sum += row[i];
    for (std::size_t i = 0; i < count; ++i) {
        if (i + reach < count) sum += row[i + reach];
        if (i > reach) sum -= row[i - reach - 1];
        values[i * stride] = sum / (2 * radius + 1);
    }
}

}  // namespace

void addGlare(cv::Mat& light, const cv::Mat& lamps, int passes, double strength) {
    const auto width = static_cast<std::size_t>(lamps.cols);
    const auto height = static_cast<std::size_t>(lamps.rows);
    constexpr std::int64_t kFine = 4096;
    std::vector<std::int64_t> plane(width * height);
    std::vector<std::int64_t> row;
    for (int channel = 0; channel < 3; ++channel) {
        for (const Halo& halo : kHalos) {
            for (std::size_t y = 0; y < height; ++y) {
                const auto* from = lamps.ptr<std::int32_t>(static_cast<int>(y)) + channel;
                for (std::size_t x = 0; x < width; ++x) plane[y * width + x] = from[3 * x] * kFine;
            }
            for (int pass = 0; pass < 3; ++pass) {
                for (std::size_t y = 0; y < height; ++y) meanAlong(&plane[y * width], width, 1, halo.radius, row);
                for (std::size_t x = 0; x < width; ++x) meanAlong(&plane[x], height, width, halo.radius, row);
            }
            const auto share = static_cast<float>(halo.share * strength / (static_cast<double>(kFine) * passes));
            for (std::size_t y = 0; y < height; ++y) {
                auto* to = light.ptr<float>(static_cast<int>(y)) + channel;
                for (std::size_t x = 0; x < width; ++x) {
                    to[3 * x] += static_cast<float>(plane[y * width + x]) * share;
                }
            }
        }
    }
}

}  // namespace eyrie

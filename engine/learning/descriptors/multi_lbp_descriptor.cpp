#include "learning/descriptors/multi_lbp_descriptor.h"

#include <algorithm>

#include "learning/models/window.h"

namespace eyrie {
namespace {

constexpr int kLbpBlock = 8;
constexpr int kPatterns = 256;
constexpr int kQuantisations = 4;
constexpr int kAcross[8] = {1, 1, 0, -1, -1, -1, 0, 1};
constexpr int kDown[8] = {0, 1, 1, 1, 0, -1, -1, -1};

}  // namespace

void MultiLbpDescriptor::compute(const cv::Mat& window, std::span<float> values) const {
    requireWindow(window);
    std::fill(values.begin(), values.end(), 0.F);
    constexpr float share = 1.F / (kLbpBlock * kLbpBlock);
    for (int y = 0; y < kWindowHeight; ++y) {
        const uchar* rows[3] = {window.ptr<uchar>(std::max(y - 1, 0)), window.ptr<uchar>(y),
                                window.ptr<uchar>(std::min(y + 1, kWindowHeight - 1))};
        for (int x = 0; x < kWindowWidth; ++x) {
            unsigned patterns[kQuantisations] = {};
            for (int p = 0; p < 8; ++p) {
                const int column = std::clamp(x + kAcross[p], 0, kWindowWidth - 1);
                const int difference = rows[1 + kDown[p]][column] - rows[1][x];
                const bool above = difference >= kThreshold;
                const bool not_below = difference >= -kThreshold;
                const bool below = difference <= -kThreshold;
                const bool bits[kQuantisations] = {difference >= 0, above, not_below, above || below};
                for (int q = 0; q < kQuantisations; ++q) patterns[q] |= static_cast<unsigned>(bits[q]) << p;
            }
            const int block = y / kLbpBlock * (kWindowWidth / kLbpBlock) + x / kLbpBlock;
            for (int q = 0; q < kQuantisations; ++q) {
                values[static_cast<std::size_t>((block * kQuantisations + q) * kPatterns) + patterns[q]] += share;
            }
        }
    }
}

}  // namespace eyrie

#include "registration/pictures/picture_difference.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace eyrie {
namespace {

constexpr int kTile = 16;

int absoluteDifference(const std::uint8_t* a, const std::uint8_t* b, int count) {
    int sum = 0;
    for (int x = 0; x < count; ++x) sum += std::abs(int(a[x]) - int(b[x]));
    return sum;
}

}  // namespace

PictureDifference difference(const PaddedPicture& a, const PaddedPicture& b) {
    PictureDifference result;
    double total = 0;
    const int tiles_across = (a.width() + kTile - 1) / kTile;
    std::vector<int> sums(std::size_t(tiles_across), 0);
    for (int top = 0; top < a.height(); top += kTile) {
        const int bottom = std::min(top + kTile, a.height());
        std::fill(sums.begin(), sums.end(), 0);
        for (int y = top; y < bottom; ++y) {
            const std::uint8_t* row_a = a.row(y);
            const std::uint8_t* row_b = b.row(y);
            int tile = 0;
            int x = 0;
            for (; x + kTile <= a.width(); x += kTile)
                sums[std::size_t(tile++)] += absoluteDifference(row_a + x, row_b + x, kTile);
            if (x < a.width()) sums[std::size_t(tile)] += absoluteDifference(row_a + x, row_b + x, a.width() - x);
        }
        for (int tile = 0; tile < tiles_across; ++tile) {
            const int columns = std::min(kTile, a.width() - tile * kTile);
            const double mean = double(sums[std::size_t(tile)]) / (columns * (bottom - top));
            // Slivers at the border are too small to speak for themselves.
            if (columns * (bottom - top) >= kTile * kTile / 4) result.worst_tile = std::max(result.worst_tile, mean);
            total += sums[std::size_t(tile)];
        }
    }
    result.mean = total / (double(a.width()) * a.height());
    return result;
}

bool RepetitionDetector::repeats(const PictureDifference& difference) {
    constexpr double kSurelyRepeatedMean = 0.03;
    constexpr double kSurelyRepeatedTile = 0.35;
    constexpr double kRecompressedMean = 0.5;
    constexpr double kRecompressedTile = 1.5;
    constexpr double kShareOfUsual = 0.12;
    if (difference.mean <= kSurelyRepeatedMean && difference.worst_tile <= kSurelyRepeatedTile) return true;
    if (usual_mean_ > 0 && difference.mean <= kRecompressedMean && difference.worst_tile <= kRecompressedTile &&
        difference.mean <= kShareOfUsual * usual_mean_) {
        return true;
    }
    usual_mean_ = usual_mean_ < 0 ? difference.mean : 0.8 * usual_mean_ + 0.2 * difference.mean;
    return false;
}

}  // namespace eyrie

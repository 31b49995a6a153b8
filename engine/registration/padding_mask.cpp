#include "registration/padding_mask.h"

#include <algorithm>

namespace eyrie {
namespace {

/// Lowest and highest grey level of a block.
struct Range {
    int low = 255;
    int high = 0;
};

Range rangeOf(const PaddedPicture& picture, int left, int top, int size) {
    Range range;
    for (int y = top; y < std::min(top + size, picture.height()); ++y) {
        const std::uint8_t* row = picture.row(y);
        for (int x = left; x < std::min(left + size, picture.width()); ++x) {
            range.low = std::min<int>(range.low, row[x]);
            range.high = std::max<int>(range.high, row[x]);
        }
    }
    return range;
}

/// Whether what is left of the picture fills each row and column of blocks without gaps, as a picture that was shifted
/// or turned inside its frame does. Clipped shadows at the border of a dusky street do not leave such a shape.
bool leavesConvexPicture(const std::vector<unsigned char>& padded, int across, int down) {
    int gaps = 0;
    const auto scan = [&](int count, int start, int step) {
        int first = -1;
        int last = -1;
        for (int i = 0; i < count; ++i) {
            if (padded[std::size_t(start + i * step)] != 0) continue;
            if (first < 0) first = i;
            last = i;
        }
        for (int i = std::max(first, 0); i < last; ++i) gaps += padded[std::size_t(start + i * step)] != 0;
    };
    for (int y = 0; y < down; ++y) scan(across, y * across, 1);
    for (int x = 0; x < across; ++x) scan(down, x, across);
    const auto all = std::count(padded.begin(), padded.end(), 1);
    return gaps * 50 <= all;
}

}  // namespace

PaddingMask::PaddingMask(const PaddedPicture& picture) {
    // Compression leaves a grey level or two in what was constant.
    constexpr int kTolerance = 2;
    const int across = (picture.width() + kBlock - 1) / kBlock;
    const int down = (picture.height() + kBlock - 1) / kBlock;
    blocks_across_ = across;
    std::vector<unsigned char> visited(std::size_t(across) * std::size_t(down), 0);
    std::vector<int> padding;
    std::vector<int> area;
    const auto visit = [&](int bx, int by, int level) {
        const int index = by * across + bx;
        if (visited[std::size_t(index)] != 0) return;
        const Range range = rangeOf(picture, bx * kBlock, by * kBlock, kBlock);
        if (range.low < level - kTolerance || range.high > level + kTolerance) return;
        visited[std::size_t(index)] = 1;
        area.push_back(index);
    };
    // An area this small could as well be a clipped highlight or a black roof.
    const auto smallest = std::max<std::size_t>(6, std::size_t(across * down) / 200);
    const auto flood = [&](int bx, int by) {
        const Range seed = rangeOf(picture, bx * kBlock, by * kBlock, kBlock);
        if (seed.high - seed.low > kTolerance) return;
        area.clear();
        visit(bx, by, (seed.low + seed.high) / 2);
        const int level = (seed.low + seed.high) / 2;
        for (std::size_t next = 0; next < area.size(); ++next) {
            const int x = area[next] % across;
            const int y = area[next] / across;
            if (x > 0) visit(x - 1, y, level);
            if (x + 1 < across) visit(x + 1, y, level);
            if (y > 0) visit(x, y - 1, level);
            if (y + 1 < down) visit(x, y + 1, level);
        }
        if (area.size() >= smallest) padding.insert(padding.end(), area.begin(), area.end());
    };
    for (int bx = 0; bx < across; ++bx) {
        flood(bx, 0);
        flood(bx, down - 1);
    }
    for (int by = 0; by < down; ++by) {
        flood(0, by);
        flood(across - 1, by);
    }
    if (padding.empty()) return;
    padded_.assign(visited.size(), 0);
    for (const int index : padding) padded_[std::size_t(index)] = 1;
    if (!leavesConvexPicture(padded_, across, down)) {
        padded_.clear();
        return;
    }
    padded_.assign(visited.size(), 0);
    for (const int index : padding) {
        const int x = index % across;
        const int y = index / across;
        for (int by = std::max(0, y - 1); by <= std::min(down - 1, y + 1); ++by) {
            for (int bx = std::max(0, x - 1); bx <= std::min(across - 1, x + 1); ++bx) {
                padded_[std::size_t(by * across + bx)] = 1;
            }
        }
    }
}

}  // namespace eyrie

#include "registration/pictures/padding_mask.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace eyrie {
namespace {

constexpr int kBlock = 8;
/// Compression leaves a grey level or two in what was constant.
constexpr int kTolerance = 2;
/// px that compression may smear the border of the padding.
constexpr int kMargin = 8;

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

/// Blocks of one grey level that are joined to the border of the picture.
class BorderAreas {
 public:
    explicit BorderAreas(const PaddedPicture& picture)
        : picture_(picture),
          across_((picture.width() + kBlock - 1) / kBlock),
          down_((picture.height() + kBlock - 1) / kBlock),
          padded_(std::size_t(across_) * std::size_t(down_), 0) {
        for (int x = 0; x < across_; ++x) {
            flood(x, 0);
            flood(x, down_ - 1);
        }
        for (int y = 0; y < down_; ++y) {
            flood(0, y);
            flood(across_ - 1, y);
        }
    }

    /// Grey levels of the areas that are padding; none when the picture merely has dark or bright parts.
    std::vector<int> levels() const {
        return levels_.empty() || !leavesConvexPicture(padded_, across_, down_) ? std::vector<int>() : levels_;
    }

 private:
    void flood(int x, int y) {
        const Range seed = rangeOf(picture_, x * kBlock, y * kBlock, kBlock);
        if (seed.high - seed.low > kTolerance) return;
        const int level = (seed.low + seed.high) / 2;
        std::vector<int> area;
        visit(x, y, level, area);
        for (std::size_t next = 0; next < area.size(); ++next) {
            const int bx = area[next] % across_;
            const int by = area[next] / across_;
            visit(bx - 1, by, level, area);
            visit(bx + 1, by, level, area);
            visit(bx, by - 1, level, area);
            visit(bx, by + 1, level, area);
        }
        // An area this small could as well be a clipped highlight or a black roof.
        if (area.size() >= std::max<std::size_t>(6, padded_.size() / 200)) {
            levels_.push_back(level);
        } else {
            for (const int index : area) padded_[std::size_t(index)] = 0;
        }
    }
    void visit(int x, int y, int level, std::vector<int>& area) {
        if (x < 0 || y < 0 || x >= across_ || y >= down_ || padded_[std::size_t(y * across_ + x)] != 0) return;
        const Range range = rangeOf(picture_, x * kBlock, y * kBlock, kBlock);
        if (range.low < level - kTolerance || range.high > level + kTolerance) return;
        padded_[std::size_t(y * across_ + x)] = 1;
        area.push_back(y * across_ + x);
    }

    const PaddedPicture& picture_;
    int across_;
    int down_;
    std::vector<unsigned char> padded_;
    std::vector<int> levels_;
};

/// The largest of each value and its neighbours up to `kMargin` away.
std::vector<int> widened(const std::vector<int>& values) {
    std::vector<int> result(values.size());
    const auto count = static_cast<int>(values.size());
    for (int i = 0; i < count; ++i) {
        const auto first = values.begin() + std::max(0, i - kMargin);
        const auto last = values.begin() + std::min(count, i + kMargin + 1);
        result[std::size_t(i)] = *std::max_element(first, last);
    }
    return result;
}

}  // namespace

PaddingMask::PaddingMask(const PaddedPicture& picture) {
    const std::vector<int> levels = BorderAreas(picture).levels();
    if (levels.empty()) return;
    const int width = picture.width();
    const int height = picture.height();
    const auto padded = [&](int x, int y) {
        const int value = picture.row(y)[x];
        return std::any_of(levels.begin(), levels.end(),
                           [&](int level) { return std::abs(value - level) <= kTolerance; });
    };
    std::vector<int> left(std::size_t(height), 0);
    std::vector<int> right(std::size_t(height), 0);
    std::vector<int> top(std::size_t(width), 0);
    std::vector<int> bottom(std::size_t(width), 0);
    for (int y = 0; y < height; ++y) {
        int& from_left = left[std::size_t(y)];
        int& from_right = right[std::size_t(y)];
        while (from_left < width && padded(from_left, y)) ++from_left;
        while (from_right < width - from_left && padded(width - 1 - from_right, y)) ++from_right;
    }
    for (int x = 0; x < width; ++x) {
        int& from_top = top[std::size_t(x)];
        int& from_bottom = bottom[std::size_t(x)];
        while (from_top < height && padded(x, from_top)) ++from_top;
        while (from_bottom < height - from_top && padded(x, height - 1 - from_bottom)) ++from_bottom;
    }
    // A border that is merely dark for a pixel or two is none; a margin keeps corners off the edge of the padding.
    const auto withMargin = [](std::vector<int> runs) {
        runs = widened(runs);
        for (int& run : runs) run = run > 1 ? run + kMargin : 0;
        return runs;
    };
    from_left_ = withMargin(std::move(left));
    from_top_ = withMargin(std::move(top));
    from_right_ = withMargin(std::move(right));
    from_bottom_ = withMargin(std::move(bottom));
    for (int& end : from_right_) end = width - end;
    for (int& end : from_bottom_) end = height - end;
}

}  // namespace eyrie

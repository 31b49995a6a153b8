#include "motion/vectors/cell_means.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace eyrie {
namespace {

/// The pixels of one side that lie in a cell, and what of each does.
struct CellSpan {
    static constexpr double kLeastPart = 1e-3;  ///< of a pixel; less comes of rounding

    int first = 0;
    std::vector<float> shares;  ///< of the cell; their sum is 1

    CellSpan(int cell, int cells, int pixels) {
        const double length = static_cast<double>(pixels) / cells;
        const double begin = cell * length;
        const double end = std::min<double>(begin + length, pixels);
        first = static_cast<int>(begin);
        for (int pixel = first; pixel < end; ++pixel) {
            const double part = std::min<double>(pixel + 1, end) - std::max<double>(pixel, begin);
            if (part > kLeastPart)
                shares.push_back(static_cast<float>(part / (end - begin)));
            else if (shares.empty())
                ++first;
        }
    }
};

std::vector<CellSpan> spansOf(int cells, int pixels) {
    std::vector<CellSpan> spans;
    spans.reserve(static_cast<std::size_t>(cells));
    for (int cell = 0; cell < cells; ++cell) spans.emplace_back(cell, cells, pixels);
    return spans;
}

}  // namespace

cv::Mat cellMeans(const cv::Mat& gray, cv::Size cells) {
    CV_Assert(gray.type() == CV_8UC1 && cells.width >= 1 && cells.height >= 1);
    CV_Assert(cells.width <= gray.cols && cells.height <= gray.rows);
    cv::Mat means(cells, CV_8UC1);
    const std::vector<CellSpan> columns = spansOf(cells.width, gray.cols);
    std::vector<float> sums(static_cast<std::size_t>(gray.cols));
    for (int row = 0; row < cells.height; ++row) {
        const CellSpan rows(row, cells.height, gray.rows);
        std::fill(sums.begin(), sums.end(), 0.0F);
        int y = rows.first;
        for (const float share : rows.shares) {
            const uchar* const pixels = gray.ptr<uchar>(y++);
            for (std::size_t x = 0; x < sums.size(); ++x) sums[x] += share * static_cast<float>(pixels[x]);
        }
        for (int column = 0; column < cells.width; ++column) {
            const CellSpan& span = columns[static_cast<std::size_t>(column)];
            float mean = 0;
            auto sum = sums.begin() + span.first;
            for (const float share : span.shares) mean += share * *sum++;
            means.at<uchar>(row, column) = cv::saturate_cast<uchar>(mean);
        }
    }
    return means;
}

}  // namespace eyrie

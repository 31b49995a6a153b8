#include "detection/segmenters/relative_connectivity.h"

#include <vector>

namespace eyrie {
namespace {

/// One scan line of algorithm 1. `set` holds `size` points.
void scanLine(const std::vector<uchar>& set, int min_points, std::vector<int>& line) {
    const int size = static_cast<int>(set.size());
    const auto at = [&](int x) { return x >= 0 && x < size && set[static_cast<std::size_t>(x)] != 0; };
    for (int first = 0; first < size; ++first) {
        if (!at(first)) continue;
        const int farthest = (size - 1 - first) / (min_points - 1);  // farther apart, fewer than that many fit
        for (int step = 1; step <= farthest; ++step) {
            if (!at(first + step) || at(first - step)) continue;
            int points = 2;
            int last = first + step;
            while (at(last + step)) {
                last += step;
                ++points;
            }
            if (points < min_points) continue;
            line[static_cast<std::size_t>(first)] += points;
            line[static_cast<std::size_t>(last)] += points;
        }
    }
}

}  // namespace

cv::Mat relativeConnectivity(const cv::Mat& belonging, int min_points) {
    CV_Assert(belonging.empty() || belonging.type() == CV_8UC1);
    CV_Assert(min_points >= 2);
    cv::Mat accumulator = cv::Mat::zeros(belonging.size(), CV_32SC1);
    std::vector<uchar> set;
    std::vector<int> line;
    for (int y = 0; y < belonging.rows; ++y) {
        set.assign(belonging.ptr<uchar>(y), belonging.ptr<uchar>(y) + belonging.cols);
        line.assign(set.size(), 0);
        scanLine(set, min_points, line);
        for (int x = 0; x < belonging.cols; ++x) accumulator.at<int>(y, x) += line[static_cast<std::size_t>(x)];
    }
    for (int x = 0; x < belonging.cols; ++x) {
        set.resize(static_cast<std::size_t>(belonging.rows));
        for (int y = 0; y < belonging.rows; ++y) set[static_cast<std::size_t>(y)] = belonging.at<uchar>(y, x);
        line.assign(set.size(), 0);
        scanLine(set, min_points, line);
        for (int y = 0; y < belonging.rows; ++y) accumulator.at<int>(y, x) += line[static_cast<std::size_t>(y)];
    }
    return accumulator;
}

}  // namespace eyrie

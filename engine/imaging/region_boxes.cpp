#include "imaging/region_boxes.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace eyrie {

void closeGaps(const cv::Mat& binary, cv::Mat& closed) {
    CV_Assert(binary.empty() || binary.type() == CV_8UC1 || binary.type() == CV_32FC1);
    if (binary.empty()) {
        closed = binary.clone();
        return;
    }
    const cv::Mat square = cv::getStructuringElement(cv::MORPH_RECT, {3, 3});
    cv::morphologyEx(binary, closed, cv::MORPH_CLOSE, square);
}

std::vector<Region> findRegions(const cv::Mat& binary, int min_box_area, cv::Mat& labels) {
    CV_Assert(binary.empty() || binary.type() == CV_8UC1);
    std::vector<Region> regions;
    if (binary.empty()) {
        labels.create(binary.size(), CV_32SC1);
        return regions;
    }
    cv::Mat statistics;
    cv::Mat centroids;
    const int count = cv::connectedComponentsWithStats(binary, labels, statistics, centroids, 8, CV_32S, cv::CCL_WU);
    for (int label = 1; label < count; ++label) {
        const int* row = statistics.ptr<int>(label);
        Region region;
        region.label = label;
        region.box = {row[cv::CC_STAT_LEFT], row[cv::CC_STAT_TOP], row[cv::CC_STAT_WIDTH], row[cv::CC_STAT_HEIGHT]};
        region.pixels = row[cv::CC_STAT_AREA];
        if (region.box.area() < min_box_area) continue;
        region.cut = region.box.x == 0 || region.box.y == 0 || region.box.br().x == binary.cols ||
                     region.box.br().y == binary.rows;
        regions.push_back(region);
    }
    return regions;
}

cv::Rect boxWithin(const cv::Mat& labels, const Region& region, const cv::Rect& part) {
    const cv::Rect search = region.box & part & cv::Rect(0, 0, labels.cols, labels.rows);
    int left = search.br().x;
    int right = search.x - 1;
    int top = search.br().y;
    int bottom = search.y - 1;
    for (int y = search.y; y < search.br().y; ++y) {
        const int* row = labels.ptr<int>(y);
        for (int x = search.x; x < search.br().x; ++x) {
            if (row[x] != region.label) continue;
            left = std::min(left, x);
            right = std::max(right, x);
            top = std::min(top, y);
            bottom = std::max(bottom, y);
        }
    }
    if (right < left) return {};
    return {left, top, right - left + 1, bottom - top + 1};
}

}  // namespace eyrie

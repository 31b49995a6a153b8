#include "tracking/silhouettes/box_grid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>
#include <vector>

namespace eyrie {
namespace {

constexpr double kBulk = 0.3;  ///< rows with less of the area than this share of the fullest are fringe

/// First and last of the rows, or columns, that hold enough.
std::pair<int, int> bulkOf(const std::vector<int>& counts) {
    const int least = std::max(1, static_cast<int>(std::ceil(kBulk * *std::max_element(counts.begin(), counts.end()))));
    const auto enough = [&](int count) { return count >= least; };
    const auto first = std::find_if(counts.begin(), counts.end(), enough);
    const auto last = std::find_if(counts.rbegin(), counts.rend(), enough);
    return {static_cast<int>(first - counts.begin()), static_cast<int>(counts.rend() - last) - 1};
}

/// The label that covers most of some places; 0: none does.
int labelCovering(const cv::Mat& labels, int count, const cv::Rect& places) {
    std::vector<int> covered(static_cast<std::size_t>(count), 0);
    for (int y = places.y; y < places.br().y; ++y) {
        for (int x = places.x; x < places.br().x; ++x) ++covered[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
    covered[0] = 0;
    const auto most = std::max_element(covered.begin(), covered.end());
    return *most > 0 ? static_cast<int>(most - covered.begin()) : 0;
}

}  // namespace

BoxGrid::BoxGrid(const OrientedBox& box, double along, double across, double step)
    : box_(box),
      step_(step),
      places_(std::max(5, cvRound((box.length + 2 * along) / step)),
              std::max(5, cvRound((box.width + 2 * across) / step))) {}

cv::Point2d BoxGrid::placeOf(cv::Point2d in_box) const {
    return {in_box.x / step_ + places_.width / 2.0 - 0.5, in_box.y / step_ + places_.height / 2.0 - 0.5};
}

cv::Rect BoxGrid::inBox() const {
    const cv::Size box(std::clamp(cvRound(box_.length / step_), 1, places_.width),
                       std::clamp(cvRound(box_.width / step_), 1, places_.height));
    return {(places_.width - box.width) / 2, (places_.height - box.height) / 2, box.width, box.height};
}

cv::Mat BoxGrid::sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here, cv::Mat* beyond) const {
    cv::Mat xs(places_, CV_32FC1);
    cv::Mat ys(places_, CV_32FC1);
    if (beyond) *beyond = cv::Mat(places_, CV_8UC1, cv::Scalar(0));
    const cv::Point2d along = box_.direction() * step_;
    const cv::Point2d across(-along.y, along.x);
    for (int y = 0; y < places_.height; ++y) {
        const cv::Point2d row = box_.centre + across * (y + 0.5 - places_.height / 2.0);
        for (int x = 0; x < places_.width; ++x) {
            const cv::Point2d here = row + along * (x + 0.5 - places_.width / 2.0);
            const cv::Vec3d there = picture_from_here * cv::Vec3d(here.x, here.y, 1);
            const double px = there[0] / there[2];
            const double py = there[1] / there[2];
            if (!(px >= 0 && py >= 0 && px <= gray.cols - 1 && py <= gray.rows - 1)) {
                if (!beyond) return {};
                beyond->at<uchar>(y, x) = 255;
                xs.at<float>(y, x) = ys.at<float>(y, x) = 0;
                continue;
            }
            xs.at<float>(y, x) = static_cast<float>(px);
            ys.at<float>(y, x) = static_cast<float>(py);
        }
    }
    cv::Mat found;
    cv::remap(gray, found, xs, ys, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return found;
}

std::optional<BoxEdges> BoxGrid::edgesOf(const cv::Mat& mask, const cv::Rect& covering, cv::Mat* area) const {
    cv::Mat closed;
    cv::morphologyEx(mask, closed, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8UC1));
    cv::Mat labels;
    const int count = cv::connectedComponents(closed, labels);
    const int label = labelCovering(labels, count, covering);
    if (label == 0) return {};
    std::vector<int> in_column(static_cast<std::size_t>(places_.width), 0);
    std::vector<int> in_row(static_cast<std::size_t>(places_.height), 0);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            if (labels.at<int>(y, x) != label) continue;
            ++in_column[static_cast<std::size_t>(x)];
            ++in_row[static_cast<std::size_t>(y)];
        }
    }
    if (area) *area = labels == label;
    const auto [rear, front] = bulkOf(in_column);
    const auto [left, right] = bulkOf(in_row);
    return BoxEdges{(rear - places_.width / 2.0) * step_, (front + 1 - places_.width / 2.0) * step_,
                    (left - places_.height / 2.0) * step_, (right + 1 - places_.height / 2.0) * step_};
}

}  // namespace eyrie

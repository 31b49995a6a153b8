#include "imaging/hysteresis.h"

#include <opencv2/imgproc.hpp>
#include <vector>

namespace eyrie {

cv::Mat hysteresis(const cv::Mat& values, double low, double high) {
    CV_Assert(values.empty() || values.type() == CV_32SC1 || values.type() == CV_32FC1);
    cv::Mat kept = cv::Mat::zeros(values.size(), CV_8UC1);
    if (values.empty()) return kept;
    const cv::Mat candidates = values >= low;
    const cv::Mat strong = values >= high;
    cv::Mat labels;
    const int count = cv::connectedComponents(candidates, labels, 8, CV_32S);
    std::vector<char> accepted(static_cast<std::size_t>(count), 0);
    for (int y = 0; y < labels.rows; ++y) {
        const int* label = labels.ptr<int>(y);
        const uchar* is_strong = strong.ptr<uchar>(y);
        for (int x = 0; x < labels.cols; ++x) {
            if (is_strong[x] != 0 && label[x] > 0) accepted[static_cast<std::size_t>(label[x])] = 1;
        }
    }
    for (int y = 0; y < labels.rows; ++y) {
        const int* label = labels.ptr<int>(y);
        uchar* out = kept.ptr<uchar>(y);
        for (int x = 0; x < labels.cols; ++x) out[x] = accepted[static_cast<std::size_t>(label[x])] != 0 ? 255 : 0;
    }
    return kept;
}

}  // namespace eyrie

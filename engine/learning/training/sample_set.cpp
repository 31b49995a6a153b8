#include "learning/training/sample_set.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>

namespace eyrie {

int countOf(const SampleSet& samples, bool vehicle) {
    return static_cast<int>(std::count_if(samples.begin(), samples.end(),
                                          [vehicle](const Sample& sample) { return sample.vehicle == vehicle; }));
}

cv::Mat mirroredAcross(const cv::Mat& window) {
    cv::Mat result;
    cv::flip(window, result, 1);
    return result;
}

cv::Mat mirroredAlong(const cv::Mat& window) {
    cv::Mat result;
    cv::flip(window, result, 0);
    return result;
}

}  // namespace eyrie

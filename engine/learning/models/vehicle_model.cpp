#include "learning/models/vehicle_model.h"

namespace eyrie {

double VehicleModel::decide(const cv::Mat& window) const {
    std::vector<float> features(static_cast<std::size_t>(descriptor->dimension()));
    descriptor->compute(window, features);
    return classifier->decide(features);
}

std::vector<double> VehicleModel::decideAll(const std::vector<cv::Mat>& windows) const {
    // In parts, as 20,000 windows of 8,192 features would fill the memory.
    constexpr std::size_t kAtOnce = 2048;
    std::vector<double> values;
    for (std::size_t begin = 0; begin < windows.size(); begin += kAtOnce) {
        const std::size_t end = std::min(begin + kAtOnce, windows.size());
        const std::vector<cv::Mat> part(windows.begin() + static_cast<std::ptrdiff_t>(begin),
                                        windows.begin() + static_cast<std::ptrdiff_t>(end));
        const std::vector<double> decided = classifier->decideAll(describeWindows(*descriptor, part));
        values.insert(values.end(), decided.begin(), decided.end());
    }
    return values;
}

}  // namespace eyrie

#include "learning/classifiers/standardisation.h"

#include <cmath>

namespace eyrie {

Standardisation standardisationOf(const cv::Mat1f& features) {
    const auto dimension = static_cast<std::size_t>(features.cols);
    std::vector<double> sums(dimension, 0);
    std::vector<double> squares(dimension, 0);
    for (int i = 0; i < features.rows; ++i) {
        const float* row = features[i];
        for (std::size_t f = 0; f < dimension; ++f) sums[f] += row[f];
    }
    Standardisation result{std::vector<float>(dimension), std::vector<float>(dimension)};
    for (std::size_t f = 0; f < dimension; ++f) result.mean[f] = static_cast<float>(sums[f] / features.rows);
    for (int i = 0; i < features.rows; ++i) {
        const float* row = features[i];
        for (std::size_t f = 0; f < dimension; ++f) {
            const double off = row[f] - result.mean[f];
            squares[f] += off * off;
        }
    }
    for (std::size_t f = 0; f < dimension; ++f) {
        const double deviation = std::sqrt(squares[f] / features.rows);
        const bool varies = deviation > 1e-6 * std::abs(result.mean[f]) + 1e-12;
        result.scale[f] = varies ? static_cast<float>(1 / deviation) : 0.F;
    }
    return result;
}

}  // namespace eyrie

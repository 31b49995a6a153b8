#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <vector>

namespace eyrie {

/// Result of a two-class C-SVM in its dual form.
struct SmoSolution {
    std::vector<double> alpha;  ///< 0 … C, one per sample
    double bias = 0;            ///< decision = Σ α_i y_i K(x_i, x) + bias
};

/// Sequential minimal optimisation with second-order choice of the pair (Fan, Chen, Lin 2005). `kernel` is the matrix
/// of K between all samples, `labels` are ±1, both must occur. Stops once the optimality conditions hold to within
/// 10⁻³, or after 10⁷ steps.
SmoSolution solveSmo(const cv::Mat1f& kernel, const std::vector<int>& labels, double c);

}  // namespace eyrie

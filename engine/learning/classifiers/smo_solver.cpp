#include "learning/classifiers/smo_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyrie {
namespace {

constexpr double kTolerance = 1e-3;
constexpr double kSmallestCurvature = 1e-12;
constexpr int kMostSteps = 10'000'000;

class Smo {
 public:
    Smo(const cv::Mat1f& kernel, const std::vector<int>& labels, double c)
        : kernel_(kernel), labels_(labels), c_(c), alpha_(labels.size(), 0), gradient_(labels.size(), -1) {}

    SmoSolution solve() {
        std::size_t i = 0;
        std::size_t j = 0;
        for (int step = 0; step < kMostSteps && choosePair(i, j); ++step) optimise(i, j);
        return {alpha_, bias()};
    }

 private:
    bool mayRise(std::size_t t) const { return labels_[t] > 0 ? alpha_[t] < c_ : alpha_[t] > 0; }
    bool mayFall(std::size_t t) const { return labels_[t] > 0 ? alpha_[t] > 0 : alpha_[t] < c_; }

    bool choosePair(std::size_t& i, std::size_t& j) const {
        double highest = -std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < labels_.size(); ++t) {
            const double value = -labels_[t] * gradient_[t];
            if (mayRise(t) && value > highest) {
                highest = value;
                i = t;
            }
        }
        if (std::isinf(highest)) return false;
        const float* row = kernel_[static_cast<int>(i)];
        double lowest = std::numeric_limits<double>::infinity();
        double best = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < labels_.size(); ++t) {
            if (!mayFall(t)) continue;
            const double value = -labels_[t] * gradient_[t];
            lowest = std::min(lowest, value);
            const double gap = highest - value;
            if (gap <= 0) continue;
            const double curvature = std::max(diagonal(i) + diagonal(t) - 2.0 * row[t], kSmallestCurvature);
            if (-gap * gap / curvature < best) {
                best = -gap * gap / curvature;
                j = t;
            }
        }
        return highest - lowest > kTolerance;
    }

    /// Moves along the line that keeps Σ α y, as far as the box allows.
    void optimise(std::size_t i, std::size_t j) {
        const float* row_i = kernel_[static_cast<int>(i)];
        const float* row_j = kernel_[static_cast<int>(j)];
        const double curvature = std::max(diagonal(i) + diagonal(j) - 2.0 * row_i[j], kSmallestCurvature);
        double move = (-labels_[i] * gradient_[i] + labels_[j] * gradient_[j]) / curvature;
        // y_i α_i grows by `move`, y_j α_j shrinks by it.
        move = std::min(move, labels_[i] > 0 ? c_ - alpha_[i] : alpha_[i]);
        move = std::min(move, labels_[j] > 0 ? alpha_[j] : c_ - alpha_[j]);
        alpha_[i] = std::clamp(alpha_[i] + labels_[i] * move, 0.0, c_);
        alpha_[j] = std::clamp(alpha_[j] - labels_[j] * move, 0.0, c_);
        for (std::size_t t = 0; t < labels_.size(); ++t) gradient_[t] += labels_[t] * move * (row_i[t] - row_j[t]);
    }

    double bias() const {
        double sum = 0;
        int free = 0;
        double above = -std::numeric_limits<double>::infinity();
        double below = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < labels_.size(); ++t) {
            const double value = -labels_[t] * gradient_[t];
            if (alpha_[t] > 0 && alpha_[t] < c_) {
                sum += value;
                ++free;
            }
            if (mayRise(t)) above = std::max(above, value);
            if (mayFall(t)) below = std::min(below, value);
        }
        return free > 0 ? sum / free : (above + below) / 2;
    }

    double diagonal(std::size_t t) const { return kernel_(static_cast<int>(t), static_cast<int>(t)); }

    const cv::Mat1f& kernel_;
    const std::vector<int>& labels_;
    double c_;
    std::vector<double> alpha_;
    std::vector<double> gradient_;
};

}  // namespace

SmoSolution solveSmo(const cv::Mat1f& kernel, const std::vector<int>& labels, double c) {
    return Smo(kernel, labels, c).solve();
}

}  // namespace eyrie

#include "evaluation/comparison/significance.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>

#include "core/error.h"

namespace eyrie {
namespace {

/// Continued fraction of the incomplete beta function, evaluated from the front with the modified Lentz scheme.
double betaFraction(double a, double b, double x) {
    constexpr double tiny = 1e-300;
    const auto away_from_zero = [](double value) { return std::abs(value) < tiny ? tiny : value; };
    double numerator = 1;
    double denominator = 1 / away_from_zero(1 - (a + b) * x / (a + 1));
    double value = denominator;
    for (int m = 1; m <= 500; ++m) {
        const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        denominator = 1 / away_from_zero(1 + even * denominator);
        numerator = away_from_zero(1 + even / numerator);
        value *= numerator * denominator;
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        denominator = 1 / away_from_zero(1 + odd * denominator);
        numerator = away_from_zero(1 + odd / numerator);
        const double step = numerator * denominator;
        value *= step;
        if (std::abs(step - 1) < 1e-15) break;
    }
    return value;
}

/// Regularised incomplete beta function I_x(a, b).
double regularisedBeta(double a, double b, double x) {
    if (x <= 0) return 0;
    if (x >= 1) return 1;
    const double front =
        std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
    // The fraction converges fast on this side of the mean only; the other side follows by symmetry.
    if (x < (a + 1) / (a + b + 2)) return front * betaFraction(a, b, x) / a;
    return 1 - front * betaFraction(b, a, 1 - x) / b;
}

/// Linear interpolation between order statistics; `sorted` ascends and is not empty.
double quantile(const std::vector<double>& sorted, double share) {
    const double position = share * static_cast<double>(sorted.size() - 1);
    const auto below = static_cast<std::size_t>(position);
    const std::size_t above = std::min(below + 1, sorted.size() - 1);
    return sorted[below] + (position - static_cast<double>(below)) * (sorted[above] - sorted[below]);
}

/// Uniform in [0, bound) without the standard library's distributions, which differ between implementations.
int drawBelow(std::mt19937_64& random, int bound) {
    const auto limit = static_cast<std::uint64_t>(bound);
    const std::uint64_t usable = std::numeric_limits<std::uint64_t>::max() / limit * limit;
    std::uint64_t value = random();
    while (value >= usable) value = random();
    return static_cast<int>(value % limit);
}

}  // namespace

double studentTwoSided(double t, double degrees_of_freedom) {
    if (std::isinf(t)) return 0;
    return regularisedBeta(degrees_of_freedom / 2, 0.5, degrees_of_freedom / (degrees_of_freedom + t * t));
}

PairedTTest pairedTTest(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size() || a.size() < 2) {
        throw Error(ErrorKind::input, "paired t-test: " + std::to_string(a.size()) + " and " +
                                          std::to_string(b.size()) +
                                          " values, expected the same number of both, at least 2");
    }
    const auto n = static_cast<double>(a.size());
    PairedTTest test;
    test.pairs = static_cast<int>(a.size());
    for (std::size_t i = 0; i < a.size(); ++i) test.mean_difference += (a[i] - b[i]) / n;
    double squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) squares += std::pow(a[i] - b[i] - test.mean_difference, 2);
    const double error_of_mean = std::sqrt(squares / (n - 1) / n);
    if (test.mean_difference == 0) return test;
    test.t = error_of_mean > 0 ? test.mean_difference / error_of_mean
                               : std::copysign(std::numeric_limits<double>::infinity(), test.mean_difference);
    test.p_value = studentTwoSided(test.t, n - 1);
    return test;
}

BootstrapInterval bootstrap(int units, const Statistic& statistic, const BootstrapOptions& options) {
    if (options.resamples < 1 || !(options.confidence > 0 && options.confidence < 1)) {
        throw Error(ErrorKind::parameter, "bootstrap: expected at least 1 resample and a confidence between 0 and 1");
    }
    if (units < 1) throw Error(ErrorKind::input, "bootstrap: there is no track to draw");
    std::vector<int> counts(static_cast<std::size_t>(units), 1);
    BootstrapInterval interval;
    interval.value = statistic(counts);
    std::mt19937_64 random(options.seed);
    std::vector<double> values;
    values.reserve(static_cast<std::size_t>(options.resamples));
    for (int k = 0; k < options.resamples; ++k) {
        std::fill(counts.begin(), counts.end(), 0);
        for (int drawn = 0; drawn < units; ++drawn) ++counts[static_cast<std::size_t>(drawBelow(random, units))];
        values.push_back(statistic(counts));
    }
    std::sort(values.begin(), values.end());
    interval.low = quantile(values, (1 - options.confidence) / 2);
    interval.high = quantile(values, (1 + options.confidence) / 2);
    return interval;
}

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <functional>
#include <vector>

namespace eyrie {

/// Whether two methods differ on the same sequences.
struct PairedTTest {
    int pairs = 0;
    double mean_difference = 0;  ///< a − b
    double t = 0;                ///< ±∞ when all differences are equal and not 0
    double p_value = 1;          ///< two-sided: the chance of such a difference if the methods were equally good
};

/// Throws Error(input) unless both have the same number of values, at least two.
PairedTTest pairedTTest(const std::vector<double>& a, const std::vector<double>& b);

/// Chance that |T| exceeds |t| for Student's distribution; `degrees_of_freedom` > 0.
double studentTwoSided(double t, double degrees_of_freedom);

/// How an interval is estimated by resampling.
struct BootstrapOptions {
    int resamples = 2000;
    double confidence = 0.95;  ///< in (0, 1)
    std::uint64_t seed = 1;    ///< the same seed gives the same interval on every machine
};

/// How much a measure would vary had other tracks been filmed.
struct BootstrapInterval {
    double value = 0;  ///< of the data as they are
    double low = 0;    ///< percentile interval
    double high = 0;
};

/// A measure of a sample; `counts[i]` says how often unit i (a track) was drawn.
using Statistic = std::function<double(const std::vector<int>& counts)>;

/// Draws `units` units with replacement again and again. Throws Error(parameter) for options out of range and
/// Error(input) for no unit.
BootstrapInterval bootstrap(int units, const Statistic& statistic, const BootstrapOptions& options = {});

}  // namespace eyrie

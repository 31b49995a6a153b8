#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace eyrie {

/// A linear map of feature vectors to components: components = unmixing · (features − mean).
struct Unmixing {
    Eigen::MatrixXd unmixing;  ///< square
    Eigen::VectorXd mean;
    double log_volume = 0;  ///< ln |det unmixing|: what densities of components must be scaled by

    Eigen::VectorXd apply(const Eigen::VectorXd& features) const { return unmixing * (features - mean); }
};

/// FastICA (Hyvärinen 1999; Teutsch §5.4.3): whitening, then the symmetric fixed point iteration with tanh, from a
/// start that the seed chooses. `samples` has one row per sample; needs two at least. Directions with less
/// variance than `least_variance` (of the directions' mean) are treated as if they had it, so that the map stays square
/// and invertible. Components have variance 1; their
/// order and sign are arbitrary. Where the iteration does not settle in 100 steps its last state is taken.
Unmixing fastIca(const Eigen::MatrixXd& samples, std::uint64_t seed, double least_variance = 1e-6);

}  // namespace eyrie

#pragma once

#include <array>

#include "registration/estimation/correspondences.h"

namespace eyrie {

/// The eight free numbers of a homography with matrix(2, 2) = 1, row by row.
using HomographyParameters = std::array<float, 8>;

/// Sums over all correspondences from which a Gauss–Newton step of a robust homography follows. With point (x, y), its
/// image (u, v) under the present homography, residual (ex, ey) = image − measured, and k = weight · Tukey weight / w²
/// where w is the projective denominator (k for the right-hand side: weight · Tukey weight / w):
struct NormalSums {
    static constexpr int kMoments = 6;         ///< x², xy, x, y², y, 1
    std::array<double, kMoments> plain{};      ///< Σ k · moment
    std::array<double, 5> times_u{};           ///< Σ k u · (x², xy, x, y², y)
    std::array<double, 5> times_v{};           ///< Σ k v · (x², xy, x, y², y)
    std::array<double, 3> times_square{};      ///< Σ k (u² + v²) · (x², xy, y²)
    std::array<double, 3> right_x{};           ///< Σ k' ex · (x, y, 1)
    std::array<double, 3> right_y{};           ///< Σ k' ey · (x, y, 1)
    std::array<double, 2> right_projective{};  ///< Σ k' (u ex + v ey) · (x, y)
    double weight = 0;                         ///< Σ weight · Tukey weight
};

/// `cutoff`: residuals from here on count nothing (Tukey's biweight), in the units of the correspondences.
NormalSums sumNormalEquations(const Correspondences& points, const HomographyParameters& homography, float cutoff);

/// Squared residual of every correspondence.
void squaredResiduals(const Correspondences& points, const HomographyParameters& homography,
                      std::vector<float>& squares);

}  // namespace eyrie

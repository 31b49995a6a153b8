#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "imaging/contours/boundary_cues.h"

/// Contours that part the picture as a whole: what local cues cannot tell from texture (spectral part of "gPb",
/// Arbeláez et al. 2011; normalised cuts).
namespace eyrie {

/// One of the slowest vibrations of the picture when its pixels are bound by springs that contours weaken.
struct Vibration {
    double eigenvalue = 0;  ///< of (D − W) v = λ D v, in [0, 2]
    cv::Mat picture;        ///< v, CV_32FC1, of unit length
};

/// The `number` smallest, without the constant one of λ = 0; fewer on tiny pictures. Affinity of two pixels at most 5
/// px apart: exp(−strongest contour between them / 0.1). `contours`: CV_32FC1 in [0, 1]. Lanczos, always from the same
/// start.
std::vector<Vibration> slowestVibrations(const cv::Mat& contours, int number);

/// Spectral cue: for each direction the sum over 16 vibrations of the derivative across it, weighed by 1/√λ; no unit.
DirectedPictures spectralCues(const cv::Mat& contours);

}  // namespace eyrie

#pragma once

#include <array>
#include <opencv2/core/mat.hpp>

/// Local cues of contours: how differently the two halves of a disc look, for each direction of the line that parts
/// them (Arbeláez et al. 2011, the method "gPb" of Teutsch fig. 5.1).
namespace eyrie {

constexpr int kContourDirections = 8;

/// Angle of direction `k` of a contour: k · π / 8, clockwise from +x, in [0, π). Contours have no sense.
double contourAngle(int direction);

/// One picture for each direction, CV_32FC1 of the image's size.
using DirectedPictures = std::array<cv::Mat, kContourDirections>;

/// Multi-scale cue: the mean over brightness and texture, each with discs of three radii, of the χ² distance between
/// the histograms of both halves, in [0, 1]. `gray`: CV_8UC1; beyond the image its border is mirrored. The method's
/// weights of cues and radii were learned on photographs in colour; here all weigh the same.
DirectedPictures boundaryCues(const cv::Mat& gray);

/// χ² distance of the histograms of `values` (CV_8UC1, below `bins`) in both halves of a disc of `radius` px whose
/// parting line has the given direction; smoothed by parabolas across the line. `blur_bins`: deviation of the Gaussian
/// over neighbouring bins, 0 where they are no neighbours.
cv::Mat halfDiscDifference(const cv::Mat& values, int bins, double blur_bins, double radius, int direction);

/// For each pixel the number of the texture it belongs to, CV_8UC1: k-means over the responses of oriented even and odd
/// filters and a centre-surround filter. The same image always gives the same textures.
cv::Mat textures(const cv::Mat& gray, int kinds);

}  // namespace eyrie

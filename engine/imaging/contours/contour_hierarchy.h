#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "imaging/contours/boundary_cues.h"

/// From contours to segments at every level of detail (Arbeláez et al. 2011; Teutsch fig. 5.1 shows it for several
/// levels k): oriented watershed transform (OWT) and ultrametric contour map (UCM).
namespace eyrie {

/// Segments that join one after the other, the weakest contour first.
class ContourHierarchy {
 public:
    /// `contours`: strength of a contour through each pixel in each direction, ≥ 0.
    explicit ContourHierarchy(const DirectedPictures& contours);

    /// The segments parted by contours stronger than `level`: labels from 0, CV_32SC1 of the picture's size.
    cv::Mat segmentsAt(double level) const;

    /// Strength of the contour that parts each pixel from its right or lower neighbour, the stronger of both, 0 inside
    /// segments: CV_32FC1. Above a level these are closed lines round the segments of that level.
    cv::Mat contourMap() const;

 private:
    /// Two of the finest segments (or what they grew to) become one.
    struct Joint {
        int one;
        int other;
        double strength;  ///< never falls from one joint to the next
    };
    std::vector<int> groupsAt(double level) const;

    cv::Mat finest_;  ///< CV_32SC1, labels from 0
    int segments_ = 0;
    std::vector<Joint> joints_;
};

/// Contours of a grey image for each direction, gPb: half local cues (boundaryCues), half spectral ones, these brought
/// to the local ones' range by their strongest hundredth. The method's weights were learned on photographs. CV_8UC1.
DirectedPictures probabilityOfBoundary(const cv::Mat& gray);

}  // namespace eyrie

#pragma once

#include <cstddef>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "tracking/silhouettes/box_grid.h"

namespace eyrie {

/// How far a vehicle and its shadow reach, as the ground shows it that they cover.
struct Silhouette {
    BoxEdges whole;               ///< of all that differs from the ground
    std::optional<BoxEdges> lit;  ///< of what does and is no shadow, where there is anything
    bool lit_vehicle = false;     ///< that is the vehicle, surely: one compact area, not merely its windows or lamps
    /// Median share of its brightness that the ground keeps in the shade beyond such a vehicle; none where it has none.
    std::optional<double> shade = std::nullopt;
};

/// The grid of places about a box at which pictures are compared, in its axes.
class SilhouetteGrid {
 public:
    /// `margin`: px by which it reaches beyond the box; `step`: px from one place to the next.
    SilhouetteGrid(const OrientedBox& box, double margin, double step);

    /// What a picture (CV_8UC1) shows at the places, which `picture_from_here` takes there; CV_8UC1, heading to the
    /// right. Empty where one of them lies beyond the picture.
    cv::Mat sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here = cv::Matx33d::eye()) const;

    /// `vehicle`: what `sampled` gives while it is there, `grounds`: while it is not, at least one. Nothing where it
    /// does not stand out, or is one with something that the grid does not hold.
    std::optional<Silhouette> compare(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const;

    /// Share of the box in which a picture is as much darker than the ground as a shadow makes it, and no more; by the
    /// same pictures. 0 where the ground is dark.
    double shadedInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const;

    /// Share of the box's length ahead of its brightest place, the lamps, where that is lit ground rather than vehicle:
    /// what its headlights throw ahead of it at night. 0 where it is not.
    double beamInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const;

 private:
    std::optional<BoxEdges> edgesOf(const cv::Mat& mask) const;
    /// `beyond`: what is lit, in places.
    static std::optional<double> shadeOf(const cv::Mat& shade, const cv::Rect& beyond, const cv::Mat& vehicle,
                                         const std::vector<cv::Mat>& grounds);

    BoxGrid grid_;
};

}  // namespace eyrie

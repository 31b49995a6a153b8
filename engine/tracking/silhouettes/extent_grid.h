#pragma once

#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "tracking/silhouettes/box_grid.h"

namespace eyrie {

/// How far a vehicle of which a box may hold a part reaches, as the ground shows it that it hides.
struct VehicleExtent {
    BoxEdges whole;               ///< of all that differs from the ground and hangs together with the box's middle
    std::optional<BoxEdges> lit;  ///< of what of it is no shadow
    double lit_beyond = 0;        ///< share of what lies before and behind the box that is no shadow
    bool cut = false;             ///< it goes on beyond the grid
};

/// Places about a box, far before and behind it, as far as the longest lorries reach.
class ExtentGrid {
 public:
    /// What a picture shows there, CV_8UC1, and where that says nothing of the vehicle or the ground, 255.
    struct Sample {
        cv::Mat gray, unknown;
    };

    /// `metre`: px there; `has_parts`: other tracks may be of the same vehicle, which is a long one then.
    ExtentGrid(const OrientedBox& box, double metre, bool has_parts);

    /// `picture_from_here` takes the places into the picture (CV_8UC1); `others`: boxes of other vehicles in it, which
    /// hide what they cover, and the ground close about them unless they are beside the vehicle itself.
    Sample sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here, const std::vector<OrientedBox>& others,
                   bool beside_vehicle) const;
    /// Whether a box of a picture may cover some of the places.
    bool mayReach(const OrientedBox& box, const cv::Matx33d& picture_from_here) const;

    /// Nothing where it does not stand out, at night, and without grounds.
    std::optional<VehicleExtent> compare(const Sample& vehicle, const std::vector<Sample>& grounds) const;

 private:
    void cover(cv::Mat& places, const OrientedBox& box, double margin, const cv::Matx33d& here_from_picture) const;
    double litBeyond(const cv::Mat& area, const cv::Mat& shaded) const;

    BoxGrid grid_;
    double metre_;
};

}  // namespace eyrie

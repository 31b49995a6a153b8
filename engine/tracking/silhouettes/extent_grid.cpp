#include "tracking/silhouettes/extent_grid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/homography_jacobian.h"
#include "tracking/silhouettes/ground_contrast.h"

namespace eyrie {
namespace {

constexpr double kAlong = 9;           ///< m before and behind the box: a lorry of which one end is in it …
constexpr double kAlongParts = 14;     ///< … the longest ones where other parts are followed, too …
constexpr double kAcross = 1.2;        ///< … and to its sides
constexpr double kStep = 0.15;         ///< m, at least half a pixel
constexpr double kAboutOthers = 0.5;   ///< m: boxes end a little before or behind the vehicle
constexpr double kBeyondTheBox = 0.3;  ///< m

}  // namespace

ExtentGrid::ExtentGrid(const OrientedBox& box, double metre, bool has_parts)
    : grid_(box, (has_parts ? kAlongParts : kAlong) * metre, kAcross * metre, std::max(0.5, kStep * metre)),
      metre_(metre) {}

bool ExtentGrid::mayReach(const OrientedBox& box, const cv::Matx33d& picture_from_here) const {
    const HomographyJacobian there(picture_from_here, grid_.box().centre);
    const cv::Point2d apart = box.centre - there.point();
    const cv::Size2d half = cv::Size2d(grid_.places()) * (grid_.step() / 2);
    const double own = std::hypot(box.length, box.width) / 2 + kAboutOthers * metre_ * there.scale();
    return std::hypot(apart.x, apart.y) <= std::hypot(half.width, half.height) * there.scale() + own;
}

void ExtentGrid::cover(cv::Mat& places, const OrientedBox& box, double margin,
                       const cv::Matx33d& here_from_picture) const {
    OrientedBox larger = box;
    larger.length += 2 * margin;
    larger.width += 2 * margin;
    std::vector<cv::Point> corners;
    for (const cv::Point2d& corner : larger.corners()) {
        const cv::Point2d here = HomographyJacobian(here_from_picture, corner).point();
        corners.emplace_back(grid_.placeOf(grid_.box().toBox(here)));
    }
    cv::fillConvexPoly(places, corners, cv::Scalar(255));
}

ExtentGrid::Sample ExtentGrid::sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here,
                                       const std::vector<OrientedBox>& others, bool beside_vehicle) const {
    Sample sample;
    sample.gray = grid_.sampled(gray, picture_from_here, &sample.unknown);
    const cv::Matx33d back = picture_from_here.inv();
    for (const OrientedBox& other : others) {
        if (mayReach(other, picture_from_here))
            cover(sample.unknown, other, beside_vehicle ? 0 : kAboutOthers * metre_, back);
    }
    return sample;
}

double ExtentGrid::litBeyond(const cv::Mat& area, const cv::Mat& shaded) const {
    const double end = grid_.box().length / 2 + kBeyondTheBox * metre_;
    const int rear = std::clamp(cvRound(grid_.placeOf({-end, 0}).x), 0, area.cols);
    const int front = std::clamp(cvRound(grid_.placeOf({end, 0}).x) + 1, 0, area.cols);
    cv::Mat beyond = area.clone();
    beyond.colRange(rear, front).setTo(0);
    const int all = cv::countNonZero(beyond);
    return all > 0 ? static_cast<double>(cv::countNonZero(beyond & ~shaded)) / all : 0;
}

std::optional<VehicleExtent> ExtentGrid::compare(const Sample& vehicle, const std::vector<Sample>& grounds) const {
    std::vector<cv::Mat> bare, unknown;
    for (const Sample& ground : grounds) {
        bare.push_back(ground.gray);
        unknown.push_back(ground.unknown);
    }
    if (allDark(bare)) return {};
    GroundMasks masks = masksAgainst(vehicle.gray, bare, unknown);
    masks.differs.setTo(0, vehicle.unknown);
    cv::Rect middle = grid_.inBox();
    middle.x += middle.width / 3;
    middle.width -= 2 * (middle.width / 3);
    cv::Mat area;
    const auto whole = grid_.edgesOf(masks.differs, middle, &area);
    if (!whole) return {};
    VehicleExtent extent{*whole, grid_.edgesOf(masks.differs & ~masks.shaded, middle), litBeyond(area, masks.shaded),
                         false};
    const double half = grid_.places().width * grid_.step() / 2;
    extent.cut = whole->rear <= -half || whole->front >= half;
    return extent;
}

}  // namespace eyrie

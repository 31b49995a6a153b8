#include "tracking/silhouettes/silhouette_grid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/robust_statistics.h"
#include "tracking/silhouettes/ground_contrast.h"

namespace eyrie {
namespace {

constexpr double kBesideMiddle = 0.2;  ///< share of a box's width left out on either side of its middle
constexpr double kLamp = 40;           ///< grey values by which lamps are brighter than the ground …
constexpr double kLampStandsOut = 5;   ///< … and brighter than what they light ahead of them …
constexpr double kLitAhead = 0.5;      ///< … which is brighter than the ground by this share of that
constexpr double kLitArea = 0.35;      ///< of the whole silhouette: less is a roof, a window or a lamp …
constexpr double kLitLength = 1.3;     ///< of its width: shorter is a roof before the vehicle's own shaded rear …
constexpr double kLitWidth = 0.6;      ///< of that of the box: narrower is a roof or a window alone …
constexpr double kLitFilled = 0.6;     ///< … and so is what fills less of its own edges

}  // namespace

SilhouetteGrid::SilhouetteGrid(const OrientedBox& box, double margin, double step) : grid_(box, margin, margin, step) {}

cv::Mat SilhouetteGrid::sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here) const {
    return grid_.sampled(gray, picture_from_here);
}

std::optional<BoxEdges> SilhouetteGrid::edgesOf(const cv::Mat& mask) const {
    const cv::Size third = grid_.places() / 3;
    const cv::Size middle = grid_.places() - third - third;
    return grid_.edgesOf(mask, {{third.width, third.height}, middle});
}

double SilhouetteGrid::shadedInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    if (allDark(grounds)) return 0;
    const GroundMasks masks = masksAgainst(vehicle, grounds);
    const cv::Rect inside = grid_.inBox();
    return static_cast<double>(cv::countNonZero((masks.differs & masks.shaded)(inside))) / inside.area();
}

double SilhouetteGrid::beamInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    // How much brighter it is than the darkest ground, along the middle of the box from its rear to its front.
    cv::Rect middle = grid_.inBox();
    const int side = static_cast<int>(middle.height * kBesideMiddle);
    middle = {middle.x, middle.y + side, middle.width, middle.height - 2 * side};
    cv::Mat ground = grounds.front().clone();
    for (const cv::Mat& other : grounds) ground = cv::min(ground, other);
    cv::Mat brighter;
    cv::subtract(vehicle(middle), ground(middle), brighter, cv::noArray(), CV_32F);
    cv::Mat along;
    cv::reduce(brighter, along, 0, cv::REDUCE_AVG);
    cv::blur(along, along, {3, 1}, {-1, -1}, cv::BORDER_REPLICATE);
    cv::Point lamps;
    double brightest = 0;
    cv::minMaxLoc(along, nullptr, &brightest, nullptr, &lamps);
    if (brightest < kLamp || 2 * lamps.x < along.cols || lamps.x + 1 == along.cols) return 0;
    const double ahead = cv::mean(along.colRange(lamps.x + 1, along.cols))[0];
    const double vehicle_itself = cv::mean(along.colRange(0, lamps.x))[0];
    if (ahead < kLitAhead * brightest || ahead + kLampStandsOut > brightest || ahead < vehicle_itself + kGroundContrast)
        return 0;
    return static_cast<double>(along.cols - 1 - lamps.x) / along.cols;
}

std::optional<Silhouette> SilhouetteGrid::compare(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    if (allDark(grounds)) return {};
    const auto [differs, shaded] = masksAgainst(vehicle, grounds);
    const auto whole = edgesOf(differs);
    if (!whole) return {};
    const cv::Size places = grid_.places();
    const double step = grid_.step();
    const double half_length = places.width * step / 2;
    const double half_width = places.height * step / 2;
    const bool cut = whole->rear <= -half_length || whole->front >= half_length || whole->left <= -half_width ||
                     whole->right >= half_width;
    if (cut) return {};
    Silhouette silhouette{*whole, {}, false};
    const cv::Mat lit = differs & ~shaded;
    silhouette.lit = edgesOf(lit);
    if (!silhouette.lit) return silhouette;
    const BoxEdges& edges = *silhouette.lit;
    const cv::Rect area(cvRound(edges.rear / step + places.width / 2.0),
                        cvRound(edges.left / step + places.height / 2.0), cvRound(edges.length() / step),
                        cvRound(edges.width() / step));
    const double filled = static_cast<double>(cv::countNonZero(lit(area))) / area.area();
    const bool long_enough = edges.length() > kLitLength * edges.width();
    const bool wide_enough = edges.width() > kLitWidth * grid_.box().width;
    silhouette.lit_vehicle =
        edges.area() > kLitArea * whole->area() && filled > kLitFilled && long_enough && wide_enough;
    if (silhouette.lit_vehicle) silhouette.shade = shadeOf(differs & shaded, area, vehicle, grounds);
    return silhouette;
}

std::optional<double> SilhouetteGrid::shadeOf(const cv::Mat& shade, const cv::Rect& beyond, const cv::Mat& vehicle,
                                              const std::vector<cv::Mat>& grounds) {
    std::vector<double> shares;
    for (int y = 0; y < shade.rows; ++y) {
        for (int x = 0; x < shade.cols; ++x) {
            if (shade.at<uchar>(y, x) == 0 || beyond.contains({x, y})) continue;
            double bare = 0;
            for (const cv::Mat& ground : grounds) bare += ground.at<uchar>(y, x);
            shares.push_back(vehicle.at<uchar>(y, x) / (bare / static_cast<double>(grounds.size())));
        }
    }
    if (shares.empty()) return std::nullopt;
    return medianOf(std::move(shares));
}

}  // namespace eyrie

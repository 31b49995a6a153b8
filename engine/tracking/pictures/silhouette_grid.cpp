#include "tracking/pictures/silhouette_grid.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr double kContrast = 12;        ///< grey values by which a vehicle or a shadow differs from the ground …
constexpr double kContrastShare = 0.1;  ///< … and share of the ground's brightness
constexpr double kDarkestShadow = 0.25;
constexpr double kBrightestShadow = 0.85;  ///< shares of the ground's brightness between which it is in the shade
constexpr double kDarkGround = 60;         ///< grey values
constexpr double kBesideMiddle = 0.2;      ///< share of a box's width left out on either side of its middle
constexpr double kLamp = 40;               ///< grey values by which lamps are brighter than the ground …
constexpr double kLampStandsOut = 5;       ///< … and brighter than what they light ahead of them …
constexpr double kLitAhead = 0.5;          ///< … which is brighter than the ground by this share of that
constexpr double kBulk = 0.3;              ///< rows with less of the area than this share of the fullest are fringe
constexpr double kLitArea = 0.35;          ///< of the whole silhouette: less is a roof, a window or a lamp …
constexpr double kLitLength = 1.3;         ///< of its width: shorter is a roof before the vehicle's own shaded rear …
constexpr double kLitFilled = 0.6;         ///< … and so is what fills less of its own edges

/// First and last of the rows, or columns, that hold enough.
std::pair<int, int> bulkOf(const std::vector<int>& counts) {
    const int least = std::max(1, static_cast<int>(std::ceil(kBulk * *std::max_element(counts.begin(), counts.end()))));
    const auto enough = [&](int count) { return count >= least; };
    const auto first = std::find_if(counts.begin(), counts.end(), enough);
    const auto last = std::find_if(counts.rbegin(), counts.rend(), enough);
    return {static_cast<int>(first - counts.begin()), static_cast<int>(counts.rend() - last) - 1};
}

/// The label of the component that covers most of the middle third; 0: none does.
int middleLabel(const cv::Mat& labels, int count) {
    std::vector<int> covered(static_cast<std::size_t>(count), 0);
    for (int y = labels.rows / 3; y < labels.rows - labels.rows / 3; ++y) {
        for (int x = labels.cols / 3; x < labels.cols - labels.cols / 3; ++x)
            ++covered[static_cast<std::size_t>(labels.at<int>(y, x))];
    }
    covered[0] = 0;
    const auto most = std::max_element(covered.begin(), covered.end());
    return *most > 0 ? static_cast<int>(most - covered.begin()) : 0;
}

/// As at night, when lamps and beams make up the silhouettes.
bool allDark(const std::vector<cv::Mat>& grounds) {
    return std::all_of(grounds.begin(), grounds.end(),
                       [](const cv::Mat& ground) { return cv::mean(ground)[0] < kDarkGround; });
}

}  // namespace

SilhouetteGrid::SilhouetteGrid(const OrientedBox& box, double margin, double step)
    : box_(box),
      step_(step),
      places_(std::max(5, cvRound((box.length + 2 * margin) / step)),
              std::max(5, cvRound((box.width + 2 * margin) / step))) {}

cv::Mat SilhouetteGrid::sampled(const cv::Mat& gray, const cv::Matx33d& picture_from_here) const {
    cv::Mat xs(places_, CV_32FC1);
    cv::Mat ys(places_, CV_32FC1);
    const cv::Point2d along = box_.direction() * step_;
    const cv::Point2d across(-along.y, along.x);
    for (int y = 0; y < places_.height; ++y) {
        const cv::Point2d row = box_.centre + across * (y + 0.5 - places_.height / 2.0);
        for (int x = 0; x < places_.width; ++x) {
            const cv::Point2d here = row + along * (x + 0.5 - places_.width / 2.0);
            const cv::Vec3d there = picture_from_here * cv::Vec3d(here.x, here.y, 1);
            const double px = there[0] / there[2];
            const double py = there[1] / there[2];
            if (!(px >= 0 && py >= 0 && px <= gray.cols - 1 && py <= gray.rows - 1)) return {};
            xs.at<float>(y, x) = static_cast<float>(px);
            ys.at<float>(y, x) = static_cast<float>(py);
        }
    }
    cv::Mat found;
    cv::remap(gray, found, xs, ys, cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    return found;
}

std::optional<BoxEdges> SilhouetteGrid::edgesOf(const cv::Mat& mask) const {
    cv::Mat closed;
    cv::morphologyEx(mask, closed, cv::MORPH_CLOSE, cv::Mat::ones(3, 3, CV_8UC1));
    cv::Mat labels;
    const int label = middleLabel(labels, cv::connectedComponents(closed, labels));
    if (label == 0) return {};
    std::vector<int> in_column(static_cast<std::size_t>(places_.width), 0);
    std::vector<int> in_row(static_cast<std::size_t>(places_.height), 0);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            if (labels.at<int>(y, x) != label) continue;
            ++in_column[static_cast<std::size_t>(x)];
            ++in_row[static_cast<std::size_t>(y)];
        }
    }
    const auto [rear, front] = bulkOf(in_column);
    const auto [left, right] = bulkOf(in_row);
    return BoxEdges{(rear - places_.width / 2.0) * step_, (front + 1 - places_.width / 2.0) * step_,
                    (left - places_.height / 2.0) * step_, (right + 1 - places_.height / 2.0) * step_};
}

SilhouetteGrid::Masks SilhouetteGrid::masksOf(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    Masks masks{cv::Mat(places_, CV_8UC1, cv::Scalar(255)), cv::Mat(places_, CV_8UC1, cv::Scalar(255))};
    for (const cv::Mat& ground : grounds) {
        for (int y = 0; y < places_.height; ++y) {
            for (int x = 0; x < places_.width; ++x) {
                const double here = vehicle.at<uchar>(y, x);
                const double bare = ground.at<uchar>(y, x);
                const double off = std::abs(here - bare);
                if (off <= kContrast || off <= kContrastShare * bare) masks.differs.at<uchar>(y, x) = 0;
                const double share = here / std::max(1.0, bare);
                if (share <= kDarkestShadow || share >= kBrightestShadow) masks.shaded.at<uchar>(y, x) = 0;
            }
        }
    }
    return masks;
}

double SilhouetteGrid::shadedInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    if (allDark(grounds)) return 0;
    const Masks masks = masksOf(vehicle, grounds);
    const cv::Rect inside = inBox();
    return static_cast<double>(cv::countNonZero((masks.differs & masks.shaded)(inside))) / inside.area();
}

cv::Rect SilhouetteGrid::inBox() const {
    const cv::Size box(std::clamp(cvRound(box_.length / step_), 1, places_.width),
                       std::clamp(cvRound(box_.width / step_), 1, places_.height));
    return {(places_.width - box.width) / 2, (places_.height - box.height) / 2, box.width, box.height};
}

double SilhouetteGrid::beamInBox(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    // How much brighter it is than the darkest ground, along the middle of the box from its rear to its front.
    cv::Rect middle = inBox();
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
    if (ahead < kLitAhead * brightest || ahead + kLampStandsOut > brightest || ahead < vehicle_itself + kContrast)
        return 0;
    return static_cast<double>(along.cols - 1 - lamps.x) / along.cols;
}

std::optional<Silhouette> SilhouetteGrid::compare(const cv::Mat& vehicle, const std::vector<cv::Mat>& grounds) const {
    if (allDark(grounds)) return {};
    const auto [differs, shaded] = masksOf(vehicle, grounds);
    const auto whole = edgesOf(differs);
    if (!whole) return {};
    const double half_length = places_.width * step_ / 2;
    const double half_width = places_.height * step_ / 2;
    const bool cut = whole->rear <= -half_length || whole->front >= half_length || whole->left <= -half_width ||
                     whole->right >= half_width;
    if (cut) return {};
    Silhouette silhouette{*whole, {}, false};
    const cv::Mat lit = differs & ~shaded;
    silhouette.lit = edgesOf(lit);
    if (!silhouette.lit) return silhouette;
    const BoxEdges& edges = *silhouette.lit;
    const cv::Rect area(cvRound(edges.rear / step_ + places_.width / 2.0),
                        cvRound(edges.left / step_ + places_.height / 2.0), cvRound((edges.front - edges.rear) / step_),
                        cvRound((edges.right - edges.left) / step_));
    const double filled = static_cast<double>(cv::countNonZero(lit(area))) / area.area();
    const bool long_enough = edges.front - edges.rear > kLitLength * (edges.right - edges.left);
    silhouette.lit_vehicle = edges.area() > kLitArea * whole->area() && filled > kLitFilled && long_enough;
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

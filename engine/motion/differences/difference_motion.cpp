#include "motion/differences/difference_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kSupportMargin = 1;      // px; corners lie on outlines
constexpr std::size_t kMostPoints = 400;  // of an area that later stages see

/// Structuring element of this diameter; empty where it would do nothing.
cv::Mat elementOf(double diameter_px) {
    const int side = cvRound((diameter_px - 1) / 2) * 2 + 1;
    return side < 3 ? cv::Mat() : cv::getStructuringElement(cv::MORPH_ELLIPSE, {side, side});
}

int depthOf(const DifferenceOptions& options) {
    switch (options.method) {
        case MotionMethod::three_frame_difference:
            return 2 * options.gap;
        case MotionMethod::median_background:
            return options.background_frames * options.background_step;
        default:
            return options.gap;
    }
}

double lowerMedianOf(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double headingOfLongerAxis(const std::vector<cv::Point>& pixels) {
    cv::Point2d mean(0, 0);
    for (const cv::Point& p : pixels) mean += cv::Point2d(p);
    mean *= 1.0 / static_cast<double>(pixels.size());
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const cv::Point& p : pixels) {
        const cv::Point2d d = cv::Point2d(p) - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    return 0.5 * std::atan2(2 * xy, xx - yy);
}

/// Pixels by area, each in reading order; areas by their first pixel.
std::vector<std::vector<cv::Point>> areasOf(const cv::Mat& binary) {
    cv::Mat labels;
    const int count = cv::connectedComponents(binary, labels, 8, CV_32S);
    std::vector<std::vector<cv::Point>> areas(static_cast<std::size_t>(count) - 1);
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            if (labels.at<int>(y, x) > 0) areas[static_cast<std::size_t>(labels.at<int>(y, x)) - 1].emplace_back(x, y);
        }
    }
    std::stable_sort(areas.begin(), areas.end(), [](const auto& a, const auto& b) {
        return a.front().y != b.front().y ? a.front().y < b.front().y : a.front().x < b.front().x;
    });
    return areas;
}

}  // namespace

DifferenceMotion::DifferenceMotion(const DifferenceOptions& options, const SceneScale& scale)
    : options_(options), first_scale_(scale), frames_(depthOf(options)) {
    zoomTo(1);
    if (options.method == MotionMethod::vectors)
        throw Error(ErrorKind::internal, "clustering of motion vectors needs no difference images");
}

void DifferenceMotion::zoomTo(double zoom) {
    scale_ = first_scale_.zoomed(zoom);
    opening_ = elementOf(scale_.px(options_.opening_m));
    closing_ = elementOf(scale_.px(options_.closing_m));
}

DifferenceImage DifferenceMotion::compare() const {
    const int gap = options_.gap;
    const int known = frames_.count();
    switch (options_.method) {
        case MotionMethod::three_frame_difference:
            if (known < 2 * gap) return {};
            return threeFrameDifference(frames_.newest(), frames_.past(gap), frames_.past(2 * gap), options_.blur);
        case MotionMethod::median_background: {
            std::vector<WarpedFrame> pictures;
            for (int i = 1; i <= options_.background_frames && i * options_.background_step <= known; ++i)
                pictures.push_back(frames_.past(i * options_.background_step));
            if (pictures.size() < 3) return {};
            return backgroundDifference(frames_.newest(), medianBackground(pictures), options_.gradient_suppression,
                                        options_.blur);
        }
        default:
            if (known < gap) return {};
            return twoFrameDifference(frames_.newest(), frames_.past(gap), options_.blur);
    }
}

bool DifferenceMotion::isGhost(const std::vector<cv::Point>& pixels, const cv::Mat& gradient) const {
    const cv::Mat& gray = frames_.newest();
    double sum = 0;
    double squares = 0;
    double slope = 0;
    for (const cv::Point& p : pixels) {
        const double value = gray.at<uchar>(p);
        sum += value;
        squares += value * value;
        slope += static_cast<double>(gradient.at<float>(p));
    }
    const auto count = static_cast<double>(pixels.size());
    const double deviation = std::sqrt(std::max(0.0, squares / count - (sum / count) * (sum / count)));
    return deviation < options_.ghost_deviation && slope / count < options_.ghost_gradient;
}

MotionCluster DifferenceMotion::clusterOf(const std::vector<cv::Point>& pixels, const FrameMotion& motion) const {
    MotionCluster cluster;
    std::vector<cv::Point2f> points(pixels.begin(), pixels.end());
    const cv::Rect bounds = cv::boundingRect(pixels);
    const OrientedBox around{{bounds.x + (bounds.width - 1) / 2.0, bounds.y + (bounds.height - 1) / 2.0},
                             double(bounds.width),
                             double(bounds.height),
                             0};
    // A vector belongs to the area when a pixel of it lies within the margin.
    std::vector<double> vx;
    std::vector<double> vy;
    for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
        const MotionVector& vector = motion.motion_vectors[i];
        const cv::Point2f then = vector.position - vector.velocity * static_cast<float>(delay());
        if (!around.contains(then, kSupportMargin)) continue;
        const bool near = std::any_of(points.begin(), points.end(), [&](const cv::Point2f& p) {
            return std::max(std::abs(p.x - then.x), std::abs(p.y - then.y)) <= static_cast<float>(kSupportMargin + 0.5);
        });
        if (!near) continue;
        cluster.members.push_back(static_cast<int>(i));
        vx.push_back(static_cast<double>(vector.velocity.x));
        vy.push_back(static_cast<double>(vector.velocity.y));
    }
    double heading = 0;
    if (!vx.empty()) {
        cluster.velocity = {lowerMedianOf(vx), lowerMedianOf(vy)};
        heading = std::atan2(cluster.velocity.y, cluster.velocity.x);
        for (cv::Point2f& point : points) point += cv::Point2f(cluster.velocity * static_cast<double>(delay()));
    } else {
        heading = headingOfLongerAxis(pixels);
    }
    cluster.box = boxAround(points, heading);
    cluster.box.length += 1;  // pixels have an extent
    cluster.box.width += 1;
    const std::size_t step = std::max<std::size_t>(1, points.size() / kMostPoints);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % step == 0) cluster.moving_points.push_back(points[i]);
    }
    return cluster;
}

void DifferenceMotion::findClusters(const FrameMotion& motion, DifferenceResult& result) const {
    result.noise = differenceNoise(result.difference);
    result.threshold = std::max(options_.noise_factor * result.noise, options_.min_contrast);
    cv::Mat binary = movingPixels(result.difference, result.threshold, options_.strong_limit);
    if (!closing_.empty()) cv::morphologyEx(binary, binary, cv::MORPH_CLOSE, closing_);
    if (!opening_.empty()) cv::morphologyEx(binary, binary, cv::MORPH_OPEN, opening_);
    binary &= result.difference.overlap;
    result.moving = cv::Mat::zeros(binary.size(), CV_8UC1);
    const bool ghosts = options_.method == MotionMethod::difference_ghosts;
    const cv::Mat gradient = ghosts ? backgroundGradient(frames_.newest()) : cv::Mat();
    for (const auto& pixels : areasOf(binary)) {
        const SceneScale here = scale_.at(pixels[pixels.size() / 2]);
        const double smallest = std::max<double>(options_.min_area_px, options_.min_area_m2 * here.px(1) * here.px(1));
        if (static_cast<double>(pixels.size()) < smallest) continue;
        if (ghosts && isGhost(pixels, gradient)) continue;
        const MotionCluster cluster = clusterOf(pixels, motion);
        if (std::max(cluster.box.length, cluster.box.width) > here.px(options_.max_length_m)) continue;
        for (const cv::Point& p : pixels) result.moving.at<uchar>(p) = 255;
        result.clusters.push_back(cluster);
    }
}

DifferenceResult DifferenceMotion::next(const Frame& frame, const FrameMotion& motion) {
    if (frame.gray.empty() || frame.gray.type() != CV_8UC1)
        throw Error(ErrorKind::internal,
                    "frame " + std::to_string(frame.index) + " has no 8 bit grey image to compare");
    zoomTo(motion.registration.zoom);
    const bool added = frames_.add(frame, motion.registration);
    if (!added && motion.registration.state == RegistrationState::frozen) return last_;
    DifferenceResult result;
    if (added) {
        result.difference = compare();
        if (!result.difference.values.empty()) findClusters(motion, result);
    }
    last_ = result;
    return result;
}

cv::Mat differenceView(const cv::Mat& gray, const DifferenceImage& difference) {
    CV_Assert(gray.type() == CV_8UC1);
    cv::Mat view;
    cv::cvtColor(gray, view, cv::COLOR_GRAY2BGR);
    if (difference.values.empty()) return view;
    CV_Assert(difference.values.size() == gray.size());
    constexpr float kGain = 3;
    for (int y = 0; y < gray.rows; ++y) {
        for (int x = 0; x < gray.cols; ++x) {
            cv::Vec3b& pixel = view.at<cv::Vec3b>(y, x);
            if (difference.overlap.at<uchar>(y, x) == 0) {
                pixel = {static_cast<uchar>(pixel[0] / 2), static_cast<uchar>(pixel[1] / 2), 255};
            } else {
                pixel[2] =
                    cv::saturate_cast<uchar>(static_cast<float>(pixel[2]) + kGain * difference.values.at<float>(y, x));
            }
        }
    }
    return view;
}

}  // namespace eyrie

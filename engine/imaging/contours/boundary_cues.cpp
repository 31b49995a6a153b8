#include "imaging/contours/boundary_cues.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "imaging/fixed_random.h"

namespace eyrie {
namespace {

constexpr int kBrightnessBins = 25;
constexpr double kBrightnessBlur_bins = 2.5;
constexpr std::array<double, 3> kBrightnessRadii_px{2.5, 5, 10};
constexpr std::array<double, 3> kTextureRadii_px{5, 10, 20};
constexpr int kTextureKinds = 32;
constexpr double kTextureFilter_px = 2;

struct HalfDiscs {
    cv::Mat one;    ///< CV_32FC1, sums to 1
    cv::Mat other;  ///< likewise
};

/// Pixels on the parting line belong to neither half.
HalfDiscs halfDiscs(double radius, double angle) {
    const int reach = cvFloor(radius);
    HalfDiscs halves{cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F),
                     cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F)};
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            if (x * x + y * y > radius * radius) continue;
            const double across = -std::sin(angle) * x + std::cos(angle) * y;
            if (std::abs(across) < 1e-6) continue;
            (across < 0 ? halves.one : halves.other).at<float>(y + reach, x + reach) = 1;
        }
    }
    halves.one /= cv::sum(halves.one)[0];
    halves.other /= cv::sum(halves.other)[0];
    return halves;
}

/// Fits a parabola across the line to the values in an ellipse that lies along it, and takes its height in the middle:
/// a Savitzky-Golay filter of second order.
cv::Mat parabolaKernel(double radius, double angle) {
    const int reach = std::max(2, cvRound(radius));
    const double across_reach = std::max(2.0, radius / 4);
    std::vector<cv::Point> places;
    std::vector<double> distances;
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const double along = std::cos(angle) * x + std::sin(angle) * y;
            const double across = -std::sin(angle) * x + std::cos(angle) * y;
            if (std::pow(along / reach, 2) + std::pow(across / across_reach, 2) > 1 + 1e-9) continue;
            places.emplace_back(x, y);
            distances.push_back(across);
        }
    }
    Eigen::MatrixXd powers(static_cast<Eigen::Index>(places.size()), 3);
    for (Eigen::Index row = 0; row < powers.rows(); ++row) {
        const double d = distances[static_cast<std::size_t>(row)];
        powers.row(row) << 1, d, d * d;
    }
    const Eigen::MatrixXd inverse = powers.completeOrthogonalDecomposition().pseudoInverse();
    cv::Mat kernel = cv::Mat::zeros(2 * reach + 1, 2 * reach + 1, CV_32F);
    for (std::size_t i = 0; i < places.size(); ++i) {
        kernel.at<float>(places[i].y + reach, places[i].x + reach) =
            static_cast<float>(inverse(0, static_cast<Eigen::Index>(i)));
    }
    return kernel;
}

/// Second derivative of a Gaussian across the line (even), or the first of a longer one (odd); free of the mean, and of
/// unit energy so that no direction or kind outweighs the others.
cv::Mat barFilter(double angle, bool even) {
    const double across_px = kTextureFilter_px / 2;
    const int reach = cvCeil(3 * kTextureFilter_px);
    cv::Mat filter(2 * reach + 1, 2 * reach + 1, CV_32F);
    for (int y = -reach; y <= reach; ++y) {
        for (int x = -reach; x <= reach; ++x) {
            const double u = (std::cos(angle) * x + std::sin(angle) * y) / kTextureFilter_px;
            const double v = (-std::sin(angle) * x + std::cos(angle) * y) / across_px;
            const double bell = std::exp(-(u * u + v * v) / 2);
            filter.at<float>(y + reach, x + reach) = static_cast<float>((even ? v * v - 1 : v) * bell);
        }
    }
    filter -= cv::mean(filter)[0];
    return filter / cv::norm(filter);
}

cv::Mat centreSurroundFilter() {
    const int reach = cvCeil(3 * kTextureFilter_px);
    const cv::Mat narrow = cv::getGaussianKernel(2 * reach + 1, kTextureFilter_px / std::numbers::sqrt2, CV_32F);
    const cv::Mat wide = cv::getGaussianKernel(2 * reach + 1, kTextureFilter_px, CV_32F);
    cv::Mat filter = narrow * narrow.t() - wide * wide.t();
    filter -= cv::mean(filter)[0];
    return filter / cv::norm(filter);
}

cv::Mat filtered(const cv::Mat& image, const cv::Mat& kernel) {
    cv::Mat response;
    cv::filter2D(image, response, CV_32F, kernel, {-1, -1}, 0, cv::BORDER_REFLECT);
    return response;
}

}  // namespace

double contourAngle(int direction) {
    return direction * std::numbers::pi / kContourDirections;
}

cv::Mat halfDiscDifference(const cv::Mat& values, int bins, double blur_bins, double radius, int direction) {
    CV_Assert(values.type() == CV_8UC1);
    const double angle = contourAngle(direction);
    const HalfDiscs halves = halfDiscs(radius, angle);
    std::vector<cv::Mat> one(static_cast<std::size_t>(bins));
    std::vector<cv::Mat> other(one.size());
    for (int bin = 0; bin < bins; ++bin) {
        cv::Mat has;
        cv::Mat(values == bin).convertTo(has, CV_32F, 1 / 255.0);
        one[static_cast<std::size_t>(bin)] = filtered(has, halves.one);
        other[static_cast<std::size_t>(bin)] = filtered(has, halves.other);
    }
    const int reach = blur_bins > 0 ? cvCeil(2 * blur_bins) : 0;
    const cv::Mat weights = cv::getGaussianKernel(2 * reach + 1, std::max(blur_bins, 1e-3), CV_32F);
    cv::Mat distance = cv::Mat::zeros(values.size(), CV_32F);
    for (int bin = 0; bin < bins; ++bin) {
        cv::Mat g = cv::Mat::zeros(values.size(), CV_32F);
        cv::Mat h = cv::Mat::zeros(values.size(), CV_32F);
        for (int step = -reach; step <= reach; ++step) {
            // What would fall beyond the first and the last bin stays in them.
            const auto from = static_cast<std::size_t>(std::clamp(bin + step, 0, bins - 1));
            const double weight = weights.at<float>(step + reach);
            cv::scaleAdd(one[from], weight, g, g);
            cv::scaleAdd(other[from], weight, h, h);
        }
        const cv::Mat apart = g - h;
        distance += apart.mul(apart) / (g + h + 1e-12F) * 0.5;
    }
    return cv::max(filtered(distance, parabolaKernel(radius, angle)), 0);
}

cv::Mat textures(const cv::Mat& gray, int kinds) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty());
    std::vector<cv::Mat> responses;
    for (int direction = 0; direction < kContourDirections; ++direction) {
        for (const bool even : {true, false})
            responses.push_back(filtered(gray, barFilter(contourAngle(direction), even)));
    }
    responses.push_back(filtered(gray, centreSurroundFilter()));
    cv::Mat stacked;
    cv::merge(responses, stacked);
    // In steps of 1/64 grey value, or rounding would be a texture on plain ground.
    cv::Mat steps;
    stacked.reshape(1, gray.rows * gray.cols).convertTo(steps, CV_32S, 64);
    cv::Mat samples;
    steps.convertTo(samples, CV_32F);
    cv::Mat numbers = cv::Mat::zeros(gray.size(), CV_8U);
    if (samples.rows < 2) return numbers;
    cv::Mat unused;
    cv::Mat centres;
    {
        const FixedRandom fixed;
        cv::kmeans(samples, std::min(kinds, samples.rows), unused,
                   {cv::TermCriteria::COUNT + cv::TermCriteria::EPS, 30, 1e-2}, 1, cv::KMEANS_PP_CENTERS, centres);
    }
    // k-means splits equal samples where it has too few others; equal ones are one texture.
    for (int i = 0; i < samples.rows; ++i) {
        double nearest = std::numeric_limits<double>::max();
        for (int kind = 0; kind < centres.rows; ++kind) {
            const double distance = cv::norm(samples.row(i), centres.row(kind), cv::NORM_L2SQR);
            if (distance >= nearest) continue;
            nearest = distance;
            numbers.at<uchar>(i / gray.cols, i % gray.cols) = static_cast<uchar>(kind);
        }
    }
    return numbers;
}

DirectedPictures boundaryCues(const cv::Mat& gray) {
    CV_Assert(gray.type() == CV_8UC1 && !gray.empty());
    cv::Mat brightness(gray.size(), CV_8UC1);
    cv::Mat steps(1, 256, CV_8UC1);
    for (int value = 0; value < 256; ++value)
        steps.at<uchar>(value) = static_cast<uchar>(value * kBrightnessBins / 256);
    cv::LUT(gray, steps, brightness);
    const cv::Mat texture = textures(gray, kTextureKinds);
    DirectedPictures cues;
    for (int direction = 0; direction < kContourDirections; ++direction) {
        cv::Mat& sum = cues[static_cast<std::size_t>(direction)];
        sum = cv::Mat::zeros(gray.size(), CV_32F);
        for (const double radius : kBrightnessRadii_px) {
            sum += halfDiscDifference(brightness, kBrightnessBins, kBrightnessBlur_bins, radius, direction);
        }
        for (const double radius : kTextureRadii_px)
            sum += halfDiscDifference(texture, kTextureKinds, 0, radius, direction);
        sum /= static_cast<double>(kBrightnessRadii_px.size() + kTextureRadii_px.size());
    }
    return cues;
}

}  // namespace eyrie

#include "imaging/following/box_patch.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

float sampleAt(const cv::Mat& gray, double x, double y) {
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const auto fx = static_cast<float>(x - column);
    const auto fy = static_cast<float>(y - row);
    const unsigned char* upper = gray.ptr(row) + column;
    const unsigned char* lower = upper + gray.step;
    const float top = static_cast<float>(upper[0]) * (1 - fx) + static_cast<float>(upper[1]) * fx;
    const float bottom = static_cast<float>(lower[0]) * (1 - fx) + static_cast<float>(lower[1]) * fx;
    return top * (1 - fy) + bottom * fy;
}

/// The nearest place in the picture whose neighbours to the right and below are in it, too; some for NaN.
cv::Point2d inside(const cv::Mat& gray, cv::Point2d at) {
    return {std::max(0.0, std::min(gray.cols - 1.001, at.x)), std::max(0.0, std::min(gray.rows - 1.001, at.y))};
}

using Values = Eigen::Map<Eigen::ArrayXf>;
using ConstValues = Eigen::Map<const Eigen::ArrayXf>;

Values arrayOf(std::vector<float>& values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

ConstValues arrayOf(const std::vector<float>& values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

}  // namespace

cv::Size BoxPatch::samplesFor(const OrientedBox& box) {
    const auto side = [](double px) { return std::clamp(static_cast<int>(std::lround(px)), 6, 48); };
    return {side(box.length), side(box.width)};
}

BoxPatch::BoxPatch(const cv::Mat& gray, const OrientedBox& box, cv::Size samples) : samples_(samples) {
    values_.resize(static_cast<std::size_t>(samples.area()));
    if (gray.cols < 2 || gray.rows < 2) return;
    // A little beyond the box, so that its outline counts.
    constexpr double kMargin = 1.12;
    const cv::Point2d along = box.direction() * (box.length * kMargin / samples.width);
    const cv::Point2d across =
        cv::Point2d(-box.direction().y, box.direction().x) * (box.width * kMargin / samples.height);
    const cv::Point2d corner = box.centre - along * ((samples.width - 1) / 2.0) - across * ((samples.height - 1) / 2.0);
    const auto isInside = [&](cv::Point2d at) { return inside(gray, at) == at; };
    float* value = values_.data();
    for (int y = 0; y < samples.height; ++y) {
        const cv::Point2d first = corner + across * static_cast<double>(y);
        const bool all_inside = isInside(first) && isInside(first + along * static_cast<double>(samples.width - 1));
        for (int x = 0; x < samples.width; ++x) {
            const cv::Point2d at = first + along * static_cast<double>(x);
            const cv::Point2d place = all_inside ? at : inside(gray, at);
            *value++ = sampleAt(gray, place.x, place.y);
        }
    }
    normalise();
}

void BoxPatch::normalise() {
    if (values_.empty()) return;
    Values values = arrayOf(values_);
    values -= values.mean();
    const float norm = values.matrix().norm();
    constexpr float kFlat = 1e-3F;
    if (norm > kFlat)
        values /= norm;
    else
        values.setZero();
}

double BoxPatch::correlation(const BoxPatch& other) const {
    if (values_.size() != other.values_.size()) return 0;
    return static_cast<double>(arrayOf(values_).matrix().dot(arrayOf(other.values_).matrix()));
}

double BoxPatch::seenOf(const BoxPatch& other) const {
    if (values_.size() != other.values_.size() || values_.empty()) return 0;
    constexpr int kPartSamples = 8;         // along a side: enough of them to be like another by chance only
    constexpr double kAlike = 0.7;          // correlation of a part
    constexpr double kLeastTexture = 0.15;  // of a part, against the mean of all
    const int columns = std::max(2, samples_.width / kPartSamples), rows = std::max(2, samples_.height / kPartSamples);
    int parts = 0, alike = 0;
    for (int row = 0; row < rows; ++row) {
        const int top = samples_.height * row / rows, bottom = samples_.height * (row + 1) / rows;
        for (int column = 0; column < columns; ++column) {
            const int left = samples_.width * column / columns, right = samples_.width * (column + 1) / columns;
            double count = 0, a = 0, b = 0, aa = 0, bb = 0, ab = 0;
            for (int y = top; y < bottom; ++y) {
                for (int x = left; x < right; ++x) {
                    const auto at = static_cast<std::size_t>(y) * static_cast<std::size_t>(samples_.width) +
                                    static_cast<std::size_t>(x);
                    const double mine = values_[at], its = other.values_[at];
                    ++count;
                    a += mine;
                    b += its;
                    aa += mine * mine;
                    bb += its * its;
                    ab += mine * its;
                }
            }
            const double mine = aa - a * a / count, its = bb - b * b / count;
            if (its * columns * rows < kLeastTexture) continue;
            ++parts;
            alike += ab - a * b / count > kAlike * std::sqrt(mine * its) ? 1 : 0;
        }
    }
    return parts == 0 ? 0 : static_cast<double>(alike) / parts;
}

void BoxPatch::learn(const BoxPatch& other, double share) {
    if (values_.size() != other.values_.size()) return;
    arrayOf(values_) += static_cast<float>(share) * (arrayOf(other.values_) - arrayOf(values_));
    normalise();
}

}  // namespace eyrie

#include "imaging/following/box_patch.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

float sampleAt(const cv::Mat& gray, double x, double y) {
    x = std::clamp(x, 0.0, gray.cols - 1.001);
    y = std::clamp(y, 0.0, gray.rows - 1.001);
    const int column = static_cast<int>(x);
    const int row = static_cast<int>(y);
    const auto fx = static_cast<float>(x - column);
    const auto fy = static_cast<float>(y - row);
    const unsigned char* upper = gray.ptr(row) + column;
    const unsigned char* lower = gray.ptr(std::min(row + 1, gray.rows - 1)) + column;
    const int next = column + 1 < gray.cols ? 1 : 0;
    const float top = static_cast<float>(upper[0]) * (1 - fx) + static_cast<float>(upper[next]) * fx;
    const float bottom = static_cast<float>(lower[0]) * (1 - fx) + static_cast<float>(lower[next]) * fx;
    return top * (1 - fy) + bottom * fy;
}

}  // namespace

cv::Size BoxPatch::samplesFor(const OrientedBox& box) {
    const auto side = [](double px) { return std::clamp(static_cast<int>(std::lround(px)), 6, 48); };
    return {side(box.length), side(box.width)};
}

BoxPatch::BoxPatch(const cv::Mat& gray, const OrientedBox& box, cv::Size samples) : samples_(samples) {
    values_.reserve(static_cast<std::size_t>(samples.area()));
    // A little beyond the box, so that its outline counts.
    constexpr double kMargin = 1.12;
    const cv::Point2d along = box.direction() * (box.length * kMargin / samples.width);
    const cv::Point2d across =
        cv::Point2d(-box.direction().y, box.direction().x) * (box.width * kMargin / samples.height);
    const cv::Point2d corner = box.centre - along * ((samples.width - 1) / 2.0) - across * ((samples.height - 1) / 2.0);
    for (int y = 0; y < samples.height; ++y) {
        cv::Point2d at = corner + across * static_cast<double>(y);
        for (int x = 0; x < samples.width; ++x, at += along) values_.push_back(sampleAt(gray, at.x, at.y));
    }
    normalise();
}

void BoxPatch::normalise() {
    double sum = 0;
    for (const float value : values_) sum += static_cast<double>(value);
    const double mean = sum / std::max<std::size_t>(1, values_.size());
    double squares = 0;
    for (float& value : values_) {
        value -= static_cast<float>(mean);
        squares += static_cast<double>(value) * static_cast<double>(value);
    }
    const double norm = std::sqrt(squares);
    for (float& value : values_) value = norm > 1e-3 ? static_cast<float>(static_cast<double>(value) / norm) : 0.F;
}

double BoxPatch::correlation(const BoxPatch& other) const {
    if (values_.size() != other.values_.size()) return 0;
    float sum = 0;
    for (std::size_t i = 0; i < values_.size(); ++i) sum += values_[i] * other.values_[i];
    return static_cast<double>(sum);
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
    const auto weight = static_cast<float>(share);
    for (std::size_t i = 0; i < values_.size(); ++i) values_[i] += weight * (other.values_[i] - values_[i]);
    normalise();
}

}  // namespace eyrie

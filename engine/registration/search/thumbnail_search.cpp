#include "registration/search/thumbnail_search.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

constexpr double kTurnStepDegrees = 2.5;
constexpr int kTurns = 9;  // −10° … 10°
constexpr double kFarthestShift = 0.4;
constexpr double kLeastCorrelation = 0.35;

/// A small picture without its slow brightness changes, which would correlate with everything.
cv::Mat thumbnailOf(const ImagePyramid& pyramid, int level, const PictureMask& graphics) {
    const PaddedPicture& picture = pyramid.level(level);
    cv::Mat values(picture.height(), picture.width(), CV_32F);
    for (int y = 0; y < picture.height(); ++y) {
        for (int x = 0; x < picture.width(); ++x) values.at<float>(y, x) = picture.row(y)[x];
    }
    cv::Mat smooth;
    cv::boxFilter(values, smooth, CV_32F, {9, 9}, {-1, -1}, true, cv::BORDER_REFLECT_101);
    values -= smooth;
    if (graphics.empty()) return values;
    for (int y = 0; y < values.rows; ++y) {
        for (int x = 0; x < values.cols; ++x) {
            if (graphics.marks(ImagePyramid::fromLevel(cv::Point(x, y), level))) values.at<float>(y, x) = 0;
        }
    }
    return values;
}

int thumbnailLevel(const ImagePyramid& pyramid) {
    constexpr int kThumbnailSide = 72;
    int level = 0;
    while (level + 1 < pyramid.levels() &&
           std::max(pyramid.level(level).width(), pyramid.level(level).height()) > kThumbnailSide) {
        ++level;
    }
    return level;
}

float productSum(const float* a, const float* b, int count) {
    std::array<float, 8> sums{};
    int i = 0;
    for (; i + 8 <= count; i += 8) {
        for (int k = 0; k < 8; ++k) sums[std::size_t(k)] += a[i + k] * b[i + k];
    }
    float sum = 0;
    for (; i < count; ++i) sum += a[i] * b[i];
    for (const float s : sums) sum += s;
    return sum;
}

struct Match {
    double correlation = -1;
    int dx = 0;
    int dy = 0;
};

/// The best shift of `a` over `b`, where b(x + dx, y + dy) shows what a(x, y) shows.
Match bestShift(const cv::Mat& a, const cv::Mat& b) {
    const int reach_x = static_cast<int>(kFarthestShift * a.cols);
    const int reach_y = static_cast<int>(kFarthestShift * a.rows);
    Match best;
    for (int dy = -reach_y; dy <= reach_y; ++dy) {
        for (int dx = -reach_x; dx <= reach_x; ++dx) {
            const int left = std::max(0, -dx);
            const int right = std::min(a.cols, b.cols - dx);
            const int top = std::max(0, -dy);
            const int bottom = std::min(a.rows, b.rows - dy);
            float ab = 0;
            float aa = 0;
            float bb = 0;
            for (int y = top; y < bottom; ++y) {
                const float* row_a = a.ptr<float>(y) + left;
                const float* row_b = b.ptr<float>(y + dy) + left + dx;
                ab += productSum(row_a, row_b, right - left);
                aa += productSum(row_a, row_a, right - left);
                bb += productSum(row_b, row_b, right - left);
            }
            const double norm = std::sqrt(double(aa) * double(bb));
            if (norm <= 0) continue;
            // A small overlap correlates by chance.
            const double share = double((right - left) * (bottom - top)) / double(a.total());
            const double correlation = double(ab) / norm * std::sqrt(share);
            if (correlation > best.correlation) best = {correlation, dx, dy};
        }
    }
    return best;
}

}  // namespace

std::optional<cv::Matx33d> searchThumbnails(const ImagePyramid& from, const ImagePyramid& to,
                                            const PictureMask& graphics) {
    const int level = thumbnailLevel(from);
    const cv::Mat source = thumbnailOf(from, level, graphics);
    const cv::Mat target = thumbnailOf(to, level, graphics);
    const cv::Point2d centre((source.cols - 1) / 2.0, (source.rows - 1) / 2.0);
    const auto turnOf = [&](int index) { return radiansFromDegrees((index - kTurns / 2) * kTurnStepDegrees); };
    std::array<Match, kTurns> matches;
    tbb::parallel_for(0, kTurns, [&](int index) {
        const double turn = turnOf(index);
        // Each pixel of the turned picture is looked up in the source.
        const cv::Matx23d source_from_turned(
            std::cos(turn), std::sin(turn), centre.x - std::cos(turn) * centre.x - std::sin(turn) * centre.y,
            -std::sin(turn), std::cos(turn), centre.y + std::sin(turn) * centre.x - std::cos(turn) * centre.y);
        cv::Mat turned;
        cv::warpAffine(source, turned, source_from_turned, source.size(), cv::INTER_LINEAR | cv::WARP_INVERSE_MAP,
                       cv::BORDER_CONSTANT, cv::Scalar(0));
        matches[std::size_t(index)] = bestShift(turned, target);
    });
    int best = kTurns / 2;
    for (int i = 0; i < kTurns; ++i) {
        if (matches[std::size_t(i)].correlation > matches[std::size_t(best)].correlation) best = i;
    }
    const Match& match = matches[std::size_t(best)];
    if (match.correlation < kLeastCorrelation) return std::nullopt;
    const double c = std::cos(turnOf(best));
    const double s = std::sin(turnOf(best));
    const cv::Matx33d small(c, -s, centre.x - c * centre.x + s * centre.y + match.dx, s, c,
                            centre.y - s * centre.x - c * centre.y + match.dy, 0, 0, 1);
    // Thumbnail pixel x lies at scale · (x + ½) − ½ of the full picture.
    const double scale = double(1 << level);
    const cv::Matx33d full_from_small(scale, 0, scale / 2 - 0.5, 0, scale, scale / 2 - 0.5, 0, 0, 1);
    return full_from_small * small * full_from_small.inv();
}

}  // namespace eyrie

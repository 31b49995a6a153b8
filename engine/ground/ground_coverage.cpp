#include "ground/ground_coverage.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace eyrie {
namespace {

constexpr double kNoWhere = std::numeric_limits<double>::infinity();

struct Bounds {
    double left = kNoWhere, top = kNoWhere, right = -kNoWhere, bottom = -kNoWhere;

    void take(cv::Point2d place) {
        left = std::min(left, place.x);
        top = std::min(top, place.y);
        right = std::max(right, place.x);
        bottom = std::max(bottom, place.y);
    }
};

double areaOf(const std::vector<cv::Point2d>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) twice += outline[i].cross(outline[(i + 1) % outline.size()]);
    return std::abs(twice) / 2;
}

/// Cells that enough of the sheets fit into, and none is so small that pictures fall into many more than wanted.
double cellSide(const std::vector<Bounds>& bounds, double largest_picture, cv::Size image,
                const CoverageOptions& options) {
    const double enlarged = std::sqrt(largest_picture / std::max(1, image.area()));
    double side = std::max(1e-6, enlarged * std::min(image.width, image.height) / std::max(1, options.cells_across));
    const auto cells = [&] {
        double all = 0;
        for (const Bounds& sheet : bounds)
            all += std::ceil((sheet.right - sheet.left) / side) * std::ceil((sheet.bottom - sheet.top) / side);
        return all;
    };
    // A sheet has one cell at least, however large that is.
    const double most = std::max(static_cast<double>(options.max_cells), 2.0 * static_cast<double>(bounds.size()));
    while (cells() > most) side *= 1.25;
    return side;
}

SheetCoverage unseen(const Bounds& bounds, double side) {
    SheetCoverage coverage;
    const auto cells = [side](double length) {
        constexpr double kRounding = 1e-6;
        return std::max(1, static_cast<int>(std::ceil(length / side - kRounding)));
    };
    const int columns = cells(bounds.right - bounds.left);
    const int rows = cells(bounds.bottom - bounds.top);
    coverage.cell = side;
    coverage.area = {bounds.left, bounds.top, columns * side, rows * side};
    coverage.seen_s = cv::Mat::zeros(rows, columns, CV_64F);
    coverage.last_frame = cv::Mat(rows, columns, CV_32S, cv::Scalar(-1));
    return coverage;
}

/// Counts a frame in all cells whose middle lies in its picture, which is convex: one span a row. Of times only what a
/// cell has more than the one to its left is kept, so that an hour of frames takes no time to speak of.
void see(SheetCoverage& coverage, const std::vector<cv::Point2d>& outline, FrameIndex frame, double seconds) {
    Bounds bounds;
    std::vector<cv::Point2d> corners;  // where the middle of a cell has whole numbers
    corners.reserve(outline.size());
    for (const cv::Point2d& corner : outline) {
        corners.push_back((corner - coverage.area.tl()) * (1 / coverage.cell) - cv::Point2d(0.5, 0.5));
        bounds.take(corners.back());
    }
    const int first_row = std::max(0, static_cast<int>(std::ceil(bounds.top)));
    const int last_row = std::min(coverage.seen_s.rows - 1, static_cast<int>(std::floor(bounds.bottom)));
    for (int row = first_row; row <= last_row; ++row) {
        double left = kNoWhere;
        double right = -kNoWhere;
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const cv::Point2d& a = corners[i];
            const cv::Point2d& b = corners[(i + 1) % corners.size()];
            if (std::min(a.y, b.y) > row || std::max(a.y, b.y) < row) continue;
            const double share = a.y == b.y ? 0 : (row - a.y) / (b.y - a.y);
            for (const double x : {a.x + share * (b.x - a.x), a.y == b.y ? b.x : a.x + share * (b.x - a.x)}) {
                left = std::min(left, x);
                right = std::max(right, x);
            }
        }
        const int begin = std::max(0, static_cast<int>(std::ceil(left)));
        const int end = std::min(coverage.seen_s.cols - 1, static_cast<int>(std::floor(right)));
        auto* seen = coverage.seen_s.ptr<double>(row);
        auto* last = coverage.last_frame.ptr<int>(row);
        if (begin > end) continue;
        seen[begin] += seconds;
        if (end + 1 < coverage.seen_s.cols) seen[end + 1] -= seconds;
        std::fill(last + begin, last + end + 1, frame);
    }
}

void addUp(SheetCoverage& coverage) {
    double shortest = kNoWhere;
    for (int row = 0; row < coverage.seen_s.rows; ++row) {
        auto* seen = coverage.seen_s.ptr<double>(row);
        const auto* last = coverage.last_frame.ptr<int>(row);
        double sum = 0;
        for (int x = 0; x < coverage.seen_s.cols; ++x) {
            sum += seen[x];
            seen[x] = last[x] < 0 ? 0 : sum;  // sums are not exactly nothing where nothing is left
            if (last[x] < 0) continue;
            shortest = std::min(shortest, sum);
            coverage.longest_s = std::max(coverage.longest_s, sum);
        }
    }
    if (shortest < kNoWhere) coverage.shortest_s = shortest;
}

}  // namespace

std::optional<cv::Point> SheetCoverage::cellAt(cv::Point2d on_sheet) const {
    const cv::Point2d at = (on_sheet - area.tl()) * (1 / cell);
    const cv::Point found(static_cast<int>(std::floor(at.x)), static_cast<int>(std::floor(at.y)));
    const bool inside = found.x >= 0 && found.y >= 0 && found.x < seen_s.cols && found.y < seen_s.rows;
    return inside ? std::optional(found) : std::nullopt;
}

std::vector<SheetCoverage> groundCoverage(const GroundSheets& sheets, const StoredTracks& run,
                                          const CoverageOptions& options) {
    std::vector<SheetCoverage> covered;
    if (sheets.count() == 0) return covered;
    std::vector<Bounds> bounds(static_cast<std::size_t>(sheets.count()));
    double largest_picture = 0;
    for (FrameIndex frame = sheets.firstFrame(); frame <= sheets.lastFrame(); ++frame) {
        const std::vector<cv::Point2d> outline = sheets.outlineOf(frame);
        for (const cv::Point2d& corner : outline) bounds[static_cast<std::size_t>(sheets.sheetOf(frame))].take(corner);
        largest_picture = std::max(largest_picture, areaOf(outline));
    }
    const double side = cellSide(bounds, largest_picture, sheets.imageSize(), options);
    covered.reserve(bounds.size());
    for (const Bounds& sheet : bounds) covered.push_back(unseen(sheet, side));
    const double usual_s = 1 / run.footage.scale.frame_rate_hz;
    for (FrameIndex frame = sheets.firstFrame(); frame <= sheets.lastFrame(); ++frame) {
        if (frame > sheets.firstFrame() && !run.footage.camera.connects(frame - 1, frame)) continue;
        SheetCoverage& sheet = covered[static_cast<std::size_t>(sheets.sheetOf(frame))];
        const double seconds = frame < sheets.lastFrame() ? run.secondsOf(frame + 1) - run.secondsOf(frame) : usual_s;
        see(sheet, sheets.outlineOf(frame), frame, seconds);
        if (sheet.frames.last < sheet.frames.first) sheet.frames.first = frame;
        sheet.frames.last = frame;
    }
    for (SheetCoverage& sheet : covered) addUp(sheet);
    return covered;
}

}  // namespace eyrie

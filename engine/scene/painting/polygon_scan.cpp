#include "scene/painting/polygon_scan.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

/// Adds the area that the span [from, to] covers of each cell, with a weight.
void addSpan(std::vector<float>& cells, int first_cell, double from, double to, float weight) {
    const double low = std::max(from + 0.5 - first_cell, 0.0);
    const double high = std::min(to + 0.5 - first_cell, static_cast<double>(cells.size()));
    if (high <= low) return;
    const auto first = static_cast<std::size_t>(low);
    const std::size_t last = std::min(static_cast<std::size_t>(high), cells.size() - 1);
    if (first == last) {
        cells[first] += weight * static_cast<float>(high - low);
        return;
    }
    cells[first] += weight * static_cast<float>(static_cast<double>(first) + 1 - low);
    for (std::size_t i = first + 1; i < last; ++i) cells[i] += weight;
    cells[last] += weight * static_cast<float>(high - static_cast<double>(last));
}

}  // namespace

void scanPolygon(const std::vector<cv::Point2d>& outline, cv::Rect bounds, const CoverageRow& row) {
    constexpr int kLines = 4;
    double left = 1e300;
    double right = -1e300;
    double top = 1e300;
    double bottom = -1e300;
    for (const cv::Point2d& p : outline) {
        left = std::min(left, p.x);
        right = std::max(right, p.x);
        top = std::min(top, p.y);
        bottom = std::max(bottom, p.y);
    }
    const auto cell = [](double value, int low, int high) {
        return static_cast<int>(
            std::clamp(std::floor(value + 0.5), static_cast<double>(low), static_cast<double>(high)));
    };
    const int x_begin = cell(left, bounds.x, bounds.x + bounds.width);
    const int x_end = cell(right + 1, bounds.x, bounds.x + bounds.width);
    const int y_begin = cell(top, bounds.y, bounds.y + bounds.height);
    const int y_end = cell(bottom + 1, bounds.y, bounds.y + bounds.height);
    if (x_begin >= x_end || y_begin >= y_end) return;

    // Long outlines have thousands of edges, of which a row meets a few.
    struct Edge {
        double top, bottom, x, slope;
    };
    std::vector<Edge> edges;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const cv::Point2d& a = outline[i];
        const cv::Point2d& b = outline[(i + 1) % outline.size()];
        const cv::Point2d& high = a.y <= b.y ? a : b;
        const cv::Point2d& low = a.y <= b.y ? b : a;
        if (low.y <= high.y || low.y < y_begin - 0.5 || high.y > y_end - 0.5) continue;
        edges.push_back({high.y, low.y, high.x, (low.x - high.x) / (low.y - high.y)});
    }
    std::vector<float> coverage(static_cast<std::size_t>(x_end - x_begin));
    std::vector<const Edge*> near;
    std::vector<double> crossings;
    for (int y = y_begin; y < y_end; ++y) {
        std::fill(coverage.begin(), coverage.end(), 0.0F);
        near.clear();
        for (const Edge& edge : edges) {
            if (edge.top < y + 0.5 && edge.bottom > y - 0.5) near.push_back(&edge);
        }
        if (near.empty()) continue;
        for (int line = 0; line < kLines; ++line) {
            const double at = y - 0.5 + (line + 0.5) / kLines;
            crossings.clear();
            for (const Edge* edge : near) {
                if (edge->top <= at && at < edge->bottom) crossings.push_back(edge->x + (at - edge->top) * edge->slope);
            }
            std::sort(crossings.begin(), crossings.end());
            for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
                addSpan(coverage, x_begin, crossings[i], crossings[i + 1], 1.0F / kLines);
            }
        }
        row(y, x_begin, x_end, coverage.data());
    }
}

}  // namespace eyrie

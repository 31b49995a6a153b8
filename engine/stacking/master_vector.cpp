#include "stacking/master_vector.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

cv::Point2d turned(cv::Point2d p, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    return {c * p.x - s * p.y, s * p.x + c * p.y};
}

}  // namespace

double lowerMedian(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>((values.size() - 1) / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double medianHeading(const std::vector<double>& headings) {
    cv::Point2d sum(0, 0);
    for (const double heading : headings) sum += cv::Point2d(std::cos(heading), std::sin(heading));
    const double mean = std::atan2(sum.y, sum.x);
    std::vector<double> turns;
    turns.reserve(headings.size());
    for (const double heading : headings) turns.push_back(turnBetween(mean, heading));
    return wrapPi(mean + lowerMedian(std::move(turns)));
}

std::vector<CornerId> MasterVector::related() const {
    std::vector<CornerId> ids;
    for (const auto& r : related_) ids.push_back(r.id);
    return ids;
}

void MasterVector::relate(const MotionVector& vector, double direction) {
    const Related related{vector.id, turned(pose_.position - cv::Point2d(vector.position), -direction),
                          turnBetween(direction, pose_.heading)};
    const auto at = std::lower_bound(related_.begin(), related_.end(), vector.id,
                                     [](const Related& r, CornerId wanted) { return r.id < wanted; });
    if (at != related_.end() && at->id == vector.id) {
        *at = related;
    } else {
        related_.insert(at, related);
    }
}

bool MasterVector::update(const std::vector<Suggestion>& present) {
    std::vector<Related> kept;
    std::vector<double> x, y, headings, vx, vy;
    for (const auto& suggestion : present) {
        const auto at = std::lower_bound(related_.begin(), related_.end(), suggestion.vector->id,
                                         [](const Related& r, CornerId wanted) { return r.id < wanted; });
        if (at == related_.end() || at->id != suggestion.vector->id) continue;
        kept.push_back(*at);
        const cv::Point2d place = cv::Point2d(suggestion.vector->position) + turned(at->offset, suggestion.direction);
        x.push_back(place.x);
        y.push_back(place.y);
        headings.push_back(wrapPi(suggestion.direction + at->turn));
        vx.push_back(suggestion.vector->velocity.x);
        vy.push_back(suggestion.vector->velocity.y);
    }
    if (kept.empty()) return false;
    std::sort(kept.begin(), kept.end(), [](const Related& a, const Related& b) { return a.id < b.id; });
    related_ = std::move(kept);
    pose_ = {{lowerMedian(std::move(x)), lowerMedian(std::move(y))},
             medianHeading(headings),
             {lowerMedian(std::move(vx)), lowerMedian(std::move(vy))}};
    return true;
}

}  // namespace eyrie

#include "imaging/contours/contour_hierarchy.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <opencv2/imgproc.hpp>
#include <queue>
#include <utility>

#include "imaging/contours/spectral_contours.h"

namespace eyrie {
namespace {

constexpr double kArcReach_px = 4;   // part of an arc that tells its direction
constexpr double kNoContour = 1e-3;  // below is what rounding leaves on plain ground

cv::Mat strongestOf(const DirectedPictures& pictures) {
    cv::Mat strongest = pictures[0].clone();
    for (const cv::Mat& picture : pictures) strongest = cv::max(strongest, picture);
    return strongest;
}

/// Value that 99 of 100 pixels stay below.
double strongHundredth(const cv::Mat& picture) {
    std::vector<float> values(picture.begin<float>(), picture.end<float>());
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 99 / 100);
    std::nth_element(values.begin(), place, values.end());
    return *place;
}

/// Regional minima, numbered from 0, grow in order of strength until they meet (Meyer's flooding).
cv::Mat flood(const cv::Mat& strength, int& basins) {
    cv::Mat steps;
    double strongest = 0;
    cv::minMaxLoc(strength, nullptr, &strongest);
    strength.convertTo(steps, CV_8U, strongest > 0 ? 255 / strongest : 0);
    constexpr int kNone = -1;
    cv::Mat labels(steps.size(), CV_32SC1, cv::Scalar(kNone));
    const cv::Rect whole({0, 0}, steps.size());
    const cv::Point around[] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
    using Entry = std::pair<std::pair<int, int>, int>;  // height, order of arrival; pixel
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> waiting;
    int order = 0;
    basins = 0;
    cv::Mat seen = cv::Mat::zeros(steps.size(), CV_8U);
    for (int y = 0; y < steps.rows; ++y) {
        for (int x = 0; x < steps.cols; ++x) {
            if (seen.at<uchar>(y, x) != 0) continue;
            // A plateau is a minimum if nothing beside it is lower.
            std::vector<cv::Point> plateau{{x, y}};
            seen.at<uchar>(y, x) = 1;
            const int height = steps.at<uchar>(y, x);
            bool lowest = true;
            for (std::size_t i = 0; i < plateau.size(); ++i) {
                for (const cv::Point step : around) {
                    const cv::Point beside = plateau[i] + step;
                    if (!whole.contains(beside)) continue;
                    const int other = steps.at<uchar>(beside);
                    if (other < height) lowest = false;
                    if (other != height || seen.at<uchar>(beside) != 0) continue;
                    seen.at<uchar>(beside) = 1;
                    plateau.push_back(beside);
                }
            }
            if (!lowest) continue;
            for (const cv::Point p : plateau) {
                labels.at<int>(p) = basins;
                waiting.push({{height, order++}, p.y * steps.cols + p.x});
            }
            ++basins;
        }
    }
    while (!waiting.empty()) {
        const auto [when, pixel] = waiting.top();
        waiting.pop();
        const cv::Point p(pixel % steps.cols, pixel / steps.cols);
        for (const cv::Point step : around) {
            const cv::Point beside = p + step;
            if (!whole.contains(beside) || labels.at<int>(beside) != kNone) continue;
            labels.at<int>(beside) = labels.at<int>(p);
            const int height = std::max<int>(when.first, steps.at<uchar>(beside));
            waiting.push({{height, order++}, beside.y * steps.cols + beside.x});
        }
    }
    return labels;
}

using Sides = std::pair<int, int>;  ///< two segments, the smaller number first

/// The place between two neighbouring pixels of different segments.
struct Crack {
    cv::Point one;
    cv::Point other;
    cv::Point2d middle() const { return {(one.x + other.x) / 2.0, (one.y + other.y) / 2.0}; }
};
using Arc = std::vector<Crack>;

std::map<Sides, Arc> arcsOf(const cv::Mat& labels) {
    std::map<Sides, Arc> arcs;
    const auto look = [&](cv::Point a, cv::Point b) {
        const int one = labels.at<int>(a);
        const int other = labels.at<int>(b);
        if (one != other) arcs[std::minmax(one, other)].push_back({a, b});
    };
    for (int y = 0; y < labels.rows; ++y) {
        for (int x = 0; x < labels.cols; ++x) {
            if (x + 1 < labels.cols) look({x, y}, {x + 1, y});
            if (y + 1 < labels.rows) look({x, y}, {x, y + 1});
        }
    }
    return arcs;
}

/// Direction of an arc near one of its cracks: main axis of the middles around it; alone, along the crack itself.
int directionAt(const Arc& arc, const Crack& crack) {
    const cv::Point2d centre = crack.middle();
    cv::Point2d mean;
    int count = 0;
    const auto near = [&](const Crack& c) { return cv::norm(c.middle() - centre) <= kArcReach_px; };
    for (const Crack& c : arc) {
        if (!near(c)) continue;
        mean += c.middle();
        ++count;
    }
    mean /= count;
    double xx = 0;
    double xy = 0;
    double yy = 0;
    for (const Crack& c : arc) {
        if (!near(c)) continue;
        const cv::Point2d d = c.middle() - mean;
        xx += d.x * d.x;
        xy += d.x * d.y;
        yy += d.y * d.y;
    }
    double angle = std::atan2(2 * xy, xx - yy) / 2;
    if (count < 2) angle = crack.one.x == crack.other.x ? 0 : CV_PI / 2;
    const int direction = cvRound(angle * kContourDirections / CV_PI);
    return (direction + kContourDirections) % kContourDirections;
}

/// Oriented watershed: a crack is as strong as the contours of its arc's own direction; so a strong contour that an arc
/// only meets or crosses does not strengthen it.
double strengthOf(const DirectedPictures& contours, const Arc& arc) {
    double sum = 0;
    for (const Crack& crack : arc) {
        const cv::Mat& picture = contours[static_cast<std::size_t>(directionAt(arc, crack))];
        sum += std::max(picture.at<float>(crack.one), picture.at<float>(crack.other));
    }
    return sum;
}

struct Border {
    double strength = 0;  ///< sum over its cracks
    int cracks = 0;
    double mean() const { return strength / cracks; }
};

}  // namespace

ContourHierarchy::ContourHierarchy(const DirectedPictures& contours) {
    CV_Assert(contours[0].type() == CV_32FC1);
    if (contours[0].empty()) return;
    finest_ = flood(strongestOf(contours), segments_);

    std::vector<std::map<int, Border>> borders(static_cast<std::size_t>(segments_));
    for (const auto& [sides, arc] : arcsOf(finest_)) {
        const Border border{strengthOf(contours, arc), static_cast<int>(arc.size())};
        borders[static_cast<std::size_t>(sides.first)][sides.second] = border;
        borders[static_cast<std::size_t>(sides.second)][sides.first] = border;
    }
    using Entry = std::pair<double, Sides>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> weakest;
    for (int one = 0; one < segments_; ++one) {
        for (const auto& [other, border] : borders[static_cast<std::size_t>(one)]) {
            if (one < other) weakest.push({border.mean(), {one, other}});
        }
    }
    double reached = 0;
    while (!weakest.empty()) {
        const auto [strength, sides] = weakest.top();
        weakest.pop();
        auto& kept = borders[static_cast<std::size_t>(sides.first)];
        const auto entry = kept.find(sides.second);
        if (entry == kept.end() || entry->second.mean() != strength) continue;  // joined or changed since
        reached = std::max(reached, strength);
        joints_.push_back({sides.first, sides.second, reached});
        kept.erase(entry);
        for (const auto& [third, border] : std::exchange(borders[static_cast<std::size_t>(sides.second)], {})) {
            if (third == sides.first) continue;
            auto& its = borders[static_cast<std::size_t>(third)];
            its.erase(sides.second);
            Border& sum = kept[third];
            sum.strength += border.strength;
            sum.cracks += border.cracks;
            its[sides.first] = sum;
            weakest.push({sum.mean(), std::minmax(sides.first, third)});
        }
    }
}

std::vector<int> ContourHierarchy::groupsAt(double level) const {
    std::vector<int> group(static_cast<std::size_t>(segments_));
    std::iota(group.begin(), group.end(), 0);
    const auto headOf = [&](int segment) {
        while (group[static_cast<std::size_t>(segment)] != segment) segment = group[static_cast<std::size_t>(segment)];
        return segment;
    };
    for (const Joint& joint : joints_) {
        if (joint.strength > level) break;
        group[static_cast<std::size_t>(headOf(joint.other))] = headOf(joint.one);
    }
    std::map<int, int> numbers;
    std::vector<int> numbered(group.size());
    for (int segment = 0; segment < segments_; ++segment) {
        numbered[static_cast<std::size_t>(segment)] =
            numbers.try_emplace(headOf(segment), static_cast<int>(numbers.size())).first->second;
    }
    return numbered;
}

cv::Mat ContourHierarchy::segmentsAt(double level) const {
    const std::vector<int> group = groupsAt(level);
    cv::Mat labels = finest_.clone();
    for (int& label : cv::Mat_<int>(labels)) label = group[static_cast<std::size_t>(label)];
    return labels;
}

cv::Mat ContourHierarchy::contourMap() const {
    cv::Mat map = cv::Mat::zeros(finest_.size(), CV_32F);
    double level = 0;
    // From the finest level up: what still parts two pixels there is stronger than the joints up to it.
    const auto raise = [&](const cv::Mat& labels, double strength) {
        for (int y = 0; y < labels.rows; ++y) {
            for (int x = 0; x < labels.cols; ++x) {
                const int own = labels.at<int>(y, x);
                const bool right = x + 1 < labels.cols && labels.at<int>(y, x + 1) != own;
                const bool below = y + 1 < labels.rows && labels.at<int>(y + 1, x) != own;
                if (right || below) map.at<float>(y, x) = static_cast<float>(strength);
            }
        }
    };
    for (const Joint& joint : joints_) {
        if (joint.strength <= level) continue;
        raise(segmentsAt(level), joint.strength);
        level = joint.strength;
    }
    return map;
}

DirectedPictures probabilityOfBoundary(const cv::Mat& gray) {
    DirectedPictures contours = boundaryCues(gray);
    const DirectedPictures spectral = spectralCues(strongestOf(contours));
    const double local = strongHundredth(strongestOf(contours));
    const double global = strongHundredth(strongestOf(spectral));
    const double share = global > 0 ? local / global : 0;
    for (std::size_t k = 0; k < contours.size(); ++k) {
        const cv::Mat both = contours[k] * 0.5 + spectral[k] * (0.5 * share);
        cv::threshold(both, contours[k], kNoContour, 0, cv::THRESH_TOZERO);
    }
    return contours;
}

}  // namespace eyrie

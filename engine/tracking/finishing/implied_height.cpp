#include "tracking/finishing/implied_height.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>
#include <vector>

#include "core/robust_statistics.h"

namespace eyrie {
namespace {

constexpr int kHeightWindow = 24;    ///< frames …
constexpr int kLeastWindow = 8;      ///< … at least
constexpr int kHeightStep = 6;       ///< frames from one window to the next
constexpr double kFocalShare = 0.8;  ///< focal length of a usual lens, as a share of the image's width
constexpr double kLowest = -0.2;
constexpr double kHighest = 0.9;
constexpr double kHeightGrid = 0.01;

/// Turn of the camera, its way as a share of its height over the plane, and the plane's normal (away from the camera).
struct PlaneMotion {
    cv::Matx33d turn;
    cv::Vec3d way;
    cv::Vec3d normal;
};

cv::Matx33d columns(cv::Vec3d a, cv::Vec3d b, cv::Vec3d c) {
    return {a[0], b[0], c[0], a[1], b[1], c[1], a[2], b[2], c[2]};
}

/// Decomposes a homography between calibrated pictures (Ma, Soatto, Košecká, Sastry: An Invitation to 3-D Vision,
/// §5.3.3). Of the up to four solutions that in which the ground lies before the camera and not above the horizon, and
/// the horizon is level.
std::optional<PlaneMotion> planeMotionOf(cv::Matx33d map) {
    cv::Vec3d squares;
    cv::Matx33d rows;
    cv::eigen(map.t() * map, squares, rows);
    if (!(squares[1] > 0)) return std::nullopt;
    map *= (cv::determinant(map) < 0 ? -1 : 1) / std::sqrt(squares[1]);
    squares *= 1 / squares[1];
    const cv::Vec3d v1(rows(0, 0), rows(0, 1), rows(0, 2));
    cv::Vec3d v2(rows(1, 0), rows(1, 1), rows(1, 2));
    const cv::Vec3d v3(rows(2, 0), rows(2, 1), rows(2, 2));
    if (v1.cross(v2).dot(v3) < 0) v2 = -v2;
    const double spread = squares[0] - squares[2];
    if (!(spread > 1e-9)) return std::nullopt;  // it turned without moving
    const double a = std::sqrt(std::max(0.0, 1 - squares[2]) / spread);
    const double b = std::sqrt(std::max(0.0, squares[0] - 1) / spread);

    std::optional<PlaneMotion> best;
    for (const double side : {1.0, -1.0}) {
        const cv::Vec3d u = v1 * a + v3 * (side * b);
        const cv::Vec3d mapped_v = map * v2;
        const cv::Vec3d mapped_u = map * u;
        PlaneMotion found;
        found.turn = columns(mapped_v, mapped_u, mapped_v.cross(mapped_u)) * columns(v2, u, v2.cross(u)).t();
        found.normal = v2.cross(u);
        found.way = (map - found.turn) * found.normal;
        if (found.normal[2] < 0) {
            found.normal = -found.normal;
            found.way = -found.way;
        }
        if (found.normal[2] < 0.15 || found.normal[1] < -0.25) continue;
        if (!best || std::abs(found.normal[0]) < std::abs(best->normal[0])) best = found;
    }
    return best;
}

cv::Point2d pixelOf(const cv::Vec3d& seen) {
    return {seen[0] / seen[2], seen[1] / seen[2]};
}

/// The height whose standing thing would have moved most nearly from one place to another.
ImpliedHeight explain(const PlaneMotion& motion, const cv::Matx33d& lens, cv::Point2d from, cv::Point2d to) {
    const cv::Vec3d ray = lens.inv() * cv::Vec3d(from.x, from.y, 1);
    const cv::Vec3d turned = lens * (motion.turn * ray);
    const cv::Vec3d pushed = lens * motion.way * motion.normal.dot(ray);
    const auto missed = [&](double height) {
        const cv::Point2d way = pixelOf(turned + pushed * (1 / (1 - height))) - to;
        return std::hypot(way.x, way.y);
    };
    ImpliedHeight best;
    best.moved = missed(0);
    best.oblique = motion.normal[2];
    best.rest = best.moved;
    const int steps = static_cast<int>(std::lround((kHighest - kLowest) / kHeightGrid));
    for (int i = 0; i <= steps; ++i) {
        const double height = kLowest + i * kHeightGrid;
        if (const double rest = missed(height); rest < best.rest) {
            best.rest = rest;
            best.height = height;
        }
    }
    return best;
}

std::optional<cv::Matx33d> mapBetween(const GroundMotion& ground, FrameIndex first, FrameIndex last) {
    cv::Matx33d map = cv::Matx33d::eye();
    for (FrameIndex frame = first; frame < last; ++frame) {
        const cv::Matx33d* step = ground.step(frame, frame + 1, true);
        if (step == nullptr) return std::nullopt;
        map = *step * map;
    }
    return map;
}

}  // namespace

std::optional<ImpliedHeight> impliedHeightOf(const TrackPath& path, const GroundMotion& ground) {
    std::vector<double> heights, rests, moves, obliques;
    const auto& states = path.states;
    for (std::size_t i = 0; i < states.size(); i += kHeightStep) {
        const auto& [first, begin] = states[i];
        const auto& [last, end] = states[std::min(i + kHeightWindow, states.size() - 1)];
        if (begin.origin == StateOrigin::standing || end.origin == StateOrigin::standing) continue;
        const cv::Size image = ground.imageSize(first);
        if (last - first < kLeastWindow || image.empty()) continue;
        const auto map = mapBetween(ground, first, last);
        if (!map) continue;
        const double focal = kFocalShare * image.width;
        const cv::Matx33d lens(focal, 0, (image.width - 1) / 2.0, 0, focal, (image.height - 1) / 2.0, 0, 0, 1);
        const auto motion = planeMotionOf(lens.inv() * *map * lens);
        if (!motion) continue;
        const ImpliedHeight one = explain(*motion, lens, begin.box.centre, end.box.centre);
        heights.push_back(one.height);
        rests.push_back(one.rest);
        moves.push_back(one.moved);
        obliques.push_back(one.oblique);
    }
    if (heights.empty()) return std::nullopt;
    return ImpliedHeight{medianOf(std::move(heights)), medianOf(std::move(rests)), medianOf(std::move(moves)),
                         medianOf(std::move(obliques))};
}

}  // namespace eyrie

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/homography.h"
#include "tracking/finishing/track_occupancy.h"

namespace eyrie {
namespace {

constexpr double kFittedSeconds = 3;       ///< of a track's beginning
constexpr std::size_t kFewestFitted = 12;  ///< states
constexpr double kShortestWay = 1;         ///< px; what moved less says nothing
constexpr int kRounds = 8;                 ///< of reweighting
constexpr double kSmallestResidual = 0.1;  ///< px; smaller ones weigh alike
constexpr double kFastest = 3.5;           ///< m/s at which a vehicle that starts from rest is found at the latest
constexpr double kRestInImage = 0.9;       ///< share of the box that must lie in the image

/// A place along the way at some frame after the first.
struct Station {
    double time = 0;  ///< frames
    double way = 0;   ///< px
};

/// Uniformly accelerated motion over the ground, in the first frame of a track.
struct Start {
    cv::Point2d direction;    ///< of length 1
    double speed = 0;         ///< px/frame in the first frame
    double acceleration = 0;  ///< px/frame²

    bool isFromRest(double fastest) const { return speed > 0 && acceleration > 0 && speed <= fastest; }
    double framesSinceRest() const { return speed / acceleration; }
    /// px from where it was so many frames before the first one
    double wayFrom(double frames_before) const {
        const double moving = std::min(frames_before, framesSinceRest());
        return moving * (speed - acceleration * moving / 2);
    }
    double speedAt(double frames_before) const { return std::max(0.0, speed - acceleration * frames_before); }
};

/// Least absolute deviations, so that the boxes of the first frames, which grow with the vectors, do not decide.
void fit(Start& start, const std::vector<Station>& stations) {
    std::vector<double> weights(stations.size(), 1);
    for (int round = 0; round < kRounds; ++round) {
        Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
        Eigen::Vector3d right = Eigen::Vector3d::Zero();
        const auto powersOf = [](double time) { return Eigen::Vector3d(1, time, time * time / 2); };
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const Eigen::Vector3d powers = powersOf(stations[i].time);
            normal += weights[i] * powers * powers.transpose();
            right += weights[i] * stations[i].way * powers;
        }
        const Eigen::Vector3d solution = normal.ldlt().solve(right);
        if (!solution.allFinite()) return;
        start.speed = solution(1);
        start.acceleration = solution(2);
        for (std::size_t i = 0; i < stations.size(); ++i) {
            const double residual = std::abs(powersOf(stations[i].time).dot(solution) - stations[i].way);
            weights[i] = 1 / std::max(kSmallestResidual, residual);
        }
    }
}

std::optional<Start> startOf(const TrackPath& path, const GroundMotion& ground, double fitted_frames) {
    std::vector<std::pair<double, cv::Point2d>> places;
    Homography into_first;
    FrameIndex frame = path.firstFrame();
    for (const auto& [at, state] : path.states) {
        if (at - path.firstFrame() > fitted_frames) break;
        for (; frame < at; ++frame) {
            const cv::Matx33d* step = ground.step(frame + 1, frame, false);
            if (step == nullptr) return std::nullopt;
            into_first.matrix = into_first.matrix * *step;
        }
        places.emplace_back(at - path.firstFrame(), into_first.apply(state.box.centre));
    }
    if (places.size() < kFewestFitted) return std::nullopt;
    const cv::Point2d moved = places.back().second - places.front().second;
    const double way = std::hypot(moved.x, moved.y);
    if (!(way >= kShortestWay)) return std::nullopt;
    Start start;
    start.direction = moved / way;
    std::vector<Station> stations;
    stations.reserve(places.size());
    for (const auto& [time, place] : places) {
        stations.push_back({time, (place - places.front().second).dot(start.direction)});
    }
    fit(start, stations);
    return start;
}

}  // namespace

void extendToRest(std::vector<TrackPath>& paths, const GroundMotion& ground, int frames, const SceneScale& scale) {
    if (frames < 1 || !hasMetricLimits(scale)) return;
    TrackOccupancy taken(paths);
    for (TrackPath& path : paths) {
        const PathState first = path.states.front().second;
        // A predicted beginning was extended before.
        if (first.origin == StateOrigin::predicted) continue;
        const cv::Point2d found_at = first.box.centre;
        const auto start = startOf(path, ground, kFittedSeconds * scale.frame_rate_hz);
        if (!start || !start->isFromRest(scale.at(path.firstFrame(), found_at).pxPerFrame(kFastest)) ||
            start->framesSinceRest() > frames)
            continue;
        std::vector<TimedPathState> extension;
        Homography from_first;
        for (int before = 1; before <= frames; ++before) {
            const FrameIndex frame = path.firstFrame() - before;
            const cv::Matx33d* step = ground.step(frame + 1, frame, false);
            if (step == nullptr) break;
            from_first.matrix = *step * from_first.matrix;
            const cv::Point2d centre = found_at - start->direction * start->wayFrom(before);
            PathState state = first;
            state.box.centre = from_first.apply(centre);
            state.box.heading = from_first.turned(centre, first.box.heading);
            state.velocity = first.velocity * (start->speedAt(before) / start->speed);
            state.origin = StateOrigin::predicted;
            state.hits = 0;
            if (!taken.isFree(frame, state.box) ||
                areaInImage(state.box, ground.imageSize(frame)) < kRestInImage * state.box.area())
                break;
            extension.emplace_back(frame, state);
        }
        prepend(path, extension);
        taken.extended(path);
    }
}

}  // namespace eyrie

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <optional>

#include "core/geometry/angle.h"
#include "core/geometry/homography.h"
#include "tracking/finishing/track_paths.h"

namespace eyrie {
namespace {

double weightOf(const PathState& state) {
    switch (state.origin) {
        case StateOrigin::detected:
        case StateOrigin::by_hand:
            return 1;
        case StateOrigin::reconstructed:
        case StateOrigin::standing:
            return 0.6;
        case StateOrigin::predicted:
            break;
    }
    return 0.1;
}

double weightedMedian(std::vector<std::pair<double, double>>& values_and_weights) {
    std::sort(values_and_weights.begin(), values_and_weights.end());
    double total = 0;
    for (const auto& [value, weight] : values_and_weights) total += weight;
    double sum = 0;
    for (const auto& [value, weight] : values_and_weights) {
        sum += weight;
        if (2 * sum >= total) return value;
    }
    return values_and_weights.back().first;
}

/// A polynomial of degree ≤ 2 fitted to weighted values; `value` and `slope` at time 0.
class LocalFit {
 public:
    void add(double time, double measured, double weight) {
        const double t2 = time * time;
        const Eigen::Vector3d powers(1, time, t2);
        normal_ += weight * powers * powers.transpose();
        right_ += weight * measured * powers;
    }
    bool solve(int degree) {
        const int size = degree + 1;
        const Eigen::LDLT<Eigen::MatrixXd> solver(normal_.topLeftCorner(size, size));
        const Eigen::VectorXd solution = solver.solve(right_.head(size));
        if (solver.info() != Eigen::Success || !solution.allFinite()) return false;
        value = solution(0);
        slope = degree > 0 ? solution(1) : 0;
        return true;
    }
    double value = 0;
    double slope = 0;

 private:
    Eigen::Matrix3d normal_ = Eigen::Matrix3d::Zero();
    Eigen::Vector3d right_ = Eigen::Vector3d::Zero();
};

/// The neighbours of one state, carried into its frame.
struct Neighbour {
    double time = 0;  ///< frames from the state, but those in which the picture stood
    cv::Point2d centre;
    double heading = 0;
    double weight = 0;
};

void collectNeighbours(const TrackPath& path, std::size_t at, int direction, const GroundMotion& ground,
                       int half_window, std::vector<Neighbour>& neighbours) {
    const FrameIndex here = path.states[at].first;
    Homography into_here;
    FrameIndex frame = here;
    int time = 0;
    for (std::size_t i = at + static_cast<std::size_t>(direction); i < path.states.size();
         i += static_cast<std::size_t>(direction)) {
        const auto& [other_frame, other] = path.states[i];
        if (std::abs(other_frame - here) > half_window) return;
        while (frame != other_frame) {
            const cv::Matx33d* step = ground.step(frame + direction, frame, false);
            if (!step) return;
            into_here.matrix = into_here.matrix * *step;
            time += direction * ground.elapsed(frame, frame + direction);
            frame += direction;
        }
        if (std::abs(time) > half_window) return;
        const double near = 1 - std::pow(std::abs(time) / (half_window + 1.0), 3);
        neighbours.push_back({1.0 * time, into_here.apply(other.box.centre),
                              into_here.turned(other.box.centre, other.box.heading),
                              weightOf(other) * near * near * near});
    }
}

std::optional<PathState> smoothed(const TrackPath& path, std::size_t at, const GroundMotion& ground, int half_window) {
    const PathState& state = path.states[at].second;
    std::vector<Neighbour> neighbours{{0, state.box.centre, state.box.heading, weightOf(state)}};
    collectNeighbours(path, at, -1, ground, half_window, neighbours);
    const std::size_t before = neighbours.size() - 1;
    collectNeighbours(path, at, +1, ground, half_window, neighbours);
    const std::size_t after = neighbours.size() - 1 - before;
    if (neighbours.size() < 4) return std::nullopt;

    LocalFit x;
    LocalFit y;
    LocalFit turn;
    double earliest = 0;
    double latest = 0;
    for (const Neighbour& n : neighbours) {
        x.add(n.time, n.centre.x, n.weight);
        y.add(n.time, n.centre.y, n.weight);
        turn.add(n.time, axisTurnBetween(state.box.heading, n.heading), n.weight);
        earliest = std::min(earliest, n.time);
        latest = std::max(latest, n.time);
    }
    // A parabola follows turns, but needs neighbours on both sides.
    const int degree = before >= 3 && after >= 3 ? 2 : 1;
    if (!x.solve(degree) || !y.solve(degree) || !turn.solve(1)) return std::nullopt;
    PathState result = state;
    result.box.centre = cv::Point2d(x.value, y.value);
    result.velocity = cv::Point2d(x.slope, y.slope);
    double heading = wrapPi(state.box.heading + turn.value);
    // A vehicle that moved on by its own length points along its path.
    const double travelled = std::hypot(x.slope, y.slope) * (latest - earliest);
    const double trust = std::clamp(travelled / state.box.length - 0.5, 0.0, 1.0);
    if (trust > 0) {
        const double tangent = std::atan2(y.slope, x.slope);
        heading = wrapPi(heading + trust * axisTurnBetween(heading, tangent));
        if (std::abs(turnBetween(heading, tangent)) > kPi / 2) heading = wrapPi(heading + kPi);
    }
    result.box.heading = static_cast<float>(heading);
    return result;
}

}  // namespace

void steadySize(TrackPath& path, const GroundMotion& ground, int half_window) {
    // Enlargement of each frame relative to the first, along the path.
    std::vector<double> enlargement{1};
    std::vector<double> weights;
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        const auto& [frame, state] = path.states[i];
        weights.push_back(weightOf(state) * (ground.cutByBorder(state.box, frame) ? 0.05 : 1));
        if (i + 1 == path.states.size()) break;
        const auto& [next_frame, next] = path.states[i + 1];
        double scale = 1;
        Homography over;
        for (FrameIndex f = frame; f < next_frame; ++f) {
            const cv::Matx33d* step = ground.step(f, f + 1, false);
            if (!step) continue;
            scale *= localScale(*step, state.box.centre);
            over.matrix = *step * over.matrix;
        }
        // What is left is its own way, over ground that may be seen at an angle.
        scale *= ground.enlargement(over.apply(state.box.centre), next.box.centre);
        enlargement.push_back(enlargement.back() * (scale > 0 && std::isfinite(scale) ? scale : 1));
    }
    std::vector<OrientedBox> steady;
    std::size_t first = 0;
    std::size_t past = 0;
    std::vector<std::pair<double, double>> lengths;
    std::vector<std::pair<double, double>> widths;
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        const auto& [frame, state] = path.states[i];
        while (path.states[first].first < frame - half_window) ++first;
        while (past < path.states.size() && path.states[past].first <= frame + half_window) ++past;
        lengths.clear();
        widths.clear();
        for (std::size_t j = first; j < past; ++j) {
            const double scale = enlargement[i] / enlargement[j];
            lengths.emplace_back(path.states[j].second.box.length * scale, weights[j]);
            widths.emplace_back(path.states[j].second.box.width * scale, weights[j]);
        }
        steady.push_back({state.box.centre, weightedMedian(lengths), weightedMedian(widths), state.box.heading});
    }
    for (std::size_t i = 0; i < path.states.size(); ++i) path.states[i].second.box = steady[i];
}

void smoothPath(TrackPath& path, const GroundMotion& ground, int half_window) {
    std::vector<TimedPathState> result;
    result.reserve(path.states.size());
    for (std::size_t i = 0; i < path.states.size(); ++i) {
        const auto state = smoothed(path, i, ground, half_window);
        result.emplace_back(path.states[i].first, state ? *state : path.states[i].second);
    }
    path.states = std::move(result);
}

}  // namespace eyrie

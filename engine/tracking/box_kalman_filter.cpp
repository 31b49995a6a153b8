#include "tracking/box_kalman_filter.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

enum Row { kX, kY, kVx, kVy, kLength, kWidth, kHeading };
constexpr double kSmallestSide = 1.0;
constexpr double kNoKnowledge = 1e3;

double squared(double value) {
    return value * value;
}

/// First-order map of directions at a point; the identity when the homography is degenerate there.
struct DirectionMap {
    cv::Point2d mapped;
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
    double scale = 1;
    bool valid = false;
};

DirectionMap directionMapAt(const Homography& map, cv::Point2d point) {
    DirectionMap local;
    local.mapped = point;
    const auto& m = map.matrix;
    const double w = m(2, 0) * point.x + m(2, 1) * point.y + m(2, 2);
    if (!(std::abs(w) > 1e-9)) return local;
    const cv::Point2d mapped = map.apply(point);
    Eigen::Matrix2d j;
    j << (m(0, 0) - mapped.x * m(2, 0)) / w, (m(0, 1) - mapped.x * m(2, 1)) / w, (m(1, 0) - mapped.y * m(2, 0)) / w,
        (m(1, 1) - mapped.y * m(2, 1)) / w;
    const double determinant = j.determinant();
    // One frame cannot mirror the ground, nor enlarge it more than a few times.
    if (!std::isfinite(mapped.x) || !std::isfinite(mapped.y) || !(determinant > 0.04) || !(determinant < 25)) {
        return local;
    }
    local.mapped = mapped;
    local.jacobian = j;
    local.scale = std::sqrt(determinant);
    local.valid = true;
    return local;
}

/// Covariance of a centre whose deviations are given along and across a heading.
Eigen::Matrix2d turnedCovariance(double along, double across, double heading) {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    Eigen::Matrix2d turn;
    turn << c, -s, s, c;
    return turn * Eigen::Vector2d(squared(along), squared(across)).asDiagonal() * turn.transpose();
}

/// Adds covariances of the centre with the size, given along and across a heading, to a full covariance.
void addCentreWithSize(BoxKalmanFilter::Covariance& full, double heading, double along, double across) {
    const double c = std::cos(heading);
    const double s = std::sin(heading);
    const auto add = [&](int row, int column, double value) {
        full(row, column) += value;
        full(column, row) += value;
    };
    add(kX, kLength, along * c);
    add(kY, kLength, along * s);
    add(kX, kWidth, -across * s);
    add(kY, kWidth, across * c);
}

double known(double deviation, double otherwise) {
    return std::isfinite(deviation) ? deviation : otherwise;
}

}  // namespace

void BoxMeasurement::setEnds(double front, double rear, double left, double right) {
    along = std::hypot(front, rear) / 2;
    across = std::hypot(left, right) / 2;
    length = std::hypot(front, rear);
    width = std::hypot(left, right);
    along_with_length = (squared(front) - squared(rear)) / 2;
    across_with_width = (squared(right) - squared(left)) / 2;
}

BoxKalmanFilter::BoxKalmanFilter(const BoxMeasurement& first) {
    const OrientedBox& box = first.box;
    state_ << box.centre.x, box.centre.y, first.velocity.x, first.velocity.y, box.length, box.width,
        wrapPi(box.heading);
    covariance_.setZero();
    covariance_.topLeftCorner<2, 2>() =
        turnedCovariance(known(first.along, kNoKnowledge), known(first.across, kNoKnowledge), box.heading);
    const double side = std::max(box.length, box.width);
    covariance_(kVx, kVx) = covariance_(kVy, kVy) = squared(known(first.speed, std::max(1.0, side / 4)));
    covariance_(kLength, kLength) = squared(known(first.length, box.length / 2 + 1));
    covariance_(kWidth, kWidth) = squared(known(first.width, box.width / 2 + 1));
    covariance_(kHeading, kHeading) = squared(known(first.heading, kPi / 4));
    keepSane();
}

bool BoxKalmanFilter::predict(const Homography& current_from_previous, const BoxProcessNoise& noise) {
    state_(kX) += state_(kVx);
    state_(kY) += state_(kVy);
    const DirectionMap local = directionMapAt(current_from_previous, {state_(kX), state_(kY)});
    const Eigen::Matrix2d& j = local.jacobian;

    const Eigen::Vector2d direction(std::cos(state_(kHeading)), std::sin(state_(kHeading)));
    const Eigen::Vector2d turned = j * direction;
    const double turn_gain = j.determinant() / turned.squaredNorm();

    Covariance transition = Covariance::Zero();
    transition.block<2, 2>(kX, kX) = j;
    transition.block<2, 2>(kX, kVx) = j;
    transition.block<2, 2>(kVx, kVx) = j;
    transition(kLength, kLength) = transition(kWidth, kWidth) = local.scale;
    transition(kHeading, kHeading) = turn_gain;

    state_(kX) = local.mapped.x;
    state_(kY) = local.mapped.y;
    state_.segment<2>(kVx) = (j * state_.segment<2>(kVx)).eval();
    state_(kLength) *= local.scale;
    state_(kWidth) *= local.scale;
    state_(kHeading) = std::atan2(turned.y(), turned.x());

    covariance_ = (transition * covariance_ * transition.transpose()).eval();
    const double q = squared(noise.acceleration);
    for (int axis = 0; axis < 2; ++axis) {
        covariance_(kX + axis, kX + axis) += q / 4 + squared(noise.position);
        covariance_(kX + axis, kVx + axis) += q / 2;
        covariance_(kVx + axis, kX + axis) += q / 2;
        covariance_(kVx + axis, kVx + axis) += q;
    }
    covariance_(kLength, kLength) += squared(noise.size);
    covariance_(kWidth, kWidth) += squared(noise.size);
    covariance_(kHeading, kHeading) += squared(noise.heading);
    keepSane();
    return local.valid;
}

bool BoxKalmanFilter::update(const BoxMeasurement& m) {
    State innovation;
    innovation << m.box.centre.x - state_(kX), m.box.centre.y - state_(kY), m.velocity.x - state_(kVx),
        m.velocity.y - state_(kVy), m.box.length - state_(kLength), m.box.width - state_(kWidth),
        axisTurnBetween(state_(kHeading), m.box.heading);

    Covariance noise = Covariance::Zero();
    noise.topLeftCorner<2, 2>() =
        turnedCovariance(known(m.along, kNoKnowledge), known(m.across, kNoKnowledge), m.box.heading);
    noise(kVx, kVx) = noise(kVy, kVy) = squared(m.speed);
    noise(kLength, kLength) = squared(m.length);
    noise(kWidth, kWidth) = squared(m.width);
    noise(kHeading, kHeading) = squared(m.heading);
    addCentreWithSize(noise, m.box.heading, m.along_with_length, m.across_with_width);

    // The measured quantities are entries of the state: the measurement matrix picks rows.
    std::array<int, kSize> rows{};
    int count = 0;
    for (int row = 0; row < kSize; ++row) {
        if (std::isfinite(noise(row, row))) rows[static_cast<std::size_t>(count++)] = row;
    }
    using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kSize, kSize>;
    using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kSize, 1>;
    Small measured_noise(count, count);
    Small cross(kSize, count);
    Small innovation_covariance(count, count);
    Small picks = Small::Zero(count, kSize);
    SmallVector measured(count);
    for (int a = 0; a < count; ++a) {
        const int row = rows[static_cast<std::size_t>(a)];
        measured(a) = innovation(row);
        cross.col(a) = covariance_.col(row);
        picks(a, row) = 1;
        for (int b = 0; b < count; ++b) {
            const int column = rows[static_cast<std::size_t>(b)];
            measured_noise(a, b) = noise(row, column);
            innovation_covariance(a, b) = covariance_(row, column) + noise(row, column);
        }
    }
    if (count == 0 || !measured.allFinite() || !measured_noise.allFinite()) return false;

    const Eigen::LDLT<Small> solver(innovation_covariance);
    const Small gain = solver.solve(cross.transpose()).transpose();
    const State corrected = state_ + gain * measured;
    // Joseph form: stays symmetric and positive for any gain.
    const Covariance keep = Covariance::Identity() - gain * picks;
    const Covariance shrunk = keep * covariance_ * keep.transpose() + gain * measured_noise * gain.transpose();
    if (!corrected.allFinite() || !shrunk.allFinite()) return false;
    state_ = corrected;
    covariance_ = shrunk;
    keepSane();
    return true;
}

void BoxKalmanFilter::pointForward(double slow_speed) {
    if (!(speed() >= slow_speed) || speed() <= 0) return;
    const double along = state_(kVx) * std::cos(state_(kHeading)) + state_(kVy) * std::sin(state_(kHeading));
    if (along < 0) state_(kHeading) = wrapPi(state_(kHeading) + kPi);
}

void BoxKalmanFilter::slowDown(double factor) {
    Covariance scale = Covariance::Identity();
    scale(kVx, kVx) = scale(kVy, kVy) = factor;
    state_.segment<2>(kVx) *= factor;
    covariance_ = (scale * covariance_ * scale).eval();
    keepSane();
}

void BoxKalmanFilter::forgetSize(double deviation) {
    covariance_(kLength, kLength) = std::max(covariance_(kLength, kLength), squared(deviation));
    covariance_(kWidth, kWidth) = std::max(covariance_(kWidth, kWidth), squared(deviation));
}

void BoxKalmanFilter::loosenEnds(double front, double rear, double left, double right) {
    BoxMeasurement ends;
    ends.setEnds(front, rear, left, right);
    covariance_.topLeftCorner<2, 2>() += turnedCovariance(ends.along, ends.across, state_(kHeading));
    covariance_(kLength, kLength) += squared(ends.length);
    covariance_(kWidth, kWidth) += squared(ends.width);
    addCentreWithSize(covariance_, state_(kHeading), ends.along_with_length, ends.across_with_width);
}

void BoxKalmanFilter::smear(cv::Point2d displacement) {
    const Eigen::Vector2d d(displacement.x, displacement.y);
    covariance_.topLeftCorner<2, 2>() += d * d.transpose();
}

OrientedBox BoxKalmanFilter::box() const {
    return {{state_(kX), state_(kY)}, state_(kLength), state_(kWidth), state_(kHeading)};
}

double BoxKalmanFilter::speed() const {
    return std::hypot(state_(kVx), state_(kVy));
}

double BoxKalmanFilter::positionDeviation(cv::Point2d direction) const {
    const Eigen::Vector2d d(direction.x, direction.y);
    return std::sqrt(std::max(0.0, d.dot(covariance_.topLeftCorner<2, 2>() * d)));
}

void BoxKalmanFilter::keepSane() {
    state_(kLength) = std::max(state_(kLength), kSmallestSide);
    state_(kWidth) = std::max(state_(kWidth), kSmallestSide);
    state_(kHeading) = wrapPi(state_(kHeading));
    covariance_ = (0.5 * (covariance_ + covariance_.transpose())).eval();
    // Rounding may eat a variance that was measured almost exactly.
    for (int row = 0; row < kSize; ++row) covariance_(row, row) = std::max(covariance_(row, row), 1e-12);
}

}  // namespace eyrie

#include "motion/vectors/parallax_test.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdint>

namespace eyrie {
namespace {

constexpr double kStrong = 3;        ///< deviations from which a residual tells a direction
constexpr double kOffTheLine = 2.5;  ///< deviations off the epipolar line
constexpr std::size_t kFewest = 30;  ///< strong residuals, of each side too
constexpr std::size_t kMost = 600;   ///< strong residuals that vote
constexpr int kTrials = 150;
constexpr double kUsual = 0.9;  ///< quantile of the parallax that is seen

/// A small generator of its own, so that every run draws the same pairs.
class Draw {
 public:
    std::size_t below(std::size_t count) {
        state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
        return static_cast<std::size_t>((state_ >> 33) % count);
    }

 private:
    std::uint64_t state_ = 0x9e3779b97f4a7c15ULL;
};

cv::Point2d towardsEpipole(const cv::Vec3d& epipole, cv::Point2d position) {
    return {epipole[0] - epipole[2] * position.x, epipole[1] - epipole[2] * position.y};
}

/// The line through a residual, homogeneous.
cv::Vec3d lineOf(cv::Point2d p, cv::Point2d v) {
    return {-v.y, v.x, v.y * p.x - v.x * p.y};
}

}  // namespace

void ParallaxTestOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::motion);
    declare.flag(
        "motion.parallax_test", parallax_test,
        {"",
         "Corners that move along epipolar lines, no faster than roofs and trees of this scene seem to, do not "
         "count as moving.",
         ""});
    declare.real(
        "motion.parallax_factor", parallax_factor, 0.5, 20,
        {"",
         "Up to this many times the scene's usual parallax a corner may be a standing one. Larger: fewer false "
         "alarms on high buildings, slow vehicles along the flight are lost.",
         ""});
    declare.real("motion.parallax_agreement", parallax_agreement, 0.3, 1,
                 {"", "Share of the background's residuals that must agree on an epipole.", ""});
}

void ParallaxTest::clear() {
    residuals_.clear();
    epipole_ = {0, 0, 0};
    limits_ = {};
}

void ParallaxTest::add(cv::Point2d position, cv::Point2d velocity) {
    residuals_.push_back({position, velocity});
}

bool ParallaxTest::onLine(const cv::Vec3d& epipole, const Residual& residual) const {
    // As direction(…).cross(velocity) would tell, without a root for each of so many.
    const cv::Point2d towards = towardsEpipole(epipole, residual.position);
    const double off = towards.cross(residual.velocity);
    return off * off <= across_ * across_ * towards.dot(towards);
}

cv::Point2d ParallaxTest::direction(const cv::Vec3d& epipole, cv::Point2d position) {
    const cv::Point2d towards = towardsEpipole(epipole, position);
    const double length = std::hypot(towards.x, towards.y);
    return length > 1e-12 ? towards / length : cv::Point2d(0, 0);
}

double ParallaxTest::supportOf(const cv::Vec3d& epipole, const std::vector<Residual>& strong) const {
    double support = 0;
    for (const Residual& residual : strong) {
        if (onLine(epipole, residual)) support += 1;
    }
    return support;
}

cv::Vec3d ParallaxTest::refined(const cv::Vec3d& epipole, const std::vector<Residual>& strong) const {
    // Positions are scaled to about one, so that the epipole's components weigh alike.
    constexpr double kUnit = 500;
    Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
    for (const Residual& residual : strong) {
        if (!onLine(epipole, residual)) continue;
        const cv::Vec3d line = lineOf(residual.position / kUnit, residual.velocity);
        const Eigen::Vector3d row(line[0], line[1], line[2]);
        normal += row * row.transpose();
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(normal);
    const Eigen::Vector3d e = solver.eigenvectors().col(0);
    return {e(0) * kUnit, e(1) * kUnit, e(2)};
}

void ParallaxTest::finish(double sigma) {
    across_ = kOffTheLine * sigma;
    std::vector<Residual> strong;
    const double least = kStrong * sigma;
    for (const Residual& residual : residuals_) {
        if (residual.velocity.dot(residual.velocity) > least * least) strong.push_back(residual);
    }
    if (strong.size() < kFewest) return;
    if (strong.size() > kMost) {
        const std::size_t step = (strong.size() + kMost - 1) / kMost;
        std::size_t kept = 0;
        for (std::size_t i = 0; i < strong.size(); i += step) strong[kept++] = strong[i];
        strong.resize(kept);
    }
    Draw draw;
    cv::Vec3d best{0, 0, 0};
    double best_support = 0;
    for (int trial = 0; trial < kTrials; ++trial) {
        const Residual& a = strong[draw.below(strong.size())];
        const Residual& b = strong[draw.below(strong.size())];
        const cv::Vec3d crossing = lineOf(a.position, a.velocity).cross(lineOf(b.position, b.velocity));
        const double size = cv::norm(crossing);
        if (!(size > 1e-12)) continue;
        const double support = supportOf(crossing / size, strong);
        if (support > best_support) {
            best_support = support;
            best = crossing / size;
        }
    }
    if (best_support < static_cast<double>(kFewest)) return;
    const cv::Vec3d better = refined(best, strong);
    const double better_support = supportOf(better, strong);
    if (better_support >= best_support) {
        best = better;
        best_support = better_support;
    }
    if (best_support < options_.parallax_agreement * static_cast<double>(strong.size())) return;
    epipole_ = best;

    std::array<std::vector<double>, 2> sides;
    for (const Residual& residual : residuals_) {
        const cv::Point2d along = direction(epipole_, residual.position);
        if (std::abs(along.cross(residual.velocity)) > across_) continue;
        const double projection = along.dot(residual.velocity);
        if (std::abs(projection) > kStrong * sigma) sides[projection > 0 ? 0 : 1].push_back(std::abs(projection));
    }
    for (std::size_t side = 0; side < sides.size(); ++side) {
        if (sides[side].size() < kFewest) continue;
        const auto usual =
            sides[side].begin() + static_cast<std::ptrdiff_t>(kUsual * static_cast<double>(sides[side].size() - 1));
        std::nth_element(sides[side].begin(), usual, sides[side].end());
        limits_[side] = options_.parallax_factor * *usual;
    }
}

bool ParallaxTest::explains(cv::Point2d position, cv::Point2d velocity) const {
    if (!active()) return false;
    const cv::Point2d along = direction(epipole_, position);
    if (std::abs(along.cross(velocity)) > across_) return false;
    const double projection = along.dot(velocity);
    return std::abs(projection) <= limits_[projection > 0 ? 0 : 1];
}

}  // namespace eyrie

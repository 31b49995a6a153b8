#include "chain/scale_slope_fit.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

constexpr std::size_t kFewestVotes = 12;
constexpr int kRounds = 30;
constexpr double kLeastScatter = 0.12;  ///< of the logarithm: cars differ by as much
constexpr double kOutlier = 1.5;        ///< scatters from which a vote counts less
constexpr double kRepeated = 2;         ///< votes are of the same vehicles in several frames
constexpr double kLevel = 0.12;         ///< usual growth from the middle to the side of the picture …
constexpr double kTilted = 0.6;         ///< … and to its upper or lower edge
constexpr double kSureSlope = 3.5;      ///< standard errors
constexpr double kWorthwhile = 0.12;    ///< growth from the middle of the picture to its edge

double middleValue(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

}  // namespace

std::optional<ScaleSlope> fitSlope(const std::vector<ScaleVote>& votes, cv::Size image) {
    if (votes.size() < kFewestVotes) return std::nullopt;
    const cv::Point2d half(image.width / 2.0, image.height / 2.0);
    ScaleSlope slope;
    slope.centre_x = half.x - 0.5;
    slope.centre_y = half.y - 0.5;
    // Unknown: the logarithm of pixels per metre at the centre, and the growth from there to the right and lower edge.
    const double usual = middleValue([&] {
        std::vector<double> logs;
        for (const ScaleVote& vote : votes) logs.push_back(-std::log(vote.gsd_m_per_px));
        return logs;
    }());
    Eigen::Vector3d found(usual, 0, 0);
    Eigen::Matrix3d information;
    double scatter = kLeastScatter;
    for (int round = 0; round < kRounds; ++round) {
        ScaleSlope present = slope;
        present.right_per_px = found[1] / half.x;
        present.down_per_px = found[2] / half.y;
        std::vector<double> residuals;
        for (const ScaleVote& vote : votes)
            residuals.push_back(-std::log(vote.gsd_m_per_px) - found[0] - std::log(present.factorAt(vote.place)));
        std::vector<double> sizes;
        for (const double residual : residuals) sizes.push_back(std::abs(residual));
        scatter = std::max(kLeastScatter, 1.4826 * middleValue(sizes));
        information = Eigen::Vector3d(0, 1 / (kLevel * kLevel), 1 / (kTilted * kTilted)).asDiagonal();
        Eigen::Vector3d pull(0, -found[1] / (kLevel * kLevel), -found[2] / (kTilted * kTilted));
        const double weight_of_one = 1 / (kRepeated * scatter * scatter);
        for (std::size_t i = 0; i < votes.size(); ++i) {
            const double off = residuals[i] / (kOutlier * scatter);
            const double weight = weight_of_one / (1 + off * off);
            const double factor = present.factorAt(votes[i].place);
            const Eigen::Vector3d gradient(1, (votes[i].place.x - slope.centre_x) / half.x / factor,
                                           (votes[i].place.y - slope.centre_y) / half.y / factor);
            information += weight * gradient * gradient.transpose();
            pull += weight * residuals[i] * gradient;
        }
        const Eigen::Vector3d step = information.ldlt().solve(pull);
        found += step;
        found[1] = std::clamp(found[1], -0.5, 0.5);
        found[2] = std::clamp(found[2], -0.95, 0.95);
        if (step.norm() < 1e-6) break;
    }
    const Eigen::Matrix2d deviation = information.inverse().bottomRightCorner<2, 2>();
    const Eigen::Vector2d growth = found.tail<2>();
    if (!growth.allFinite() || growth.dot(deviation.inverse() * growth) < kSureSlope * kSureSlope) return std::nullopt;
    if (std::max(std::abs(growth[0]), std::abs(growth[1])) < kWorthwhile) return std::nullopt;
    slope.right_per_px = growth[0] / half.x;
    slope.down_per_px = growth[1] / half.y;
    return slope;
}

}  // namespace eyrie

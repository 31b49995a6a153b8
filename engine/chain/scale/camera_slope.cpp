#include "chain/scale/camera_slope.h"

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>

namespace eyrie {
namespace {

constexpr double kFirstGrowth = -0.9;  ///< upside down
constexpr int kFineGrowths = 37;       ///< up to 0.9 …
constexpr double kFineStep = 0.05;
constexpr double kGrowthShare = 1.15;  ///< … and from there each so much more than the last, up to 4
constexpr int kGrowths = 48;
constexpr std::array kAfter{8, 16, 24, 33};           ///< steps after which the way so far is looked at
constexpr std::array kFocalLengths{0.73, 0.97, 1.3};  ///< in widths of the picture
constexpr double kFocalSpread = 0.25;                 ///< of the logarithm about the middle one
constexpr double kTurnSpread = 0.0015;                ///< radians a step, of turns about the axes of the picture
constexpr double kOff = 0.15;                         ///< px by which registrations are off after one step
constexpr int kPlacesAside = 5;                       ///< of a grid of places over the picture …
constexpr double kGridShare = 0.8;                    ///< … that covers so much of each side
constexpr double kIndependentPlaces = 4;              ///< a map has no more to say than so many
constexpr double kNearHorizon = 0.2;                  ///< scale against the middle up to which no ground is seen
constexpr int kRounds = 5;
constexpr double kNoPlane = 2.5;       ///< cost of the best growth from which on it is no plane
constexpr double kGrowthError = 0.06;  ///< relief, and the tilt of a camera that moves
constexpr double kMostOfStretch = 10;  ///< cost; what a stretch says may be wrong

using Vector6 = Eigen::Matrix<double, 6, 1>;

double growthAt(int i) {
    if (i < kFineGrowths) return kFirstGrowth + i * kFineStep;
    return (kFirstGrowth + (kFineGrowths - 1) * kFineStep) * std::pow(kGrowthShare, i - kFineGrowths + 1);
}

/// Where places go, in halves of the picture's height from its middle; and after how many steps.
struct Seen {
    std::vector<Eigen::Vector2d> from, to;
    int steps = 0;
};

Seen seenThrough(const cv::Matx33d& map, cv::Size image, int steps) {
    const double half = image.height / 2.0;
    const cv::Point2d middle((image.width - 1) / 2.0, (image.height - 1) / 2.0);
    Seen seen;
    seen.steps = steps;
    for (int row = 0; row < kPlacesAside; ++row) {
        for (int column = 0; column < kPlacesAside; ++column) {
            const auto off = [](int i, int size) { return (i / (kPlacesAside - 1.0) - 0.5) * kGridShare * size; };
            const cv::Point2d place(off(column, image.width), off(row, image.height));
            const cv::Vec3d there = map * cv::Vec3d(place.x + middle.x, place.y + middle.y, 1);
            seen.from.emplace_back(place.x / half, place.y / half);
            seen.to.emplace_back((there[0] / there[2] - middle.x) / half, (there[1] / there[2] - middle.y) / half);
        }
    }
    return seen;
}

/// A camera over a plane of a growth; lengths in halves of the picture's height.
class PlaneCamera {
 public:
    PlaneCamera(double growth, double focal_length, double pixel)
        : growth_(growth), focal_length_(focal_length), pixel_(pixel) {}

    /// How badly the best turn and way explain what is seen; as the negative logarithm of the likelihood.
    double costOf(const Seen& seen) const {
        Vector6 motion = Vector6::Zero();  // turn, way
        double cost = 0;
        for (int round = 0; round <= kRounds; ++round) {
            const Eigen::VectorXd off = residuals(seen, motion);
            cost = off.squaredNorm() / 2;
            if (round == kRounds || !std::isfinite(cost)) break;
            Eigen::MatrixXd change(off.size(), 6);
            constexpr double kLittle = 1e-6;
            for (int i = 0; i < 6; ++i) {
                Vector6 moved = motion;
                moved[i] += kLittle;
                change.col(i) = (residuals(seen, moved) - off) / kLittle;
            }
            motion -= (change.transpose() * change + 1e-9 * Eigen::Matrix<double, 6, 6>::Identity())
                          .ldlt()
                          .solve(change.transpose() * off);
        }
        return cost;
    }

 private:
    /// Of every place on the ground, in deviations, and of the turns about the axes of the picture.
    Eigen::VectorXd residuals(const Seen& seen, const Vector6& motion) const {
        const Eigen::Vector3d turn = motion.head<3>();
        const double angle = turn.norm();
        const Eigen::Vector3d axis = angle > 0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX();
        const Eigen::Matrix3d map = Eigen::AngleAxisd(angle, axis).toRotationMatrix() +
                                    motion.tail<3>() * Eigen::RowVector3d(0, growth_ * focal_length_, 1);
        const auto steps = static_cast<double>(seen.steps);
        std::vector<double> off;
        for (std::size_t i = 0; i < seen.from.size(); ++i) {
            if (1 + growth_ * seen.from[i].y() < kNearHorizon) continue;
            const Eigen::Vector3d there =
                map * Eigen::Vector3d(seen.from[i].x() / focal_length_, seen.from[i].y() / focal_length_, 1);
            off.push_back(focal_length_ * there.x() / there.z() - seen.to[i].x());
            off.push_back(focal_length_ * there.y() / there.z() - seen.to[i].y());
        }
        // The lower half of the grid is never beyond the horizon, so there is always something to weigh.
        const double weight =
            std::sqrt(2 * kIndependentPlaces / static_cast<double>(off.size())) / (kOff * pixel_ * std::sqrt(steps));
        Eigen::VectorXd all(static_cast<Eigen::Index>(off.size()) + 2);
        for (std::size_t i = 0; i < off.size(); ++i) all[static_cast<Eigen::Index>(i)] = weight * off[i];
        all.tail<2>() = turn.head<2>() / (kTurnSpread * steps);
        return all;
    }

    double growth_;
    double focal_length_;
    double pixel_;
};

}  // namespace

void CameraWay::add(const Registration& registration) {
    if (registration.state == RegistrationState::first) return;
    ended_ = ended_ || !registration.reliable();
    if (!ended_) steps_.push_back(registration.current_from_previous.matrix);
}

CameraSlope::CameraSlope(cv::Size image) : image_(image), costs_(kGrowths, 0) {}

void CameraSlope::add(const std::vector<cv::Matx33d>& steps) {
    std::vector<Seen> all;
    cv::Matx33d way = cv::Matx33d::eye();
    for (std::size_t i = 0; i < steps.size(); ++i) {
        way = steps[i] * way;
        const int done = static_cast<int>(i) + 1;
        if (std::find(kAfter.begin(), kAfter.end(), done) != kAfter.end())
            all.push_back(seenThrough(way, image_, done));
    }
    if (all.empty()) return;
    std::vector<double> costs;
    for (int i = 0; i < kGrowths; ++i) {
        double best = 1e300;
        for (const double width : kFocalLengths) {
            const double half = image_.height / 2.0;
            const PlaneCamera camera(growthAt(i), width * image_.width / half, 1 / half);
            const double unusual = std::log(width / kFocalLengths[1]) / kFocalSpread;
            double cost = unusual * unusual / 2;
            for (const Seen& seen : all) cost += camera.costOf(seen) / static_cast<double>(all.size());
            if (cost < best) best = cost;
        }
        costs.push_back(best);
    }
    const double least = *std::min_element(costs.begin(), costs.end());
    if (!(least < kNoPlane)) return;
    for (int i = 0; i < kGrowths; ++i) {
        double nearby = kMostOfStretch;
        for (int j = 0; j < kGrowths; ++j) {
            const double off = (growthAt(i) - growthAt(j)) / (kGrowthError * std::max(1.0, growthAt(i)));
            nearby = std::min(nearby, costs[static_cast<std::size_t>(j)] - least + off * off / 2);
        }
        costs_[static_cast<std::size_t>(i)] += nearby;
    }
}

double CameraSlope::cost(double growth) const {
    int after = 1;
    while (after < kGrowths - 1 && growthAt(after) < growth) ++after;
    const double share = std::clamp((growth - growthAt(after - 1)) / (growthAt(after) - growthAt(after - 1)), 0.0, 1.0);
    const auto at = static_cast<std::size_t>(after);
    return costs_[at - 1] + share * (costs_[at] - costs_[at - 1]);
}

}  // namespace eyrie

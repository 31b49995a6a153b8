#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numeric>
#include <opencv2/calib3d.hpp>
#include <opencv2/core.hpp>

#include "chain/scale/camera_slope.h"

/// What the way of the camera says of the slope, against a slow way that follows the words of the description: for each
/// growth the turn and the way over the ground are sought that explain best where places of the picture went.
namespace eyrie::slow_camera_slope_test {
namespace {

const cv::Size kImage{640, 480};

/// Where a place of the picture went, both from its middle on in halves of its height.
struct Seen {
    cv::Point2d from, to;
};

/// Five by five places over four fifths of each side.
std::vector<Seen> placesThrough(const cv::Matx33d& map) {
    std::vector<Seen> seen;
    for (int row = -2; row <= 2; ++row) {
        for (int column = -2; column <= 2; ++column) {
            const cv::Point2d from(column * 0.2 * kImage.width, row * 0.2 * kImage.height);
            const cv::Vec3d to = map * cv::Vec3d(from.x + 319.5, from.y + 239.5, 1);
            seen.push_back({from / 240, (cv::Point2d(to[0], to[1]) / to[2] - cv::Point2d(319.5, 239.5)) / 240});
        }
    }
    return seen;
}

/// How far a camera that turns so and goes this way over a plane that grows so would be off, in deviations.
std::vector<double> offBy(const std::vector<Seen>& seen, int steps, double growth, double focal_length,
                          const std::array<double, 6>& motion) {
    cv::Matx33d turn;
    cv::Rodrigues(cv::Vec3d(motion[0], motion[1], motion[2]), turn);
    std::vector<double> off;
    for (const Seen& place : seen) {
        // The scale there against the middle; near the horizon no ground is seen.
        const double nearness = 1 + growth * place.from.y;
        if (nearness < 0.2) continue;
        const cv::Vec3d ray(place.from.x / focal_length, place.from.y / focal_length, 1);
        const cv::Vec3d there = turn * ray + nearness * cv::Vec3d(motion[3], motion[4], motion[5]);
        off.push_back(focal_length * there[0] / there[2] - place.to.x);
        off.push_back(focal_length * there[1] / there[2] - place.to.y);
    }
    // .15 px a step, which adds up as chance does; all places together have no more to say than four.
    const double deviation = 0.15 / 240 * std::sqrt(steps);
    const double share = std::sqrt(8 / std::max(1.0, static_cast<double>(off.size())));
    for (double& value : off) value *= share / deviation;
    // A turn about an axis of the picture is unusual from .0015 a step on.
    off.push_back(motion[0] / (0.0015 * steps));
    off.push_back(motion[1] / (0.0015 * steps));
    return off;
}

double leastCost(const std::vector<Seen>& seen, int steps, double growth, double focal_length) {
    std::array<double, 6> motion{};
    double cost = 0;
    for (int time = 0; time < 7; ++time) {
        const std::vector<double> off = offBy(seen, steps, growth, focal_length, motion);
        std::array<std::vector<double>, 6> slopes;
        for (std::size_t i = 0; i < 6; ++i) {
            std::array<double, 6> more = motion, less = motion;
            more[i] += 1e-5;
            less[i] -= 1e-5;
            slopes[i] = offBy(seen, steps, growth, focal_length, more);
            const std::vector<double> below = offBy(seen, steps, growth, focal_length, less);
            for (std::size_t k = 0; k < below.size(); ++k) slopes[i][k] = (slopes[i][k] - below[k]) / 2e-5;
        }
        const auto product = [](const std::vector<double>& u, const std::vector<double>& v) {
            return std::inner_product(u.begin(), u.end(), v.begin(), 0.0);
        };
        cost = product(off, off) / 2;
        cv::Matx66d squares;
        cv::Matx61d against;
        for (int i = 0; i < 6; ++i) {
            against(i) = product(slopes[static_cast<std::size_t>(i)], off);
            for (int k = 0; k < 6; ++k)
                squares(i, k) = product(slopes[static_cast<std::size_t>(i)], slopes[static_cast<std::size_t>(k)]);
        }
        const cv::Matx61d change = squares.solve(against, cv::DECOMP_CHOLESKY);
        for (int i = 0; i < 6; ++i) motion[static_cast<std::size_t>(i)] -= change(i);
    }
    return cost;
}

/// Growths that are compared: from upside down in steps of a twentieth, then by shares up to a little over 4.
std::vector<double> growths() {
    std::vector<double> all;
    for (int i = -18; i <= 18; ++i) all.push_back(i / 20.0);
    while (all.size() < 48) all.push_back(all.back() * 1.15);
    return all;
}

/// What each of the growths costs after one stretch; all 0 where none fits.
std::vector<double> slowCosts(const std::vector<cv::Matx33d>& steps) {
    std::vector<double> costs;
    for (const double growth : growths()) {
        double best = 1e9;
        for (const double width : {0.73, 0.97, 1.3}) {
            double sum = 0;
            int looks = 0;
            cv::Matx33d way = cv::Matx33d::eye();
            for (int done = 1; done <= static_cast<int>(steps.size()); ++done) {
                way = steps[static_cast<std::size_t>(done - 1)] * way;
                if (done != 8 && done != 16 && done != 24 && done != 33) continue;
                sum += leastCost(placesThrough(way), done, growth, width * kImage.width / 240);
                ++looks;
            }
            const double unusual = std::log(width / 0.97) / 0.25;
            best = std::min(best, sum / looks + unusual * unusual / 2);
        }
        costs.push_back(best);
    }
    const double least = *std::min_element(costs.begin(), costs.end());
    if (least >= 2.5) return std::vector<double>(costs.size(), 0);
    // Relief and a camera that tilts make each growth look like its neighbours.
    std::vector<double> told;
    for (const double growth : growths()) {
        double cost = 10;
        for (std::size_t i = 0; i < costs.size(); ++i) {
            const double apart = (growths()[i] - growth) / (0.06 * std::max(1.0, growth));
            cost = std::min(cost, costs[i] - least + apart * apart / 2);
        }
        told.push_back(cost);
    }
    return told;
}

/// A camera over a plane; registrations are off by a little, each by chance.
std::vector<cv::Matx33d> flight(cv::RNG& dice, double growth, int steps, double off_px) {
    const double focal_length = kImage.width * dice.uniform(0.75, 1.25);
    const cv::Matx33d camera(focal_length, 0, 319.5, 0, focal_length, 239.5, 0, 0, 1);
    const cv::Vec3d way(dice.uniform(-0.003, 0.003), dice.uniform(-0.003, 0.003), dice.uniform(-0.002, 0.002));
    const cv::Vec3d turn(dice.uniform(-0.0006, 0.0006), dice.uniform(-0.0006, 0.0006), dice.uniform(-0.003, 0.003));
    cv::Matx33d turned;
    cv::Rodrigues(turn, turned);
    const cv::Matx13d ground(0, growth * focal_length / 240, 1);
    std::vector<cv::Matx33d> all;
    for (int i = 0; i < steps; ++i) {
        cv::Matx33d step = camera * (turned + cv::Matx31d(way.val) * ground) * camera.inv();
        step *= 1 / step(2, 2);
        step(0, 2) += dice.gaussian(off_px);
        step(1, 2) += dice.gaussian(off_px);
        step(0, 0) += dice.gaussian(off_px / 300);
        step(1, 1) += dice.gaussian(off_px / 300);
        all.push_back(step);
    }
    return all;
}

}  // namespace

TEST(SlowCameraSlope, FlightsSayOfEachGrowthWhatTheDescriptionSays) {
    int told = 0, nothing = 0;
    for (const std::uint64_t seed : {1, 2, 5, 6}) {
        SCOPED_TRACE(seed);
        cv::RNG dice(seed);
        // The fifth sees the horizon close above the middle.
        const double growth = seed == 5 ? 4.7 : dice.uniform(-0.6, 1.5);
        const std::vector<cv::Matx33d> steps = flight(dice, growth, seed % 2 == 0 ? 33 : 20, seed == 6 ? 3 : 0.1);
        CameraSlope slope(kImage);
        slope.add(steps);
        const std::vector<double> slow = slowCosts(steps);
        for (std::size_t i = 0; i < slow.size(); ++i)
            EXPECT_NEAR(slope.cost(growths()[i]), slow[i], 0.001 + 0.001 * slow[i]) << growths()[i];
        // Between two of them in proportion.
        const double between = growths()[40] * 0.25 + growths()[41] * 0.75;
        EXPECT_NEAR(slope.cost(between), slope.cost(growths()[40]) * 0.25 + slope.cost(growths()[41]) * 0.75, 1e-9);
        EXPECT_EQ(slope.cost(-3), slope.cost(-0.9));
        for (const double beyond : {4.3, 5.0, 9.0}) EXPECT_EQ(slope.cost(beyond), slope.cost(growths().back()));
        (*std::max_element(slow.begin(), slow.end()) > 0 ? told : nothing)++;
    }
    EXPECT_GE(told, 2);
    EXPECT_GE(nothing, 1);
}

}  // namespace eyrie::slow_camera_slope_test

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "events/ground/flow_field.h"

/// The flow field held to a slow one, which keeps every place of every track by itself.
namespace eyrie::slow_flow_test {
namespace {

constexpr double kRadius_m = 2;
constexpr double kCell_m = kRadius_m / 2;
using Cell = std::pair<int, int>;

Cell cellAt(cv::Point2d at) {
    return {static_cast<int>(std::floor(at.x / kCell_m)), static_cast<int>(std::floor(at.y / kCell_m))};
}

/// The direction in which a path passes each cell.
std::map<Cell, double> directionsOf(const GroundPath& path) {
    std::map<Cell, cv::Point2d> sums;
    const auto pass = [&](cv::Point2d at, cv::Point2d direction) {
        const Cell here = cellAt(at);
        for (int x = here.first - 3; x <= here.first + 3; ++x)
            for (int y = here.second - 3; y <= here.second + 3; ++y)
                if (std::hypot((x + 0.5) * kCell_m - at.x, (y + 0.5) * kCell_m - at.y) <= kRadius_m)
                    sums[{x, y}] += direction;
    };
    const GroundSample* before = nullptr;
    for (const GroundSample& sample : path.samples) {
        if (!sample.moving) {
            before = nullptr;
            continue;
        }
        const cv::Point2d direction = sample.velocity * (1 / sample.speed);
        const cv::Point2d way = before != nullptr ? sample.at - before->at : cv::Point2d(0, 0);
        const double far = std::hypot(way.x, way.y);
        if (before != nullptr && far < kCell_m) continue;
        const int parts = std::max(1, static_cast<int>(far / kCell_m));
        for (int part = 1; part <= parts; ++part)
            pass(before != nullptr ? before->at + way * (double{1} * part / parts) : sample.at, direction);
        before = &sample;
    }
    std::map<Cell, double> directions;
    for (const auto& [cell, sum] : sums) directions[cell] = std::atan2(sum.y, sum.x);
    return directions;
}

/// The middle of the 15 degrees in which a direction lies, radians.
double told(double direction) {
    const double step = 2 * kPi / 24;
    return (std::floor(direction / step) + 0.5) * step;
}

/// A track that wanders about the origin, now and then standing.
GroundPath wandering(std::mt19937& random) {
    const auto share = [&random] { return static_cast<double>(random() % 10'000) / 10'000; };
    GroundPath path;
    path.measured = true;
    cv::Point2d at(30 * share() - 15, 30 * share() - 15);
    double direction = 2 * kPi * share();
    for (int i = 0; i < 60; ++i) {
        direction += share() - 0.5;
        GroundSample sample;
        sample.frame = i;
        sample.speed = 0.1 + 3 * share();
        sample.velocity = cv::Point2d(std::cos(direction), std::sin(direction)) * sample.speed;
        sample.moving = random() % 10 > 0;
        if (sample.moving) at += sample.velocity;
        sample.at = at;
        path.samples.push_back(sample);
    }
    return path;
}

}  // namespace

TEST(SlowFlow, TellsTheSameOfOthersAtEveryPlace) {
    std::mt19937 random(7);
    FlowField field(kRadius_m);
    std::vector<GroundPath> paths;
    std::vector<std::map<Cell, double>> slow;
    for (int i = 0; i < 30; ++i) {
        paths.push_back(wandering(random));
        slow.push_back(directionsOf(paths.back()));
        const FlowField::Votes votes = field.votesOf(paths.back());
        EXPECT_EQ(votes.size(), slow.back().size());
        field.add(votes);
    }
    const double against = 2 * kPi / 3;
    int met = 0;
    for (std::size_t own = 0; own < paths.size(); ++own) {
        const FlowField::Votes votes = field.votesOf(paths[own]);
        for (const GroundSample& sample : paths[own].samples) {
            const double direction = std::atan2(sample.velocity.y, sample.velocity.x);
            FlowField::Others wanted;
            for (std::size_t other = 0; other < paths.size(); ++other) {
                const auto passes = slow[other].find(cellAt(sample.at));
                if (other == own || passes == slow[other].end()) continue;
                const double turn = std::abs(turnBetween(direction, told(passes->second)));
                ++wanted.all;
                wanted.along += turn <= FlowField::kAlong ? 1 : 0;
                wanted.against += turn > against ? 1 : 0;
            }
            const FlowField::Others others = field.othersAt(sample.at, direction, against, votes);
            ASSERT_EQ(others.all, wanted.all);
            ASSERT_EQ(others.along, wanted.along);
            ASSERT_EQ(others.against, wanted.against);
            met += wanted.all;
        }
    }
    EXPECT_GT(met, 100) << "they hardly meet";
}

TEST(SlowFlow, WhatIsKeptOfATrackGrowsWithItsWayAndNotWithItsTime) {
    const FlowField field(kRadius_m);
    GroundPath slow;
    for (int i = 0; i < 10'000; ++i) {
        GroundSample sample;
        sample.frame = i;
        sample.at = {0.001 * i, 0.5};
        sample.velocity = {0.025, 0};
        sample.speed = 0.025;
        sample.moving = true;
        slow.samples.push_back(sample);
    }
    EXPECT_LE(field.votesOf(slow).size(), 5U * (10 + 5)) << "five cells wide, ten and its ends long";
}

}  // namespace eyrie::slow_flow_test

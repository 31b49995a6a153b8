#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "annotation/scenes.h"
#include "core/geometry/angle.h"
#include "imaging/following/box_follower.h"

/// The follower against one that is written as its rules are told, step by step, over drawn pictures and every kind of
/// trouble. Patches and flow are tested by themselves.
namespace eyrie::slow_follower_test {
namespace {

const cv::Size kPicture(200, 150);

double lengthOf(cv::Point2d way) {
    return std::hypot(way.x, way.y);
}

/// What lies on the ground and goes `way` in one picture, in the next one; a camera comes nearer by a quarter at most.
OrientedBox onNextPicture(const OrientedBox& box, cv::Point2d way, const Homography& map) {
    const double nearer = std::min(1.25, std::max(0.8, map.scaleAt(box.centre)));
    return {map.apply(box.centre + way), box.length * nearer, box.width * nearer, map.turned(box.centre, box.heading)};
}

class SlowFollower {
 public:
    SlowFollower(const OrientedBox& box, const cv::Mat& gray, const FollowOptions& options)
        : options_(options), at_(box), last_sure_(box), drawn_at_(box), drawn_(look(gray, box)), lately_(drawn_) {}

    void startsWith(cv::Point2d speed) {
        speed_ = speed;
        usual_ = speed;
        steps_ = 6;
    }

    BoxFollower::Step advance(const cv::Mat& current, const cv::Mat& next, const Homography& map) {
        OrientedBox predicted = onNextPicture(at_, speed_, map);
        predicted.length *= growth_;
        predicted.width *= growth_;
        last_sure_ = onNextPicture(last_sure_, {0, 0}, map);
        drawn_at_ = onNextPicture(drawn_at_, {0, 0}, map);
        const BoxFlow flow =
            flowOf(current, next, at_, predicted, {options_.max_corners, options_.max_forward_backward_px});
        BoxFollower::Step step;
        step.box = mostAlike(next, flow, predicted);
        const double size = std::sqrt(flow.box.length * flow.box.width);
        step.by_corners = options_.corners_to_grow > 0 && size >= options_.size_to_grow_px &&
                          flow.agreeing >= options_.corners_to_grow && flow.agreeing >= 0.6 * flow.corners;
        if (step.by_corners) {
            const double grown = std::min(1.15, std::max(1 / 1.15, flow.growth));
            step.box.length *= grown;
            step.box.width *= grown;
            growth_ *= std::sqrt(grown);
        } else {
            growth_ = std::sqrt(growth_);
        }
        const BoxPatch seen = look(next, step.box);
        const double like_drawn = seen.correlation(drawn_), like_lately = seen.correlation(lately_);
        const double certainty =
            0.55 * std::max(0.0, like_lately) + 0.25 * std::max(0.0, like_drawn) + 0.05 * std::min(flow.agreeing, 4);
        step.certainty = std::min(1.0, certainty);
        const cv::Point2d movement = step.box.centre - map.apply(at_.centre);
        const cv::Point2d speed = map.applyToVector(at_.centre, speed_);
        const cv::Point2d usual = map.applyToVector(at_.centre, usual_);
        step.end = endOf(step, flow.agreeing, like_drawn, like_lately, movement, speed, usual);
        if (!step.end) {
            speed_ = steps_ == 0 ? movement : (speed + movement) * 0.5;
            const double share = std::max(options_.usual_share, 1.0 / (steps_ + 1));
            usual_ = usual + (movement - usual) * share;
            ++steps_;
            at_ = step.box;
            if (like_lately >= 0.75) {
                lately_.learn(look(next, at_), 0.25);
                last_sure_ = at_;
                waited_ = lengthOf(at_.centre - drawn_at_.centre) < at_.length / 4 && steps_ >= 6 &&
                          lengthOf(usual_) < options_.max_standing_px;
            }
        } else if (waited_) {
            const double in_sight = look(next, last_sure_).seenOf(drawn_);
            at_ = last_sure_;
            step.box = last_sure_;
            speed_ = {0, 0};
            step.hidden = in_sight < options_.min_seen;
            if (!step.hidden) {
                step.certainty = in_sight;
                step.end.reset();
            }
        }
        return step;
    }
    cv::Point2d usualVelocity() const { return usual_; }

 private:
    BoxPatch look(const cv::Mat& gray, const OrientedBox& box) const { return {gray, box, samples_}; }

    double alike(const cv::Mat& gray, const OrientedBox& box) const {
        const BoxPatch seen = look(gray, box);
        return 0.4 * seen.correlation(drawn_) + 0.6 * seen.correlation(lately_);
    }

    OrientedBox mostAlike(const cv::Mat& gray, const BoxFlow& flow, const OrientedBox& predicted) const {
        if (flow.agreeing < 3) return climbed(gray, predicted, steps_ == 0 ? 6 : 3);
        const OrientedBox by_corners = climbed(gray, flow.box, 1);
        if (steps_ == 0) return by_corners;
        const OrientedBox by_speed = climbed(gray, predicted, 2);
        return alike(gray, by_speed) > alike(gray, by_corners) + 0.05 ? by_speed : by_corners;
    }

    /// In steps that are halved down to an eighth of a pixel or so, up to four times in each: whatever is better than
    /// what was best, forward, back, to the right, to the left, and turned to either side.
    OrientedBox climbed(const cv::Mat& gray, const OrientedBox& from, int reach) const {
        const auto worth = [&](const OrientedBox& box) {
            const double away = lengthOf(box.centre - from.centre);
            const double turned = std::abs(wrapPi(box.heading - from.heading));
            return alike(gray, box) - 0.004 * away * away - turned * turned;
        };
        OrientedBox best = from;
        double most = worth(best);
        for (int part = 1; static_cast<double>(reach) / part >= 0.12; part *= 2) {
            const double step = static_cast<double>(reach) / part;
            const double turn = std::min(0.06, step / std::max(4.0, from.length / 2));
            for (int time = 0; time < 4; ++time) {
                const OrientedBox middle = best;
                bool found = false;
                for (const auto& [along, across, more] : {std::array{step, 0.0, 0.0},
                                                          {-step, 0, 0},
                                                          {0, step, 0},
                                                          {0, -step, 0},
                                                          {0, 0, turn},
                                                          {0, 0, -turn}}) {
                    const OrientedBox beside{middle.toImage({along, across}), from.length, from.width,
                                             wrapPi(middle.heading + more)};
                    if (worth(beside) <= most + 1e-6) continue;
                    most = worth(beside);
                    best = beside;
                    found = true;
                }
                if (!found) break;
            }
        }
        return best;
    }

    std::optional<FollowEnd> endOf(const BoxFollower::Step& step, int agreeing, double like_drawn, double like_lately,
                                   cv::Point2d movement, cv::Point2d speed, cv::Point2d usual) const {
        const double size = std::sqrt(step.box.length * step.box.width);
        const double most = std::max(options_.max_speed_change_px, options_.max_speed_change_share * size);
        if (steps_ >= 2 && lengthOf(movement - speed) > most) return FollowEnd::jump;
        const double of_usual = std::max(0.35 * most, lengthOf(usual) / 2);
        if (steps_ >= 6 && !step.by_corners && lengthOf((movement + speed) / 2 - usual) > of_usual)
            return FollowEnd::jump;
        if (like_drawn < options_.min_start_likeness) return FollowEnd::appearance;
        if (like_lately >= 0.5 && step.certainty >= options_.min_certainty) return std::nullopt;
        return agreeing < 2 ? FollowEnd::few_corners : FollowEnd::appearance;
    }

    FollowOptions options_;
    OrientedBox at_, last_sure_, drawn_at_;
    cv::Size samples_ = BoxPatch::samplesFor(at_);
    BoxPatch drawn_, lately_;
    cv::Point2d speed_{0, 0}, usual_{0, 0};
    double growth_ = 1;
    int steps_ = 0;
    bool waited_ = false;
};

Homography cameraStep(double turn, double scale, cv::Point2d shift) {
    const double c = scale * std::cos(turn), s = scale * std::sin(turn);
    const cv::Point2d middle(kPicture.width / 2.0, kPicture.height / 2.0);
    Homography map;
    map.matrix = {c, -s, middle.x + shift.x - c * middle.x + s * middle.y,
                  s, c,  middle.y + shift.y - s * middle.x - c * middle.y,
                  0, 0,  1};
    return map;
}

/// Ground that the camera flies over, and a vehicle that moves on it and now and then meets trouble.
class Scene {
 public:
    explicit Scene(std::uint64_t seed, const OrientedBox& vehicle)
        : dice_(seed),
          box_(vehicle),
          ground_(test::groundTexture(kPicture, static_cast<int>(seed) + 50, 2, 60, 190)),
          body_(test::groundTexture(kPicture, static_cast<int>(seed) + 90, 1.3, 20, 235)),
          other_(test::groundTexture(kPicture, static_cast<int>(seed) + 20, 1.3, 20, 235)) {}

    /// The picture after a step of the camera, and of the vehicle over the ground.
    cv::Mat after(const Homography& map, cv::Point2d movement, double turn, double growth) {
        ground_from_first_ = map.matrix * ground_from_first_;
        box_.centre = map.apply(box_.centre) + movement;
        box_.heading = map.turned(box_.centre, box_.heading) + turn;
        box_.length *= map.scaleAt(box_.centre) * growth;
        box_.width *= map.scaleAt(box_.centre) * growth;
        return picture();
    }
    cv::Mat picture() {
        cv::Mat picture = warped(ground_, ground_from_first_);
        const double c = std::cos(box_.heading) * box_.length / 60, s = std::sin(box_.heading) * box_.length / 60;
        const cv::Matx33d here(c, -s, box_.centre.x - 60 * c + 60 * s, s, c, box_.centre.y - 60 * s - 60 * c, 0, 0, 1);
        cv::Mat inside(kPicture, CV_8UC1, cv::Scalar(0));
        std::vector<cv::Point> outline;
        for (const cv::Point2d& corner : box_.corners()) outline.emplace_back(corner);
        cv::fillConvexPoly(inside, outline, 255);
        warped(body_, here).copyTo(picture, inside);
        cv::Mat noise(kPicture, CV_16S);
        dice_.fill(noise, cv::RNG::NORMAL, 0, 3);
        cv::add(picture, noise, picture, {}, CV_8U);
        return picture;
    }
    cv::Mat covered(cv::Mat picture, double share) const {
        const int width = static_cast<int>(share * 2 * box_.length);
        const cv::Rect part =
            cv::Rect(static_cast<int>(box_.centre.x - box_.length), static_cast<int>(box_.centre.y - box_.length),
                     width, static_cast<int>(2 * box_.length)) &
            cv::Rect({}, kPicture);
        other_(part).copyTo(picture(part));
        return picture;
    }
    cv::Mat faded(const cv::Mat& picture, double share) const {
        cv::Mat result;
        cv::addWeighted(picture, 1 - share, other_, share, 0, result);
        return result;
    }

 private:
    static cv::Mat warped(const cv::Mat& picture, const cv::Matx33d& map) {
        cv::Mat result;
        cv::warpAffine(picture, result, map.get_minor<2, 3>(0, 0), kPicture, cv::INTER_LINEAR, cv::BORDER_REFLECT);
        return result;
    }
    cv::RNG dice_;
    OrientedBox box_;
    cv::Matx33d ground_from_first_ = cv::Matx33d::eye();
    cv::Mat ground_, body_, other_;
};

/// How often what happened, so that the test sees that it has seen all.
struct Seen {
    int steps = 0, grown = 0, hidden = 0, in_sight_again = 0;
    std::array<int, 7> ends{};
};

void expectSame(const BoxFollower::Step& step, const BoxFollower::Step& slow) {
    EXPECT_LT(lengthOf(step.box.centre - slow.box.centre), 1e-6);
    EXPECT_NEAR(step.box.heading, slow.box.heading, 1e-9);
    EXPECT_NEAR(step.box.length, slow.box.length, 1e-9);
    EXPECT_NEAR(step.box.width, slow.box.width, 1e-9);
    EXPECT_NEAR(step.certainty, slow.certainty, 1e-6);
    EXPECT_EQ(step.by_corners, slow.by_corners);
    EXPECT_EQ(step.end, slow.end);
    EXPECT_EQ(step.hidden, slow.hidden);
}

FollowOptions someOptions(cv::RNG& dice) {
    FollowOptions options;
    options.max_corners = dice.uniform(0, 3) == 0 ? dice.uniform(1, 6) : 40;
    options.corners_to_grow = dice.uniform(0, 2) == 0 ? dice.uniform(3, 12) : 0;
    options.size_to_grow_px = dice.uniform(15.0, 25.0);
    options.max_speed_change_share = dice.uniform(0.0, 0.3);
    options.max_speed_change_px = dice.uniform(1.0, 6.0);
    options.min_certainty = dice.uniform(0.3, 0.8);
    options.min_start_likeness = dice.uniform(0.0, 0.7);
    options.max_standing_px = dice.uniform(0.3, 2.0);
    options.min_seen = dice.uniform(0.3, 0.9);
    return options;
}

/// Twelve pictures or until it ends.
void follow(std::uint64_t seed, double most_speed, Seen& seen) {
    SCOPED_TRACE(seed);
    cv::RNG dice(seed);
    const FollowOptions options = someOptions(dice);
    const OrientedBox start{{dice.uniform(70.0, 130.0), dice.uniform(60.0, 90.0)},
                            dice.uniform(7.0, 44.0),
                            dice.uniform(6.0, 16.0),
                            dice.uniform(-kPi, kPi)};
    const cv::Point2d usual = start.direction() * dice.uniform(0.0, most_speed);
    Scene scene(seed, start);
    cv::Mat current = scene.picture();
    BoxFollower follower(start, current, options);
    SlowFollower slow(start, current, options);
    if (dice.uniform(0, 2) == 0) {
        follower.startsWith(usual);
        slow.startsWith(usual);
    }
    const double turn = dice.uniform(-0.05, 0.05), growth = dice.uniform(0.97, 1.04);
    for (int i = 0; i < 12; ++i) {
        const Homography map = cameraStep(dice.uniform(-0.02, 0.02), dice.uniform(0.98, 1.02),
                                          {dice.uniform(-3.0, 3.0), dice.uniform(-3.0, 3.0)});
        const double jolt = dice.uniform(0, 6) == 0 ? 4 : 0.4;
        const cv::Point2d movement =
            usual + cv::Point2d(dice.uniform(-jolt, jolt), dice.uniform(-jolt, jolt)) * (most_speed > 0 ? 1 : 0.5);
        cv::Mat next = scene.after(map, movement, turn, growth);
        const int trouble = dice.uniform(0, 10);
        if (trouble == 0) next = scene.faded(next, dice.uniform(0.3, 0.6));
        if (trouble == 1) next = scene.covered(next, dice.uniform(0.3, 0.9));
        if (trouble == 2) next = cv::Mat(kPicture, CV_8UC1, cv::Scalar(90));
        const BoxFollower::Step step = follower.advance(current, next, map);
        expectSame(step, slow.advance(current, next, map));
        EXPECT_LT(lengthOf(follower.usualVelocity() - slow.usualVelocity()), 1e-6);
        ++seen.steps;
        seen.grown += step.by_corners;
        seen.hidden += step.hidden;
        if (step.end) ++seen.ends[static_cast<std::size_t>(*step.end)];
        if (testing::Test::HasFailure() || (step.end && !step.hidden)) return;
        current = next;
    }
}

}  // namespace

TEST(SlowFollower, WhatDrivesIsFollowedAndLeftAsTheRulesSay) {
    Seen seen;
    for (std::uint64_t seed = 1; seed <= 36; ++seed) follow(seed, 4, seen);
    EXPECT_GE(seen.steps, 120);
    EXPECT_GE(seen.grown, 10);
    for (const FollowEnd end : {FollowEnd::appearance, FollowEnd::few_corners, FollowEnd::jump})
        EXPECT_GE(seen.ends[static_cast<std::size_t>(end)], 3) << static_cast<int>(end);
}

TEST(SlowFollower, WhatStandsIsWaitedForAsTheRulesSay) {
    Seen seen;
    for (std::uint64_t seed = 101; seed <= 124; ++seed) follow(seed, 0, seen);
    EXPECT_GE(seen.steps, 100);
    EXPECT_GE(seen.hidden, 5);
}

}  // namespace eyrie::slow_follower_test

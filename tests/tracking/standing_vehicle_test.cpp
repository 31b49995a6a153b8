#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "core/geometry/angle.h"
#include "tracking/drawn_cars.h"
#include "tracking/finishing/track_finishing.h"
#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"
#include "tracking/vehicle_template.h"

namespace eyrie::standing_vehicle_test {
namespace {

using test::drawnCars;
using test::MovingScene;

constexpr int kStops = 40;      ///< frame in which the car comes to stand
constexpr double kSpeed = 1.2;  ///< px/frame before and after; 7.5 m/s

cv::Mat grained(const cv::Mat& image, double deviation, std::uint64_t seed) {
    cv::Mat noise(image.size(), CV_16SC1);
    cv::RNG(seed).fill(noise, cv::RNG::NORMAL, 0, deviation);
    cv::Mat sum;
    cv::add(image, noise, sum, cv::noArray(), CV_8U);
    return sum;
}

/// A car that brakes, stands and drives on, seen by a camera that drifts and turns. It is detected while it moves.
struct StoppingCar {
    int stands = 250;                 ///< frames
    int frames = 0;                   ///< 0: until it has driven on for a while
    std::optional<int> gone;          ///< frame from which plain road is in its place
    std::optional<int> passes;        ///< frame in which another car is right in front of it
    std::optional<double> slides_by;  ///< px/frame that it goes on with unseen, instead of standing
    bool drove = true;                ///< otherwise it is detected where it stands, as what only seems to move
    double grain = 0;                 ///< grey levels, deviation of noise over the pictures in which it stands
    TrackerOptions options;

    double wayAt(int frame) const {
        if (!drove) return 60;
        constexpr int kBrakes = 30;
        const double deceleration = kSpeed / kBrakes;
        const double braking = std::clamp(frame - (kStops - kBrakes), 0, kBrakes);
        const double driven =
            std::min(frame, kStops - kBrakes) * kSpeed + kSpeed * braking - deceleration * braking * braking / 2;
        const int after = std::max(0, frame - kStops - stands);
        const double started = std::min(after, kBrakes);
        return driven + deceleration * started * started / 2 + kSpeed * std::max(0, after - kBrakes) +
               slides_by.value_or(0) * std::max(0, frame - kStops);
    }
    OrientedBox onGround(int frame) const { return {{80 + wayAt(frame), 150}, 20, 10, 0}; }
    OrientedBox passerOnGround(int frame) const { return {{118 + 2.0 * (frame - *passes), 153}, 22, 11, 0}; }

    struct Result {
        std::vector<TimedState> states;  ///< of the tracker
        std::vector<FrameMotionSummary> motion;
        std::map<int, std::vector<TrackState>> by_frame;
        std::vector<OrientedBox> truth;
        int pictures = 0;  ///< that the tracker asked for

        /// The track that lies on the car.
        const TrackState* onCar(int frame) const {
            return test::nearest(by_frame.at(frame), truth[static_cast<std::size_t>(frame)]);
        }
        std::set<TrackId> idsOnCar(int from, int to) const {
            std::set<TrackId> ids;
            for (int frame = from; frame < to; ++frame) {
                const TrackState* state = onCar(frame);
                ids.insert(state == nullptr ? 0 : state->id);
            }
            return ids;
        }
        int marked(int from, int to) const {
            int count = 0;
            for (int frame = from; frame < to; ++frame) {
                const TrackState* state = onCar(frame);
                count += state != nullptr && state->origin == StateOrigin::standing;
            }
            return count;
        }
    };

    Result run() const {
        MovingScene scene;
        scene.image = {220, 120};
        scene.camera.turn = [](int frame) { return 0.04 * std::sin(frame / 90.0); };
        scene.camera.shift = [](int frame) { return cv::Point2d(-60 - 8 * std::sin(frame / 120.0), -90); };
        const auto inImage = [&](const OrientedBox& ground, int frame) {
            const Homography map = scene.map(frame);
            return OrientedBox{map.apply(ground.centre), ground.length, ground.width,
                               map.turned(ground.centre, ground.heading)};
        };
        Result result;
        Tracker tracker(options, scene.scale);
        const int count = frames > 0 ? frames : kStops + stands + 60;
        for (int frame = 0; frame < count; ++frame) {
            const FrameMotion motion = scene.motion(frame);
            std::vector<Detection> detections;
            const auto detect = [&](const OrientedBox& now, const OrientedBox& next) {
                Detection detection;
                detection.box = inImage(now, frame);
                detection.velocity = scene.map(frame).applyToVector(now.centre, next.centre - now.centre);
                detections.push_back(detection);
            };
            const bool there = !gone || frame < *gone;
            std::vector<OrientedBox> drawn;
            result.truth.push_back(inImage(onGround(frame), frame));
            if (there) drawn.push_back(result.truth.back());
            const double speed = onGround(frame + 1).centre.x - onGround(frame).centre.x;
            const bool moves = speed > 0.15 && !(slides_by && frame >= kStops - 4);
            if (there && (moves || (!drove && frame < kStops))) detect(onGround(frame), onGround(frame + 1));
            if (passes && std::abs(frame - *passes) < 60) {
                detect(passerOnGround(frame), passerOnGround(frame + 1));
                drawn.push_back(detections.back().box);
            }
            const auto seed = static_cast<std::uint64_t>(frame + 1);
            result.by_frame[frame] = tracker.next(motion, detections, nullptr, [&] {
                ++result.pictures;
                return frame > kStops + 30 ? grained(drawnCars(drawn, seed, scene.image), grain, seed)
                                           : drawnCars(drawn, seed, scene.image);
            });
            for (const TrackState& state : result.by_frame[frame]) result.states.emplace_back(frame, state);
            result.motion.push_back({frame, motion.registration, scene.image});
        }
        return result;
    }
};

}  // namespace

TEST(StandingVehicle, thatDrivesOnAfterTenSecondsKeepsItsIdAndIsMarkedMeanwhile) {
    const StoppingCar::Result result = StoppingCar{}.run();
    EXPECT_EQ(result.idsOnCar(5, kStops + 250 + 60), std::set<TrackId>{1});
    EXPECT_GE(result.marked(kStops, kStops + 250), 235);
    EXPECT_EQ(result.marked(0, kStops - 10), 0);
    EXPECT_EQ(result.marked(kStops + 250 + 20, kStops + 250 + 60), 0);
    const TrackState* late = result.onCar(kStops + 249);
    ASSERT_NE(late, nullptr);
    const cv::Point2d off = late->box.centre - result.truth[kStops + 249].centre;
    EXPECT_LT(std::hypot(off.x, off.y), 1.5);
}

TEST(StandingVehicle, staysForMinutes) {
    StoppingCar car;
    car.stands = 25 * 130;
    const StoppingCar::Result result = car.run();
    EXPECT_EQ(result.idsOnCar(5, kStops + car.stands + 60), std::set<TrackId>{1});
}

TEST(StandingVehicle, keepsNoIdWithoutItsLook) {
    StoppingCar car;
    car.options.appearance = AppearanceUse::none;
    const StoppingCar::Result result = car.run();
    EXPECT_EQ(result.onCar(kStops + 100), nullptr);
    EXPECT_EQ(result.idsOnCar(kStops + 300, kStops + 310), std::set<TrackId>{2});
}

TEST(StandingVehicle, thatIsGoneIsLostWhenItWasLastSeen) {
    StoppingCar car;
    car.frames = 320;
    car.gone = 200;
    const StoppingCar::Result result = car.run();
    EXPECT_NE(result.onCar(199), nullptr);
    EXPECT_TRUE(result.by_frame.at(200 + 60).empty()) << "kept where nothing stands any more";
    const auto finished = finishTracks(result.states, result.motion, {}, MovingScene{}.scale, FoundInFrames{}, nullptr);
    ASSERT_FALSE(finished.empty());
    EXPECT_NEAR(finished.back().first, 199, 3) << "what was only waited for does not belong to the track";
    EXPECT_EQ(finished.back().second.origin, StateOrigin::standing);
}

TEST(StandingVehicle, isNotEndedByWhatPassesInFrontAndDoesNotGiveItsIdAway) {
    StoppingCar car;
    car.passes = 160;
    const StoppingCar::Result result = car.run();
    EXPECT_EQ(result.idsOnCar(5, 120), std::set<TrackId>{1});
    for (int frame = 120; frame < kStops + 250 + 60; ++frame) {
        const auto& states = result.by_frame.at(frame);
        const auto first = std::find_if(states.begin(), states.end(), [](const TrackState& s) { return s.id == 1; });
        ASSERT_NE(first, states.end()) << frame;
        EXPECT_GT(overlap(first->box, result.truth[static_cast<std::size_t>(frame)]), 0.5) << frame;
    }
    EXPECT_GT(result.marked(190, kStops + 250), 90) << "seen again once the way is free";
}

TEST(StandingVehicle, isLookedAtSomeTimesASecondAndWhatDrivesNotAtAll) {
    StoppingCar car;
    EXPECT_LT(car.run().pictures, 40 + 250 / 2);
    car.frames = 10;
    EXPECT_EQ(car.run().pictures, 0);
}

TEST(StandingVehicle, isNothingThatSlidesOverTheGround) {
    for (const double slides : {0.1, 0.2, 0.3}) {
        StoppingCar car;
        car.slides_by = slides;
        car.frames = 200;
        EXPECT_EQ(car.run().marked(0, 200), 0) << slides;
    }
}

TEST(StandingVehicle, isNothingThatNeverDrove) {
    StoppingCar car;
    car.drove = false;
    car.frames = 120;
    const StoppingCar::Result result = car.run();
    EXPECT_NE(result.onCar(kStops - 5), nullptr);
    EXPECT_EQ(result.marked(0, 120), 0);
}

namespace {

/// The last frame in which there is a track, of one whose options have a parameter set by its name.
int lastFrameWith(StoppingCar car, const std::string& name, const std::string& value) {
    setParameter(describeOf(car.options), name, value);
    int last = -1;
    for (const auto& [frame, states] : car.run().by_frame) {
        if (!states.empty()) last = frame;
    }
    return last;
}

}  // namespace

TEST(StandingVehicle, isWaitedForAsLongAsMaxHiddenSays) {
    StoppingCar car;
    car.frames = 320;
    car.gone = 200;
    EXPECT_NEAR(lastFrameWith(car, "tracking.max_hidden", "1"), 200 + 25, 3);
    EXPECT_NEAR(lastFrameWith(car, "tracking.max_hidden", "3"), 200 + 75, 3);
}

TEST(StandingVehicle, isKeptByItsLookAsLongAsMaxStandingSays) {
    StoppingCar car;
    car.frames = 280;
    const int short_life = lastFrameWith(car, "tracking.max_standing", "2");
    EXPECT_NEAR(short_life, kStops + 50, 15) << "from when it is sure to stand";
    EXPECT_EQ(lastFrameWith(car, "tracking.max_standing", "5") - short_life, 75);
    EXPECT_EQ(lastFrameWith(car, "tracking.max_standing", "600"), 279);
}

TEST(StandingVehicle, mustLookAsItDidAsMuchAsAppearanceAgreementSays) {
    StoppingCar car;
    car.frames = 200;
    car.grain = 60;  // correlations of about .8
    EXPECT_EQ(lastFrameWith(car, "tracking.appearance_agreement", "0.7"), 199);
    EXPECT_LT(lastFrameWith(car, "tracking.appearance_agreement", "0.9"), 150);
    car.grain = 0;
    EXPECT_EQ(lastFrameWith(car, "tracking.appearance_agreement", "0.9"), 199);
}

TEST(StandingVehicle, mustBeToldFromWhatIsBesideItAsAppearanceMarginSays) {
    StoppingCar car;
    car.frames = 200;
    // What half a car beside it looks like is told by the pictures themselves.
    const OrientedBox place{{100, 60}, 20, 10, 0};
    const auto look = VehicleTemplate::of(drawnCars({place}, 1, {220, 120}), place);
    ASSERT_TRUE(look);
    const auto match = look->find(drawnCars({place}, 2, {220, 120}), place, 3);
    ASSERT_TRUE(match);
    const double margin = match->agreement - match->beside;
    EXPECT_EQ(lastFrameWith(car, "tracking.appearance_margin", "0.1"), 199);
    EXPECT_EQ(lastFrameWith(car, "tracking.appearance_margin", std::to_string(margin - 0.15)), 199);
    EXPECT_LT(lastFrameWith(car, "tracking.appearance_margin", std::to_string(margin + 0.15)), 150) << margin;
}

}  // namespace eyrie::standing_vehicle_test

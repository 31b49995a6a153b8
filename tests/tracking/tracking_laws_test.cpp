// Whichever way the picture is turned, and whenever a run begins, the same vehicles are followed in the same way.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>
#include <random>

#include "tracking/drawn_cars.h"
#include "tracking/finishing/track_finishing.h"
#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"
#include "tracking/turned_picture.h"

namespace eyrie::tracking_laws_test {
namespace {

using test::expectAlike;
using test::Mirror;
using test::MovingScene;
using test::QuarterTurn;
using test::RigidMap;

constexpr int kFrames = 170;
constexpr int kLost = 60;  ///< frame after which the car that brakes is not detected any more

/// What a tracker and finishing are given in each frame.
struct Seen {
    std::vector<FrameMotion> motion;
    std::vector<std::vector<Detection>> detections;
    std::vector<cv::Mat> pictures;
    SceneScale scale;
};

/// Cars of all directions under a turning, zooming camera: some are missed, split, merged or cut by the border, one
/// brakes and stands, registration fails once; all with noise.
Seen busyStreet() {
    MovingScene scene;
    scene.image = {320, 240};
    // Objects are placed about the middle of 640 × 480 px, which the camera is turned about.
    scene.objects = {{{215, 150}, {1.6, 0.3}, 20, 10, 0},    {{420, 330}, {-1.1, -0.9}, 22, 9, 100},
                     {{300, 320}, {0.4, -1.3}, 44, 12, 200}, {{260, 250}, {1.2, 0.2}, 20, 9, 300},
                     {{262, 262}, {1.2, 0.2}, 20, 9, 400},   {{470, 240}, {-2.2, 0.4}, 21, 10, 500},
                     {{380, 170}, {0.02, 0.01}, 20, 10, 600}};
    scene.camera.turn = [](int frame) { return 0.15 * std::sin(frame / 60.0); };
    scene.camera.zoom = [](int frame) { return 1 + 0.0006 * frame; };
    scene.camera.shift = [](int frame) { return cv::Point2d(-160 + 6 * std::sin(frame / 25.0), -120 + 0.05 * frame); };
    std::mt19937 random(21);
    std::normal_distribution<double> noise(0, 1);
    std::uniform_real_distribution<double> chance(0, 1);
    Seen seen;
    seen.scale = {0.22, 25, true};
    for (int frame = 0; frame < kFrames; ++frame) {
        FrameMotion motion = scene.motion(frame);
        std::vector<Detection> detections;
        std::vector<OrientedBox> drawn;
        for (std::size_t i = 0; i < scene.objects.size(); ++i) {
            Detection d = scene.detection(i, frame);
            if (areaInImage(d.box, scene.image) < 1) continue;
            drawn.push_back(d.box);
            if (i == 6) {
                // It drove up to there and stands from then on.
                const double before = std::max(0, kLost - frame);
                const cv::Point2d back(-0.02 * before * before, 0.004 * before);
                d.box.centre += back;
                d.velocity = {0.04 * before, -0.008};
                drawn.back() = d.box;
                if (frame > kLost - 4) continue;
            }
            if (frame > 6 && chance(random) < 0.12) continue;
            if (i == 1 && frame > 50 && frame < 90 && frame % 4 != 0) continue;  // rebuilt from vectors
            d.complete = chance(random) < 0.3;
            d.score = chance(random);
            d.box.centre += 0.4 * cv::Point2d(noise(random), noise(random));
            d.box.length *= 1 + 0.05 * noise(random);
            d.box.width *= 1 + 0.05 * noise(random);
            d.box.heading += 0.03 * noise(random);
            d.velocity += 0.03 * cv::Point2d(noise(random), noise(random));
            if (i == 2 && frame % 5 == 0) {  // in two parts
                const OrientedBox whole = d.box;
                d.box = {whole.toImage({-12, 0}), 17, 11, whole.heading};
                detections.push_back(d);
                d.box = {whole.toImage({12, 0}), 15, 11, whole.heading};
            }
            if (i == 4 && frame > 40 && frame < 60 && !detections.empty()) {  // merged with its neighbour
                detections.back().box = unionBox(detections.back().box, d.box);
                continue;
            }
            detections.push_back(d);
        }
        if (frame % 9 == 0) detections.push_back({{{60, 200.0 - frame / 2.0}, 9, 6, 1}, 0.4, {0.3, -0.5}, 0, {}, {}});
        for (MotionVector& v : motion.motion_vectors) {
            v.position += cv::Point2f(float(0.1 * noise(random)), float(0.1 * noise(random)));
            v.velocity += cv::Point2f(float(0.02 * noise(random)), float(0.02 * noise(random)));
        }
        std::erase_if(motion.motion_vectors, [&](const MotionVector& v) {
            return v.id >= 600 || v.position.x < 3 || v.position.y < 3 || v.position.x > 316 || v.position.y > 236;
        });
        if (frame == 110) motion.registration.state = RegistrationState::failed;
        if (frame == 111) motion.registration.state = RegistrationState::frozen;
        seen.motion.push_back(motion);
        seen.detections.push_back(detections);
        seen.pictures.push_back(test::drawnCars(drawn, std::uint64_t(frame + 1), scene.image));
    }
    return seen;
}

Seen turned(const Seen& seen, const RigidMap& map) {
    Seen result = seen;
    for (std::size_t i = 0; i < seen.motion.size(); ++i) {
        result.motion[i] = map(seen.motion[i]);
        for (Detection& detection : result.detections[i]) detection = map(detection);
        result.pictures[i] = map(seen.pictures[i]);
    }
    return result;
}

std::vector<TimedState> tracked(const Seen& seen, const TrackerOptions& options = {}, FrameIndex first = 0) {
    Tracker tracker(options, seen.scale);
    std::vector<TimedState> states;
    for (std::size_t i = 0; i < seen.motion.size(); ++i) {
        const auto found = tracker.next(seen.motion[i], seen.detections[i], nullptr, [&] { return seen.pictures[i]; });
        for (const TrackState& state : found) states.emplace_back(static_cast<FrameIndex>(i) + first, state);
    }
    return states;
}

std::vector<TimedState> finished(const Seen& seen, const std::vector<TimedState>& states,
                                 const FinishingOptions& options = {}, FrameIndex first = 0) {
    std::vector<FrameMotionSummary> motion;
    VectorsByFrame vectors;
    ClassifiedByFrame classified;
    for (std::size_t i = 0; i < seen.motion.size(); ++i) {
        const auto frame = static_cast<FrameIndex>(i) + first;
        motion.push_back({frame, seen.motion[i].registration, seen.motion[i].image_size});
        vectors[frame] = seen.motion[i].motion_vectors;
        classified[frame] = classifiedOf(seen.detections[i]);
    }
    return finishTracks(states, motion, options, seen.scale, {vectorsIn(vectors), classifiedIn(classified)});
}

/// `places`: where a box of `a` is in `b`.
void expectSameTracks(const std::vector<TimedState>& a, const std::vector<TimedState>& b,
                      const std::function<OrientedBox(const OrientedBox&)>& places, double tolerance,
                      FrameIndex later = 0) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
        const TrackState& one = a[i].second;
        const TrackState& other = b[i].second;
        SCOPED_TRACE("frame " + std::to_string(a[i].first) + ", track " + std::to_string(one.id));
        ASSERT_EQ(b[i].first, a[i].first + later);
        ASSERT_EQ(other.id, one.id);
        ASSERT_EQ(other.origin, one.origin);
        ASSERT_EQ(other.status, one.status);
        ASSERT_EQ(other.hits, one.hits);
        ASSERT_EQ(other.age, one.age);
        ASSERT_NEAR(other.score, one.score, 1e-3);
        expectAlike(other.box, places(one.box), tolerance);
        const double speed = std::hypot(one.velocity.x, one.velocity.y);
        ASSERT_NEAR(std::hypot(other.velocity.x, other.velocity.y), speed, tolerance);
        if (testing::Test::HasNonfatalFailure()) return;
    }
}

OrientedBox unmoved(const OrientedBox& box) {
    return box;
}

const Seen& street() {
    static const Seen seen = busyStreet();
    return seen;
}

/// px by which a place may differ: vectors are floats, pictures are sampled to a thirty-second of a pixel.
double toleranceOf(const TrackerOptions& options) {
    return options.appearance == AppearanceUse::none ? 0.003 : 0.2;
}

std::vector<TrackerOptions> kindsOfTracking() {
    TrackerOptions by_look;
    by_look.appearance = AppearanceUse::lost;
    TrackerOptions blind;
    blind.appearance = AppearanceUse::none;
    TrackerOptions whole = blind;
    whole.adapt_size = false;
    whole.visible_overlap = false;
    whole.one_vehicle = 0;
    return {TrackerOptions{}, TrackerOptions::thesis(), by_look, blind, whole};
}

}  // namespace

TEST(TrackingLaws, TheBusyStreetHoldsWhatTheLawsAreTriedOn) {
    std::map<StateOrigin, int> origins;
    std::map<TrackStatus, int> statuses;
    for (const auto& [frame, state] : tracked(street())) {
        ++origins[state.origin];
        ++statuses[state.status];
    }
    EXPECT_GT(origins[StateOrigin::detected], 500);
    EXPECT_GT(origins[StateOrigin::reconstructed], 20);
    EXPECT_GT(origins[StateOrigin::predicted], 10);
    EXPECT_GT(origins[StateOrigin::standing], 50);
    EXPECT_GT(statuses[TrackStatus::coasting], 50);
}

TEST(TrackingLaws, AQuarterTurnOfThePicturesTurnsTheTracks) {
    const QuarterTurn turn(street().motion[0].image_size);
    const Seen seen = turned(street(), turn);
    // Of an even number of vectors the upper one of the middle is taken, which is no symmetry either.
    FinishingOptions untraced;
    untraced.trace_back_s = 0;
    for (const TrackerOptions& options : kindsOfTracking()) {
        const auto before = tracked(street(), options);
        const auto after = tracked(seen, options);
        const double tolerance = toleranceOf(options);
        expectSameTracks(before, after, turn, tolerance);
        expectSameTracks(finished(street(), before), finished(seen, after), turn, 0.2);
        expectSameTracks(finished(street(), before, untraced), finished(seen, after, untraced), turn, tolerance);
    }
}

TEST(TrackingLaws, AMirrorMirrorsTheTracks) {
    const Mirror mirror(street().motion[0].image_size);
    const Seen seen = turned(street(), mirror);
    FinishingOptions untraced;
    untraced.trace_back_s = 0;
    for (const TrackerOptions& options : kindsOfTracking()) {
        const auto before = tracked(street(), options);
        const auto after = tracked(seen, options);
        // A slanted box that comes in over the border with an end and a side is smeared along their sum, which has a
        // hand.
        const double tolerance = 0.3;
        expectSameTracks(before, after, mirror, tolerance);
        expectSameTracks(finished(street(), before), finished(seen, after), mirror, tolerance);
        expectSameTracks(finished(street(), before, untraced), finished(seen, after, untraced), mirror, tolerance);
    }
}

TEST(TrackingLaws, ARunThatBeginsLaterHasTheSameTracksLater) {
    constexpr FrameIndex kLater = 1000;
    Seen later = street();
    for (FrameMotion& motion : later.motion) {
        motion.frame += kLater;
        motion.registration.current_from_previous.from_frame += kLater;
        motion.registration.current_from_previous.to_frame += kLater;
    }
    const auto before = tracked(street());
    const auto after = tracked(later, {}, kLater);
    expectSameTracks(before, after, unmoved, 0, kLater);
    expectSameTracks(finished(street(), before), finished(later, after, {}, kLater), unmoved, 0, kLater);
}

TEST(TrackingLaws, TheOrderOfDetectionsOnlyNumbersNewTracks) {
    Seen other = street();
    for (std::size_t i = 1; i < other.detections.size(); ++i)
        std::reverse(other.detections[i].begin(), other.detections[i].end());
    const auto before = tracked(street());
    const auto after = tracked(other);
    ASSERT_EQ(before.size(), after.size());
    // Sums of numbers and pairs of frames and boxes, whichever id has them.
    std::map<std::pair<FrameIndex, int>, int> balance;
    const auto keyOf = [](const TimedState& state) {
        return std::pair(state.first, cvRound(state.second.box.centre.x) + 1000 * cvRound(state.second.box.centre.y));
    };
    for (const TimedState& state : before) ++balance[keyOf(state)];
    for (const TimedState& state : after) --balance[keyOf(state)];
    int different = 0;
    for (const auto& [key, count] : balance) different += count != 0;
    EXPECT_LT(different, static_cast<int>(before.size()) / 50);
}

}  // namespace eyrie::tracking_laws_test

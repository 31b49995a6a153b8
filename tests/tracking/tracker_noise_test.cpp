// What detections tell a track, and how fast it changes by itself: the deviations of the Kalman filter by name.
#include <gtest/gtest.h>

#include <functional>
#include <numbers>

#include "tracking/measurement_model.h"
#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"

namespace eyrie::tracker_noise_test {
namespace {

using test::MovingScene;
using test::twoCars;

const SceneScale kQuarterMetre{0.25, 25, true};

TrackerOptions withDeviation(const std::string& name, const std::string& value) {
    TrackerOptions options;
    options.adapt_size = false;  // one deviation for all boxes
    setParameter(describeOf(options), name, value);
    return options;
}

BoxMeasurement measured(const TrackerOptions& options) {
    MeasurementModel model(options, kQuarterMetre);
    model.startFrame({640, 480}, 0);
    Detection detection;
    detection.box = {{100, 100}, 20, 10, 0};
    detection.velocity = {1e6, 0};  // so fast that the background says nothing against its direction
    return model.update(detection.box, detection, detection.box, true).measurement;
}

BoxProcessNoise processOf(const TrackerOptions& options) {
    return MeasurementModel(options, kQuarterMetre).processNoise({});
}

}  // namespace

TEST(TrackerNoise, MetresBecomePixelsAndAddToWhatDoesNotScale) {
    TrackerOptions options = withDeviation("tracking.position_noise_m", "0.75");  // 3 px
    setParameter(describeOf(options), "tracking.position_noise_px", "4");
    EXPECT_NEAR(measured(options).along, 5, 1e-9);
    EXPECT_NEAR(measured(options).across, 5, 1e-9);
    options = withDeviation("tracking.size_noise_m", "1.25");  // 5 px
    setParameter(describeOf(options), "tracking.size_noise_px", "12");
    EXPECT_NEAR(measured(options).length, 13, 1e-9);
    EXPECT_NEAR(measured(options).width, 13, 1e-9);
    options = withDeviation("tracking.velocity_noise", "25");  // 4 px/frame
    setParameter(describeOf(options), "tracking.velocity_noise_px", "3");
    EXPECT_NEAR(measured(options).speed, 5, 1e-9);
}

TEST(TrackerNoise, EndsThatAreMeasuredOneByOneSayWhereTheCentreIs) {
    TrackerOptions options = withDeviation("tracking.size_noise_m", "0");
    setParameter(describeOf(options), "tracking.size_noise_px", "2");
    setParameter(describeOf(options), "tracking.position_noise_px", "8");
    options.adapt_size = true;
    EXPECT_NEAR(measured(options).along, 1, 1e-9) << "half the deviation of the length";
    const MeasurementModel model(options, kQuarterMetre);
    EXPECT_NEAR(model.placed({{100, 100}, 20, 10, 0}).along, 8, 1e-9);
    EXPECT_NEAR(model.reconstructed({}).along, 8, 1e-9);
}

TEST(TrackerNoise, DegreesAndSecondsBecomeRadiansAndFrames) {
    EXPECT_NEAR(measured(withDeviation("tracking.heading_noise", "9")).heading, std::numbers::pi / 20, 1e-6);
    EXPECT_NEAR(processOf(withDeviation("tracking.turn_rate", "45")).heading, std::numbers::pi / 4 / 25, 1e-9);
    EXPECT_NEAR(processOf(withDeviation("tracking.size_rate", "0.5")).size, 2, 1e-9) << "px in a frame";
}

namespace {

/// A parameter, and by how much a track follows when what it is about changes from one detection to the next.
struct Deviation {
    const char* parameter;
    const char* small;
    const char* large;
    bool follows_more;  ///< with the large value
    std::function<void(Detection&)> change;
    std::function<double(const TrackState&)> followed;
};

const std::vector<Deviation> kDeviations = {
    {"tracking.turn_rate", "10", "160", true, [](Detection& d) { d.box.heading += 0.3; },
     [](const TrackState& s) { return s.box.heading; }},
    {"tracking.heading_noise", "1", "16", false, [](Detection& d) { d.box.heading += 0.3; },
     [](const TrackState& s) { return s.box.heading; }},
    {"tracking.acceleration", "0.5", "40", true, [](Detection& d) { d.velocity.x += 0.4; },
     [](const TrackState& s) { return s.velocity.x; }},
    {"tracking.size_rate", "0.01", "0.2", true, [](Detection& d) { d.box.length += 3; },
     [](const TrackState& s) { return s.box.length; }},
    {"tracking.size_noise_m", "0", "1.6", false, [](Detection& d) { d.box.length += 3; },
     [](const TrackState& s) { return s.box.length; }},
    {"tracking.size_noise_px", "0.1", "6", false, [](Detection& d) { d.box.length += 3; },
     [](const TrackState& s) { return s.box.length; }},
    {"tracking.position_noise_m", "0", "0.5", false, [](Detection& d) { d.box.centre.y += 1; },
     [](const TrackState& s) { return s.box.centre.y; }},
    {"tracking.position_noise_px", "0.1", "2", false, [](Detection& d) { d.box.centre.y += 1; },
     [](const TrackState& s) { return s.box.centre.y; }},
    {"tracking.velocity_noise_px", "0.01", "1", false, [](Detection& d) { d.velocity.x += 0.4; },
     [](const TrackState& s) { return s.velocity.x; }},
};

}  // namespace

TEST(TrackerNoise, ATrackFollowsLessWhatIsUncertainAndMoreWhatMayChange) {
    const MovingScene scene = twoCars();
    for (const Deviation& deviation : kDeviations) {
        const auto followed = [&](const char* value) {
            Tracker tracker(withDeviation(deviation.parameter, value), scene.scale);
            for (int frame = 0; frame < 20; ++frame) tracker.next(scene.motion(frame), scene.detections(frame));
            Tracker undisturbed = tracker;
            auto detections = scene.detections(20);
            const auto before = undisturbed.next(scene.motion(20), detections);
            deviation.change(detections[0]);
            const auto after = tracker.next(scene.motion(20), detections);
            return deviation.followed(after.at(0)) - deviation.followed(before.at(0));
        };
        const double with_small = followed(deviation.small), with_large = followed(deviation.large);
        EXPECT_GT(std::min(with_small, with_large), 0) << deviation.parameter;
        const double ratio = deviation.follows_more ? with_large / with_small : with_small / with_large;
        EXPECT_GT(ratio, 1.2) << deviation.parameter << ": " << with_small << ", " << with_large;
    }
}

}  // namespace eyrie::tracker_noise_test

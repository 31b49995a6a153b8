// What a detection tells of a track, by hand, and that it does not matter which way the picture is turned.
#include "tracking/measurement_model.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "core/geometry/angle.h"
#include "tracking/turned_picture.h"

namespace eyrie::measurement_model_test {
namespace {

const SceneScale kFourToAMetre{0.25, 25, true};
const cv::Size kPicture(640, 480);

/// Deviations of round numbers: 3 px of a place, 4 px of a size, 6 of an axis' degrees, 5 px/frame of a velocity. A
/// vehicle has at most 1.5 times 20 × 8 px and three for the gradients: 33 × 15.
TrackerOptions roundOptions() {
    TrackerOptions options;
    options.position_noise_m = 0;
    options.position_noise_px = 3;
    options.size_noise_m = 0;
    options.size_noise_px = 4;
    options.heading_noise_deg = 6;
    options.velocity_noise_m_s = 25;  // 4 px/frame
    options.velocity_noise_px = 3;
    options.size_gate = 2;
    options.car_length_m = 5;
    options.car_width_m = 2;
    options.one_vehicle = 1.5;
    return options;
}

MeasurementModel modelWith(const TrackerOptions& options, double sigma = 0.1) {
    MeasurementModel model(options, kFourToAMetre);
    model.startFrame(kPicture, sigma);
    return model;
}

Detection detectionOf(const OrientedBox& box, cv::Point2d velocity = {10, 0}, bool complete = false) {
    Detection detection;
    detection.box = box;
    detection.velocity = velocity;
    detection.complete = complete;
    return detection;
}

MeasurementModel::Update updated(const OrientedBox& box, const OrientedBox& predicted,
                                 const TrackerOptions& options = roundOptions(), cv::Point2d velocity = {10, 0},
                                 bool complete = false, bool size_known = true) {
    return modelWith(options).update(box, detectionOf(box, velocity, complete), predicted, size_known);
}

}  // namespace

TEST(MeasurementModel, EachEndSaysHowFarItMayBeTrusted) {
    // Of 20 × 10 px at x = 300: the front 3 px short, the rear 2 px beyond, the right 1 px beyond, the left 4 px short.
    const OrientedBox predicted{{300, 200}, 20, 10, 0};
    const OrientedBox box{{297.5, 202.5}, 19, 7, 0};
    const auto update = updated(box, predicted);
    const double noise = 4 / std::sqrt(2.0);
    const double front = std::hypot(noise, 3), rear = noise, right = noise, left = std::hypot(noise, 4);
    EXPECT_TRUE(update.by_ends);
    EXPECT_NEAR(update.measurement.length, std::hypot(front, rear), 1e-9);
    EXPECT_NEAR(update.measurement.width, std::hypot(left, right), 1e-9);
    EXPECT_NEAR(update.measurement.along, std::hypot(front, rear) / 2, 1e-9);
    EXPECT_NEAR(update.measurement.across, std::hypot(left, right) / 2, 1e-9);
    EXPECT_NEAR(update.measurement.along_with_length, 4.5, 1e-9);
    EXPECT_NEAR(update.measurement.across_with_width, -8, 1e-9);
    EXPECT_NEAR(update.grows_front, 0, 1e-9);
    EXPECT_NEAR(update.grows_rear, 2, 1e-9);
    EXPECT_NEAR(update.grows_right, 1, 1e-9);
    EXPECT_NEAR(update.grows_left, 0, 1e-9);
    EXPECT_FALSE(update.grows);
    EXPECT_FALSE(update.size_differs);
    EXPECT_NEAR(update.measurement.heading, std::hypot(radiansFromDegrees(6), std::atan2(0.1, 10)), 1e-12);
    EXPECT_NEAR(update.measurement.speed, 5, 1e-9);
    EXPECT_EQ(update.measurement.velocity, cv::Point2d(10, 0));
    EXPECT_EQ(update.size_growth, 0);
}

TEST(MeasurementModel, AnEndGrowsWhereItReachesBeyondByMoreThanNoiseDoes) {
    const OrientedBox predicted{{300, 200}, 20, 10, 0};
    // Twice 4 / √2 = 5.657 px.
    for (const double beyond : {5.6, 5.7}) {
        TrackerOptions options = roundOptions();
        options.size_gate = 9;
        EXPECT_EQ(updated({{300 + beyond / 2, 200}, 20 + beyond, 10, 0}, predicted, options).grows, beyond > 5.657);
        EXPECT_EQ(updated({{300 - beyond / 2, 200}, 20 + beyond, 10, 0}, predicted, options).grows, beyond > 5.657);
        options.one_vehicle = 3;
        EXPECT_EQ(updated({{300, 200 + beyond / 2}, 20, 10 + beyond, 0}, predicted, options).grows, beyond > 5.657);
        EXPECT_EQ(updated({{300, 200 - beyond / 2}, 20, 10 + beyond, 0}, predicted, options).grows, beyond > 5.657);
    }
}

TEST(MeasurementModel, BoxesOfMoreThanAVehicleAreMeasuredWhole) {
    // The predicted and the measured one must both be a vehicle's: 33 × 15 px.
    for (const double length : {32.9, 33.1}) {
        EXPECT_EQ(updated({{300, 200}, 25, 10, 0}, {{300, 200}, length, 10, 0}).by_ends, length < 33);
        EXPECT_EQ(updated({{300, 200}, length, 10, 0}, {{300, 200}, 25, 10, 0}).by_ends, length < 33);
    }
    for (const double width : {14.9, 15.1}) {
        EXPECT_EQ(updated({{300, 200}, 20, 12, 0}, {{300, 200}, 20, width, 0}).by_ends, width < 15);
        EXPECT_EQ(updated({{300, 200}, 20, width, 0}, {{300, 200}, 20, 12, 0}).by_ends, width < 15);
    }
    // Too long by 8, so the centre may be off by 4; too narrow by 6, so it may be off by 3.
    const auto update = updated({{300, 200}, 48, 12, 0}, {{300, 200}, 40, 18, 0});
    EXPECT_FALSE(update.by_ends);
    EXPECT_NEAR(update.measurement.along, 5, 1e-9);
    EXPECT_NEAR(update.measurement.across, std::hypot(3, 3), 1e-9);
    EXPECT_NEAR(update.measurement.length, 4, 1e-9);
    EXPECT_NEAR(update.measurement.width, 4, 1e-9);
}

TEST(MeasurementModel, AClassifiersBoxHasTheLengthOfItsStep) {
    const auto update = updated({{300, 200}, 30, 12, 0}, {{300, 200}, 26, 12, 0}, roundOptions(), {10, 0}, true);
    // Half of 4 px for each end, and a tenth of 30 px that both share.
    const double end = std::hypot(2, 3 / std::sqrt(2.0));
    EXPECT_TRUE(update.by_ends);
    EXPECT_NEAR(update.measurement.length, std::sqrt(2.0) * end, 1e-9);
    EXPECT_NEAR(update.measurement.along, end / std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(update.measurement.width, std::sqrt(2.0) * 2, 1e-9);
    EXPECT_NEAR(update.measurement.across, std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(update.measurement.along_with_length, 0, 1e-9);
    const BoxMeasurement first = modelWith(roundOptions()).first(detectionOf({{300, 200}, 30, 12, 0}, {10, 0}, true));
    EXPECT_NEAR(first.length, std::sqrt(2.0) * end, 1e-9);
    EXPECT_NEAR(first.width, std::sqrt(2.0) * 2, 1e-9);
}

TEST(MeasurementModel, TheSizeGateIsARatioOfAreasBothWays) {
    const OrientedBox predicted{{300, 200}, 20, 10, 0};
    for (const auto& [width, differs] : {std::pair(19.9, false), {20.1, true}, {5.1, false}, {4.9, true}}) {
        for (const bool known : {true, false}) {
            const auto update = updated({{300, 200}, 20, width, 0}, predicted, roundOptions(), {10, 0}, false, known);
            EXPECT_EQ(update.size_differs, differs) << width;
            EXPECT_EQ(std::isfinite(update.measurement.width), !(differs && known)) << width;
            EXPECT_EQ(std::isfinite(update.measurement.length), !(differs && known)) << width;
        }
    }
    TrackerOptions options = roundOptions();
    options.size_gate = 1;
    EXPECT_FALSE(updated({{300, 200}, 20, 40, 0}, predicted, options).size_differs);
}

TEST(MeasurementModel, ASlowDetectionIsSeenInTheTracksAxes) {
    // It lies across; second moments along the track's axes are the same there.
    const OrientedBox predicted{{300, 200}, 20, 10, 0.4};
    const OrientedBox box{{300, 200}, 10, 20, 0.4 + kPi / 2};
    const auto slow = updated(box, predicted, roundOptions(), {0.49, 0});  // five times .1
    EXPECT_NEAR(slow.measurement.box.heading, 0.4, 1e-12);
    EXPECT_NEAR(slow.measurement.box.length, 20, 1e-9);
    EXPECT_NEAR(slow.measurement.box.width, 10, 1e-9);
    EXPECT_EQ(slow.measurement.heading, BoxMeasurement::kUnknown);
    const OrientedBox askew{{300, 200}, 20, 10, 0.4 + kPi / 6};
    const auto turned = updated(askew, predicted, roundOptions(), {0.49, 0});
    EXPECT_NEAR(turned.measurement.box.length, std::sqrt(300 + 25), 1e-9);
    EXPECT_NEAR(turned.measurement.box.width, std::sqrt(100 + 75), 1e-9);
    const auto fast = updated(askew, predicted, roundOptions(), {0.51, 0});
    EXPECT_NEAR(fast.measurement.box.heading, 0.4 + kPi / 6, 1e-12);
    EXPECT_NEAR(fast.measurement.heading, std::hypot(radiansFromDegrees(6), std::atan2(0.1, 0.51)), 1e-12);
    const auto unknown = updated(askew, predicted, roundOptions(), {0, 0});
    EXPECT_NEAR(unknown.measurement.box.heading, 0.4 + kPi / 6, 1e-12);
    EXPECT_NEAR(unknown.measurement.heading, 2 * radiansFromDegrees(6), 1e-12);
    EXPECT_EQ(unknown.measurement.speed, BoxMeasurement::kUnknown);
}

TEST(MeasurementModel, SlowSpeedIsInDeviationsOfTheBackgrounds) {
    // .35 px/frame where the background's deviation is .1.
    const OrientedBox predicted{{300, 200}, 20, 10, 0.4};
    const OrientedBox box{{300, 200}, 20, 10, 0.7};
    for (const auto& [deviations, told] : {std::pair("3", true), {"4", false}, {"0", true}}) {
        TrackerOptions options = roundOptions();
        setParameter(describeOf(options), "tracking.slow_speed", deviations);
        const auto update = updated(box, predicted, options, {0.35, 0});
        EXPECT_EQ(std::isfinite(update.measurement.heading), told) << deviations;
        EXPECT_NEAR(update.measurement.box.heading, told ? 0.7 : 0.4, 1e-12) << deviations;
    }
}

TEST(MeasurementModel, AVelocityIsKnownWhereItIsNotZeroOrVectorsSayThatItIs) {
    Detection detection = detectionOf({{0, 0}, 20, 10, 0}, {0, 0});
    EXPECT_FALSE(velocityKnown(detection));
    detection.velocity = {0, 0.1};
    EXPECT_TRUE(velocityKnown(detection));
    detection.velocity = {-0.1, 0};
    EXPECT_TRUE(velocityKnown(detection));
    detection.velocity = {0, 0};
    detection.vectors = {3};
    EXPECT_TRUE(velocityKnown(detection));
}

TEST(MeasurementModel, ABoxThatTheBorderCutsIsCompletedAwayFromIt) {
    // 12 of 20 px are seen; the border lies at x = 639, corners are tracked up to 4 px from it.
    const OrientedBox seen{{629, 200}, 12, 10, 0};
    const CompletedBox completed = completeAtBorder(seen, 20, 14, kPicture, 4.1);
    EXPECT_TRUE(completed.length_cut);
    EXPECT_FALSE(completed.width_cut);
    EXPECT_NEAR(completed.box.length, 20, 1e-9);
    EXPECT_NEAR(completed.box.centre.x, 633, 1e-9) << "its rear stays where it is";
    EXPECT_NEAR(completed.box.width, 10, 1e-9);
    EXPECT_FALSE(completeAtBorder(seen, 20, 14, kPicture, 3.9).length_cut);
    EXPECT_NEAR(completeAtBorder({{629, 200}, 24, 10, 0}, 20, 14, kPicture, 4).box.length, 24, 1e-9)
        << "never cut down";
    EXPECT_FALSE(completeAtBorder(seen, 20, 14, {}, 4).length_cut);
    // Both ends hidden: nothing tells to which side it goes on.
    const CompletedBox both = completeAtBorder({{300, 3}, 600, 10, kPi / 2}, 700, 10, {640, 300}, 4);
    EXPECT_TRUE(both.length_cut);
    EXPECT_NEAR(both.box.length, 700, 1e-9);
    EXPECT_NEAR(both.box.centre.y, 3, 1e-9);
}

TEST(MeasurementModel, AtTheBorderSizesAreTheTracksOwn) {
    TrackerOptions options = roundOptions();
    options.size_gate = 9;
    // The front is cut: completed to 20 px; its width is measured.
    const auto leaves = updated({{632, 200}, 8, 12, 0}, {{637, 200}, 20, 10, 0}, options);
    EXPECT_NEAR(leaves.measurement.box.length, 20, 1e-9);
    EXPECT_NEAR(leaves.measurement.box.centre.x, 638, 1e-9);
    EXPECT_EQ(leaves.measurement.length, BoxMeasurement::kUnknown);
    EXPECT_NEAR(leaves.measurement.width, 4, 1e-9);
    EXPECT_NEAR(leaves.measurement.along, 3, 1e-9);
    EXPECT_NEAR(leaves.measurement.across, 3, 1e-9);
    EXPECT_FALSE(leaves.by_ends);
    EXPECT_EQ(leaves.size_growth, 0);
    // It comes in: what is seen is already longer than what was known.
    const auto comes = updated({{623, 200}, 26, 10, kPi}, {{626, 200}, 20, 10, kPi}, options, {-10, 0});
    EXPECT_NEAR(comes.measurement.length, 4, 1e-9);
    EXPECT_NEAR(comes.size_growth, 6, 1e-9);
    EXPECT_NEAR(comes.shift.x, -6, 1e-9);
    EXPECT_NEAR(comes.shift.y, 0, 1e-9);
    const auto sideways = updated({{300, 470}, 20, 13, 0}, {{300, 471.5}, 20, 10, 0}, options);
    EXPECT_NEAR(sideways.size_growth, 3, 1e-9);
    EXPECT_NEAR(sideways.shift.y, 3, 1e-9);
    EXPECT_NEAR(sideways.measurement.width, 4, 1e-9);
    // In a corner both grow; the larger one counts.
    const auto corner = updated({{624, 468}, 23, 15, 0}, {{625, 470}, 20, 10, 0}, options);
    EXPECT_NEAR(corner.size_growth, 5, 1e-9);
    EXPECT_NEAR(corner.shift.x, 3, 1e-9);
    EXPECT_NEAR(corner.shift.y, 5, 1e-9);
}

TEST(MeasurementModel, OnlyWhatWasAtTheBorderComesInOverIt) {
    TrackerOptions options = roundOptions();
    // Within 8 px of the border the prediction is taken to be cut: 639 − 8 = 631.
    const auto grows = [&](double front) {
        return updated({{626, 200}, 24, 14, 0}, {{front - 10, 200}, 20, 8, 0}, options);
    };
    EXPECT_NEAR(grows(631.5).size_growth, 4, 1e-9);
    EXPECT_FALSE(grows(631.5).size_differs);
    EXPECT_EQ(grows(630.5).size_growth, 0);
    EXPECT_TRUE(grows(630.5).size_differs) << "any other one that grows is merged with something";
    EXPECT_EQ(grows(630.5).measurement.width, BoxMeasurement::kUnknown);
    // What shrinks at the border is not doubted.
    EXPECT_FALSE(updated({{634, 200}, 5, 4, 0}, {{626, 200}, 20, 10, 0}, options).size_differs);
    options.complete_at_border = false;
    EXPECT_EQ(grows(631.5).size_growth, 0);
}

TEST(MeasurementModel, ProcessNoiseIsInFramesAndHasFloors) {
    TrackerOptions options;
    options.acceleration_m_s2 = 5;
    options.turn_rate_deg = 50;
    options.size_rate_m = 0.5;
    const BoxProcessNoise noise = MeasurementModel(options, kFourToAMetre).processNoise({});
    EXPECT_NEAR(noise.acceleration, 5 / 0.25 / 625, 1e-12);
    EXPECT_NEAR(noise.heading, radiansFromDegrees(2), 1e-12);
    EXPECT_NEAR(noise.size, 2, 1e-12);
    EXPECT_NEAR(noise.position, 0.05, 1e-12);
    options.acceleration_m_s2 = 0.01;
    options.size_rate_m = 0;
    const BoxProcessNoise least = MeasurementModel(options, kFourToAMetre).processNoise({});
    EXPECT_NEAR(least.acceleration, 0.004, 1e-12);
    EXPECT_NEAR(least.size, 0.01, 1e-12);
}

TEST(MeasurementModel, TheBackgroundsSpeedSaysWhatIsSlow) {
    MeasurementModel model(TrackerOptions{}, kFourToAMetre);
    model.startFrame(kPicture, 0.03);
    EXPECT_NEAR(model.slowSpeed(), 0.15, 1e-12);
    model.startFrame(kPicture, 0.001);
    EXPECT_NEAR(model.backgroundSpeedSigma(), 0.01, 1e-12) << "no registration is better";
    model.startFrame(kPicture, NAN);
    EXPECT_NEAR(model.slowSpeed(), 0.05, 1e-12);
}

TEST(MeasurementModel, VectorsTellPlacesBetterThanHeadings) {
    Reconstruction rebuilt;
    rebuilt.box = {{300, 200}, 20, 10, 0};
    rebuilt.velocity = {6, 8};
    MeasurementModel model = modelWith(roundOptions());
    BoxMeasurement placed = model.reconstructed(rebuilt);
    EXPECT_NEAR(placed.along, 3, 1e-12);
    EXPECT_NEAR(placed.speed, 5, 1e-12);
    EXPECT_EQ(placed.velocity, cv::Point2d(6, 8));
    EXPECT_EQ(placed.heading, BoxMeasurement::kUnknown);
    rebuilt.heading_known = true;
    placed = model.reconstructed(rebuilt);
    EXPECT_NEAR(placed.heading, 2 * std::hypot(radiansFromDegrees(6), std::atan2(0.1, 10)), 1e-12);
    TrackerOptions options = roundOptions();
    options.measure_velocity = false;
    EXPECT_EQ(modelWith(options).reconstructed(rebuilt).speed, BoxMeasurement::kUnknown);
}

TEST(MeasurementModel, AQuarterTurnOfThePictureTurnsTheMeasurement) {
    const test::QuarterTurn turn{kPicture};
    std::mt19937 random(4);
    std::uniform_real_distribution<double> share(0, 1);
    MeasurementModel upright = modelWith(TrackerOptions{});
    MeasurementModel turned(TrackerOptions{}, kFourToAMetre);
    turned.startFrame(turn.image(), 0.1);
    int cut = 0;
    for (int round = 0; round < 300; ++round) {
        // A third of them beside the border.
        const double x = round % 3 == 0 ? 640 * (share(random) < 0.5) : 640 * share(random);
        const OrientedBox predicted{
            {x, 480 * share(random)}, 12 + 20 * share(random), 6 + 8 * share(random), 6 * share(random)};
        OrientedBox box = predicted;
        box.centre += cv::Point2d(4 * share(random) - 2, 4 * share(random) - 2);
        box.length *= 0.5 + share(random);
        box.width *= 0.5 + share(random);
        box.heading += 0.4 * share(random);
        Detection seen = detectionOf(box, share(random) * box.direction(), round % 2 == 0);
        const auto update = upright.update(box, seen, predicted, round % 5 == 0);
        seen.box = turn(box);
        seen.velocity = turn.vector(seen.velocity);
        const auto after = turned.update(seen.box, seen, turn(predicted), round % 5 == 0);
        test::expectAlike(after.measurement.box, turn(update.measurement.box), 1e-9);
        const auto same = [&](double a, double b) { EXPECT_TRUE(a == b || std::abs(a - b) < 1e-9) << round; };
        same(after.measurement.along, update.measurement.along);
        same(after.measurement.across, update.measurement.across);
        same(after.measurement.length, update.measurement.length);
        same(after.measurement.width, update.measurement.width);
        same(after.measurement.heading, update.measurement.heading);
        same(after.measurement.along_with_length, update.measurement.along_with_length);
        same(after.measurement.across_with_width, update.measurement.across_with_width);
        same(after.size_growth, update.size_growth);
        same(after.grows_left, update.grows_left);
        same(after.grows_right, update.grows_right);
        const cv::Point2d apart = after.shift - turn.vector(update.shift);
        EXPECT_LT(std::hypot(apart.x, apart.y), 1e-9);
        cut += update.measurement.box.length != seen.box.length;
    }
    EXPECT_GT(cut, 20);
}

}  // namespace eyrie::measurement_model_test

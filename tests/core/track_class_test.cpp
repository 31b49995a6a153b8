#include "core/labels/track_class.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/parameter.h"

namespace eyrie::track_class_test {
namespace {

constexpr double kGsd = 0.2;  // m/px
constexpr double kRate = 25;  // Hz

SceneScale known() {
    return {kGsd, kRate, true};
}

/// Metres and m/s as they are in the image, for two seconds.
TrackExtent extent(double length_m, double width_m, double speed_m_s, const SceneScale& scale = known()) {
    return {50, scale.px(length_m), scale.px(width_m), scale.pxPerFrame(speed_m_s)};
}

TrackClass classed(double length_m, double width_m, double speed_m_s) {
    return classOf(extent(length_m, width_m, speed_m_s), known(), {});
}

TEST(TrackClass, SizeAndSpeedOnTheGroundDecide) {
    EXPECT_EQ(classed(4.5, 1.8, 14), TrackClass::vehicle);
    EXPECT_EQ(classed(4.5, 1.8, 1), TrackClass::vehicle) << "in a queue";
    EXPECT_EQ(classed(18, 2.6, 14), TrackClass::vehicle);
    EXPECT_EQ(classed(2.1, 0.8, 14), TrackClass::two_wheeler) << "a motorcycle";
    EXPECT_EQ(classed(1.8, 0.6, 1), TrackClass::two_wheeler) << "a bicycle that is pushed";
    EXPECT_EQ(classed(0.6, 0.6, 1.4), TrackClass::person);
    EXPECT_EQ(classed(0.8, 0.7, 3), TrackClass::person) << "running";
}

TEST(TrackClass, PartsOfVehiclesAreNoPersonsAndNoTwoWheelers) {
    EXPECT_EQ(classed(1.0, 0.9, 12), TrackClass::unknown) << "a headlamp, too fast for a person";
    EXPECT_EQ(classed(2.0, 1.8, 12), TrackClass::vehicle) << "the front half of a car";
    EXPECT_EQ(classed(4.2, 0.9, 12), TrackClass::vehicle) << "its side";
}

TEST(TrackClass, WhatIsSmallMustHaveBeenFollowedForASecond) {
    TrackExtent rider = extent(2, 0.8, 8);
    TrackExtent car = extent(4.5, 1.8, 8);
    rider.states = car.states = 24;  // of 25 a second
    EXPECT_EQ(classOf(rider, known(), {}), TrackClass::unknown) << "it may be a part of a car";
    EXPECT_EQ(classOf(car, known(), {}), TrackClass::vehicle);
    rider.states = 25;
    EXPECT_EQ(classOf(rider, known(), {}), TrackClass::two_wheeler);
    TrackClassOptions at_once;
    at_once.min_life_s = 0;
    rider.states = 1;
    EXPECT_EQ(classOf(rider, known(), at_once), TrackClass::two_wheeler);
}

TEST(TrackClass, NothingIsToldWhereMetresMeanNothing) {
    const SceneScale fallback;
    EXPECT_EQ(classOf(extent(4.5, 1.8, 14, fallback), fallback, {}), TrackClass::unknown);
    EXPECT_EQ(classOf(extent(0.6, 0.6, 1, fallback), fallback, {}), TrackClass::unknown);
    EXPECT_EQ(classOf({}, known(), {}), TrackClass::unknown);
    const double none = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(classOf({50, none, 5, 1}, known(), {}), TrackClass::unknown);
    EXPECT_EQ(classOf({50, 5, 5, none}, known(), {}), TrackClass::unknown);
}

TEST(TrackClass, AnEstimatedScaleMakesItMoreCareful) {
    const SceneScale estimated{kGsd, kRate, false};
    // 2.5 m is the limit, of which four fifths hold: 2 m.
    EXPECT_EQ(classOf(extent(1.9, 0.8, 14), estimated, {}), TrackClass::two_wheeler);
    EXPECT_EQ(classOf(extent(2.1, 0.8, 14), estimated, {}), TrackClass::vehicle);
    EXPECT_EQ(classOf(extent(2.1, 0.8, 14), known(), {}), TrackClass::two_wheeler);
}

TEST(TrackClass, LimitsAreParameters) {
    TrackClassOptions options;
    setParameter(describeOf(options), "classes.two_wheeler_length", "2");
    EXPECT_EQ(classOf(extent(2.1, 0.8, 14), known(), options), TrackClass::vehicle);
    setParameter(describeOf(options), "classes.person_speed", "1");
    EXPECT_EQ(classOf(extent(0.6, 0.6, 1.4), known(), options), TrackClass::unknown);
    setParameter(describeOf(options), "classes.two_wheeler_width", "0");
    EXPECT_EQ(classOf(extent(0.6, 0.6, 1.4), known(), options), TrackClass::vehicle) << "everything is a vehicle then";
}

TEST(TrackClass, WordsOfFilesBelongToClasses) {
    for (const char* word : {"car", "truck", "bus", "van", "vehicle"})
        EXPECT_EQ(trackClassOf(word), TrackClass::vehicle) << word;
    for (const char* word : {"motorcycle", "bicycle", "two_wheeler"})
        EXPECT_EQ(trackClassOf(word), TrackClass::two_wheeler) << word;
    EXPECT_EQ(trackClassOf("person"), TrackClass::person);
    for (const char* word : {"", "other", "Car", "tram"}) EXPECT_EQ(trackClassOf(word), TrackClass::unknown) << word;
    for (const TrackClass one : {TrackClass::unknown, TrackClass::vehicle, TrackClass::two_wheeler, TrackClass::person})
        EXPECT_EQ(trackClassOf(wordOf(one)), one);
}

TEST(TrackClass, TheCommonestWordOfAClassBelongsToIt) {
    EXPECT_STREQ(commonestWordOf(TrackClass::vehicle), "car");
    EXPECT_STREQ(commonestWordOf(TrackClass::two_wheeler), "motorcycle");
    for (const TrackClass one : {TrackClass::unknown, TrackClass::vehicle, TrackClass::two_wheeler, TrackClass::person})
        EXPECT_EQ(trackClassOf(commonestWordOf(one)), one);
}

TEST(TrackClass, AllBoxesOfATrackGetTheClassOfItsMeans) {
    BoxesByFrame boxes;
    const auto add = [&](FrameIndex frame, std::optional<int> id, double length_m) {
        BoxRecord record;
        record.frame = frame;
        record.id = id;
        record.box = {{50, 50}, known().px(length_m), known().px(1), 0};
        record.velocity = {known().pxPerFrame(10), 0};
        record.object_class = "before";
        boxes[frame].push_back(record);
    };
    add(0, 1, 2.0);  // 3 m on average
    add(1, 1, 4.0);
    add(0, 2, 2.0);
    add(1, {}, 2.0);
    TrackClassOptions at_once;
    at_once.min_life_s = 0;
    nameClasses(boxes, known(), at_once);
    EXPECT_EQ(boxes[0][0].object_class, "vehicle");
    EXPECT_EQ(boxes[1][0].object_class, "vehicle");
    EXPECT_EQ(boxes[0][1].object_class, "two_wheeler");
    EXPECT_EQ(boxes[1][1].object_class, "before") << "no track";
    nameClasses(boxes, {}, {});
    EXPECT_EQ(boxes[0][0].object_class, "") << "without a scale nothing is told";
}

TEST(TrackClass, InAnObliqueViewBoxesAreMeasuredWhereTheyAre) {
    SceneScale scale = known();
    scale.slope = ScaleSlope::ofPicture({201, 101}, 0, 0.01);
    // At the lower edge a metre has half as many pixels more: 7.5 instead of 5.
    const auto classAtTheEdge = [&](double length_px, double width_px, cv::Point2d velocity) {
        BoxesByFrame boxes;
        BoxRecord record;
        record.id = 1;
        record.box = {{100, 100}, length_px, width_px, 0};
        record.velocity = velocity;
        boxes[0].push_back(record);
        TrackClassOptions at_once;
        at_once.min_life_s = 0;
        nameClasses(boxes, scale, at_once);
        return boxes[0][0].object_class;
    };
    EXPECT_EQ(classAtTheEdge(15, 7.5, {}), "two_wheeler") << "2 m long, 1 m wide";
    EXPECT_EQ(classAtTheEdge(20, 7.5, {}), "vehicle") << "2.7 m long";
    EXPECT_EQ(classAtTheEdge(15, 10, {}), "vehicle") << "1.33 m wide";
    EXPECT_EQ(classAtTheEdge(6, 6, {0, 1}), "person") << "at 3.3 m/s";
    EXPECT_EQ(classAtTheEdge(6, 6, {1, 0}), "person");
    EXPECT_EQ(classAtTheEdge(6, 6, {0, 1.2}), "") << "at 4 m/s";
    EXPECT_EQ(classAtTheEdge(6, 6, {1.2, 0}), "");
}

}  // namespace
}  // namespace eyrie::track_class_test

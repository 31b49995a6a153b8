/// What boxes do on the ground, worked out by hand.
#include "formats/track_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie::track_world_test {
namespace {

const LocalPlane kPlane(GeoPoint{48, 11});

LabelBox boxAt(cv::Point2d centre, double heading, cv::Point2d velocity) {
    LabelBox box;
    box.frame = 7;
    box.box = {centre, 20, 10, heading};
    box.velocity = velocity;
    return box;
}

/// Half a metre a pixel along x, a quarter along y; right of x = 500 another ground.
TrackWorld onTheGround() {
    TrackWorld world;
    world.frame_rate_hz = 10;
    world.ground = [](FrameIndex, cv::Point2d px) {
        return std::optional(TrackWorld::GroundPlace{px.x > 500 ? 1 : 0, {px.x / 2, px.y / 4}});
    };
    return world;
}

/// Two metres a pixel; the picture's top to the north, known left of x = 800.
void placeOnEarth(TrackWorld& world) {
    world.place = [](FrameIndex, cv::Point2d px) {
        return px.x < 800 ? std::optional(kPlane.placeOf({2 * px.x, -2 * px.y})) : std::nullopt;
    };
}

}  // namespace

TEST(GroundStates, AreMeasuredAlongTheAxesOfTheBox) {
    const TrackWorld world = onTheGround();
    const GroundState along = groundStateOf(&world, boxAt({100, 100}, 0, {3, 16}));
    EXPECT_NEAR(along.length_m.value(), 10, 1e-9);
    EXPECT_NEAR(along.width_m.value(), 2.5, 1e-9);
    EXPECT_NEAR(along.speed_km_h.value(), std::hypot(1.5, 4) * 10 * 3.6, 1e-9);
    EXPECT_FALSE(along.course_deg) << "nobody knows where north is";
    const GroundState down = groundStateOf(&world, boxAt({100, 100}, CV_PI / 2, {0, 0}));
    EXPECT_NEAR(down.length_m.value(), 5, 1e-9);
    EXPECT_NEAR(down.width_m.value(), 5, 1e-9);
    EXPECT_EQ(down.speed_km_h, 0);
}

TEST(GroundStates, AcrossTwoGroundsTheEarthIsTheMeasure) {
    TrackWorld world = onTheGround();
    const LabelBox across = boxAt({495, 100}, 0, {2, 0});  // from 485 to 505
    EXPECT_FALSE(groundStateOf(&world, across).length_m);
    EXPECT_TRUE(groundStateOf(&world, across).width_m);
    placeOnEarth(world);
    EXPECT_NEAR(groundStateOf(&world, across).length_m.value(), 40, 0.01);
    EXPECT_NEAR(groundStateOf(&world, across).width_m.value(), 2.5, 1e-9) << "the run's scale where it can be had";
    world.ground = {};
    EXPECT_NEAR(groundStateOf(&world, across).width_m.value(), 20, 0.01);
    const LabelBox at_the_end = boxAt({795, 100}, 0, {2, 0});
    EXPECT_FALSE(groundStateOf(&world, at_the_end).length_m) << "of one end nobody knows where it is";
    EXPECT_TRUE(groundStateOf(&world, at_the_end).speed_km_h);
}

TEST(GroundStates, ACourseIsClockwiseFromNorthOfWhatMoves) {
    TrackWorld world = onTheGround();
    placeOnEarth(world);
    const auto courseOf = [&](cv::Point2d velocity) {
        return groundStateOf(&world, boxAt({100, 100}, 0, velocity)).course_deg;
    };
    EXPECT_NEAR(courseOf({0, -5}).value(), 0, 1e-6);
    EXPECT_NEAR(courseOf({5, 0}).value(), 90, 1e-3);
    EXPECT_NEAR(std::abs(courseOf({0, 5}).value()), 180, 1e-6);
    // 1 km/h are 1 / 36 m in a tenth of a second, and so .0556 px along x.
    EXPECT_FALSE(courseOf({0.055, 0}));
    EXPECT_TRUE(courseOf({0.056, 0}));
    EXPECT_FALSE(groundStateOf(&world, boxAt({799, 100}, 0, {5, 0})).course_deg) << "it leads where nobody knows";
    EXPECT_FALSE(groundStateOf(nullptr, boxAt({100, 100}, 0, {5, 0})).speed_km_h);
    const TrackWorld nothing;
    EXPECT_FALSE(groundStateOf(&nothing, boxAt({100, 100}, 0, {5, 0})).speed_km_h);
}

}  // namespace eyrie::track_world_test

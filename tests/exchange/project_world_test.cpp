#include "exchange/project_world.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

/// When and where the boxes of a run were: what is known by what the run, the video and a person say, and what is not.
namespace eyrie::project_world_test {
namespace {

/// The place of a pixel where 0.25 m are one, north is up and the corner lies at 50° N, 8° E.
GeoPoint placeOf(cv::Point2d px) {
    constexpr double kMetresPerDegree = 111'200;
    return {50 - 0.25 * px.y / kMetresPerDegree, 8 + 0.25 * px.x / kMetresPerDegree / std::cos(radiansFromDegrees(50))};
}

class ProjectWorld : public testing::Test {
 protected:
    std::shared_ptr<const TrackWorld> world(bool gsd_known, std::optional<std::int64_t> start,
                                            std::vector<ControlPoint> control) {
        RunRecord planned;
        planned.sequence = {.path = "/nowhere/clip.mp4", .size = {320, 240}, .frame_count = 10, .frame_rate_hz = 25};
        planned.scale = {0.25, 25, gsd_known, {}};
        const auto path = folder_ / "p.eyrie";
        const RunRecord run = test::writeRun(path, planned, [](int frame, FrameResult& result) {
            result.motion.time_us = std::int64_t{40'000} * frame;
            // The camera moves on by 2 px a frame; nothing joins frames 6 and 7.
            result.motion.registration.current_from_previous.matrix(0, 2) = -2;
            if (frame == 7) result.motion.registration.state = RegistrationState::first;
        });
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        return trackWorldOf(RunStore(project), run, nullptr, start, {}, std::move(control));
    }
    test::TemporaryFolder folder_;
};

TEST_F(ProjectWorld, WithoutVideoAndPersonOnlySecondsAreKnown) {
    const auto known = world(false, {}, {});
    EXPECT_NEAR(known->seconds(5), 0.2, 1e-6);
    EXPECT_EQ(known->frame_rate_hz, 25);
    EXPECT_FALSE(known->ground);
    EXPECT_FALSE(known->utc_us);
    EXPECT_FALSE(known->place);
    EXPECT_FALSE(known->height);
    EXPECT_FALSE(known->no_clock.empty());
    EXPECT_FALSE(known->no_place.empty());
    EXPECT_TRUE(known->clock_origin.empty());
    EXPECT_TRUE(known->place_origin.empty());
}

TEST_F(ProjectWorld, WithAScaleTheGroundIsThatOfEachStretch) {
    const auto known = world(true, {}, {});
    ASSERT_TRUE(known->ground);
    const auto first = known->ground(0, {40, 20});
    const auto later = known->ground(5, {40, 20});
    const auto behind = known->ground(8, {40, 20});
    ASSERT_TRUE(first && later && behind);
    EXPECT_EQ(first->stretch, later->stretch);
    EXPECT_NEAR(later->metres.x - first->metres.x, 5 * 2 * 0.25, 1e-6);
    EXPECT_NEAR(later->metres.y, first->metres.y, 1e-6);
    EXPECT_NE(behind->stretch, first->stretch);
    EXPECT_FALSE(known->ground(99, {40, 20}));
}

TEST_F(ProjectWorld, APersonSaysWhenAndWhereButNotHowHigh) {
    const std::int64_t start = 1'700'000'000'000'000;
    std::vector<ControlPoint> control;
    for (const cv::Point2d px :
         {cv::Point2d(20, 20), cv::Point2d(300, 20), cv::Point2d(300, 220), cv::Point2d(20, 220)})
        control.push_back({0, px, placeOf(px)});
    const auto known = world(false, start, control);
    ASSERT_TRUE(known->utc_us);
    EXPECT_EQ(known->utc_us(0), start);
    EXPECT_EQ(known->utc_us(5), start + 200'000);
    EXPECT_FALSE(known->clock_origin.empty());
    EXPECT_TRUE(known->no_clock.empty());
    ASSERT_TRUE(known->place);
    const auto place = known->place(0, {160, 120});
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->latitude_deg, placeOf({160, 120}).latitude_deg, 2e-7);
    EXPECT_NEAR(place->longitude_deg, placeOf({160, 120}).longitude_deg, 2e-7);
    EXPECT_FALSE(known->place_origin.empty());
    EXPECT_TRUE(known->no_place.empty());
    ASSERT_TRUE(known->height);
    EXPECT_FALSE(known->height(0)) << "places on a map have none";
}

}  // namespace
}  // namespace eyrie::project_world_test

/// Which stack a vector joins, and when a detection gets its own, where several objects are near (Teutsch §5.3.1,
/// §5.3.2).
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "core/geometry/angle.h"
#include "core/state_archive.h"
#include "stacking/image_stacker.h"

namespace eyrie::rival_stacks_test {
namespace {

using Ids = std::set<CornerId>;

SceneScale quarterMetre() {
    SceneScale scale;
    scale.gsd_m_per_px = 0.25;
    scale.gsd_known = true;
    return scale;
}

Frame plainFrame(FrameIndex index) {
    Frame frame;
    frame.index = index;
    frame.gray = cv::Mat(480, 640, CV_8UC1, cv::Scalar(90));
    return frame;
}

/// Corners at places that do not change, all moving to the right, in one cluster.
struct Traffic {
    std::map<CornerId, cv::Point2f> places;
    cv::Point2f velocity{1.5F, 0};
    std::map<CornerId, cv::Point2f> other_velocities{};
    Ids without_cluster{};

    FrameMotion motion() const {
        FrameMotion motion;
        motion.image_size = {640, 480};
        motion.registration.state = RegistrationState::registered;
        for (const auto& [id, place] : places) {
            const auto other = other_velocities.find(id);
            motion.motion_vectors.push_back(
                {id, place, other == other_velocities.end() ? velocity : other->second, 10});
        }
        return motion;
    }
    std::vector<MotionCluster> clusters() const {
        MotionCluster cluster;
        cluster.velocity = velocity;
        std::vector<cv::Point2d> points;
        int index = 0;
        for (const auto& [id, place] : places) {
            if (!without_cluster.count(id)) {
                cluster.members.push_back(index);
                points.push_back(place);
            }
            ++index;
        }
        cluster.box = boxAround(points, std::atan2(velocity.y, velocity.x));
        return {cluster};
    }
    Detection detectionOf(const Ids& ids) const {
        Detection detection;
        int index = 0;
        for (const auto& [id, place] : places) {
            if (ids.count(id)) detection.vectors.push_back(index);
            ++index;
        }
        return detection;
    }
    void update(ImageStacker& stacker) const { stacker.update(plainFrame(0), motion(), clusters()); }
    void remember(ImageStacker& stacker, const std::vector<Ids>& detections) const {
        std::vector<Detection> found;
        for (const Ids& ids : detections) found.push_back(detectionOf(ids));
        stacker.remember(motion(), found);
    }
};

std::vector<StackView> viewsOf(const ImageStacker& stacker) {
    return stacker.views(plainFrame(0), StackPictures::none);
}

std::set<Ids> groupsOf(const ImageStacker& stacker) {
    std::set<Ids> groups;
    for (const StackView& view : viewsOf(stacker)) groups.insert(Ids(view.related.begin(), view.related.end()));
    return groups;
}

StackingOptions withNeighbours(int k) {
    StackingOptions options = StackingOptions::thesis();
    options.neighbours = k;
    return options;
}

/// The stack whose rivals' vectors lie so around a newcomer: 1 or 2; 0 where it joins none.
int joinedStack(const std::vector<cv::Point2f>& first, const std::vector<cv::Point2f>& second, int k,
                CornerId newcomer_id) {
    const cv::Point2f newcomer(200, 200);
    Traffic traffic;
    std::vector<Ids> detections(2);
    CornerId id = 10;
    for (const cv::Point2f& away : first) detections[0].insert(id), traffic.places[id++] = newcomer + away;
    for (const cv::Point2f& away : second) detections[1].insert(id), traffic.places[id++] = newcomer + away;
    ImageStacker stacker(withNeighbours(k), quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, detections);
    traffic.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{detections[0], detections[1]}));
    traffic.places[newcomer_id] = newcomer;
    traffic.update(stacker);
    for (const StackView& view : viewsOf(stacker)) {
        const Ids related(view.related.begin(), view.related.end());
        if (related.count(newcomer_id)) return related.count(10) ? 1 : 2;
    }
    return 0;
}

int joinedStack(const std::vector<cv::Point2f>& first, const std::vector<cv::Point2f>& second, int k) {
    const int joined = joinedStack(first, second, k, 99);
    EXPECT_EQ(joinedStack(first, second, k, 1), joined) << "wherever it stands in the list";
    return joined;
}

}  // namespace

TEST(RivalStacks, MostOfTheNearestNeighboursDecide) {
    const std::vector<cv::Point2f> near_and_far{{3, 0}, {30, 0}, {40, 0}};
    const std::vector<cv::Point2f> between{{-5, 0}, {0, -6}, {35, 4}};
    EXPECT_EQ(joinedStack(near_and_far, between, 1), 1) << "the nearest";
    EXPECT_EQ(joinedStack(near_and_far, between, 3), 2) << "two of three";
    EXPECT_EQ(joinedStack(between, near_and_far, 1), 2);
    EXPECT_EQ(joinedStack(between, near_and_far, 3), 1);
    EXPECT_EQ(joinedStack(near_and_far, between, 2), 1) << "of equally many the nearest";
    EXPECT_EQ(joinedStack(between, near_and_far, 2), 2);
    EXPECT_EQ(joinedStack(near_and_far, {{-5, 0}}, 25), 1) << "more neighbours than there are";
}

TEST(RivalStacks, NearIsMeantInEveryDirection) {
    for (const cv::Point2f near : {cv::Point2f(4, 0), {0, 4}, {-4, 0}, {0, -4}, {2.5F, 2.5F}, {-2.5F, 2.5F}}) {
        for (const cv::Point2f far : {cv::Point2f(5, 0), {0, 5}, {-5, 0}, {0, -5}, {3.5F, -3.5F}, {-3.5F, -3.5F}}) {
            EXPECT_EQ(joinedStack({near}, {far}, 1), 1) << near << far;
            EXPECT_EQ(joinedStack({far}, {near}, 1), 2) << near << far;
        }
    }
}

TEST(RivalStacks, AStackStartsInTheMedianOfItsDetection) {
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {104, 61}}, {4, {180, 90}}}};
    traffic.other_velocities = {{1, {1.25F, 0.25F}}, {3, {1, 0.125F}}};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    EXPECT_TRUE(viewsOf(stacker).empty()) << "nothing was detected yet";
    traffic.remember(stacker, {{1, 2, 3, 4}});
    traffic.update(stacker);
    ASSERT_EQ(viewsOf(stacker).size(), 1U);
    const StackView view = viewsOf(stacker)[0];
    EXPECT_EQ(view.pose.position, cv::Point2d(104, 54)) << "the lower of two middle values";
    EXPECT_EQ(view.pose.velocity, cv::Point2d(1.25, 0));
    EXPECT_NEAR(view.pose.heading, 0, 1e-12);
    EXPECT_EQ(view.height, 1);
    EXPECT_EQ(view.related, (std::vector<CornerId>{1, 2, 3, 4}));
}

TEST(RivalStacks, OnlyKeptDetectionsOfClusteredCornersStartStacks) {
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {104, 61}}, {4, {180, 90}}, {5, {102, 52}}}};
    traffic.without_cluster = {2};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    Detection rejected = traffic.detectionOf({4});
    rejected.rejection = Rejection::outlier;
    FrameMotion motion = traffic.motion();
    motion.motion_vectors[2].age = 0;  // inferred: gone in the next frame
    stacker.remember(motion, {rejected, traffic.detectionOf({1, 2, 3, 5}), traffic.detectionOf({3})});
    traffic.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{{1, 5}}));
}

TEST(RivalStacks, ADetectionWithAStackStartsNoOther) {
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {104, 61}}, {4, {120, 50}}}};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2, 3, 4}});
    traffic.update(stacker);
    for (int frame = 0; frame < 3; ++frame) {
        traffic.remember(stacker, {{1, 2, 3, 4}});
        traffic.update(stacker);
    }
    ASSERT_EQ(viewsOf(stacker).size(), 1U);
    EXPECT_EQ(viewsOf(stacker)[0].height, 4);
    traffic.remember(stacker, {{1, 2}});  // half of the stack: it might still be its object
    traffic.update(stacker);
    EXPECT_EQ(viewsOf(stacker).size(), 1U);
}

TEST(RivalStacks, WhatSharedAStackGetsItsOwn) {
    Traffic traffic{
        .places = {{1, {100, 50}}, {2, {110, 54}}, {3, {104, 61}}, {4, {120, 50}}, {5, {160, 50}}, {6, {165, 54}}}};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2, 3, 4, 5, 6}});
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2, 3, 4}, {5, 6}});
    traffic.update(stacker);
    traffic.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{{1, 2, 3, 4}, {5, 6}}));
    const auto views = viewsOf(stacker);
    ASSERT_EQ(views.size(), 2U);
    EXPECT_EQ(views[0].id, 1);
    EXPECT_EQ(views[0].height, 3);
    EXPECT_EQ(views[1].id, 2);
    EXPECT_EQ(views[1].height, 2);
}

TEST(RivalStacks, StackAreasStayWithinReasonWhateverTheScale) {
    for (const auto& [gsd, size] : {std::pair(0.01, cv::Size(1024, 2048)), {5.0, cv::Size(16, 32)}}) {
        SceneScale scale = quarterMetre();
        scale.gsd_m_per_px = gsd;
        Traffic traffic{.places = {{1, {100, 50}}}};
        ImageStacker stacker(StackingOptions::thesis(), scale);
        traffic.update(stacker);
        traffic.remember(stacker, {{1}});
        traffic.update(stacker);
        EXPECT_EQ(stacker.views(plainFrame(0), StackPictures::whole_area).at(0).stacked.size(), size);
    }
}

TEST(RivalStacks, AStackDiesWithItsVectorsAndAllWithAReset) {
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {200, 61}}, {4, {210, 50}}}};
    StackingOptions options = StackingOptions::thesis();
    options.follow_lone_vectors = false;
    ImageStacker stacker(options, quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2}, {3, 4}});
    traffic.update(stacker);
    Traffic fewer = traffic;
    fewer.places.erase(1);
    fewer.places.erase(2);
    fewer.without_cluster = {4};
    fewer.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{{3}})) << "a corner without a cluster is lost, too";
    traffic.remember(stacker, {{1, 2}, {3, 4}});
    stacker.reset();
    EXPECT_TRUE(viewsOf(stacker).empty());
    traffic.update(stacker);
    EXPECT_TRUE(viewsOf(stacker).empty()) << "nothing is remembered";
}

TEST(RivalStacks, InTheThesisVectorsOutsideEveryClusterCarryTheirStack) {
    EXPECT_FALSE(StackingOptions{}.follow_lone_vectors);
    // A master at (100, 50), 10 px behind and 4 px to the left of the second vector; the third is somebody else.
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {300, 90}}}};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2}});
    traffic.update(stacker);
    traffic.without_cluster = {1, 2};
    traffic.places[1] += cv::Point2f(2, 1);
    traffic.places[2] += cv::Point2f(2, 1);
    traffic.update(stacker);
    ASSERT_EQ(groupsOf(stacker), (std::set<Ids>{{1, 2}}));
    EXPECT_EQ(viewsOf(stacker)[0].pose.position, cv::Point2d(102, 51));
    EXPECT_EQ(viewsOf(stacker)[0].height, 2);
    // By its own direction: the second has turned down, and the master lies behind and to the left of it still.
    traffic.places.erase(1);
    traffic.places[2] = {200, 100};
    traffic.other_velocities[2] = {0, 1.5F};
    traffic.update(stacker);
    ASSERT_EQ(groupsOf(stacker), (std::set<Ids>{{2}}));
    EXPECT_NEAR(viewsOf(stacker)[0].pose.position.x, 204, 1e-5);
    EXPECT_NEAR(viewsOf(stacker)[0].pose.position.y, 90, 1e-5);
    EXPECT_NEAR(viewsOf(stacker)[0].pose.heading, kPi / 2, 1e-6);
    traffic.places.erase(2);
    traffic.update(stacker);
    EXPECT_TRUE(viewsOf(stacker).empty()) << "it goes with its last vector";
}

TEST(RivalStacks, AFrameThatWasNotRegisteredChangesNothing) {
    Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}}};
    ImageStacker stacker(StackingOptions::thesis(), quarterMetre());
    traffic.update(stacker);
    traffic.remember(stacker, {{1, 2}});
    traffic.update(stacker);
    FrameMotion lost = traffic.motion();
    lost.registration.state = RegistrationState::failed;
    stacker.update(plainFrame(1), lost, traffic.clusters());
    ASSERT_EQ(viewsOf(stacker).size(), 1U);
    EXPECT_EQ(viewsOf(stacker)[0].height, 1);
    traffic.update(stacker);
    EXPECT_EQ(viewsOf(stacker)[0].height, 2);
}

TEST(RivalStacks, KMeansStartsOneStackForEachVehicleLength) {
    // 4.5 m are 18 px. Two groups of corners in a cluster of 36 px: two vehicles.
    StackingOptions options = StackingOptions::thesis();
    options.initialisation = StackInitialisation::k_means;
    Traffic two{
        .places = {
            {1, {100, 100}}, {2, {104, 103}}, {3, {102, 106}}, {4, {130, 100}}, {5, {134, 103}}, {6, {136, 106}}}};
    ImageStacker stacker(options, quarterMetre());
    two.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{{1, 2, 3}, {4, 5, 6}}));
    options.vehicle_length_m = 9;
    ImageStacker longer(options, quarterMetre());
    two.update(longer);
    EXPECT_EQ(groupsOf(longer), (std::set<Ids>{{1, 2, 3, 4, 5, 6}}));

    // Side by side and of different speed: what moves alike belongs together.
    options.vehicle_length_m = 4.5;
    Traffic mixed{
        .places = {
            {1, {100, 100}}, {2, {101, 100}}, {3, {136, 100}}, {4, {135, 100}}, {5, {100, 101}}, {6, {136, 101}}}};
    mixed.other_velocities = {{2, {5.5F, 0}}, {4, {5.5F, 0}}};
    for (const CornerId id : {1, 3, 5, 6}) mixed.other_velocities[id] = {0.5F, 0};
    ImageStacker by_speed(options, quarterMetre());
    mixed.update(by_speed);
    EXPECT_EQ(groupsOf(by_speed), (std::set<Ids>{{1, 3, 5, 6}, {2, 4}}));
}

TEST(RivalStacks, KMeansWantsThreeFreeVectors) {
    StackingOptions options = StackingOptions::thesis();
    options.initialisation = StackInitialisation::k_means;
    Traffic traffic{.places = {{1, {100, 100}}, {2, {104, 103}}}};
    ImageStacker stacker(options, quarterMetre());
    traffic.update(stacker);
    EXPECT_TRUE(viewsOf(stacker).empty()) << "two are too few";
    traffic.places[3] = {107, 101};
    traffic.update(stacker);
    EXPECT_EQ(groupsOf(stacker), (std::set<Ids>{{1, 2, 3}}));
    for (CornerId id = 4; id < 9; ++id) traffic.places[id] = {100 + 2.F * static_cast<float>(id), 108};
    traffic.update(stacker);
    EXPECT_EQ(viewsOf(stacker).size(), 1U) << "newcomers join the stack of their neighbours";
    EXPECT_EQ(viewsOf(stacker)[0].related.size(), 8U);
}

TEST(RivalStacks, WhatIsRememberedGoesOnElsewhere) {
    for (const auto arrangement : {StackArrangement::accumulation, StackArrangement::circular_median}) {
        StackingOptions options = StackingOptions::thesis();
        options.arrangement = arrangement;
        options.capacity = 3;
        Traffic traffic{.places = {{1, {100, 50}}, {2, {110, 54}}, {3, {104, 61}}, {4, {120, 50}}, {9, {300, 90}}}};
        ImageStacker stacker(options, quarterMetre());
        const auto step = [&](ImageStacker& one, FrameIndex index) {
            Frame frame = plainFrame(index);
            frame.gray.setTo(cv::Scalar(30.0 * static_cast<double>(index)));
            one.update(frame, traffic.motion(), traffic.clusters());
            traffic.remember(one, {{1, 2, 3, 4}, {9}});
        };
        for (FrameIndex index = 0; index < 5; ++index) step(stacker, index);
        StateWriter writer;
        stacker.transfer(writer);
        const std::string bytes = writer.bytes();
        ImageStacker other(options, quarterMetre());
        StateReader reader(bytes, [](FrameIndex index) {
            return cv::Mat(480, 640, CV_8UC1, cv::Scalar(30.0 * static_cast<double>(index)));
        });
        other.transfer(reader);
        reader.end();
        for (FrameIndex index = 5; index < 7; ++index) {
            step(stacker, index);
            step(other, index);
            const auto expected = stacker.views(plainFrame(index), StackPictures::surroundings);
            const auto found = other.views(plainFrame(index), StackPictures::surroundings);
            ASSERT_EQ(expected.size(), 2U);
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].id, expected[i].id);
                EXPECT_EQ(found[i].pose.position, expected[i].pose.position);
                EXPECT_EQ(found[i].height, expected[i].height);
                EXPECT_EQ(found[i].related, expected[i].related);
                EXPECT_EQ(cv::norm(found[i].stacked, expected[i].stacked, cv::NORM_INF), 0);
            }
        }
    }
}

}  // namespace eyrie::rival_stacks_test

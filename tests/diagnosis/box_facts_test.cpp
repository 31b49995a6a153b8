#include "diagnosis/box_facts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"

/// What a run stored about a place, stage by stage, from a frame that is written down.
namespace eyrie::box_facts_test {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

const OrientedBox kPlace{{100, 100}, 20, 10, 0};

OrientedBox at(double x, double y = 100) {
    return {{x, y}, 20, 10, 0};
}

class FactsOfAFrame : public testing::Test {
 protected:
    FactsOfAFrame() {
        result.motion.image_size = {640, 480};
        result.motion.registration.state = RegistrationState::registered;
        options.clustering.min_density_share = 0;
        options.outliers.min_density_share = 0;
    }
    BoxFacts facts(const OrientedBox& box = kPlace, bool upright = false) {
        return FrameFacts(result, options, {0.25, 25, true, {}}, upright).at(box);
    }
    void addVector(cv::Point2f place, cv::Point2f velocity) {
        auto& vectors = result.motion.motion_vectors;
        vectors.push_back({static_cast<CornerId>(vectors.size()), place, velocity, 20});
    }
    void addDetection(const OrientedBox& box, Rejection rejection = Rejection::none) {
        Detection detection;
        detection.box = box;
        detection.rejection = rejection;
        result.detections.push_back(detection);
    }
    void addTrack(TrackId id, const OrientedBox& box, TrackStatus status) {
        TrackState state;
        state.id = id;
        state.box = box;
        state.status = status;
        result.tracks.push_back(state);
    }
    FrameResult result;
    ChainOptions options;
};

TEST_F(FactsOfAFrame, OfNothingAreNone) {
    const BoxFacts none = facts();
    EXPECT_EQ(none.image, cv::Size(640, 480));
    EXPECT_EQ(none.flow, cv::Point2d(0, 0));
    EXPECT_EQ(none.corners, 0);
    EXPECT_EQ(none.velocity, cv::Point2d(0, 0));
    for (const NearBox& near : {none.kept, none.rejected, none.dropped, none.tentative, none.confirmed}) {
        EXPECT_EQ(near.index, -1);
        EXPECT_EQ(near.overlap, 0);
    }
    EXPECT_THAT(none.clusters, IsEmpty());
    EXPECT_THAT(none.covering, IsEmpty());
}

TEST_F(FactsOfAFrame, TheGroundFlowsAsTheRegistrationSaysThere) {
    auto& registration = result.motion.registration;
    registration.current_from_previous.matrix = {1.1, 0, 3, 0, 1, -2, 0, 0, 1};
    EXPECT_NEAR(facts().flow.x, 0.1 * 100 + 3, 1e-9);
    EXPECT_NEAR(facts().flow.y, -2, 1e-9);
    registration.state = RegistrationState::failed;
    registration.failure.count = 12;
    EXPECT_EQ(facts().flow, cv::Point2d(0, 0)) << "a guess tells nothing";
    EXPECT_EQ(facts().registration, RegistrationState::failed);
    EXPECT_EQ(facts().failure.count, 12);
}

TEST_F(FactsOfAFrame, CornersAndVectorsOfThePlaceAreCountedAndTheirMotionIsTheMean) {
    result.motion.stationary_corners = {{95, 100}, {300, 100}, {105, 102}};
    addVector({300, 100}, {9, 9});
    addVector({96, 100}, {2, 0});
    addVector({104, 100}, {4, 1});
    EXPECT_EQ(facts().motion_vectors, 2);
    EXPECT_EQ(facts().corners, 4) << "standing and moving";
    EXPECT_EQ(facts().velocity, cv::Point2d(3, 0.5));
    EXPECT_EQ(facts().clustering.here, 2) << "none is in a cluster";
    EXPECT_NE(facts().clustering.refusal, ClusterRefusal::none);
    MotionCluster cluster;
    cluster.box = kPlace;
    cluster.members = {1, 2};
    result.clusters = {{at(300), {}, {0}}, cluster};
    EXPECT_THAT(facts().clusters, ElementsAre(1));
    EXPECT_EQ(facts().clustering.here, 0) << "there is nothing to explain";
    result.clusters.clear();
    options.difference.method = MotionMethod::two_frame_difference;
    EXPECT_TRUE(facts().by_differences);
    EXPECT_EQ(facts().clustering.here, 0);
}

TEST_F(FactsOfAFrame, OfDetectionsKeptAndRejectedOnesTheNearestAreTold) {
    addDetection(at(112));
    addDetection(at(108));
    addDetection(at(111));
    addDetection(at(106), Rejection::size);
    addDetection(at(95), Rejection::outlier);
    addDetection(at(105.5), Rejection::duplicate);
    const BoxFacts found = facts();
    EXPECT_EQ(found.kept.index, 1);
    EXPECT_NEAR(found.kept.overlap, 12 / 28.0, 1e-9);
    EXPECT_EQ(found.rejected.index, 4);
    EXPECT_NEAR(found.rejected.overlap, 15 / 25.0, 1e-9);
    EXPECT_EQ(found.removal.rejection, Rejection::outlier);
}

TEST_F(FactsOfAFrame, KeptDetectionsOnHalfOfThePlaceCoverIt) {
    addDetection(at(109.9));
    addDetection(at(110.1));
    addDetection(at(100), Rejection::duplicate);
    addDetection({{120, 100}, 60, 40, 0});
    EXPECT_THAT(facts().covering, ElementsAre(0, 3));
    EXPECT_THAT(facts({{100, 100}, 0, 0, 0}).covering, IsEmpty()) << "nothing covers a place of no size";
}

TEST_F(FactsOfAFrame, TracksAreToldByTheirStatusAndWhatWasLeftOut) {
    addTrack(3, at(104), TrackStatus::tentative);
    addTrack(4, at(102), TrackStatus::tentative);
    addTrack(5, at(106), TrackStatus::confirmed);
    addTrack(6, at(105), TrackStatus::coasting);
    result.dropped = {{7, at(107), TrackDrop::shadow, 2}, {8, at(103), TrackDrop::too_small, 0}};
    const BoxFacts found = facts();
    EXPECT_EQ(found.tentative.index, 1);
    EXPECT_EQ(found.unconfirmed.id, 4);
    EXPECT_EQ(found.unconfirmed.why, TrackDrop::unconfirmed);
    EXPECT_EQ(found.unconfirmed.box.centre, cv::Point2d(102, 100));
    EXPECT_EQ(found.confirmed.index, 3);
    EXPECT_EQ(found.dropped.index, 1);
    EXPECT_EQ(found.drop.id, 8);
    EXPECT_EQ(found.drop.why, TrackDrop::too_small);
}

TEST_F(FactsOfAFrame, BoxesAreComparedUprightWhereTheEvaluationDoes) {
    OrientedBox aslant = kPlace;
    aslant.heading = kPi / 2;
    addDetection({{100, 100}, 10, 20, 0});
    EXPECT_NEAR(facts(aslant, true).kept.overlap, 1, 1e-9);
    OrientedBox diagonal = kPlace;
    diagonal.heading = kPi / 4;
    const double side = 30 / std::sqrt(2.0);
    result.detections[0].box = {{100, 100}, side, side, 0};
    EXPECT_NEAR(facts(diagonal, true).kept.overlap, 1, 1e-9);
    EXPECT_NEAR(facts(diagonal, false).kept.overlap, 200 / (side * side), 1e-9);
}

}  // namespace
}  // namespace eyrie::box_facts_test

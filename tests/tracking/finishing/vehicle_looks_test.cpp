#include "tracking/finishing/vehicle_looks.h"

#include <gtest/gtest.h>

#include <cmath>

namespace eyrie::vehicle_looks_test {
namespace {

const OrientedBox kBox{{100, 50}, 20, 10, 0};

ClassifiedBox at(cv::Point2d centre, bool whole, double decision = std::nan("")) {
    return {{centre, 20, 10, 0}, whole, decision};
}

}  // namespace

TEST(VehicleLooks, TheNearestBoxWithinHalfALengthSpeaksForATrack) {
    TrackLooks looks;
    looks.add(kBox, {at({108, 50}, false, 9), at({103, 50}, false, 2), at({100, 50}, true)});
    EXPECT_EQ(looks.alike, 1) << "any whole vehicle there";
    EXPECT_EQ(looks.looked_at, 1);
    EXPECT_EQ(looks.decision(), 2) << "the nearest of which it was said";
    looks.add(kBox, {at({110, 50}, true, 9), at({100, 59.9}, false, 4)});
    EXPECT_EQ(looks.alike, 1) << "half a length away is too far";
    EXPECT_EQ(looks.decision(), 3) << "their mean";
    looks.add(kBox, {});
    EXPECT_EQ(looks.looked_at, 2);
}

TEST(VehicleLooks, NoSingleFrameOutweighsAllOthers) {
    TrackLooks looks;
    looks.add(kBox, {at({100, 50}, false, -50)});
    EXPECT_EQ(looks.decision(), -6);
    looks.add(kBox, {at({100, 50}, false, 40)});
    EXPECT_EQ(looks.decision(), 3);
}

TEST(VehicleLooks, WhereNobodyLookedNothingIsSaid) {
    EXPECT_TRUE(std::isnan(TrackLooks().decision()));
    TrackLooks looks;
    looks.add(kBox, {at({100, 50}, true)});
    EXPECT_TRUE(std::isnan(looks.decision()));
}

TEST(VehicleLooks, CountDetectedStatesAlone) {
    TrackPath path{4, {}};
    for (FrameIndex frame = 0; frame < 6; ++frame) {
        TrackState state;
        state.id = 4;
        state.box = kBox;
        state.origin = frame % 2 == 0 ? StateOrigin::detected : StateOrigin::predicted;
        path.states.emplace_back(frame, PathState(state));
    }
    int asked = 0;
    const VehicleLooks looks = looksOf({path, TrackPath{5, {path.states[1]}}}, [&](FrameIndex frame) {
        ++asked;
        return std::vector<ClassifiedBox>{at({100, 50}, frame == 4, frame)};
    });
    EXPECT_EQ(asked, 3) << "each frame once";
    ASSERT_TRUE(looks.contains(4));
    EXPECT_EQ(looks.at(4).alike, 1);
    EXPECT_EQ(looks.at(4).decision(), 2);
    EXPECT_FALSE(looks.contains(5));
}

TEST(ClassifiedBoxes, AreThoseThatWereKeptAndJudged) {
    Detection nothing_said;
    Detection whole;
    whole.complete = true;
    Detection judged;
    judged.decision = -3;
    Detection rejected = whole;
    rejected.rejection = Rejection::duplicate;
    const auto boxes = classifiedOf({nothing_said, whole, judged, rejected});
    ASSERT_EQ(boxes.size(), 2U);
    EXPECT_TRUE(boxes[0].whole && std::isnan(boxes[0].decision));
    EXPECT_TRUE(!boxes[1].whole && boxes[1].decision == -3);
}

}  // namespace eyrie::vehicle_looks_test

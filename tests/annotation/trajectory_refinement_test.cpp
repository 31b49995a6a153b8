#include "annotation/pictures/trajectory_refinement.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "annotation/keyframes/interpolation.h"
#include "annotation/scenes.h"

namespace eyrie::trajectory_refinement_test {
namespace {

/// A textured car on a textured ground; the camera stands still.
class Street {
 public:
    static constexpr int kLast = 50;

    static OrientedBox truth(double frame) { return {{40 + 3.0 * frame, 80 + 0.06 * frame}, 26, 12, 0.02}; }

    cv::Mat picture(FrameIndex frame) const {
        if (frame < 0 || frame > kLast) return {};
        cv::Mat result = ground_.clone();
        const OrientedBox box = truth(frame);
        const cv::Point2d d = box.direction();
        const cv::Point2d corner = box.toImage({-13, -6});
        cv::warpAffine(car_, result, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), result.size(),
                       cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return result;
    }
    GrayFrames frames() const {
        return [this](FrameIndex frame) { return picture(frame); };
    }

 private:
    cv::Mat ground_ = test::groundTexture({260, 160}, 1, 2.5);
    cv::Mat car_ = test::groundTexture({27, 13}, 2, 1.2);
};

const CameraMotion standing = CameraMotion::standing(0, Street::kLast);

/// A track that is off by more and more, its first box put right by hand.
LabelledObject driftingTrack() {
    LabelledObject object = test::object(1, {}, Street::kLast);
    for (const FrameIndex frame : {0, 25, 50}) {
        Keyframe keyframe = test::keyframe(frame, Street::truth(frame), true);
        keyframe.computed = frame != 0;
        keyframe.box.centre += cv::Point2d(0.12, 0.04) * frame;
        object.keyframes.push_back(keyframe);
    }
    return object;
}

double worstOverlap(const LabelledObject& object) {
    double worst = 1;
    for (FrameIndex frame = firstFrameOf(object); frame <= object.last_frame; ++frame)
        worst = std::min(worst, overlap(boxAt(object, frame, standing).box, Street::truth(frame)));
    return worst;
}

TEST(TrajectoryRefinement, LaysATrackOnItsVehicle) {
    const Street street;
    const LabelledObject before = driftingTrack();
    EXPECT_LT(worstOverlap(before), 0.6);
    const PictureFit fit = fittedToPictures(before, standing, street.frames());
    EXPECT_GT(worstOverlap(fit.object), 0.85);
    EXPECT_GT(fit.sure, 45);
    EXPECT_LE(fit.sure, fit.frames);
    EXPECT_EQ(fit.object.last_frame, before.last_frame);
    ASSERT_NE(keyframeAt(fit.object, 0), nullptr);
    EXPECT_FALSE(keyframeAt(fit.object, 0)->computed);
    EXPECT_EQ(keyframeAt(fit.object, 0)->box.centre, Street::truth(0).centre);
}

TEST(TrajectoryRefinement, KeepsFlagsWhereTheyAre) {
    const Street street;
    LabelledObject object = driftingTrack();
    object.keyframes[1].occlusion = Occlusion::partly;
    const PictureFit fit = fittedToPictures(object, standing, street.frames());
    EXPECT_EQ(boxAt(fit.object, 24, standing).occlusion, Occlusion::none);
    for (const FrameIndex frame : {25, 26, 40, 49})
        EXPECT_EQ(boxAt(fit.object, frame, standing).occlusion, Occlusion::partly) << frame;
}

TEST(TrajectoryRefinement, NeedsAHandAndSomethingComputed) {
    const Street street;
    LabelledObject by_hand = driftingTrack();
    for (Keyframe& keyframe : by_hand.keyframes) keyframe.computed = false;
    LabelledObject by_run = driftingTrack();
    for (Keyframe& keyframe : by_run.keyframes) keyframe.computed = true;
    for (const LabelledObject& object : {by_hand, by_run}) {
        const PictureFit fit = fittedToPictures(object, standing, street.frames());
        ASSERT_EQ(fit.object.keyframes.size(), 3U);
        for (std::size_t i = 0; i < 3; ++i)
            EXPECT_EQ(fit.object.keyframes[i].box.centre, object.keyframes[i].box.centre);
    }
}

TEST(TrajectoryRefinement, WithoutPicturesNothingMoves) {
    const LabelledObject object = driftingTrack();
    const PictureFit fit = fittedToPictures(object, standing, [](FrameIndex) { return cv::Mat(); });
    for (const FrameIndex frame : {0, 20, 50})
        EXPECT_LT(test::cornerDistance(boxAt(fit.object, frame, standing).box, boxAt(object, frame, standing).box),
                  1.8);
}

TEST(TrajectoryRefinement, StopsWhenAsked) {
    const Street street;
    std::stop_source stop;
    stop.request_stop();
    const PictureFit fit = fittedToPictures(driftingTrack(), standing, street.frames(), {}, stop.get_token());
    EXPECT_EQ(fit.object.keyframes.size(), 3U);
    EXPECT_EQ(fit.frames, 0);
}

// ---- corrections that go on -----------------------------------------------------------------------------------------

LabelledObject computedTrack() {
    LabelledObject object = test::object(1, {}, 40);
    for (const FrameIndex frame : {0, 10, 20, 30, 40}) {
        object.keyframes.push_back(test::keyframe(frame, {{20.0 + 4 * frame, 50}, 24, 10, 0}, true));
        object.keyframes.back().computed = true;
    }
    return object;
}

TEST(CarriedCorrection, GoesToAllThatWasComputed) {
    const OrientedBox right{{20.0 + 4 * 20 + 2, 51}, 20, 9, 0};
    const LabelledObject done = withBoxCarriedOn(computedTrack(), 20, right, true, CameraMotion::standing(0, 40));
    ASSERT_EQ(done.keyframes.size(), 5U);
    for (const Keyframe& keyframe : done.keyframes) {
        EXPECT_NEAR(keyframe.box.centre.x, 20 + 4 * keyframe.frame + 2, 1e-9);
        EXPECT_NEAR(keyframe.box.centre.y, 51, 1e-9);
        EXPECT_NEAR(keyframe.box.length, 20, 1e-9);
        EXPECT_NEAR(keyframe.box.width, 9, 1e-9);
        EXPECT_EQ(keyframe.computed, keyframe.frame != 20);
    }
}

TEST(CarriedCorrection, FadesTowardsWhatAHandSet) {
    LabelledObject object = computedTrack();
    object.keyframes[0].computed = false;
    const OrientedBox right{{20.0 + 4 * 20, 54}, 24, 10, 0};
    const LabelledObject done = withBoxCarriedOn(object, 20, right, true, CameraMotion::standing(0, 40));
    EXPECT_EQ(done.keyframes[0].box.centre.y, 50);
    EXPECT_NEAR(done.keyframes[1].box.centre.y, 52, 1e-9) << "half way";
    EXPECT_NEAR(done.keyframes[3].box.centre.y, 54, 1e-9);
    EXPECT_NEAR(done.keyframes[4].box.centre.y, 54, 1e-9);
}

TEST(CarriedCorrection, ATrackThatWasElsewhereIsPutRightInThisFrameOnly) {
    const OrientedBox elsewhere{{20.0 + 4 * 20 + 60, 90}, 24, 10, 0};
    const LabelledObject done = withBoxCarriedOn(computedTrack(), 20, elsewhere, true, CameraMotion::standing(0, 40));
    EXPECT_EQ(done.keyframes[1].box.centre.y, 50);
    EXPECT_EQ(done.keyframes[2].box.centre.y, 90);
}

TEST(CarriedCorrection, BoxesDrawnUprightMakeTheComputedOnesUpright) {
    LabelledObject object = computedTrack();
    for (Keyframe& keyframe : object.keyframes) keyframe.box.heading = 0.3;
    const OrientedBox hull = object.keyframes[2].box.upright();
    const LabelledObject done = withBoxCarriedOn(object, 20, hull, true, CameraMotion::standing(0, 40));
    for (const Keyframe& keyframe : done.keyframes) {
        EXPECT_EQ(keyframe.box.heading, 0);
        EXPECT_NEAR(keyframe.box.length, hull.length, 1e-9);
        EXPECT_NEAR(keyframe.box.width, hull.width, 1e-9);
    }
}

TEST(CarriedCorrection, BoxesAtTheBorderAreTold) {
    EXPECT_FALSE(isCutByBorder({{8, 50}, 24, 10, 0}, {320, 240})) << "all of it is drawn";
    EXPECT_TRUE(isCutByBorder({{12, 50}, 24, 10, 0}, {320, 240}));
    EXPECT_FALSE(isCutByBorder({{20, 50}, 24, 10, 0}, {320, 240}));
    EXPECT_TRUE(isCutByBorder({{307, 50}, 24, 10, 0}, {320, 240}));
    EXPECT_TRUE(isCutByBorder({{160, 234.5}, 24, 10, 0}, {320, 240}));
}

}  // namespace
}  // namespace eyrie::trajectory_refinement_test

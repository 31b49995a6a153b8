#include "annotation/pictures/box_tracker.h"

#include <gmock/gmock.h>

#include <cstdio>
#include <map>
#include <opencv2/imgproc.hpp>

#include "annotation/scenes.h"
#include "core/error.h"
#include "core/geometry/angle.h"
#include "io/tables/box_csv.h"
#include "io/tables/homography_csv.h"
#include "io/video/frame_source.h"
#include "support/shared_data.h"

namespace eyrie::box_tracker_test {
namespace {

/// A textured car on a textured ground under a camera that pans and turns; optionally a bridge it passes under.
class DrawnScene {
 public:
    explicit DrawnScene(bool bridge = false) : bridge_(bridge) {}

    static cv::Matx33d view(double frame) {
        const double angle = 0.006 * frame;
        const double c = std::cos(angle);
        const double s = std::sin(angle);
        return {c, -s, 40 - 0.8 * frame, s, c, 0.3 * frame, 0, 0, 1};
    }
    static OrientedBox onGround(double frame) {
        const double heading = 0.3 + 0.01 * frame;
        return {{90 + 2.2 * frame, 90 + 0.8 * frame + 0.004 * frame * frame}, 26, 12, heading};
    }
    static OrientedBox truth(double frame) { return test::seen(onGround(frame), view(frame)); }

    cv::Mat picture(FrameIndex frame) const {
        if (frame < 0 || frame > 100) return {};
        const cv::Matx33d v = view(frame);
        const cv::Matx23d map(v(0, 0), v(0, 1), v(0, 2), v(1, 0), v(1, 1), v(1, 2));
        cv::Mat result;
        cv::warpAffine(ground_, result, map, {320, 240}, cv::INTER_LINEAR, cv::BORDER_REFLECT);
        const OrientedBox box = truth(frame);
        const cv::Point2d d = box.direction();
        const cv::Point2d corner = box.toImage({-13, -6});
        const cv::Matx23d place(d.x, -d.y, corner.x, d.y, d.x, corner.y);
        cv::warpAffine(car_, result, place, result.size(), cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        if (bridge_) {
            cv::Mat over;
            cv::warpAffine(roof_, over, map, result.size(), cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
            over.copyTo(result, over > 0);
        }
        return result;
    }

 private:
    bool bridge_;
    cv::Mat ground_ = test::groundTexture({500, 400}, 1, 2.5);
    cv::Mat car_ = test::groundTexture({27, 13}, 2, 1.2);
    cv::Mat roof_ = [] {
        cv::Mat roof = cv::Mat::zeros(400, 500, CV_8UC1);
        test::groundTexture({50, 400}, 3, 2).copyTo(roof(cv::Rect(190, 0, 50, 400)));
        return roof;
    }();
};

double worstOverlap(const FollowResult& result) {
    double worst = 1;
    for (const auto& each : result.boxes) worst = std::min(worst, overlap(each.box, DrawnScene::truth(each.frame)));
    return worst;
}

TEST(BoxTracker, FollowsForwardAndBackwardWithAndWithoutKnowingTheCamera) {
    const DrawnScene scene;
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const CameraMotion known(test::stepsOf(DrawnScene::view, 100));
    for (const CameraMotion& camera : {known, CameraMotion()}) {
        for (const auto& [start, last] : {std::pair(5, 50), std::pair(50, 5)}) {
            const FollowResult result = followBox(DrawnScene::truth(start), start, last, gray, camera);
            EXPECT_EQ(result.end, FollowEnd::end_of_range) << result.reason;
            ASSERT_EQ(result.boxes.size(), 45U);
            EXPECT_EQ(result.boxes.front().frame, start < last ? start + 1 : start - 1);
            EXPECT_GT(worstOverlap(result), 0.75);
            for (const auto& each : result.boxes) EXPECT_GT(each.certainty, 0.45);
        }
    }
}

TEST(BoxTracker, LiesOnTheVehicleToAFifthOfAPixelInTheMean) {
    const cv::Mat ground = test::groundTexture({420, 330}, 1, 2.5);
    for (const double blur : {1.2, 2.5}) {
        const cv::Mat car = test::groundTexture({27, 13}, 2, blur, 20, 235);
        for (const cv::Point2d& speed : {cv::Point2d(2.2, 0.8), {4.3, 2.7}}) {
            const auto truth = [&](FrameIndex frame) {
                return OrientedBox{cv::Point2d(90, 90) + speed * frame, 26, 12, 0.3 + 0.03 * frame};
            };
            const auto gray = [&](FrameIndex frame) {
                cv::Mat picture = ground.clone();
                const cv::Point2d d = truth(frame).direction(), corner = truth(frame).toImage({-13, -6});
                cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), picture.size(),
                               cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
                return picture;
            };
            const FollowResult result = followBox(truth(0), 0, 25, gray, CameraMotion::standing(0, 25));
            ASSERT_EQ(result.boxes.size(), 25U) << result.reason;
            double off = 0, turned = 0;
            for (const FollowedBox& each : result.boxes) {
                off += cv::norm(each.box.centre - truth(each.frame).centre) / 25;
                turned = std::max(turned, std::abs(turnBetween(each.box.heading, truth(each.frame).heading)));
                EXPECT_NEAR(each.box.length, 26, 1e-9);
                EXPECT_NEAR(each.box.width, 12, 1e-9);
                EXPECT_GT(each.certainty, 0.8);
            }
            EXPECT_LT(off, 0.2) << blur << speed;
            EXPECT_LT(turned, 0.05) << blur << speed;
        }
    }
}

TEST(BoxTracker, WithoutCornersTheFirstStepMayGoAlongAndAcross) {
    FollowOptions options;
    options.max_corners = 1;
    const cv::Mat ground = test::groundTexture({200, 160}, 1, 2.5);
    cv::Mat car(25, 41, CV_8UC1,
                cv::Scalar(60));  // what lies along it fits wherever it is across, and the other way round
    cv::rectangle(car, {0, 10, 41, 3}, cv::Scalar(200), cv::FILLED);
    cv::rectangle(car, {18, 0, 3, 25}, cv::Scalar(200), cv::FILLED);
    cv::GaussianBlur(car, car, {}, 1);
    for (const cv::Point2d way : {cv::Point2d(7, 6), {-6, 7}, {7, -7}}) {
        const auto placeIn = [&](FrameIndex frame) { return cv::Point2d(90, 70) + way * frame; };
        const auto gray = [&](FrameIndex frame) {
            cv::Mat picture = ground.clone();
            car.copyTo(picture(cv::Rect(cv::Point(placeIn(frame)) - cv::Point(20, 12), car.size())));
            return picture;
        };
        const FollowResult result =
            followBox({placeIn(0), 40, 24, 0}, 0, 1, gray, CameraMotion::standing(0, 1), options);
        ASSERT_EQ(result.boxes.size(), 1U) << way << result.reason;
        EXPECT_LT(cv::norm(result.boxes[0].box.centre - placeIn(1)), 0.6) << way;
    }
}

TEST(BoxTracker, StopsUnderABridgeAndSaysWhy) {
    const DrawnScene scene(true);
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const FollowResult result =
        followBox(DrawnScene::truth(5), 5, 90, gray, CameraMotion(test::stepsOf(DrawnScene::view, 100)));
    EXPECT_NE(result.end, FollowEnd::end_of_range);
    EXPECT_THAT(result.reason, testing::HasSubstr("frame " + std::to_string(result.end_frame)));
    // The bridge stands from x = 190 to 240 on the ground: the car's front reaches it in frame 40, its middle in 45.
    EXPECT_GT(result.end_frame, 36);
    EXPECT_LT(result.end_frame, 52);
    for (const auto& each : result.boxes) {
        if (each.frame < 40) {
            EXPECT_GT(overlap(each.box, DrawnScene::truth(each.frame)), 0.7) << each.frame;
        }
    }
}

TEST(BoxTracker, EndsAtTheBorderAtMissingPicturesAndOnDemand) {
    const DrawnScene scene;
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const auto out = followBox(DrawnScene::truth(60), 60, 101, gray, CameraMotion());
    EXPECT_NE(out.end, FollowEnd::end_of_range);
    const auto hole = [&](FrameIndex frame) { return frame == 20 ? cv::Mat() : scene.picture(frame); };
    const auto missing = followBox(DrawnScene::truth(10), 10, 40, hole, CameraMotion());
    EXPECT_EQ(missing.end, FollowEnd::no_picture);
    EXPECT_EQ(missing.end_frame, 20);
    EXPECT_EQ(missing.boxes.size(), 9U);
    std::stop_source stop;
    int seen = 0;
    const auto stopped = followBox(
        DrawnScene::truth(10), 10, 40, gray, CameraMotion(), {},
        [&](const FollowedBox&) {
            if (++seen == 4) stop.request_stop();
        },
        stop.get_token());
    EXPECT_EQ(stopped.end, FollowEnd::stopped);
    EXPECT_EQ(stopped.boxes.size(), 4U);
    EXPECT_EQ(followBox({{900, 10}, 20, 9, 0}, 10, 20, gray, CameraMotion()).end, FollowEnd::left_image);
    EXPECT_TRUE(followBox(DrawnScene::truth(10), 10, 10, gray, CameraMotion()).boxes.empty());
    EXPECT_THROW(followBox({{90, 90}, 0, 9, 0}, 10, 20, gray, CameraMotion()), Error);
}

/// A car waits under a camera that pans, and a long lorry drives past in front of it in frames 15 to 31: over its lower
/// part, over all of it where `high`. `leaves`: when it has passed, the car is gone.
class WaitingScene {
 public:
    WaitingScene(bool high, bool leaves) : high_(high), leaves_(leaves) {}

    static cv::Matx33d view(double frame) { return {1, 0, 20 - 0.4 * frame, 0, 1, 0.2 * frame, 0, 0, 1}; }
    static OrientedBox truth(double frame) { return test::seen({{150, 120}, 40, 20, 0}, view(frame)); }

    cv::Mat picture(FrameIndex frame) const {
        cv::Mat scene = ground_.clone();
        if (!leaves_ || frame < 25) car_.copyTo(scene(cv::Rect(130, 110, 40, 20)));
        const int left = -50 + 7 * frame;
        const cv::Rect lorry(left, high_ ? 106 : 119, 80, 30);
        const cv::Rect seen = lorry & cv::Rect({}, scene.size());
        if (!seen.empty()) lorry_(seen - lorry.tl()).copyTo(scene(seen));
        const cv::Matx33d v = view(frame);
        cv::Mat result;
        cv::warpAffine(scene, result, cv::Matx23d(1, 0, v(0, 2), 0, 1, v(1, 2)), {320, 240}, cv::INTER_LINEAR,
                       cv::BORDER_REFLECT);
        return result;
    }
    FollowResult followed() const {
        return followBox(
            truth(0), 0, 60, [&](FrameIndex frame) { return picture(frame); }, CameraMotion(test::stepsOf(view, 60)));
    }

 private:
    bool high_, leaves_;
    cv::Mat ground_ = test::groundTexture({400, 300}, 5, 2.5);
    cv::Mat car_ = test::groundTexture({40, 20}, 6, 1.2);
    cv::Mat lorry_ = test::groundTexture({80, 30}, 7, 1.5);
};

TEST(BoxTracker, WhatWaitsIsFollowedWhileOthersPassInFrontOfIt) {
    for (const bool high : {false, true}) {
        const FollowResult result = WaitingScene(high, false).followed();
        EXPECT_EQ(result.end, FollowEnd::end_of_range) << result.reason;
        ASSERT_EQ(result.boxes.size(), 60U) << high;
        for (const FollowedBox& each : result.boxes)
            EXPECT_GT(overlap(each.box, WaitingScene::truth(each.frame)), 0.8) << each.frame;
    }
}

TEST(BoxTracker, WhatIsGoneWhenItCanBeSeenAgainEndsWhereItWasHidden) {
    const FollowResult result = WaitingScene(true, true).followed();
    EXPECT_NE(result.end, FollowEnd::end_of_range);
    EXPECT_GT(result.end_frame, 14);
    EXPECT_LT(result.end_frame, 26) << "by then it is hidden";
    ASSERT_FALSE(result.boxes.empty());
    EXPECT_EQ(result.boxes.back().frame, result.end_frame - 1);
}

/// Real vehicles of 22 × 9 px, followed from their first whole frame. Printed, because the figures are wanted in
/// reports.
TEST(BoxTracker, FollowsRealVehicles) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    const auto folder = test::sharedData("collage_day");
    const auto source = openSource(folder / "frames");
    std::map<FrameIndex, cv::Mat> frames;
    const auto gray = [&](FrameIndex frame) {
        if (!frames.count(frame)) frames[frame] = source->read(frame, false).gray;
        return frames[frame];
    };
    const CameraMotion camera = test::cameraOf(readHomographyCsv(folder / "homography.csv"));
    std::map<int, std::map<FrameIndex, OrientedBox>> tracks;
    for (const auto& [frame, records] : readBoxCsv(folder / "ground_truth.csv")) {
        for (const BoxRecord& record : records) {
            if (areaInImage(record.box, {320, 224}) > 0.95 * record.box.area()) tracks[*record.id][frame] = record.box;
        }
    }
    for (const CameraMotion& used : {camera, CameraMotion()}) {
        int followed = 0;
        int good = 0;
        int possible = 0;
        int bad_ends = 0;
        for (const auto& [id, boxes] : tracks) {
            const FrameIndex first = boxes.begin()->first;
            const FrameIndex last = std::min(boxes.rbegin()->first, first + 40);
            if (last - first < 20 || id % 3 != 0) continue;
            possible += last - first;
            const FollowResult result = followBox(boxes.begin()->second, first, last, gray, used);
            int bad = 0;
            for (const auto& each : result.boxes) {
                ++followed;
                const auto truth = boxes.find(each.frame);
                if (truth == boxes.end()) continue;
                const bool fits = overlap(truth->second, each.box) >= 0.5;
                good += fits;
                bad += !fits;
            }
            bad_ends += bad > 0;
        }
        std::printf(
            "collage_day, camera %s: followed %d of %d frames, %.1f %% of them with overlap of 0.5 and more, %d "
            "objects with a frame below\n",
            used.empty() ? "estimated" : "known", followed, possible, 100.0 * good / std::max(1, followed), bad_ends);
        EXPECT_GT(followed, possible / 2);
        EXPECT_GT(good, followed * 9 / 10);
    }
}

}  // namespace
}  // namespace eyrie::box_tracker_test

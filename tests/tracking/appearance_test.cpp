#include "tracking/appearance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "tracking/tracked_scene.h"
#include "tracking/tracker.h"

namespace eyrie {
namespace {

using testing::MovingScene;

/// A car with a dark windscreen near its front on plain ground with noise of one grey level.
cv::Mat picture(const std::vector<OrientedBox>& cars, cv::Size size = {400, 300}) {
    constexpr int kFine = 4;
    cv::Mat fine(size * kFine, CV_8UC1, cv::Scalar(90));
    const auto fill = [&](const OrientedBox& box, int level) {
        std::vector<cv::Point> corners;
        for (const cv::Point2d& c : box.corners())
            corners.emplace_back(cvRound((c.x + 0.5) * kFine - 0.5), cvRound((c.y + 0.5) * kFine - 0.5));
        cv::fillConvexPoly(fine, corners, cv::Scalar(level));
    };
    for (const OrientedBox& car : cars) {
        fill(car, 190);
        OrientedBox screen = car.scaled(0.2, 0.8);
        screen.centre = car.toImage({0.2 * car.length, 0});
        fill(screen, 30);
    }
    cv::Mat image;
    cv::resize(fine, image, size, 0, 0, cv::INTER_AREA);
    cv::Mat noise(size, CV_8UC1);
    cv::RNG random(7);
    random.fill(noise, cv::RNG::UNIFORM, 0, 3);
    return image + noise;
}

double distance(cv::Point2d a, cv::Point2d b) {
    return std::hypot(a.x - b.x, a.y - b.y);
}

}  // namespace

TEST(AppearanceMemory, findsTheObjectWhereItIsToAPartOfAPixel) {
    const OrientedBox before{{120, 90}, 22, 10, radiansFromDegrees(30)};
    AppearanceMemory looks(0.8);
    looks.remember(5, picture({before}), before);
    OrientedBox now = before;
    now.centre = {161.5, 120.25};
    now.heading = radiansFromDegrees(75);  // the camera has turned meanwhile
    OrientedBox expected = now;
    expected.centre += cv::Point2d(1.7, -1.2);
    const auto found = looks.find(5, picture({now}), expected, 3);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(found->centre, now.centre), 0.3);
    EXPECT_EQ(found->length, expected.length);
    EXPECT_EQ(found->heading, expected.heading);
}

TEST(AppearanceMemory, followsAZoomOfTheCamera) {
    const OrientedBox before{{120, 90}, 20, 10, 0};
    AppearanceMemory looks(0.8);
    looks.remember(1, picture({before}), before);
    const OrientedBox now{{200, 150}, 26, 13, 0};
    const auto found = looks.find(1, picture({now}), now, 2);
    ASSERT_TRUE(found);
    EXPECT_LT(distance(found->centre, now.centre), 0.5);
}

TEST(AppearanceMemory, doesNotFindWhatIsNotThere) {
    const OrientedBox car{{120, 90}, 22, 10, 0};
    AppearanceMemory looks(0.8);
    EXPECT_FALSE(looks.find(1, picture({car}), car, 3)) << "was never remembered";
    looks.remember(1, picture({car}), car);
    EXPECT_FALSE(looks.find(1, picture({}), car, 3)) << "drove away";
    OrientedBox turned = car;
    turned.heading = kPi / 2;
    EXPECT_FALSE(looks.find(1, picture({turned}), car, 3)) << "another one stands across";
    EXPECT_FALSE(looks.find(2, picture({car}), car, 3)) << "another track";
    EXPECT_FALSE(looks.find(1, {}, car, 3));
    looks.forget(1);
    EXPECT_FALSE(looks.find(1, picture({car}), car, 3));
}

TEST(AppearanceMemory, remembersNothingWithoutContrastOrBeyondTheImage) {
    AppearanceMemory looks(0.5);
    const OrientedBox plain{{60, 60}, 22, 10, 0};
    looks.remember(1, picture({}), plain);
    EXPECT_FALSE(looks.find(1, picture({}), plain, 2));
    const OrientedBox cut{{3, 60}, 22, 10, 0};
    looks.remember(2, picture({cut}), cut);
    EXPECT_FALSE(looks.find(2, picture({cut}), cut, 2));
    const OrientedBox speck{{60, 60}, 2, 2, 0};
    looks.remember(3, picture({speck}), speck);
    EXPECT_FALSE(looks.find(3, picture({speck}), speck, 2));
    const OrientedBox broken{{NAN, 60}, 22, 10, 0};
    looks.remember(4, picture({}), broken);
    EXPECT_FALSE(looks.find(4, picture({}), broken, 2));
}

/// A car brakes, stands for eight seconds without a motion vector and drives on.
std::vector<TrackId> idsOfAStoppingCar(AppearanceUse use, bool stays) {
    TrackerOptions options;
    options.appearance = use;
    MovingScene scene;
    Tracker tracker(options, scene.scale);
    const auto placeAt = [](int frame) {
        const double until_stop = std::min(frame, 30);
        const double after = std::max(0, frame - 230);
        return OrientedBox{{80 + 1.2 * until_stop - 0.02 * until_stop * until_stop + 1.2 * after, 100}, 20, 10, 0};
    };
    std::vector<TrackId> ids;
    for (int frame = 0; frame < 260; ++frame) {
        FrameMotion motion = scene.motion(frame);
        motion.motion_vectors.clear();
        std::vector<Detection> detections;
        const OrientedBox box = placeAt(frame);
        const double speed = placeAt(frame + 1).centre.x - box.centre.x;
        if (frame < 28 || (frame > 232 && stays)) {
            Detection detection;
            detection.box = box;
            detection.velocity = {speed, 0};
            detections.push_back(detection);
        }
        const bool there = stays || frame < 40;
        const auto states =
            tracker.next(motion, detections, nullptr, picture(there ? std::vector{box} : std::vector<OrientedBox>{}));
        for (const TrackState& state : states)
            if (state.status != TrackStatus::tentative && (ids.empty() || ids.back() != state.id))
                ids.push_back(state.id);
        if (!stays && frame == 120) {
            EXPECT_TRUE(states.empty()) << "kept where nothing stands any more";
        }
        if (stays && frame == 120 && use == AppearanceUse::stopped) {
            EXPECT_EQ(states.size(), 1U);
            for (const TrackState& state : states) EXPECT_LT(distance(state.box.centre, box.centre), 1);
        }
    }
    return ids;
}

TEST(Tracker, aStandingVehicleKeepsItsIdWhenItsLooksAreRemembered) {
    EXPECT_EQ(idsOfAStoppingCar(AppearanceUse::stopped, true), std::vector<TrackId>{1});
    EXPECT_EQ(idsOfAStoppingCar(AppearanceUse::none, true), (std::vector<TrackId>{1, 2}));
    EXPECT_EQ(idsOfAStoppingCar(AppearanceUse::stopped, false), std::vector<TrackId>{1});
}

}  // namespace eyrie

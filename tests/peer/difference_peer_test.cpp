#include "peer/difference_peer.h"

#include <gtest/gtest.h>

#include "support/moving_scene.h"

namespace eyrie::difference_peer_test {
namespace {

/// The true registration of a frame of the scene onto the one before.
Registration registrationOf(const test::MovingScene& scene, int frame) {
    Registration registration;
    registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
    registration.current_from_previous.from_frame = frame == 0 ? 0 : frame - 1;
    registration.current_from_previous.to_frame = frame;
    if (frame > 0) {
        registration.current_from_previous.matrix(0, 2) = -scene.camera_per_frame.x;
        registration.current_from_previous.matrix(1, 2) = -scene.camera_per_frame.y;
    }
    return registration;
}

FrameMotion motionOf(const test::MovingScene& scene, int frame) {
    FrameMotion motion;
    motion.frame = frame;
    motion.image_size = scene.size;
    motion.registration = registrationOf(scene, frame);
    return motion;
}

Frame frameOf(const test::MovingScene& scene, int index) {
    Frame frame;
    frame.index = index;
    frame.gray = scene.draw(index);
    return frame;
}

OrientedBox uprightBox(const test::MovingScene& scene, std::size_t vehicle, int frame) {
    const auto& v = scene.vehicles[vehicle];
    return OrientedBox{scene.vehicleAt(v, frame), v.size.width, v.size.height, std::atan2(v.velocity.y, v.velocity.x)}
        .upright();
}

}  // namespace

TEST(ThreeFrameBoxes, AnswersForThePictureInTheMiddle) {
    const test::MovingScene scene;
    PeerOptions options;
    options.gap = 3;
    ThreeFrameBoxes boxes(options);
    for (int i = 0; i < 12; ++i) {
        const auto answer = boxes.next(frameOf(scene, i), registrationOf(scene, i));
        ASSERT_EQ(answer.has_value(), i >= 6) << i;
        if (!answer) continue;
        EXPECT_EQ(answer->frame, i - 3);
        for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
            double best = 0;
            for (const OrientedBox& box : answer->boxes)
                best = std::max(best, overlap(box, uprightBox(scene, v, i - 3)));
            EXPECT_GT(best, 0.5) << "vehicle " << v << " in frame " << i - 3;
        }
        EXPECT_LE(answer->boxes.size(), 4U) << "the ground stands still";
    }
}

TEST(ThreeFrameBoxes, AreMadeOfAreasAsTheParametersSay) {
    test::MovingScene still;
    still.camera_per_frame = {0, 0};
    // Things that leap over a plain ground, 10 px down and 40 px aside from picture to picture.
    const auto found = [&](const std::vector<cv::Rect>& things, const char* name, const char* value) {
        PeerOptions options;
        options.gap = 1;
        options.joining = 0;
        options.min_area = 1;
        setParameter(describeOf(options), name, value);
        ThreeFrameBoxes boxes(options);
        std::size_t count = 0;
        for (int i = 0; i < 4; ++i) {
            Frame frame;
            frame.index = i;
            frame.gray = cv::Mat(still.size, CV_8UC1, cv::Scalar(100));
            for (const cv::Rect& thing : things) frame.gray(thing + cv::Point(40 * i, 10 * i)).setTo(140);
            if (const auto answer = boxes.next(frame, registrationOf(still, i))) count = answer->boxes.size();
        }
        return count;
    };
    const std::vector<cv::Rect> two = {{50, 50, 6, 6}, {60, 50, 6, 6}};  // with 4 px between them
    EXPECT_EQ(found(two, "peer.joining", "2"), 2U);
    EXPECT_EQ(found(two, "peer.joining", "5"), 1U);
    const std::vector<cv::Rect> apart = {{50, 50, 6, 6}, {64, 50, 6, 6}};  // with 8 px between them
    EXPECT_EQ(found(apart, "peer.joining", "8"), 2U);
    EXPECT_EQ(found(apart, "peer.joining", "11"), 1U);
    EXPECT_EQ(found(two, "peer.min_area", "36"), 2U);
    EXPECT_EQ(found(two, "peer.min_area", "37"), 0U);
    const std::vector<cv::Rect> speck = {{50, 50, 1, 1}};
    EXPECT_EQ(found(speck, "peer.blur", "0"), 1U);
    EXPECT_EQ(found(speck, "peer.blur", "2"), 0U);
}

TEST(ThreeFrameBoxes, KnowNothingBeyondACutAndOfRepeatedPictures) {
    const test::MovingScene scene;
    PeerOptions options;
    ThreeFrameBoxes boxes(options);
    for (int i = 0; i < 8; ++i) boxes.next(frameOf(scene, i), registrationOf(scene, i));
    Registration frozen = registrationOf(scene, 8);
    frozen.state = RegistrationState::frozen;
    frozen.current_from_previous.matrix = cv::Matx33d::eye();
    EXPECT_FALSE(boxes.next(frameOf(scene, 8), frozen).has_value());
    Registration cut = registrationOf(scene, 9);
    cut.state = RegistrationState::first;
    cut.current_from_previous.from_frame = 9;
    EXPECT_FALSE(boxes.next(frameOf(scene, 9), cut).has_value());
    EXPECT_FALSE(boxes.next(frameOf(scene, 10), registrationOf(scene, 10)).has_value());
}

TEST(DifferencePeer, ReturnsEveryFrameOnceInOrderWithConfirmedTracks) {
    const test::MovingScene scene;
    DifferencePeer peer({});
    std::vector<DifferencePeer::Result> all;
    const auto add = [&](std::vector<DifferencePeer::Result> more) {
        for (auto& result : more) all.push_back(std::move(result));
    };
    for (int i = 0; i < scene.frames; ++i) add(peer.next(frameOf(scene, i), motionOf(scene, i)));
    add(peer.finish());
    ASSERT_EQ(all.size(), static_cast<std::size_t>(scene.frames));
    int followed = 0;
    for (int i = 0; i < scene.frames; ++i) {
        const auto& [frame, result] = all[static_cast<std::size_t>(i)];
        EXPECT_EQ(frame.index, i);
        EXPECT_EQ(result.motion.frame, i);
        for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
            for (const TrackState& state : result.tracks) {
                followed += state.status == TrackStatus::confirmed && overlap(state.box, uprightBox(scene, v, i)) > 0.4;
            }
        }
    }
    EXPECT_GE(followed, 2 * (scene.frames - 12));
}

TEST(DifferencePeer, HoldsNoEndlessStretchOfFramesThatWereNotRegistered) {
    const test::MovingScene scene;
    DifferencePeer peer({});
    const Frame picture = frameOf(scene, 0);
    int returned = 0;
    for (int i = 0; i < 400; ++i) {
        Frame frame = picture;
        frame.index = i;
        FrameMotion motion = motionOf(scene, i);
        if (i > 0) motion.registration.state = RegistrationState::failed;
        for (const auto& [done, result] : peer.next(frame, motion)) {
            EXPECT_EQ(done.index, returned++);
            EXPECT_TRUE(result.tracks.empty());
        }
    }
    EXPECT_GT(returned, 300);
    for (const auto& [done, result] : peer.finish()) EXPECT_EQ(done.index, returned++);
    EXPECT_EQ(returned, 400);
}

}  // namespace eyrie::difference_peer_test

// From pictures to boxes: cars in the sun whose boxes hold half of their shadow.
#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>

#include "tracking/finishing/track_finishing.h"
#include "tracking/frame_summaries.h"

namespace eyrie::trimmed_boxes_test {
namespace {

const SceneScale kScale{.gsd_m_per_px = 0.2, .frame_rate_hz = 25, .gsd_known = true};
constexpr int kFrames = 50;
constexpr int kShadowRight = 4;  // px
constexpr int kShadowDown = 3;

/// Six lanes, three each way; the camera goes 1 px/frame to the left.
struct SunnyRoad {
    int paint = 230;
    FinishingOptions options;
    std::vector<FrameIndex> asked;

    static bool backwards(int lane) { return lane % 2 == 1; }
    static cv::Rect carAt(int lane, FrameIndex frame) {
        const int driven = backwards(lane) ? 560 - 4 * frame : 40 + 4 * frame;
        return {driven + frame, 30 + 40 * lane, 22, 10};
    }
    static OrientedBox boxAt(int lane, FrameIndex frame) {
        const cv::Rect car = carAt(lane, frame);
        const double length = car.width + kShadowRight / 2.0;
        const double width = car.height + kShadowDown / 2.0;
        return {{car.x - 0.5 + length / 2, car.y - 0.5 + width / 2}, length, width, backwards(lane) ? CV_PI : 0};
    }
    cv::Mat pictureOf(FrameIndex frame) {
        asked.push_back(frame);
        static const cv::Mat ground = [] {
            cv::Mat grain(280, 720, CV_8UC1);
            cv::RNG(3).fill(grain, cv::RNG::NORMAL, 150, 12);
            cv::GaussianBlur(grain, grain, {5, 5}, 1.5);
            return grain;
        }();
        cv::Mat picture = ground(cv::Rect(60 - frame, 0, 640, 280)).clone();
        for (int lane = 0; lane < 6; ++lane) {
            const cv::Rect car = carAt(lane, frame);
            for (int y = car.y + kShadowDown; y < car.br().y + kShadowDown; ++y) {
                for (int x = car.x + kShadowRight; x < car.br().x + kShadowRight; ++x)
                    picture.at<uchar>(y, x) = static_cast<uchar>(picture.at<uchar>(y, x) / 2);
            }
            picture(car).setTo(paint);
        }
        return picture;
    }

    std::map<TrackId, OrientedBox> boxesIn(FrameIndex wanted, bool with_pictures = true) {
        std::vector<FrameMotionSummary> motion;
        std::vector<TimedState> states;
        for (FrameIndex frame = 0; frame < kFrames; ++frame) {
            motion.push_back(test::summaryOfFrame(frame, 1));
            motion.back().image_size = {640, 280};
            for (int lane = 0; lane < 6; ++lane) {
                TrackState state;
                state.id = lane + 1;
                state.box = boxAt(lane, frame);
                state.velocity = {backwards(lane) ? -4.0 : 4.0, 0};
                state.status = TrackStatus::confirmed;
                states.emplace_back(frame, state);
            }
        }
        FoundInFrames found;
        found.classified_at = [](FrameIndex frame) {
            std::vector<ClassifiedBox> cars;
            cars.reserve(6);
            for (int lane = 0; lane < 6; ++lane) cars.push_back({boxAt(lane, frame), true, 8});
            return cars;
        };
        if (with_pictures) found.gray_at = [this](FrameIndex frame) { return pictureOf(frame); };
        std::map<TrackId, OrientedBox> boxes;
        for (const auto& [frame, state] : finishTracks(states, motion, options, kScale, found))
            if (frame == wanted) boxes[state.id] = state.box;
        return boxes;
    }
};

}  // namespace

TEST(TrimmedBoxes, EndWithTheVehicleWhicheverWayItDrives) {
    SunnyRoad road;
    const auto boxes = road.boxesIn(25);
    ASSERT_EQ(boxes.size(), 6U);
    for (const auto& [id, box] : boxes) {
        const cv::Rect car = SunnyRoad::carAt(id - 1, 25);
        const OrientedBox upright = box.upright();
        EXPECT_NEAR(upright.centre.x - upright.length / 2, car.x - 0.5, 0.3) << id;
        EXPECT_NEAR(upright.centre.x + upright.length / 2, car.br().x - 0.5, 0.9) << id;
        EXPECT_NEAR(upright.centre.y - upright.width / 2, car.y - 0.5, 0.3) << id;
        EXPECT_NEAR(upright.centre.y + upright.width / 2, car.br().y - 0.5, 0.9) << id;
    }
}

TEST(TrimmedBoxes, StayAsTheyAreWithoutPicturesAndWhereNothingIsSaidOfShadows) {
    SunnyRoad road;
    const auto expectUntouched = [](const std::map<TrackId, OrientedBox>& boxes) {
        ASSERT_EQ(boxes.size(), 6U);
        for (const auto& [id, box] : boxes) {
            EXPECT_NEAR(box.length, 24, 0.1) << id;
            EXPECT_NEAR(box.width, 11.5, 0.1) << id;
        }
    };
    expectUntouched(road.boxesIn(25, false));
    road.options.trim_shadows = false;
    expectUntouched(road.boxesIn(25));
    road.options.trim_shadows = true;
    road.paint = 75;  // as dark as the shade: which part is the car?
    expectUntouched(road.boxesIn(25));
}

TEST(TrimmedBoxes, ReadEveryPictureOnceAndInOrder) {
    SunnyRoad road;
    road.boxesIn(25);
    ASSERT_FALSE(road.asked.empty());
    for (std::size_t i = 1; i < road.asked.size(); ++i) EXPECT_LT(road.asked[i - 1], road.asked[i]);
}

}  // namespace eyrie::trimmed_boxes_test

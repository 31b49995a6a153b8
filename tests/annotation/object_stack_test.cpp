#include "annotation/pictures/object_stack.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <set>

#include "annotation/scenes.h"

namespace eyrie::object_stack_test {
namespace {

constexpr int kLast = 40;

/// A textured car that drives over a textured ground; every picture has noise of its own.
class NoisyScene {
 public:
    explicit NoisyScene(double noise, int hidden_from = kLast + 1) : noise_(noise), hidden_from_(hidden_from) {}

    static OrientedBox truth(FrameIndex frame) { return {{60 + 3.0 * frame, 70 + 1.0 * frame}, 26, 12, 0.32}; }

    static cv::Mat clean(FrameIndex frame) {
        static const cv::Mat ground = test::groundTexture({240, 160}, 3, 3, 20, 235);
        static const cv::Mat car = test::groundTexture({26, 12}, 9, 1.2, 20, 235);
        cv::Mat picture = ground.clone();
        const OrientedBox box = truth(frame);
        const cv::Point2d d = box.direction();
        const cv::Point2d corner = box.toImage({-12.5, -5.5});
        cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), picture.size(),
                       cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
        return picture;
    }

    cv::Mat picture(FrameIndex frame) {
        asked.insert(frame);
        if (frame < 0 || frame > kLast) return {};
        cv::Mat picture = frame < hidden_from_ ? clean(frame) : cv::Mat(160, 240, CV_8UC1, cv::Scalar(90));
        cv::Mat noise(picture.size(), CV_16SC1);
        cv::RNG dice(static_cast<std::uint64_t>(frame + 1));
        dice.fill(noise, cv::RNG::NORMAL, 0, noise_);
        cv::add(picture, noise, picture, cv::noArray(), CV_8U);
        return picture;
    }

    std::set<FrameIndex> asked;

 private:
    double noise_;
    int hidden_from_;
};

/// Mean difference from what the car looks like without noise, over the inside of its box.
double error(const cv::Mat& upright, const OrientedBox& area, FrameIndex frame) {
    const cv::Mat clean = NoisyScene::clean(frame);
    const OrientedBox car = NoisyScene::truth(frame);
    double sum = 0;
    int count = 0;
    const double step = area.length / upright.cols;
    for (int y = 0; y < upright.rows; ++y) {
        for (int x = 0; x < upright.cols; ++x) {
            const cv::Point2d at =
                area.toImage({(x - (upright.cols - 1) / 2.0) * step, (y - (upright.rows - 1) / 2.0) * step});
            if (!car.contains(at, -1.5)) continue;
            cv::Mat value;
            cv::getRectSubPix(clean, {1, 1}, cv::Point2f(at), value);
            sum += std::abs(static_cast<double>(upright.at<unsigned char>(y, x)) -
                            static_cast<double>(value.at<unsigned char>(0, 0)));
            ++count;
        }
    }
    return sum / count;
}

LabelledObject carWith(cv::Point2d wrong_by) {
    OrientedBox first = NoisyScene::truth(0);
    OrientedBox last = NoisyScene::truth(kLast);
    last.centre += wrong_by;
    return test::object(1, {test::keyframe(0, first, true), test::keyframe(kLast, last, true)}, kLast);
}

TEST(ObjectStack, LooksAtTheNearestFramesUpToTheFirstAndTheLast) {
    const auto lookedAt = [](FrameIndex frame) {
        NoisyScene scene(5);
        stackObject(carWith({}), frame, CameraMotion::standing(0, kLast),
                    [&](FrameIndex at) { return scene.picture(at); }, {.layers = 7});
        return scene.asked;
    };
    EXPECT_EQ(lookedAt(20), (std::set<FrameIndex>{17, 18, 19, 20, 21, 22, 23}));
    EXPECT_EQ(lookedAt(kLast - 1), (std::set<FrameIndex>{34, 35, 36, 37, 38, 39, 40}));
    EXPECT_EQ(lookedAt(1), (std::set<FrameIndex>{0, 1, 2, 3, 4, 5, 6}));
}

TEST(ObjectStack, TakesTheNoiseAway) {
    NoisyScene scene(25);
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const ObjectStack one = stackObject(carWith({}), 20, CameraMotion::standing(0, kLast), gray, {.layers = 3});
    const ObjectStack many = stackObject(carWith({}), 20, CameraMotion::standing(0, kLast), gray);
    ASSERT_FALSE(many.stacked.empty());
    EXPECT_EQ(many.layers, 25);
    EXPECT_EQ(many.frame, 20);
    EXPECT_NEAR(many.area.centre.x, NoisyScene::truth(20).centre.x, 1e-9);
    EXPECT_LT(error(many.stacked, many.area, 20), 0.6 * error(one.stacked, one.area, 20));
    EXPECT_LT(error(many.stacked, many.area, 20), 8);
    EXPECT_EQ(scene.asked.size(), 25U) << "the nearest frames and no others";
    EXPECT_EQ(*scene.asked.begin(), 8);
}

TEST(ObjectStack, LiesOnTheFrameEvenWhereTheInterpolationIsAFewPixelsOff) {
    NoisyScene scene(12);
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    // 4 px after 40 frames: the box creeps over the car by 0.1 px a frame.
    const ObjectStack stack = stackObject(carWith({4, 0}), 20, CameraMotion::standing(0, kLast), gray);
    ASSERT_FALSE(stack.stacked.empty());
    EXPECT_LT(error(stack.stacked, stack.area, 20), 12);
}

TEST(ObjectStack, LeavesOutFramesInWhichItIsHidden) {
    NoisyScene scene(5, 21);
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const ObjectStack stack = stackObject(carWith({}), 20, CameraMotion::standing(0, kLast), gray);
    EXPECT_GE(stack.layers, 12);
    EXPECT_LE(stack.layers, 13);
    ASSERT_FALSE(stack.stacked.empty());
    EXPECT_LT(error(stack.stacked, stack.area, 20), 10);
}

TEST(ObjectStack, ShowsHalfTheLengthAroundTheBoxAndThreePixelsAtLeast) {
    const auto areaOf = [](double length, double width) {
        const auto box = test::object(1, {test::keyframe(0, {{100, 80}, length, width, 0.5})}, 0);
        const ObjectStack stack = stackObject(box, 0, CameraMotion::standing(0, 1),
                                              [](FrameIndex) { return cv::Mat(160, 240, CV_8UC1, cv::Scalar(90)); });
        EXPECT_EQ(stack.area.centre, cv::Point2d(100, 80));
        EXPECT_EQ(stack.area.heading, 0.5);
        return cv::Size2d(stack.area.length, stack.area.width);
    };
    EXPECT_EQ(areaOf(26, 12), cv::Size2d(26 + 2 * 13, 12 + 2 * 13));
    EXPECT_EQ(areaOf(12, 26), cv::Size2d(12 + 2 * 6, 26 + 2 * 6));
    EXPECT_EQ(areaOf(4, 2), cv::Size2d(4 + 2 * 3, 2 + 2 * 3));
    // 512 samples along the longest side at most.
    EXPECT_NEAR(areaOf(300, 100).width, 600, 1.5);
    EXPECT_NEAR(areaOf(300, 100).height, 400, 1.5);
}

TEST(ObjectStack, BringsWhatGrowsToTheSizeItHasInTheFrame) {
    // The camera comes down on a parked car: all grows from half to twice its size.
    const cv::Mat ground = test::groundTexture({240, 160}, 9, 3, 20, 235);
    const auto sizeIn = [](FrameIndex frame) { return 0.5 + 1.5 * frame / kLast; };
    const auto gray = [&](FrameIndex frame) {
        const double s = sizeIn(frame);
        cv::Mat picture;
        cv::warpAffine(ground, picture, cv::Matx23d(s, 0, 120 - s * 120, 0, s, 80 - s * 80), ground.size(),
                       cv::INTER_CUBIC, cv::BORDER_REFLECT);
        return picture;
    };
    std::vector<Keyframe> keyframes;
    for (FrameIndex frame = 0; frame <= kLast; ++frame)
        keyframes.push_back(test::keyframe(frame, {{120, 80}, 30 * sizeIn(frame), 20 * sizeIn(frame), 0.4}, true));
    const LabelledObject car = test::object(1, keyframes, kLast);
    ObjectStackOptions options;
    options.min_correlation = 0.9;
    const ObjectStack stack = stackObject(car, 20, CameraMotion::standing(0, kLast), gray, options);
    EXPECT_EQ(stack.layers, 25) << "each looks the same";
    ObjectStackOptions one = options;
    one.layers = 3;
    const ObjectStack three = stackObject(car, 20, CameraMotion::standing(0, kLast), gray, one);
    ASSERT_FALSE(stack.stacked.empty());
    ASSERT_FALSE(three.stacked.empty());
    cv::Mat difference;
    cv::absdiff(stack.stacked, three.stacked, difference);
    EXPECT_LT(cv::mean(difference)[0], 3);
}

TEST(ObjectStack, SaysNothingWhereThereIsNone) {
    NoisyScene scene(5);
    const auto gray = [&](FrameIndex frame) { return scene.picture(frame); };
    const auto camera = CameraMotion::standing(0, kLast);
    EXPECT_TRUE(stackObject(carWith({}), kLast + 5, camera, gray).stacked.empty());
    auto new_one = carWith({});
    new_one.keyframes.resize(1);
    new_one.last_frame = 0;
    const ObjectStack alone = stackObject(new_one, 0, camera, gray);
    EXPECT_TRUE(alone.stacked.empty());
    EXPECT_EQ(alone.layers, 1);
    auto flat = carWith({});
    for (auto& keyframe : flat.keyframes) keyframe.box.width = 0;
    EXPECT_TRUE(stackObject(flat, 10, camera, gray).stacked.empty());
    EXPECT_TRUE(stackObject(carWith({}), 10, camera, [](FrameIndex) { return cv::Mat(); }).stacked.empty());
    std::stop_source stop;
    stop.request_stop();
    EXPECT_TRUE(stackObject(carWith({}), 10, camera, gray, {}, stop.get_token()).stacked.empty());
}

}  // namespace
}  // namespace eyrie::object_stack_test

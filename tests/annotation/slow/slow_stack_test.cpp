#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "annotation/keyframes/interpolation.h"
#include "annotation/pictures/object_stack.h"
#include "annotation/scenes.h"

/// Stacks of an object against those that are laid pixel by pixel as their rules are told.
namespace eyrie::slow_stack_test {
namespace {

const cv::Size kPicture(220, 150);

struct SlowStack {
    int layers = 0;
    cv::Size size;
    OrientedBox area;
    cv::Mat stacked;
};

double scaleOf(const OrientedBox& box, const ObjectStackOptions& options, double& border) {
    border = std::max(3.0, options.border * box.length);
    return std::min(options.samples_per_px, 512 / (std::max(box.length, box.width) + 2 * border));
}

/// A box as it looks, each sample where it lies in the picture.
cv::Mat chipOf(const cv::Mat& picture, const OrientedBox& box, double px_per_sample, cv::Size size) {
    cv::Mat xs(size, CV_32F), ys(size, CV_32F), chip;
    for (int y = 0; y < size.height; ++y)
        for (int x = 0; x < size.width; ++x) {
            const cv::Point2d at = box.toImage(
                {(x - (size.width - 1) / 2.0) * px_per_sample, (y - (size.height - 1) / 2.0) * px_per_sample});
            xs.at<float>(y, x) = static_cast<float>(at.x);
            ys.at<float>(y, x) = static_cast<float>(at.y);
        }
    cv::remap(picture, chip, xs, ys, cv::INTER_CUBIC, cv::BORDER_REPLICATE);
    return chip;
}

SlowStack slowlyStacked(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera,
                        const GrayFrames& gray, const ObjectStackOptions& options, double& nearest_limit) {
    SlowStack result;
    const LabelledBox here = boxAt(object, frame, camera);
    if (!here.visible() || here.box.area() <= 0 || gray(frame).empty()) return result;
    double border = 0;
    const double scale = scaleOf(here.box, options, border);
    result.size = {std::max(4, static_cast<int>(std::ceil((here.box.length + 2 * border) * scale))),
                   std::max(4, static_cast<int>(std::ceil((here.box.width + 2 * border) * scale)))};
    result.area = {here.box.centre, result.size.width / scale, result.size.height / scale, here.box.heading};
    const cv::Mat reference = chipOf(gray(frame), here.box, 1 / scale, result.size);
    const cv::Size part(
        std::clamp(static_cast<int>(std::lround(1.15 * here.box.length * scale)), 2, result.size.width),
        std::clamp(static_cast<int>(std::lround(1.15 * here.box.width * scale)), 2, result.size.height));
    const cv::Rect inside({(result.size.width - part.width) / 2, (result.size.height - part.height) / 2}, part);
    const int shift = static_cast<int>(std::lround(options.largest_shift_px * scale));
    // The nearest frames, the earlier of two first, as many as asked for.
    std::vector<FrameIndex> frames;
    for (FrameIndex each = firstFrameOf(object); each <= object.last_frame; ++each) frames.push_back(each);
    std::stable_sort(frames.begin(), frames.end(),
                     [&](FrameIndex a, FrameIndex b) { return std::abs(a - frame) < std::abs(b - frame); });
    frames.resize(std::min(frames.size(), static_cast<std::size_t>(std::max(1, options.layers))));
    std::vector<cv::Mat> layers;
    for (const FrameIndex each : frames) {
        const LabelledBox box = boxAt(object, each, camera);
        if (each == frame) {
            layers.push_back(reference);
            continue;
        }
        if (box.outside || box.occlusion == Occlusion::fully || gray(each).empty()) continue;
        double growth = 1;
        if (box.box.area() > 0) growth = std::clamp(std::sqrt(box.box.area() / here.box.area()), 0.25, 4.0);
        const cv::Size wide_size(result.size.width + 2 * shift, result.size.height + 2 * shift);
        const cv::Mat wide = chipOf(gray(each), box.box, growth / scale, wide_size);
        double best = -2;
        cv::Point place;
        for (int y = 0; y <= 2 * shift; ++y)
            for (int x = 0; x <= 2 * shift; ++x) {
                cv::Mat like;
                cv::matchTemplate(wide(inside + cv::Point(x, y)), reference(inside), like, cv::TM_CCOEFF_NORMED);
                if (static_cast<double>(like.at<float>(0, 0)) <= best) continue;
                best = static_cast<double>(like.at<float>(0, 0));
                place = {x, y};
            }
        nearest_limit = std::min(nearest_limit, std::abs(best - options.min_correlation));
        if (best >= options.min_correlation) layers.push_back(wide(cv::Rect(place, result.size)));
    }
    result.layers = static_cast<int>(layers.size());
    if (layers.size() < 3) return result;
    result.stacked = cv::Mat(result.size, CV_8UC1);
    for (int y = 0; y < result.size.height; ++y)
        for (int x = 0; x < result.size.width; ++x) {
            std::vector<int> values;
            values.reserve(layers.size());
            for (const cv::Mat& layer : layers) values.push_back(layer.at<unsigned char>(y, x));
            std::sort(values.begin(), values.end());
            result.stacked.at<unsigned char>(y, x) = static_cast<unsigned char>(values[(values.size() - 1) / 2]);
        }
    return result;
}

TEST(SlowStack, LayersLieAsTheRulesSay) {
    std::mt19937 dice(11);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(dice);
    };
    const cv::Mat ground = test::groundTexture(kPicture, 3, 3, 20, 235);
    int stacks = 0, left_out = 0;
    for (int scene = 0; scene < 40; ++scene) {
        const double length = scene % 7 == 6 ? between(2, 5) : scene % 11 == 10 ? between(150, 260) : between(14, 40);
        const OrientedBox first{{between(40, 180), between(30, 120)}, length, between(2, 30), between(-3, 3)};
        const cv::Point2d speed(between(-1.5, 1.5), between(-1.5, 1.5));
        const double grows = between(0, 1) < 0.3 ? between(-0.05, 0.3) : 0, turns = between(-0.03, 0.03);
        const cv::Mat car = test::groundTexture({static_cast<int>(first.length) + 2, static_cast<int>(first.width) + 2},
                                                9, 1.5, 20, 235);
        const auto truth = [&](FrameIndex frame) {
            OrientedBox box = first;
            box.centre += speed * static_cast<double>(frame - 12);
            box.length *= std::exp(grows * (frame - 12));
            box.width *= std::exp(grows * (frame - 12));
            box.heading += turns * (frame - 12);
            return box;
        };
        std::vector<cv::Mat> pictures;
        for (FrameIndex frame = 0; frame <= 24; ++frame) {
            cv::Mat picture = ground.clone();
            const OrientedBox box = truth(frame);
            const cv::Point2d d = box.direction() * std::exp(grows * (frame - 12));
            const cv::Point2d corner = box.toImage({-box.length / 2, -box.width / 2});
            if (between(0, 1) < 0.85)
                cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), kPicture,
                               cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
            cv::Mat grain(kPicture, CV_16SC1);
            cv::RNG(dice()).fill(grain, cv::RNG::NORMAL, 0, 10);
            cv::add(picture, grain, picture, cv::noArray(), CV_8U);
            pictures.push_back(picture);
        }
        if (scene % 5 == 4) pictures[10].release();
        LabelledObject object = test::object(1, {}, 24 - scene % 4);
        for (FrameIndex frame = scene % 3; frame <= 24; frame += 3) {
            OrientedBox box = truth(frame);
            box.centre += cv::Point2d(between(-1, 1), between(-1, 1));
            object.keyframes.push_back(test::keyframe(frame, box, true));
            object.keyframes.back().occlusion =
                static_cast<Occlusion>(between(0, 1) < 0.7 ? 0 : static_cast<int>(between(0, 3)));
            object.keyframes.back().outside = frame != 12 && between(0, 1) < 0.1;
        }
        if (scene == 13) object.keyframes[2].box.width = 0;
        ObjectStackOptions options;
        options.layers = scene % 8 == 7 ? 2 : 4 + scene % 21;
        if (scene % 4 == 3) options.border = 0.1;
        if (scene % 4 == 2) options.samples_per_px = 1.3;
        if (scene % 6 == 5) options.largest_shift_px = 1;
        if (scene % 3 == 2) options.min_correlation = 0.7;
        const FrameIndex frame = std::array{12, 4, 20}[static_cast<std::size_t>(scene % 3)];
        const CameraMotion camera = CameraMotion::standing(0, 24);
        const auto gray = [&](FrameIndex each) { return pictures[static_cast<std::size_t>(each)]; };
        std::vector<FrameIndex> asked;
        const ObjectStack stack = stackObject(
            object, frame, camera,
            [&](FrameIndex each) {
                asked.push_back(each);
                return gray(each);
            },
            options);
        double nearest_limit = 1;
        const SlowStack slow = slowlyStacked(object, frame, camera, gray, options, nearest_limit);
        // Samples lie on 32nds of a pixel, so that what is just alike enough may be so in one of both only.
        if (nearest_limit < 0.02) continue;
        ASSERT_EQ(stack.layers, slow.layers) << scene;
        ASSERT_EQ(stack.stacked.empty(), slow.stacked.empty()) << scene;
        ASSERT_TRUE(std::is_sorted(asked.begin() + (asked.empty() ? 0 : 1), asked.end())) << "videos are read forward";
        if (slow.layers > 0) {
            ASSERT_NEAR(stack.area.length, slow.area.length, 1e-9) << scene;
            ASSERT_NEAR(stack.area.width, slow.area.width, 1e-9) << scene;
            ASSERT_EQ(stack.area.centre, slow.area.centre) << scene;
            ASSERT_EQ(stack.area.heading, slow.area.heading) << scene;
        }
        if (slow.stacked.empty()) continue;
        ASSERT_EQ(stack.stacked.size(), slow.size) << scene;
        cv::Mat apart;
        cv::absdiff(stack.stacked, slow.stacked, apart);
        EXPECT_LT(cv::mean(apart)[0], 1.2) << scene;
        ++stacks;
        left_out += std::min(options.layers, object.last_frame - firstFrameOf(object) + 1) - slow.layers;
    }
    EXPECT_GT(stacks, 18);
    EXPECT_GT(left_out, 30);
}

}  // namespace
}  // namespace eyrie::slow_stack_test

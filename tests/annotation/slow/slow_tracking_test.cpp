#include <gtest/gtest.h>

#include <map>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <random>

#include "annotation/pictures/box_tracker.h"
#include "annotation/scenes.h"

/// A box followed through many pictures against the same followed picture by picture, with what is told of the end.
namespace eyrie::slow_tracking_test {
namespace {

const cv::Size kPicture(200, 140);

/// What following comes to, as its rules say: steps of the follower until one is not sure; what is hidden for a while
/// counts once it is seen again.
FollowResult slowlyFollowed(const OrientedBox& box, FrameIndex start, FrameIndex last, const GrayFrames& gray,
                            const CameraMotion& camera, const FollowOptions& options) {
    FollowResult result;
    const auto halfInside = [](const OrientedBox& each) { return areaInImage(each, kPicture) * 2 >= each.area(); };
    if (gray(start).empty() || !halfInside(box)) {
        result.end = gray(start).empty() ? FollowEnd::no_picture : FollowEnd::left_image;
        result.end_frame = start;
        return result;
    }
    BoxFollower follower(box, gray(start), options);
    std::vector<FollowedBox> waiting;
    std::optional<FollowEnd> why;
    OrientedBox at = box;
    const auto endsAt = [&](FollowEnd end, FrameIndex frame) {
        result.end = end;
        result.end_frame = frame;
        return result;
    };
    for (FrameIndex frame = start; frame != last;) {
        const FrameIndex next = last > start ? frame + 1 : frame - 1;
        const cv::Mat before = gray(frame), after = gray(next);
        if (after.empty() || after.size() != before.size()) return endsAt(FollowEnd::no_picture, next);
        const auto known = camera.map(frame, next);
        const BoxFollower::Step step =
            follower.advance(before, after, known ? *known : cameraAround(before, after, at));
        if (!halfInside(step.box)) return endsAt(FollowEnd::left_image, next);
        const bool waits = step.hidden && static_cast<int>(waiting.size()) < options.max_hidden_frames;
        if (waits && waiting.empty()) why = step.end;
        if (!waits && step.end) {
            if (waiting.empty()) return endsAt(*step.end, next);
            return endsAt(*why, waiting[0].frame);
        }
        waiting.push_back({next, step.box, step.certainty});
        if (!waits) {
            result.boxes.insert(result.boxes.end(), waiting.begin(), waiting.end());
            waiting.clear();
        }
        at = step.box;
        frame = next;
    }
    if (!waiting.empty()) return endsAt(*why, waiting[0].frame);
    return endsAt(FollowEnd::end_of_range, last);
}

TEST(SlowTracking, BoxesAreFollowedAndEndAsTheRulesSay) {
    std::mt19937 dice(2);
    const auto between = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(dice);
    };
    const cv::Mat ground = test::groundTexture({400, 300}, 1, 2.5), other = test::groundTexture({60, 40}, 4, 1.5);
    std::map<FollowEnd, int> ends;
    int hidden = 0;
    for (int scene = 0; scene < 26; ++scene) {
        const bool waits = scene % 3 == 0;
        const OrientedBox first{{between(40, 160), between(40, 100)}, 26, 13, between(-3, 3)};
        const cv::Mat car = test::groundTexture({27, 14}, 2, 1.2);
        const cv::Point2d pan(scene % 4 == 1 ? 0.8 : 0, 0);
        const double speed = waits ? 0 : between(0.5, 4);
        const int count = 26, covered_from = waits ? 8 : 100 + scene % 2 * -88;
        const int covered_for = static_cast<int>(between(2, 9));
        std::vector<cv::Mat> pictures;
        for (int frame = 0; frame < count; ++frame) {
            cv::Mat picture = ground(cv::Rect(static_cast<int>(std::lround(60 + pan.x * frame)), 40, 200, 140)).clone();
            OrientedBox box = first;
            box.centre += first.direction() * (speed * frame);
            const cv::Point2d d = box.direction(), corner = box.toImage({-13, -6.5});
            cv::warpAffine(car, picture, cv::Matx23d(d.x, -d.y, corner.x, d.y, d.x, corner.y), kPicture,
                           cv::INTER_LINEAR, cv::BORDER_TRANSPARENT);
            if (frame >= covered_from && frame < covered_from + covered_for) {
                const cv::Rect over(cvRound(box.centre.x) - 34 + 12 * (frame - covered_from),
                                    cvRound(box.centre.y) - 20, 60, 40);
                const cv::Rect part = over & cv::Rect({}, kPicture);
                if (!part.empty()) other(part - over.tl()).copyTo(picture(part));
            }
            pictures.push_back(picture);
        }
        if (scene % 7 == 6) pictures[17].release();
        if (scene % 13 == 12) pictures[15] = pictures[15](cv::Rect(0, 0, 199, 140)).clone();
        FollowOptions options;
        options.max_hidden_frames = scene % 2 == 0 ? 45 : 3;
        if (scene % 5 == 4) options.min_certainty = 0.75;
        const CameraMotion camera =
            scene % 4 == 2 ? CameraMotion()
                           : CameraMotion(test::stepsOf(
                                 [&](double frame) {
                                     return cv::Matx33d(1, 0, -std::round(60 + pan.x * frame), 0, 1, 0, 0, 0, 1);
                                 },
                                 count));
        const auto gray = [&](FrameIndex frame) {
            return frame >= 0 && frame < count ? pictures[static_cast<std::size_t>(frame)] : cv::Mat();
        };
        const bool back = scene % 8 == 5;
        OrientedBox box = first;
        if (back) box.centre += first.direction() * (speed * 10);
        const FrameIndex start = back ? 10 : 0, last = back ? 0 : scene % 9 == 8 ? count + 3 : count - 1;
        std::vector<FollowedBox> told;
        const FollowResult found =
            followBox(box, start, last, gray, camera, options, [&](const FollowedBox& each) { told.push_back(each); });
        const FollowResult slow = slowlyFollowed(box, start, last, gray, camera, options);
        ASSERT_EQ(found.end, slow.end) << scene;
        ASSERT_EQ(found.end_frame, slow.end_frame) << scene;
        ASSERT_EQ(found.boxes.size(), slow.boxes.size()) << scene;
        ASSERT_EQ(told.size(), slow.boxes.size()) << scene;
        for (std::size_t i = 0; i < slow.boxes.size(); ++i) {
            ASSERT_EQ(found.boxes[i].frame, slow.boxes[i].frame) << scene;
            ASSERT_EQ(told[i].frame, slow.boxes[i].frame) << scene;
            ASSERT_EQ(found.boxes[i].certainty, slow.boxes[i].certainty) << scene;
            ASSERT_EQ(test::cornerDistance(found.boxes[i].box, slow.boxes[i].box), 0) << scene;
            ASSERT_EQ(test::cornerDistance(told[i].box, slow.boxes[i].box), 0) << scene;
        }
        const std::string number = std::to_string(found.end_frame);
        ASSERT_EQ(found.reason.find(found.end == FollowEnd::end_of_range ? "reached frame " + number
                                                                         : "stopped at frame " + number + ": "),
                  0U)
            << found.reason;
        ++ends[found.end];
        hidden += waits && slow.boxes.size() > 20;
    }
    EXPECT_GE(ends.size(), 4U);
    EXPECT_GE(hidden, 1);
}

}  // namespace
}  // namespace eyrie::slow_tracking_test

#include "annotation/keyframes/box_reader.h"

#include <gtest/gtest.h>

#include <random>

#include "annotation/edits/carried_boxes.h"
#include "annotation/keyframes/dense_boxes.h"
#include "annotation/scenes.h"

namespace eyrie::box_reader_test {
namespace {

/// A car that stops, turns and drives on, seen by a camera that lost the ground once.
LabelledObject drivingCar(bool headings_set) {
    std::vector<Keyframe> keyframes;
    for (const int frame : {3, 20, 34, 35, 36, 60, 90, 91, 120}) {
        const double t = frame;
        keyframes.push_back(test::keyframe(frame, {{90 + 40 * std::sin(t / 20), 80 + t}, 20, 9, t / 30}, headings_set));
    }
    keyframes[6].outside = true;
    return test::object(1, keyframes, 150);
}

CameraMotion camera() {
    auto steps = test::stepsOf(test::flyingView, 200);
    steps.erase(steps.begin() + 70);
    return CameraMotion(steps);
}

bool same(const LabelledBox& a, const LabelledBox& b) {
    return a.source == b.source && a.box.centre == b.box.centre && a.box.length == b.box.length &&
           a.box.width == b.box.width && a.box.heading == b.box.heading && a.outside == b.outside &&
           a.heading_from_path == b.heading_from_path;
}

TEST(BoxReader, ShowsInAnyOrderToTheBitWhatEachFrameShowsAlone) {
    for (const bool headings_set : {false, true}) {
        const LabelledObject car = drivingCar(headings_set);
        for (const CameraMotion& moving : {camera(), CameraMotion()}) {
            CarriedBoxes known(moving, 4);
            BoxReader in_order(car, moving);
            BoxReader with_known(car, moving, PathShape::smooth, &known);
            for (int round = 0; round < 2; ++round) {
                for (int frame = 0; frame < 160; ++frame) {
                    const int jumping = frame * 37 % 160;
                    EXPECT_TRUE(same(in_order.at(frame), boxAt(car, frame, moving))) << frame;
                    EXPECT_TRUE(same(with_known.at(jumping), boxAt(car, jumping, moving))) << jumping;
                }
            }
        }
    }
}

TEST(BoxReader, KeepsAKeyframeWithItsHeadingToTheBit) {
    const LabelledObject car = drivingCar(true);
    const CameraMotion moving = camera();
    BoxReader reader(car, moving);
    for (const Keyframe& keyframe : car.keyframes) {
        const LabelledBox shown = reader.at(keyframe.frame);
        EXPECT_EQ(shown.source, BoxSource::keyframe);
        EXPECT_EQ(shown.box.heading, keyframe.box.heading);
        EXPECT_FALSE(shown.heading_from_path);
    }
}

TEST(Deviations, FindTheFirstOfTheWorstHoweverTheyChange) {
    std::mt19937 dice(4);
    std::vector<double> plain(300, 0);
    Deviations deviations(plain.size());
    for (int change = 0; change < 5000; ++change) {
        const std::size_t i = dice() % plain.size();
        plain[i] = static_cast<double>(dice() % 50);
        deviations.set(i, plain[i]);
        ASSERT_EQ(deviations.worst(),
                  static_cast<std::size_t>(std::max_element(plain.begin(), plain.end()) - plain.begin()));
    }
}

}  // namespace
}  // namespace eyrie::box_reader_test

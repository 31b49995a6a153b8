#include "detection/sliding_window/box_classifier.h"

#include <gtest/gtest.h>

#include <cmath>

#include "detection/detector_factory.h"
#include "detection/trained_window_model.h"

namespace eyrie::box_classifier_test {
namespace {

using test::drivenScene;
using test::drivenSceneWindow;
using test::kContractScale;

BoxClassifier classifier(double frame_rate_hz = 25) {
    SceneScale scale = kContractScale;
    scale.frame_rate_hz = frame_rate_hz;
    return {loadModel(drivenSceneWindow().model), drivenSceneWindow(), scale};
}

OrientedBox moved(OrientedBox box, cv::Point2d by) {
    box.centre += by;
    return box;
}

}  // namespace

TEST(BoxClassifier, VehiclesLieAboveZeroAndGroundBelow) {
    for (const double heading : {-2.5, -0.7, 0.3, 1.9}) {
        const auto scene = drivenScene(heading, {150, 118}, 77);
        EXPECT_GT(classifier().at(scene.frame.gray, scene.vehicle), 0) << heading;
        EXPECT_LT(classifier().at(scene.frame.gray, moved(scene.vehicle, {0, 70})), 0) << heading;
    }
}

TEST(BoxClassifier, BoxesThatAreNotExactAreForgiven) {
    const auto scene = drivenScene(0.4, {150, 118}, 78);
    const double ground = classifier().at(scene.frame.gray, moved(scene.vehicle, {0, 70}));
    OrientedBox part = scene.vehicle;
    part.length *= 0.7;
    OrientedBox joined = scene.vehicle;
    joined.length *= 1.5;
    for (const OrientedBox& box : {moved(scene.vehicle, {3, 0}), part, joined})
        EXPECT_GT(classifier().at(scene.frame.gray, box), ground) << box.length;
}

TEST(BoxClassifier, BoxesThatAreNoSizeOfACarAreLookedAtAsIfTheyWere) {
    const auto scene = drivenScene(0.4, {150, 118}, 79);
    const auto sized = [&](double length, double width) {
        OrientedBox box = scene.vehicle;
        box.length = length;
        box.width = width;
        return classifier().at(scene.frame.gray, box);
    };
    // A car is 40 × 16 px here: half and twice as long, .6 and 1.6 times as wide are the limits.
    EXPECT_EQ(sized(20, 16), sized(1, 16));
    EXPECT_EQ(sized(80, 16), sized(500, 16));
    EXPECT_EQ(sized(40, 9.6), sized(40, 0));
    EXPECT_EQ(sized(40, 25.6), sized(40, 200));
    EXPECT_NE(sized(30, 16), sized(20, 16));
    EXPECT_NE(sized(60, 16), sized(80, 16));
}

TEST(BoxClassifier, OfABoxBeyondThePictureNothingIsSaid) {
    const auto scene = drivenScene(0.4, {150, 118}, 80);
    const auto at = [&](cv::Point2d centre) {
        OrientedBox box = scene.vehicle;
        box.centre = centre;
        return classifier().at(scene.frame.gray, box);
    };
    const cv::Size size = scene.frame.gray.size();
    EXPECT_TRUE(std::isnan(at({-1, 50})));
    EXPECT_TRUE(std::isnan(at({50, size.height + 0.0})));
    EXPECT_TRUE(std::isfinite(at({0, 50})));
    EXPECT_TRUE(std::isfinite(at({size.width - 1.0, size.height - 1.0})));
}

TEST(BoxClassifier, LooksAtKeptDetectionsSomeFourTimesASecond) {
    const auto looked = [](double frame_rate_hz) {
        const BoxClassifier asked = classifier(frame_rate_hz);
        int frames = 0;
        for (FrameIndex frame = 0; frame < 60; ++frame) frames += asked.looksAt(frame) ? 1 : 0;
        return frames;
    };
    EXPECT_EQ(looked(25), 10);  // every sixth
    EXPECT_EQ(looked(10), 20);  // every third
    EXPECT_EQ(looked(2), 60);
    auto scene = drivenScene(0.4, {150, 118}, 81);
    Detection kept;
    kept.box = scene.vehicle;
    Detection rejected = kept;
    rejected.rejection = Rejection::outlier;
    std::vector<Detection> detections{kept, rejected};
    scene.frame.index = 5;
    classifier().judge(detections, scene.frame, 1);
    EXPECT_TRUE(std::isnan(detections[0].decision));
    scene.frame.index = 6;
    classifier().judge(detections, scene.frame, 1);
    EXPECT_EQ(detections[0].decision, classifier().at(scene.frame.gray, scene.vehicle));
    EXPECT_TRUE(std::isnan(detections[1].decision));
}

TEST(BoxClassifier, ExpectsLargerVehiclesWhenTheCameraHasZoomedIn) {
    const auto scene = drivenScene(0.4, {150, 118}, 81);
    cv::Mat zoomed;
    cv::resize(scene.frame.gray, zoomed, {}, 2, 2, cv::INTER_CUBIC);
    const OrientedBox there{scene.vehicle.centre * 2 + cv::Point2d(0.5, 0.5), scene.vehicle.length * 2,
                            scene.vehicle.width * 2, scene.vehicle.heading};
    EXPECT_GT(classifier().at(zoomed, there, 2), classifier().at(zoomed, there));
}

TEST(BoxClassifier, AsksTheModelOfTheDetectorThatOnlyThoseWithAClassifierHave) {
    for (const DetectionMethod method : allDetectionMethods()) {
        DetectionOptions options;
        options.method = method;
        options.sliding_window = drivenSceneWindow();
        const std::unique_ptr<Detector> detector = makeDetector(options, kContractScale);
        ASSERT_EQ(detector->model() != nullptr, looksThroughWindows(method)) << nameOf(method);
        if (detector->model() == nullptr) continue;
        const test::DrivenScene scene = drivenScene(0.4);
        EXPECT_EQ(BoxClassifier(*detector->model(), options.sliding_window, kContractScale)
                      .at(scene.frame.gray, scene.vehicle),
                  classifier().at(scene.frame.gray, scene.vehicle))
            << nameOf(method);
    }
}

}  // namespace eyrie::box_classifier_test

#include "detection/scaled_detectors.h"

#include <gtest/gtest.h>

#include <set>

#include "core/error.h"
#include "detection/detector_factory.h"
#include "detection/detector_table.h"
#include "detection/trained_window_model.h"

namespace eyrie::scaled_detectors_test {
namespace {

/// Answers with one detection whose score is its metres per pixel.
class TellsItsScale : public Detector {
 public:
    explicit TellsItsScale(const SceneScale& scale) : scale_(scale) {}
    std::vector<Detection> detect(const MotionRoi&, DetectionTrace*) const override {
        Detection detection;
        detection.score = scale_.gsd_m_per_px;
        detection.complete = scale_.slope.isFlat();
        return {detection};
    }
    const VehicleModel* model() const override { return nullptr; }

 private:
    SceneScale scale_;
};

MotionRoi areaAt(double x, double y) {
    MotionRoi roi;
    roi.box.centre = {x, y};
    return roi;
}

SceneScale tilted() {
    SceneScale scale{0.2, 25, true};
    scale.slope = ScaleSlope::ofPicture({801, 601}, 0, 0.003);
    return scale;
}

TEST(ScaledDetectors, ASearchAreaGoesToTheDetectorOfItsScale) {
    const ScaledDetectors detectors(tilted(),
                                    [](const SceneScale& here) { return std::make_unique<TellsItsScale>(here); });
    for (double y = 0; y <= 600; y += 20) {
        const Detection found = detectors.detect(areaAt(100, y)).at(0);
        EXPECT_TRUE(found.complete) << "each works at one scale";
        const double there = tilted().at({100, y}).gsd_m_per_px;
        EXPECT_NEAR(found.score / there, 1, 0.051) << y;
        EXPECT_EQ(detectors.decide(areaAt(100, y), nullptr).at(0).score, found.score);
    }
    EXPECT_EQ(detectors.detect(areaAt(100, 300)).at(0).score, 0.2) << "the given scale itself in the middle";
    EXPECT_EQ(detectors.detect(areaAt(100, 9000)).at(0).score, detectors.detect(areaAt(100, 600)).at(0).score)
        << "beyond the picture as at its edge";
}

TEST(ScaledDetectors, AClassifierThatTakesPartCanBeAskedInAnObliqueViewToo) {
    DetectionOptions options;
    options.sliding_window = test::drivenSceneWindow();
    SceneScale flat = tilted();
    flat.slope = {};
    for (const DetectionMethod method : allDetectionMethods()) {
        options.method = method;
        for (const SceneScale& scale : {flat, tilted()})
            EXPECT_EQ(makeDetector(options, scale)->model() != nullptr, looksThroughWindows(method))
                << kindOf(method).name << (scale.slope.isFlat() ? ", flat" : ", oblique");
    }
}

TEST(ScaledDetectors, EachOfThePictureIsMadeOnce) {
    std::multiset<double> made;
    const ScaledDetectors detectors(tilted(), [&](const SceneScale& here) {
        made.insert(here.gsd_m_per_px);
        return std::make_unique<TellsItsScale>(here);
    });
    // Factors from .2 to 1.9, steps of 1.1.
    EXPECT_EQ(made.size(), 25U);
    EXPECT_EQ(std::set<double>(made.begin(), made.end()).size(), made.size());
}

TEST(ScaledDetectors, WhatCannotBeMadeIsSaidAtOnce) {
    const auto refuse = [](const SceneScale&) -> std::unique_ptr<Detector> {
        throw Error(ErrorKind::input, "there is no model");
    };
    EXPECT_THROW(ScaledDetectors(tilted(), refuse), Error);
}

}  // namespace
}  // namespace eyrie::scaled_detectors_test

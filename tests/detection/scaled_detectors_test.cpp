#include "detection/scaled_detectors.h"

#include <gtest/gtest.h>

#include <opencv2/core/utility.hpp>
#include <set>

#include "core/error.h"

namespace eyrie {
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
    for (double y = -200; y <= 800; y += 37) {
        const Detection found = detectors.detect(areaAt(100, y)).at(0);
        EXPECT_TRUE(found.complete) << "each works at one scale";
        const double there = tilted().at({100, y}).gsd_m_per_px;
        EXPECT_NEAR(found.score / there, 1, 0.051) << y;
        EXPECT_EQ(detectors.decide(areaAt(100, y), nullptr).at(0).score, found.score);
    }
    EXPECT_EQ(detectors.detect(areaAt(100, 300)).at(0).score, 0.2) << "the given scale itself in the middle";
}

TEST(ScaledDetectors, EachIsMadeOnceWhoeverAsksFirst) {
    std::mutex mutex;
    std::multiset<double> made;
    const ScaledDetectors detectors(tilted(), [&](const SceneScale& here) {
        const std::scoped_lock lock(mutex);
        made.insert(here.gsd_m_per_px);
        return std::make_unique<TellsItsScale>(here);
    });
    cv::parallel_for_(cv::Range(0, 600), [&](const cv::Range& range) {
        for (int y = range.start; y < range.end; ++y) detectors.detect(areaAt(5, y));
    });
    EXPECT_GT(made.size(), 10U);
    EXPECT_EQ(made.size(), std::set<double>(made.begin(), made.end()).size());
}

TEST(ScaledDetectors, WhatCannotBeMadeIsSaidAtOnce) {
    const auto refuse = [](const SceneScale&) -> std::unique_ptr<Detector> {
        throw Error(ErrorKind::input, "there is no model");
    };
    EXPECT_THROW(ScaledDetectors(tilted(), refuse), Error);
}

}  // namespace
}  // namespace eyrie

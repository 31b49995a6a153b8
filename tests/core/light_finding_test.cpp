#include "core/evidence/light_finding.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie::light_finding_test {
namespace {

const SceneScale kKnown{0.2, 25, true};
const SceneScale kGuessed{0.2, 25, false};

LightFinding shadows(FrameIndex first = 0, FrameIndex last = 99) {
    LightFinding finding;
    finding.first_frame = first;
    finding.last_frame = last;
    finding.heading = radiansFromDegrees(135);
    finding.reach_m = 2.44;
    finding.vehicles = 14;
    finding.agreement = 0.93;
    finding.darkening = 0.45;
    finding.trimmed = 31;
    finding.dropped = 1;
    return finding;
}

LightFinding none(LightOutcome outcome, int vehicles = 0) {
    LightFinding finding;
    finding.last_frame = 49;
    finding.outcome = outcome;
    finding.vehicles = vehicles;
    return finding;
}

double areaOf(const std::vector<cv::Point2d>& outline) {
    double twice = 0;
    for (std::size_t i = 0; i < outline.size(); ++i) twice += outline[i].cross(outline[(i + 1) % outline.size()]);
    return twice / 2;
}

}  // namespace

TEST(LightFinding, SaysWhereShadowsFallHowFarAndWhoSaysSo) {
    EXPECT_EQ(
        describe({shadows()}, kKnown),
        "shadows fall to 135° (to the lower left) in frame 0, 2.4 m beyond most vehicles and are 45 % darker than "
        "the ground: 14 vehicles say so, 93 % of what they say agrees; taken out of the boxes of 31 tracks, 1 "
        "track left out as mere shadow");
    LightFinding bare = shadows();
    bare.darkening.reset();
    bare.trimmed = bare.dropped = 0;
    EXPECT_EQ(describe({bare}, kGuessed),
              "shadows fall to 135° (to the lower left) in frame 0, 12.2 px beyond most vehicles: 14 vehicles say so, "
              "93 % of what they say agrees")
        << "no metres where nobody knows them";
}

TEST(LightFinding, OfSeveralStretchesTheLongestIsToldAndTheOthersAreCounted) {
    const std::string text = describe({shadows(), none(LightOutcome::few_vehicles, 1), shadows(200, 400)}, kKnown);
    EXPECT_THAT(text, testing::HasSubstr("in frame 200"));
    EXPECT_THAT(text, testing::HasSubstr("; the like in 1 other stretch"));
    EXPECT_THAT(text, testing::HasSubstr("In frames 0 to 49 no shadows found: only 1 vehicle stands out"));
}

TEST(LightFinding, SaysWhyThereAreNone) {
    EXPECT_EQ(describe(std::vector<LightFinding>{}, kKnown), "");
    const auto told = [](LightOutcome outcome, int vehicles = 0) {
        return describe({none(outcome, vehicles)}, kKnown);
    };
    EXPECT_EQ(told(LightOutcome::few_vehicles),
              "no shadows found: no vehicle stands out clearly from what is dark beside it, 4 are needed");
    EXPECT_EQ(told(LightOutcome::few_vehicles, 3),
              "no shadows found: only 3 vehicles stand out clearly from what is dark beside them, 4 are needed");
    EXPECT_THAT(told(LightOutcome::short_shadows, 6), testing::HasSubstr("beside 6 vehicles hardly reaches"));
    EXPECT_THAT(told(LightOutcome::disagreement, 6), testing::HasSubstr("does not lie on one side"));
    EXPECT_THAT(told(LightOutcome::shaded_sides, 6), testing::HasSubstr("their own shaded sides"));
    EXPECT_THAT(told(LightOutcome::switched_off), testing::HasSubstr("finishing.trim_shadows"));
    EXPECT_THAT(told(LightOutcome::no_scale), testing::HasSubstr("scale is not known"));
    EXPECT_THAT(told(LightOutcome::no_classifier), testing::HasSubstr("no classifier"));
    EXPECT_THAT(told(LightOutcome::no_pictures), testing::HasSubstr("not read once more"));
    LightFinding beams = none(LightOutcome::beams, 12);
    beams.trimmed = 40;
    EXPECT_EQ(describe({beams}, kKnown),
              "night: what the headlights of 12 vehicles light about them was taken out of the boxes of 40 tracks");
}

TEST(LightFinding, DirectionsHaveWordsForTheScreen) {
    const char* const ways[] = {"to the right", "to the lower right", "down", "to the lower left",
                                "to the left",  "to the upper left",  "up",   "to the upper right"};
    for (int i = 0; i < 8; ++i) {
        EXPECT_EQ(wayOnScreen(radiansFromDegrees(45 * i + 20)), ways[i]) << i;
        EXPECT_EQ(wayOnScreen(radiansFromDegrees(45 * i - 20)), ways[i]) << i;
    }
    EXPECT_EQ(describe(FrameShadow{3, radiansFromDegrees(-0.2), 10}, kKnown),
              "to 0° (to the right), 2.0 m beyond most vehicles");
}

TEST(LightFinding, AShadowReachesFartherInPixelsWhereTheGroundIsNearer) {
    SceneScale scale = kKnown;
    scale.slope = {0, 0.005, 320, 180};
    const FrameShadow shadow{0, kPi / 2, 10};
    EXPECT_NEAR(shadowReach(shadow, {320, 180}, scale).y, 10, 1e-9);
    EXPECT_NEAR(shadowReach(shadow, {320, 280}, scale).y, 15, 1e-9);
    EXPECT_NEAR(shadowReach(shadow, {320, 280}, scale).x, 0, 1e-9);
}

TEST(LightFinding, TheOutlineHoldsTheBoxAndAllThatItSweeps) {
    for (const double heading : {0.0, 0.7, 2.0, -2.9}) {
        const OrientedBox box{{100, 60}, 20, 8, heading};
        for (int turn = 0; turn < 16; ++turn) {
            const double way = turn * kPi / 8;
            const cv::Point2d reach(6 * std::cos(way), 6 * std::sin(way));
            const std::vector<cv::Point2d> outline = shadowOutline(box, reach);
            const cv::Point2d in_box = box.toBox(box.centre + reach);
            // What a box sweeps is as wide as it is across the way.
            const double swept = std::abs(in_box.x) * box.width + std::abs(in_box.y) * box.length;
            EXPECT_NEAR(areaOf(outline), box.area() + swept, 1e-6) << heading << " " << way;
            for (const cv::Point2d& corner : box.corners()) {
                for (const cv::Point2d& end : {corner, corner + reach}) {
                    for (std::size_t i = 0; i < outline.size(); ++i) {
                        const cv::Point2d side = outline[(i + 1) % outline.size()] - outline[i];
                        EXPECT_GE(side.cross(end - outline[i]), -1e-6) << "clockwise, nothing outside";
                    }
                }
            }
        }
    }
}

TEST(LightFinding, ATrimIsToldByItsShareOfTheBoxes) {
    EXPECT_EQ(describe(BoxTrim{LightOutcome::shadows, 0.5, 0.4, 0.234}),
              "its shadow was taken out of its boxes: 23 % of their area");
    EXPECT_EQ(describe(BoxTrim{LightOutcome::beams, 0.3, 0, 0.3}),
              "what its headlights light was taken out of its boxes: 30 % of their area");
    EXPECT_EQ(describe(BoxTrim{LightOutcome::shadows, 0.01, 0, 0.002}),
              "its shadow was taken out of its boxes: less than 1 % of their area");
}

}  // namespace eyrie::light_finding_test

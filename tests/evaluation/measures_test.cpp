#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "evaluation/evaluate.h"
#include "evaluation_boxes.h"

namespace eyrie {
namespace {

using test::boxes;
using test::car;
using test::ignored;
using test::shiftFor;

EvaluationOptions at(double overlap, Convention convention = Convention::thesis) {
    EvaluationOptions options;
    options.overlap = overlap;
    options.convention = convention;
    return options;
}

/// One object for ten frames, found in those of `found` by the track of the given id (0: not found).
struct OneObject {
    BoxesByFrame truth;
    BoxesByFrame result;
};
OneObject oneObject(const std::vector<int>& found_by) {
    OneObject scene;
    for (int frame = 0; frame < static_cast<int>(found_by.size()); ++frame) {
        const int id = found_by[static_cast<std::size_t>(frame)];
        scene.truth[frame].push_back(car(frame, 1, 100 + 3 * frame));
        // A car far away keeps every frame of the result populated.
        scene.truth[frame].push_back(car(frame, 2, 900));
        scene.result[frame].push_back(car(frame, 99, 900));
        if (id != 0) scene.result[frame].push_back(car(frame, id, 100 + 3 * frame));
    }
    return scene;
}

TEST(DetectionMeasures, FollowTheirEquations) {
    // 3 found with overlap 0.6, 1 missed, 2 false: P 3/5, R 3/4, f 6/9, N-MODA 1 − 3/4, N-MODP 0.6
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int k = 0; k < 4; ++k) truth[0].push_back(car(0, k, 100 * k));
    for (int k = 0; k < 3; ++k) result[0].push_back(car(0, std::nullopt, 100 * k + shiftFor(0.6)));
    for (int k = 0; k < 2; ++k) result[0].push_back(car(0, std::nullopt, 100 * k, 300));
    const Measures m = evaluate(truth, result, at(0.1));
    EXPECT_EQ(m.detection.true_positives, 3);
    EXPECT_EQ(m.detection.false_positives, 2);
    EXPECT_EQ(m.detection.false_negatives, 1);
    EXPECT_DOUBLE_EQ(m.detection.precision, 0.6);
    EXPECT_DOUBLE_EQ(m.detection.recall, 0.75);
    EXPECT_DOUBLE_EQ(m.detection.f_score, 6.0 / 9);
    EXPECT_DOUBLE_EQ(m.detection.n_moda, 0.25);
    EXPECT_NEAR(m.detection.n_modp, 0.6, 1e-12);
    EXPECT_FALSE(m.tracking || m.identity || m.hota);  // no ids, no tracking
}

TEST(DetectionMeasures, NothingAtAllIsZeroNotUndefined) {
    const Measures m = evaluate({}, {}, at(0.1));
    EXPECT_EQ(m.detection.f_score, 0);
    EXPECT_EQ(m.detection.n_moda, 1);
    EXPECT_EQ(m.shared_frames, 0);
    EXPECT_FALSE(remarksOn(m).empty());
}

TEST(DetectionMeasures, ATruthOfAnotherVideoIsSuspected) {
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 60; ++frame) {
        BoxRecord record;
        record.frame = frame;
        record.box = {{20, 20}, 10, 5, 0};
        truth[frame].push_back(record);
        record.box.centre.x = frame == 7 ? 20 : 200;  // one hit by chance
        result[frame].push_back(record);
    }
    const auto remarks = remarksOn(evaluate(truth, result, at(0.1)));
    EXPECT_TRUE(std::any_of(remarks.begin(), remarks.end(),
                            [](const std::string& r) { return r.find("same video") != std::string::npos; }));
}

TEST(TrackingMeasures, PerfectTracks) {
    const OneObject scene = oneObject(std::vector<int>(10, 4));
    for (const Convention convention : {Convention::thesis, Convention::trackeval}) {
        const Measures m = evaluate(scene.truth, scene.result, at(0.5, convention));
        ASSERT_TRUE(m.tracking && m.identity && m.hota);
        EXPECT_EQ(m.tracking->mota, 1);
        EXPECT_EQ(m.tracking->motp, 1);
        EXPECT_EQ(m.tracking->id_switches, 0);
        EXPECT_EQ(m.tracking->fragments, 0);
        EXPECT_EQ(m.tracking->mostly_tracked, 2);
        EXPECT_EQ(m.identity->idf1, 1);
        EXPECT_NEAR(meanOf(m.hota->hota), 1, 1e-12);
        EXPECT_EQ(m.shared_frames, 10);
        EXPECT_TRUE(remarksOn(m).empty());
    }
}

TEST(TrackingMeasures, SwitchesAndFragments) {
    // Found by 4, lost, found by 5 (a switch after the gap), changed to 6 at once, lost for good.
    const OneObject scene = oneObject({4, 4, 0, 0, 5, 5, 6, 6, 0, 0});
    const Measures m = evaluate(scene.truth, scene.result, at(0.5));
    EXPECT_EQ(m.tracking->id_switches, 2);
    EXPECT_EQ(m.tracking->fragments, 2);  // tracked → not tracked: before frames 2 and 8
    EXPECT_EQ(m.tracking->partially_tracked, 1);
    EXPECT_NEAR(m.tracking->mota, 1 - (4 + 0 + 2) / 20.0, 1e-12);
    const Measures other = evaluate(scene.truth, scene.result, at(0.5, Convention::trackeval));
    EXPECT_EQ(other.tracking->id_switches, 2);
    EXPECT_EQ(other.tracking->fragments, 1);  // two runs
    ASSERT_EQ(m.tracks.truth.size(), 2u);
    EXPECT_EQ(m.tracks.truth[0].id, 1);
    EXPECT_EQ(m.tracks.truth[0].frames, 10);
    EXPECT_EQ(m.tracks.truth[0].matched, 6);
    EXPECT_EQ(m.tracks.truth[0].switches, 2);
}

TEST(TrackingMeasures, EightyPercentDependsOnTheConvention) {
    const OneObject scene = oneObject({4, 4, 4, 4, 4, 4, 4, 4, 0, 0});
    const Measures ours = evaluate(scene.truth, scene.result, at(0.5));
    EXPECT_EQ(ours.tracking->mostly_tracked, 2);
    const Measures theirs = evaluate(scene.truth, scene.result, at(0.5, Convention::trackeval));
    EXPECT_EQ(theirs.tracking->mostly_tracked, 1);
    EXPECT_EQ(theirs.tracking->partially_tracked, 1);
}

TEST(TrackingMeasures, TwentyPercentIsNotMostlyLost) {
    const OneObject two = oneObject({4, 4, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(evaluate(two.truth, two.result, at(0.5)).tracking->mostly_lost, 0);
    const OneObject one = oneObject({4, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    EXPECT_EQ(evaluate(one.truth, one.result, at(0.5)).tracking->mostly_lost, 1);
}

TEST(TrackingMeasures, AnObjectThatIsIgnoredForAWhileIsNotLost) {
    OneObject scene = oneObject({4, 4, 0, 0, 4, 4, 4, 4, 4, 4});
    for (const int frame : {2, 3}) scene.truth[frame][0].ignore = true;
    const Measures m = evaluate(scene.truth, scene.result, at(0.5));
    EXPECT_EQ(m.tracking->fragments, 0);
    EXPECT_EQ(m.tracking->id_switches, 0);
    EXPECT_EQ(m.tracks.truth[0].frames, 8);
    EXPECT_EQ(m.detection.false_negatives, 0);
}

TEST(IdentityAndHota, ATrackCutInHalf) {
    // One object, four frames, found exactly by two tracks of two frames each: IDF1 counts one of them; the association
    // of each of the four hits is 2 / 4.
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 4; ++frame) {
        truth[frame].push_back(car(frame, 1, 100));
        result[frame].push_back(car(frame, frame < 2 ? 10 : 11, 100));
    }
    const Measures m = evaluate(truth, result, at(0.5));
    EXPECT_EQ(m.identity->idtp, 2);
    EXPECT_EQ(m.identity->idfp, 2);
    EXPECT_EQ(m.identity->idfn, 2);
    EXPECT_DOUBLE_EQ(m.identity->idf1, 0.5);
    EXPECT_NEAR(meanOf(m.hota->det_a), 1, 1e-12);
    EXPECT_NEAR(meanOf(m.hota->ass_a), 0.5, 1e-12);
    EXPECT_NEAR(meanOf(m.hota->hota), std::sqrt(0.5), 1e-12);
}

TEST(IdentityAndHota, OverlapDecidesPerThreshold) {
    BoxesByFrame truth = boxes({car(0, 1, 100)});
    BoxesByFrame result = boxes({car(0, 1, 105)});  // overlap 0.6 exactly: 12 of 19 thresholds
    const HotaMeasures h = *evaluate(truth, result, at(0.1)).hota;
    EXPECT_NEAR(meanOf(h.hota), 12.0 / 19, 1e-12);
    EXPECT_NEAR(meanOf(h.loc_a), (12 * 0.6 + 7 * 1) / 19, 1e-12);
}

TEST(IdentityAndHota, ForgivenResultsAreNoMistakes) {
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 5; ++frame) {
        truth[frame] = {car(frame, 1, 100), ignored(car(frame, 2, 200))};
        result[frame] = {car(frame, 1, 100), car(frame, 2, 202)};
    }
    const Measures m = evaluate(truth, result, at(0.3));
    EXPECT_EQ(m.identity->idf1, 1);
    EXPECT_NEAR(meanOf(m.hota->hota), 1, 1e-12);
    EXPECT_EQ(m.detection.ignored_results, 5);
}

TEST(IdentityAndHota, IdentityCountsAddUpToTheDetectionCounts) {
    const OneObject scene = oneObject({4, 4, 0, 7, 5, 5, 6, 6, 0, 0});
    const Measures m = evaluate(scene.truth, scene.result, at(0.5));
    EXPECT_EQ(m.identity->idtp + m.identity->idfp, m.detection.true_positives + m.detection.false_positives);
    EXPECT_EQ(m.identity->idtp + m.identity->idfn, m.detection.ground_truth);
}

TEST(Measures, SeveralOverlapsGiveTheSameAsEachAlone) {
    const OneObject scene = oneObject({4, 4, 0, 7, 5, 5, 6, 6, 0, 0});
    const auto all = evaluateAt({0.1, 0.9}, scene.truth, scene.result, at(0.5));
    ASSERT_EQ(all.size(), 2u);
    for (const Measures& m : all) {
        const Measures alone = evaluate(scene.truth, scene.result, at(m.overlap));
        const auto listed = listMeasures(m);
        const auto listed_alone = listMeasures(alone);
        ASSERT_EQ(listed.size(), listed_alone.size());
        for (std::size_t k = 0; k < listed.size(); ++k) {
            EXPECT_EQ(listed[k].value, listed_alone[k].value) << listed[k].key;
        }
    }
}

TEST(Measures, RenamingTheTracksChangesNothing) {
    const OneObject scene = oneObject({4, 4, 0, 7, 5, 5, 6, 6, 0, 0});
    BoxesByFrame renamed = scene.result;
    for (auto& entry : renamed) {
        for (BoxRecord& record : entry.second) record.id = 1000 - 7 * *record.id;
    }
    const auto before = listMeasures(evaluate(scene.truth, scene.result, at(0.5)));
    const auto after = listMeasures(evaluate(scene.truth, renamed, at(0.5)));
    for (std::size_t k = 0; k < before.size(); ++k) EXPECT_EQ(before[k].value, after[k].value) << before[k].key;
}

TEST(BoxErrors, AreMeansOverTheMatchedPairs) {
    BoxesByFrame truth = boxes({car(0, 1, 100), car(0, 2, 300)});
    BoxesByFrame result = boxes({car(0, 1, 103, 54), car(0, 2, 300)});
    result[0][0].box.length += 4;
    result[0][0].box.width -= 2;
    result[0][0].box.heading = radiansFromDegrees(-10);
    result[0][1].box.heading = radiansFromDegrees(170);
    const BoxErrors e = evaluate(truth, result, at(0.1)).boxes;
    EXPECT_EQ(e.pairs, 2);
    EXPECT_NEAR(e.centre_px, 2.5, 1e-12);
    EXPECT_NEAR(e.length_px, 2, 1e-12);
    EXPECT_NEAR(e.length_bias_px, 2, 1e-12);
    EXPECT_NEAR(e.width_px, 1, 1e-12);
    EXPECT_NEAR(e.width_bias_px, -1, 1e-12);
    EXPECT_NEAR(e.heading_degrees, (10 + 170) / 2.0, 1e-9);
    EXPECT_NEAR(e.heading_axis_degrees, 10, 1e-9);
}

}  // namespace
}  // namespace eyrie

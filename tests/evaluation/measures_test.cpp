#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "evaluation/evaluate.h"
#include "evaluation_boxes.h"

namespace eyrie::measures_test {
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

TEST(DetectionMeasures, FalsePositivesAreGivenForEachFrame) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(1, 1, 100), car(3, 1, 100), car(4, 1, 100)});
    const BoxesByFrame result = boxes({car(0, 1, 100), car(0, 2, 300), car(1, 2, 300), car(3, 1, 100)});
    const Measures m = evaluate(truth, result, at(0.5));
    EXPECT_EQ(m.detection.frames, 4) << "with truth";
    EXPECT_DOUBLE_EQ(m.detection.false_positives_per_frame, 2.0 / 4);
    EXPECT_EQ(m.detection.ground_truth, 4);
    EXPECT_DOUBLE_EQ(m.detection.n_moda, 1 - (2 + 2) / 4.0);
    EXPECT_EQ(evaluate(truth, result, at(0.5, Convention::trackeval)).detection.frames, 5) << "0 to 4";
}

TEST(Remarks, SayWhatMakesAComparisonDoubtful) {
    const auto scene = [](int objects, int hits) {
        BoxesByFrame truth;
        BoxesByFrame result;
        for (int frame = 0; frame < objects; ++frame) {
            truth[frame].push_back(car(frame, 1, 100));
            result[frame].push_back(car(frame, 1, frame < hits ? 100 : 300));
        }
        return remarksOn(evaluate(truth, result, at(0.5))).size();
    };
    EXPECT_EQ(scene(49, 0), 0U) << "too few to judge";
    EXPECT_EQ(scene(50, 0), 1U);
    EXPECT_EQ(scene(50, 1), 0U) << "one of fifty";
    EXPECT_EQ(scene(101, 2), 1U);
    EXPECT_EQ(scene(100, 2), 0U);
    const auto remarks = [](const std::vector<BoxRecord>& truth, const std::vector<BoxRecord>& result) {
        return remarksOn(evaluate(boxes(truth), boxes(result), at(0.5)));
    };
    EXPECT_TRUE(remarks({car(0, 1, 100)}, {car(0, 1, 100)}).empty());
    EXPECT_EQ(remarks({car(0, 1, 100)}, {car(0, 1, 100), car(7, 1, 100)}).size(), 1U) << "a frame without truth";
    EXPECT_EQ(remarks({car(0, 1, 100)}, {car(0, 1, 100), car(0, 1, 300)}).size(), 1U) << "an id twice";
    EXPECT_EQ(remarks({ignored(car(0, 1, 100))}, {car(0, 1, 100)}).size(), 1U) << "nothing counts";
    EXPECT_EQ(remarks({car(0, 1, 100)}, {car(0, {}, 100)}).size(), 1U) << "no tracks";
    BoxesByFrame even;
    BoxesByFrame odd;
    for (int frame = 0; frame < 140; ++frame) (frame % 2 == 0 ? even : odd)[frame].push_back(car(frame, 1, 100));
    const auto none_shared = remarksOn(evaluate(even, odd, at(0.5, Convention::trackeval)));
    EXPECT_EQ(std::count_if(none_shared.begin(), none_shared.end(),
                            [](const std::string& r) { return r.find("same video") != std::string::npos; }),
              1)
        << "that no frame is shared says it all";
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
    EXPECT_NEAR(m.tracking->mota_log, 1 - (4 + 0 + std::log10(2)) / 20.0, 1e-12);
    EXPECT_NEAR(m.tracking->mota_soft, (16 - 0 - 2) / 20.0, 1e-12);
    EXPECT_EQ(m.tracking->truth_tracks, 2);
    EXPECT_EQ(m.tracking->result_tracks, 4);
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

TEST(TrackingMeasures, InitialisationIsTheMeanTimeUntilAnObjectIsFirstFound) {
    // The car far away is found at once, the other after three frames; that it is lost again later does not matter.
    OneObject scene = oneObject({0, 0, 0, 4, 4, 0, 0, 5, 5, 5});
    for (const Convention convention : {Convention::thesis, Convention::trackeval}) {
        const Measures m = evaluate(scene.truth, scene.result, at(0.5, convention));
        EXPECT_EQ(m.tracks.truth[0].until_found, 3);
        EXPECT_EQ(m.tracks.truth[1].until_found, 0);
        EXPECT_DOUBLE_EQ(m.tracking->initialisation_frames, 3 / 2.0);
    }
    scene.truth[1][0].ignore = true;
    EXPECT_DOUBLE_EQ(evaluate(scene.truth, scene.result, at(0.5)).tracking->initialisation_frames, 2 / 2.0)
        << "where it does not count nobody waits for it";
    const OneObject never = oneObject(std::vector<int>(10, 0));
    EXPECT_DOUBLE_EQ(evaluate(never.truth, never.result, at(0.5)).tracking->initialisation_frames, 10 / 2.0);
    const BoxesByFrame one = boxes({car(0, 1, 100)});
    EXPECT_EQ(evaluate({}, one, at(0.5, Convention::trackeval)).tracking->initialisation_frames, 0);
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

TEST(TrackingMeasures, FalsePositivesCostAccuracyAndBelongToTheirTracks) {
    OneObject scene = oneObject({4, 4, 4, 4, 4, 5, 5, 5, 5, 5});
    for (const int frame : {1, 2, 8}) scene.result[frame].push_back(car(frame, 30, 500));
    scene.result[4].push_back(car(4, 4, 700));
    scene.result[4].erase(scene.result[4].begin() + 1);  // track 4 is elsewhere there
    const Measures m = evaluate(scene.truth, scene.result, at(0.5));
    EXPECT_EQ(m.detection.false_positives, 4);
    EXPECT_EQ(m.tracking->id_switches, 1);
    EXPECT_NEAR(m.tracking->mota, 1 - (1 + 4 + 1) / 20.0, 1e-12);
    EXPECT_NEAR(m.tracking->mota_log, 1 - (1 + 4 + 0) / 20.0, 1e-12) << "the logarithm of one switch is none";
    EXPECT_NEAR(m.tracking->mota_soft, (19 - 4 - 1) / 20.0, 1e-12);
    std::vector<std::array<int, 3>> tallies;
    for (const ResultTrackTally& track : m.tracks.results)
        tallies.push_back({track.id, track.matched, track.false_positives});
    EXPECT_EQ(tallies, (std::vector<std::array<int, 3>>{{4, 4, 1}, {5, 5, 0}, {30, 0, 3}, {99, 10, 0}}));
    EXPECT_NEAR(m.tracks.truth[0].overlap_sum, 9, 1e-12);
}

TEST(IdentityAndHota, FollowTheirEquations) {
    // One object in four frames: track 10 finds it exactly in three and is elsewhere in the last, 11 is always
    // elsewhere.
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 4; ++frame) {
        truth[frame].push_back(car(frame, 1, 100));
        result[frame] = {car(frame, 11, 500), car(frame, 10, frame < 3 ? 100 : 300)};
    }
    for (const Convention convention : {Convention::thesis, Convention::trackeval}) {
        const Measures m = evaluate(truth, result, at(0.5, convention));
        EXPECT_EQ(m.identity->idtp, 3);
        EXPECT_EQ(m.identity->idfp, 5);
        EXPECT_EQ(m.identity->idfn, 1);
        EXPECT_DOUBLE_EQ(m.identity->idp, 3.0 / 8);
        EXPECT_DOUBLE_EQ(m.identity->idr, 3.0 / 4);
        EXPECT_DOUBLE_EQ(m.identity->idf1, 3 / 6.0);
        const HotaMeasures& h = *m.hota;
        EXPECT_NEAR(meanOf(h.true_positives), 3, 1e-12);
        EXPECT_NEAR(meanOf(h.false_negatives), 1, 1e-12);
        EXPECT_NEAR(meanOf(h.false_positives), 5, 1e-12);
        EXPECT_NEAR(meanOf(h.det_re), 3.0 / 4, 1e-12);
        EXPECT_NEAR(meanOf(h.det_pr), 3.0 / 8, 1e-12);
        EXPECT_NEAR(meanOf(h.det_a), 3.0 / (4 + 8 - 3), 1e-12);
        EXPECT_NEAR(meanOf(h.ass_re), 3.0 / 4, 1e-12);
        EXPECT_NEAR(meanOf(h.ass_pr), 3.0 / 4, 1e-12);
        EXPECT_NEAR(meanOf(h.ass_a), 3.0 / (4 + 4 - 3), 1e-12);
        EXPECT_NEAR(meanOf(h.loc_a), 1, 1e-12);
        EXPECT_NEAR(meanOf(h.hota), std::sqrt(1.0 / 3 * 0.6), 1e-12);
        EXPECT_NEAR(meanOf(h.owta), std::sqrt(0.75 * 0.6), 1e-12);
    }
}

TEST(IdentityAndHota, TheTrackThatFitsLongestWinsTheObject) {
    // In frame 0 track 20 lies closer, but 10 follows the object for the rest of its way.
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 6; ++frame) {
        truth[frame].push_back(car(frame, 1, 100));
        result[frame].push_back(car(frame, 10, 100 + shiftFor(0.75)));
    }
    result[0].push_back(car(0, 20, 100 + shiftFor(0.85)));
    const Measures m = evaluate(truth, result, at(0.5));
    EXPECT_EQ(m.identity->idtp, 6);
    EXPECT_NEAR(m.hota->ass_a[0], 1, 1e-12) << "track 10 has all six";
    EXPECT_NEAR(m.hota->det_a[0], 6.0 / 7, 1e-12);
    EXPECT_NEAR(m.hota->loc_a[0], 0.75, 1e-9);
    EXPECT_EQ(m.hota->true_positives[13], 6) << "0.7 is reached";
    EXPECT_EQ(m.hota->true_positives[15], 0) << "0.8 is not";
    EXPECT_EQ(m.hota->loc_a[15], 1) << "of nothing";
}

TEST(IdentityAndHota, OverlapDecidesPerThreshold) {
    BoxesByFrame truth = boxes({car(0, 1, 100)});
    BoxesByFrame result = boxes({car(0, 1, 105)});  // overlap 0.6 exactly: 12 of 19 thresholds
    const HotaMeasures h = *evaluate(truth, result, at(0.1)).hota;
    EXPECT_NEAR(meanOf(h.hota), 12.0 / 19, 1e-12);
    EXPECT_NEAR(meanOf(h.loc_a), (12 * 0.6 + 7 * 1) / 19, 1e-12);
}

TEST(IdentityAndHota, IgnoredResultsAreNoErrors) {
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
    for (auto& [frame, records] : result) std::reverse(records.begin(), records.end());
    const Measures turned_round = evaluate(truth, result, at(0.3));
    EXPECT_EQ(turned_round.identity->idf1, 1) << "the ignored one comes first";
    EXPECT_EQ(turned_round.identity->idtp, 5);
    EXPECT_NEAR(meanOf(turned_round.hota->hota), 1, 1e-12);
    EXPECT_EQ(turned_round.tracking->mota, 1);
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

TEST(Measures, AreShownWithAsManyDigitsAsMeanSomething) {
    const OneObject scene = oneObject({4, 4, 0, 7});
    std::map<std::string, int> digits;
    for (const NamedMeasure& measure : listMeasures(evaluate(scene.truth, scene.result, at(0.5))))
        digits[measure.key] = measure.decimals;
    for (const char* count :
         {"ground_truth", "tp", "fp", "fn", "ignored_results", "id_switches", "mostly_tracked", "partially_tracked",
          "mostly_lost", "fragments", "gt_tracks", "result_tracks", "idtp", "idfp", "idfn"})
        EXPECT_EQ(digits.at(count), 0) << count;
    for (const char* share : {"precision", "recall", "f_score", "n_moda", "n_modp", "mota", "motp", "idf1", "hota",
                              "det_a", "ass_a", "loc_a"})
        EXPECT_EQ(digits.at(share), 4) << share;
    for (const char* size : {"centre_error_px", "length_error_px", "length_bias_px", "width_error_px", "width_bias_px",
                             "heading_error_deg", "axis_error_deg"})
        EXPECT_EQ(digits.at(size), 2) << size;
    EXPECT_EQ(digits.at("fp_per_frame"), 3);
    EXPECT_EQ(digits.at("initialisation_frames"), 1) << "a tenth of a frame";
    EXPECT_EQ(digits.size(), 36U);
}

TEST(Measures, NoneSaysThatAWorseResultIsBetter) {
    // Found late, by two tracks, not at its place, and not at the end; and something that is not there.
    const OneObject right = oneObject(std::vector<int>(10, 4));
    OneObject wrong = oneObject({0, 4, 4, 0, 5, 5, 6, 6, 0, 0});
    for (auto& [frame, records] : wrong.result) {
        for (BoxRecord& record : records) {
            record.box.centre.x += 1;
            record.box.length += 2;
            record.box.width += 1;
            record.box.heading += 0.05;
        }
        records.push_back(car(frame, 30, 500));
    }
    const auto best = listMeasures(evaluate(right.truth, right.result, at(0.5)));
    const auto worse = listMeasures(evaluate(wrong.truth, wrong.result, at(0.5)));
    for (std::size_t k = 0; k < best.size(); ++k) {
        if (best[k].key == "partially_tracked" || best[k].key == "result_tracks") continue;  // they only describe
        ASSERT_TRUE(best[k].value && worse[k].value) << best[k].key;
        const double gain = *best[k].value - *worse[k].value;
        EXPECT_GE(best[k].higher_is_better ? gain : -gain, 0) << best[k].key;
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

TEST(BoxErrors, UprightBoxesAreComparedWithoutHeadings) {
    BoxesByFrame truth = boxes({car(0, 1, 100)});
    BoxesByFrame result = boxes({car(0, 1, 100)});
    result[0][0].box.heading = kPi / 2;  // 10 wide and 20 high
    EvaluationOptions options = at(0.1);
    options.upright = true;
    const BoxErrors upright = evaluate(truth, result, options).boxes;
    EXPECT_FALSE(upright.has_headings);
    EXPECT_NEAR(upright.length_bias_px, -10, 1e-9);
    EXPECT_NEAR(upright.width_bias_px, 10, 1e-9);
    const Measures turned = evaluate(truth, result, at(0.1));
    EXPECT_TRUE(turned.boxes.has_headings);
    EXPECT_EQ(turned.boxes.length_px, 0);
    EXPECT_NEAR(turned.boxes.heading_degrees, 90, 1e-9);
    const auto withValue = [](const Measures& m) {
        const auto listed = listMeasures(m);
        return std::count_if(listed.begin(), listed.end(), [](const NamedMeasure& n) {
            return n.value && (n.key == "heading_error_deg" || n.key == "axis_error_deg" || n.key == "width_error_px");
        });
    };
    EXPECT_EQ(withValue(turned), 3);
    EXPECT_EQ(withValue(evaluate(truth, result, options)), 1) << "nobody knows a heading";
    EXPECT_EQ(withValue(evaluate(truth, {}, options)), 0) << "nor an error without pairs";
}

TEST(DetectionMeasures, OneObjectIsEnoughForAllOfThem) {
    const BoxesByFrame truth = boxes({car(0, 1, 100)});
    const Measures right = evaluate(truth, boxes({car(0, 7, 100)}), at(0.5));
    EXPECT_EQ(right.detection.precision, 1);
    EXPECT_EQ(right.detection.recall, 1);
    EXPECT_EQ(right.detection.f_score, 1);
    EXPECT_EQ(right.detection.n_moda, 1);
    EXPECT_EQ(right.detection.n_modp, 1);
    ASSERT_TRUE(right.tracking && right.identity && right.hota);
    EXPECT_EQ(right.tracking->mota, 1);
    EXPECT_EQ(right.tracking->mota_log, 1) << "no switch has no logarithm";
    EXPECT_EQ(right.tracking->mota_soft, 1);
    EXPECT_EQ(right.tracking->mostly_tracked, 1);
    EXPECT_EQ(right.identity->idf1, 1);
    EXPECT_EQ(right.identity->idp, 1);
    EXPECT_EQ(right.identity->idr, 1);
    for (const HotaCurve* curve : {&right.hota->det_re, &right.hota->det_pr, &right.hota->det_a, &right.hota->ass_re,
                                   &right.hota->ass_pr, &right.hota->ass_a, &right.hota->loc_a, &right.hota->hota}) {
        EXPECT_EQ(curve->front(), 1);
        EXPECT_EQ(curve->back(), 1);
    }
    const Measures twice = evaluate(truth, boxes({car(0, 7, 100), car(0, 8, 300)}), at(0.5));
    EXPECT_EQ(twice.detection.n_moda, 0);
    EXPECT_EQ(twice.detection.false_positives_per_frame, 1);
    EXPECT_EQ(twice.tracking->mota, 0);
    EXPECT_EQ(twice.tracking->mota_soft, 0);
}

TEST(DetectionMeasures, IgnoredAndLeftOutResultsAreCountedTogether) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), ignored(car(0, 2, 60))});
    EvaluationOptions options = at(0.5);
    options.border = 3;
    options.image_size = {200, 100};
    const BoxesByFrame result = boxes({car(0, {}, 100), car(0, {}, 61), car(0, {}, 58), car(0, {}, 195)});
    const Measures m = evaluate(truth, result, options);
    EXPECT_EQ(m.detection.ignored_results, 3) << "two on what is ignored, one at the border";
    EXPECT_EQ(m.detection.false_positives, 0);
}

TEST(TrackingMeasures, ASingleTrackWaitsForItself) {
    BoxesByFrame truth;
    BoxesByFrame result;
    for (int frame = 0; frame < 5; ++frame) {
        truth[frame].push_back(car(frame, 1, 100));
        result[frame].push_back(car(frame, 4, frame < 3 ? 300 : 100));
    }
    EXPECT_EQ(evaluate(truth, result, at(0.5)).tracking->initialisation_frames, 3);
}

TEST(Measures, SharedFramesHaveBoxesOfBoth) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(1, 1, 100), car(2, 1, 100)});
    EXPECT_EQ(evaluate(truth, boxes({car(1, 7, 100)}), at(0.5)).shared_frames, 1);
    EXPECT_EQ(evaluate(truth, boxes({car(5, 7, 100)}), at(0.5)).shared_frames, 0);
}

}  // namespace
}  // namespace eyrie::measures_test

#include "evaluation/error_list.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "evaluation/evaluate.h"
#include "evaluation/evaluation_boxes.h"
#include "formats/mot/motchallenge.h"
#include "support/shared_data.h"

namespace eyrie::error_list_test {
namespace {

using test::boxes;
using test::car;
using test::ignored;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<ResultError> listOf(const BoxesByFrame& truth, const BoxesByFrame& result, EvaluationOptions options = {}) {
    const EvaluationInput input = prepareEvaluation(truth, result, options);
    return listErrors(truth, result, input, matchFrames(input, options), options);
}

std::vector<ResultError> ofKind(const std::vector<ResultError>& errors, ResultErrorKind kind) {
    std::vector<ResultError> found;
    for (const ResultError& error : errors)
        if (error.kind == kind) found.push_back(error);
    return found;
}

int sumOf(const std::vector<ResultError>& errors, ResultErrorKind kind) {
    int sum = 0;
    for (const ResultError& error : ofKind(errors, kind)) sum += error.count();
    return sum;
}

BoxRecord part(FrameIndex frame, int id, double x, double length) {
    BoxRecord record = car(frame, id, x);
    record.box.length = length;
    return record;
}

}  // namespace

TEST(ErrorList, aPerfectResultHasNone) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 54), car(1, 2, 150)});
    EXPECT_THAT(listOf(truth, truth), IsEmpty());
}

TEST(ErrorList, missesOfConsecutiveFramesAreOneEntry) {
    // Object 1 is missed in 1, 2 and 4 and found in 0, 3; object 2 is missed in frame 2 alone.
    const BoxesByFrame truth =
        boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50), car(4, 1, 50), car(2, 2, 150)});
    const auto errors = listOf(truth, boxes({car(0, 7, 50), car(3, 7, 50)}));
    const auto misses = ofKind(errors, ResultErrorKind::miss);
    ASSERT_EQ(misses.size(), 3u);
    EXPECT_EQ(misses[0].first_frame, 1);
    EXPECT_EQ(misses[0].last_frame, 2);
    EXPECT_EQ(misses[0].count(), 2);
    EXPECT_THAT(misses[0].objects, ElementsAre(1));
    EXPECT_THAT(misses[0].places[1].truth, ElementsAre(0));
    EXPECT_EQ(misses[0].places[1].box.centre.x, 50);
    EXPECT_THAT(misses[1].objects, ElementsAre(2));
    EXPECT_EQ(misses[2].first_frame, 4);
    EXPECT_EQ(ofKind(errors, ResultErrorKind::fragment).size(), 2u) << "what was never found breaks nowhere";
}

TEST(ErrorList, falseAlarmsAreGroupedByTrack) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50)});
    const auto errors = listOf(
        truth, boxes({car(0, 7, 50), car(1, 7, 50), car(2, 7, 50), car(0, 8, 150), car(1, 8, 150), car(2, 9, 150)}));
    const auto alarms = ofKind(errors, ResultErrorKind::false_alarm);
    ASSERT_EQ(alarms.size(), 2u);
    EXPECT_THAT(alarms[0].tracks, ElementsAre(8));
    EXPECT_EQ(alarms[0].count(), 2);
    EXPECT_THAT(alarms[1].tracks, ElementsAre(9));
    EXPECT_THAT(alarms[1].places[0].results, ElementsAre(1));
}

TEST(ErrorList, detectionsAreGroupedByWhereTheyAre) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50)});
    const auto errors =
        listOf(truth, boxes({car(0, {}, 150), car(1, {}, 154), car(2, {}, 250), car(0, {}, 50), car(1, {}, 50)}));
    const auto alarms = ofKind(errors, ResultErrorKind::false_alarm);
    ASSERT_EQ(alarms.size(), 2u);
    EXPECT_EQ(alarms[0].count(), 2);  // 150 and 154 overlap by 16 / 24
    EXPECT_EQ(alarms[1].first_frame, 2);
    EXPECT_THAT(ofKind(errors, ResultErrorKind::id_switch), IsEmpty());
    EXPECT_THAT(ofKind(errors, ResultErrorKind::fragment), IsEmpty());
}

TEST(ErrorList, aSwitchNamesBothTracksAndTheGap) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50)});
    const auto errors = listOf(truth, boxes({car(0, 7, 50), car(3, 8, 50)}));
    const auto switches = ofKind(errors, ResultErrorKind::id_switch);
    ASSERT_EQ(switches.size(), 1u);
    EXPECT_THAT(switches[0].tracks, ElementsAre(7, 8));
    EXPECT_EQ(switches[0].first_frame, 0);
    EXPECT_EQ(switches[0].last_frame, 3);
    EXPECT_EQ(switches[0].places[0].frame, 3);
}

TEST(ErrorList, aFragmentLastsUntilTheObjectIsFoundAgain) {
    const BoxesByFrame truth =
        boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50), car(4, 1, 50), car(5, 1, 50)});
    const auto errors = listOf(truth, boxes({car(0, 7, 50), car(3, 7, 50), car(4, 7, 50)}));
    const auto fragments = ofKind(errors, ResultErrorKind::fragment);
    ASSERT_EQ(fragments.size(), 2u);
    EXPECT_EQ(fragments[0].first_frame, 1);
    EXPECT_EQ(fragments[0].last_frame, 2);
    EXPECT_EQ(fragments[1].first_frame, 5);
    EXPECT_THAT(fragments[0].tracks, ElementsAre(7));
}

TEST(ErrorList, partsSideBySideAreASplitButCopiesAreNot) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50)});
    const auto split = ofKind(listOf(truth, boxes({part(0, 7, 45, 9), part(0, 8, 55, 9)})), ResultErrorKind::split);
    ASSERT_EQ(split.size(), 1u);
    EXPECT_THAT(split[0].objects, ElementsAre(1));
    EXPECT_THAT(split[0].tracks, ElementsAre(7, 8));
    EXPECT_THAT(split[0].places[0].results, ElementsAre(0, 1));
    EXPECT_THAT(ofKind(listOf(truth, boxes({car(0, 7, 50), car(0, 8, 51)})), ResultErrorKind::split), IsEmpty());
}

TEST(ErrorList, oneBoxOverTwoObjectsIsAMerge) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(0, 2, 72), car(1, 1, 50), car(1, 2, 72)});
    const auto wide = part(0, 7, 61, 42);
    const auto merges = ofKind(listOf(truth, boxes({wide, part(1, 7, 61, 42)})), ResultErrorKind::merge);
    ASSERT_EQ(merges.size(), 1u);
    EXPECT_EQ(merges[0].count(), 2);
    EXPECT_THAT(merges[0].objects, ElementsAre(1, 2));
    EXPECT_THAT(merges[0].tracks, ElementsAre(7));
    // Both found by their own results: the third is a false alarm, not a merge.
    EXPECT_THAT(ofKind(listOf(boxes({car(0, 1, 50), car(0, 2, 72)}), boxes({wide, car(0, 8, 50), car(0, 9, 72)})),
                       ResultErrorKind::merge),
                IsEmpty());
}

TEST(ErrorList, ignoredObjectsMakeNoErrors) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), ignored(car(0, 2, 150))});
    EXPECT_THAT(listOf(truth, boxes({car(0, 7, 50), car(0, 8, 152)})), IsEmpty());
    EXPECT_THAT(listOf(truth, boxes({car(0, 7, 50)})), IsEmpty());
}

TEST(ErrorList, boxesWithoutIdsGoOnWhereTheyOverlapEnough) {
    const BoxesByFrame truth = boxes({car(0, 1, 500), car(1, 1, 500)});
    const auto alarms = [&](double shift) {
        return ofKind(listOf(truth, boxes({car(0, {}, 150), car(1, {}, 150 + shift)})), ResultErrorKind::false_alarm)
            .size();
    };
    EXPECT_EQ(alarms(test::shiftFor(0.31)), 1U);
    EXPECT_EQ(alarms(test::shiftFor(0.29)), 2U);
}

TEST(ErrorList, aPartLiesMostlyInTheObjectAndBesideItsFellow) {
    // The object reaches from 40 to 60.
    const BoxesByFrame truth = boxes({car(0, 1, 50)});
    const auto splits = [&](double x, double length, double other_x, double other_length) {
        return ofKind(listOf(truth, boxes({part(0, 7, x, length), part(0, 8, other_x, other_length)})),
                      ResultErrorKind::split)
            .size();
    };
    EXPECT_EQ(splits(40.9, 10, 55, 8), 1U) << "5.9 of 10 px inside";
    EXPECT_EQ(splits(40, 10, 55, 8), 1U) << "half of it inside";
    EXPECT_EQ(splits(39.9, 10, 55, 8), 0U) << "4.9 of 10 px inside";
    EXPECT_EQ(splits(45, 10, 50.1, 10), 1U) << "4.9 of 10 px on one another";
    EXPECT_EQ(splits(45, 10, 49.9, 10), 0U) << "5.1 of 10 px on one another";
    // A third that lies on one of two parts is no further part of them, unless it lies beside the other.
    const auto three = ofKind(listOf(truth, boxes({part(0, 7, 45, 9), part(0, 8, 55, 9), part(0, 9, 50, 19)})),
                              ResultErrorKind::split);
    ASSERT_EQ(three.size(), 1U);
    EXPECT_THAT(three[0].tracks, ElementsAre(7, 8)) << "the third covers both";
}

TEST(ErrorList, aMergeNeedsAMissedObjectMostlyInside) {
    const auto merges = [](double second_x) {
        return ofKind(listOf(boxes({car(0, 1, 50), car(0, 2, second_x)}), boxes({part(0, 7, 61, 42)})),
                      ResultErrorKind::merge);
    };
    ASSERT_EQ(merges(81).size(), 1U) << "11 of 20 px of the second inside";
    EXPECT_THAT(merges(81)[0].places[0].truth, ElementsAre(0, 1));
    EXPECT_THAT(merges(81)[0].places[0].results, ElementsAre(0));
    EXPECT_EQ(merges(83).size(), 0U) << "9 of 20 px";
}

TEST(ErrorList, trackEvalCountsFragmentsWhenTheObjectIsFoundAgain) {
    EvaluationOptions options;
    options.convention = Convention::trackeval;
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50), car(4, 1, 50),
                                      car(0, 2, 150), car(1, 2, 150), car(2, 2, 150), car(3, 2, 150), car(4, 2, 150)});
    const BoxesByFrame result = boxes(
        {car(0, 7, 50), car(2, 7, 50), car(0, 8, 150), car(1, 8, 150), car(2, 8, 150), car(3, 8, 150), car(4, 8, 150)});
    const auto fragments = ofKind(listOf(truth, result, options), ResultErrorKind::fragment);
    ASSERT_EQ(fragments.size(), 1U) << "lost for good is no fragment";
    EXPECT_THAT(fragments[0].objects, ElementsAre(1));
    EXPECT_THAT(fragments[0].tracks, ElementsAre(7));
    EXPECT_EQ(fragments[0].first_frame, 1);
    EXPECT_EQ(fragments[0].last_frame, 1);
    EXPECT_EQ(ofKind(listOf(truth, result), ResultErrorKind::fragment).size(), 2U) << "the thesis counts both losses";
}

TEST(ErrorList, trackEvalEndsARunWithTheObjectsAbsence) {
    EvaluationOptions options;
    options.convention = Convention::trackeval;
    // Object 1 has no box in frame 1, where 2 is found; in frame 3 nothing is to be found at all.
    const BoxesByFrame truth = boxes(
        {car(0, 1, 50), car(2, 1, 50), car(4, 1, 50), car(0, 2, 150), car(1, 2, 150), car(2, 2, 150), car(4, 2, 150)});
    const BoxesByFrame result = boxes(
        {car(0, 7, 50), car(2, 7, 50), car(4, 7, 50), car(0, 8, 150), car(1, 8, 150), car(2, 8, 150), car(4, 8, 150)});
    const auto fragments = ofKind(listOf(truth, result, options), ResultErrorKind::fragment);
    ASSERT_EQ(fragments.size(), 1U);
    EXPECT_THAT(fragments[0].objects, ElementsAre(1));
    EXPECT_EQ(fragments[0].first_frame, 1);
    EXPECT_EQ(fragments[0].places[0].box.centre.x, 50) << "where it was seen last";
    EXPECT_THAT(ofKind(listOf(truth, result), ResultErrorKind::fragment), IsEmpty());
}

TEST(ErrorList, aMergeIsToldBesideABoxThatMergesNothing) {
    // The first two objects have boxes of their own, so that the wide one over them is a false alarm; over the other
    // two lies nothing else.
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(0, 2, 72), car(0, 3, 250), car(0, 4, 272)});
    const auto merges =
        ofKind(listOf(truth, boxes({part(0, 7, 61, 42), car(0, 8, 50), car(0, 9, 72), part(0, 10, 261, 42)})),
               ResultErrorKind::merge);
    ASSERT_EQ(merges.size(), 1U);
    EXPECT_THAT(merges[0].tracks, ElementsAre(10));
}

TEST(ErrorList, oneBoxOverThreeObjectsIsAMergeAndOverOneIsNone) {
    const auto merges =
        ofKind(listOf(boxes({car(0, 1, 50), car(0, 2, 72), car(0, 3, 94)}), boxes({part(0, 7, 72, 64)})),
               ResultErrorKind::merge);
    ASSERT_EQ(merges.size(), 1U);
    EXPECT_THAT(merges[0].objects, ElementsAre(1, 2, 3));
    EXPECT_THAT(ofKind(listOf(boxes({car(0, 1, 50)}), boxes({part(0, 7, 72, 300)})), ResultErrorKind::merge), IsEmpty())
        << "too large for the object in it";
}

TEST(ErrorList, whatIsLostInFramesWithoutAnyResultIsLostFromTheFirstOfThem) {
    EvaluationOptions options;
    options.convention = Convention::trackeval;
    // Frames 1 and 2 have no result at all, which trackeval passes over; frame 3 has one elsewhere.
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50), car(4, 1, 50)});
    const BoxesByFrame result = boxes({car(0, 7, 50), car(3, 8, 300), car(4, 7, 50)});
    const auto fragments = ofKind(listOf(truth, result, options), ResultErrorKind::fragment);
    ASSERT_EQ(fragments.size(), 1U);
    EXPECT_EQ(fragments[0].first_frame, 1);
}

TEST(ErrorList, isOrderedByTime) {
    const BoxesByFrame truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50), car(3, 1, 50)});
    const auto errors =
        listOf(truth, boxes({car(0, 7, 50), car(2, 8, 50), car(0, 9, 300), car(1, 9, 300), car(3, 8, 300)}));
    ASSERT_GE(errors.size(), 4U);
    for (std::size_t i = 1; i < errors.size(); ++i) {
        EXPECT_LE(std::pair(errors[i - 1].first_frame, errors[i - 1].kind),
                  std::pair(errors[i].first_frame, errors[i].kind));
    }
}

TEST(ErrorList, namesAreWords) {
    EXPECT_STREQ(nameOf(ResultErrorKind::false_alarm), "false alarm");
    for (const auto kind : {ResultErrorKind::miss, ResultErrorKind::false_alarm, ResultErrorKind::id_switch,
                            ResultErrorKind::fragment, ResultErrorKind::split, ResultErrorKind::merge})
        EXPECT_STRNE(nameOf(kind), "");
}

/// The list is another view of the same counts, whatever the data and the convention.
TEST(ErrorList, sumsAreTheMeasures) {
    EYRIE_NEED_SHARED_DATA("trackeval_parity");
    for (const char* name : {"clean", "noisy", "harsh"}) {
        const auto folder = test::sharedData("trackeval_parity") / name;
        const BoxesByFrame truth = plainBoxes(readMotTruth(folder / "gt.txt"));
        const BoxesByFrame result = readMotResult(folder / "result.txt", {});
        ASSERT_FALSE(result.empty());
        for (const Convention convention : {Convention::thesis, Convention::trackeval}) {
            for (const double t_ov : {0.1, 0.5}) {
                EvaluationOptions options;
                options.convention = convention;
                options.overlap = t_ov;
                const Measures measures = evaluate(truth, result, options);
                const auto errors = listOf(truth, result, options);
                EXPECT_EQ(sumOf(errors, ResultErrorKind::miss), measures.detection.false_negatives) << name;
                EXPECT_EQ(sumOf(errors, ResultErrorKind::false_alarm), measures.detection.false_positives) << name;
                ASSERT_TRUE(measures.tracking);
                EXPECT_EQ(sumOf(errors, ResultErrorKind::id_switch), measures.tracking->id_switches) << name;
                EXPECT_EQ(sumOf(errors, ResultErrorKind::fragment), measures.tracking->fragments)
                    << name << " " << nameOf(convention);
            }
        }
    }
}

}  // namespace eyrie::error_list_test

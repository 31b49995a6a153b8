#include "evaluation/matching.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluation/measures/detection_measures.h"
#include "evaluation_boxes.h"

namespace eyrie::matching_test {
namespace {

using test::boxes;
using test::car;
using test::ignored;
using test::shiftFor;

EvaluationOptions at(double overlap) {
    EvaluationOptions options;
    options.overlap = overlap;
    return options;
}

struct Counts {
    std::size_t tp = 0;
    std::size_t fp = 0;
    std::size_t fn = 0;
    bool operator==(const Counts&) const = default;
};

std::ostream& operator<<(std::ostream& stream, const Counts& counts) {
    return stream << counts.tp << " TP, " << counts.fp << " FP, " << counts.fn << " FN";
}

Counts countsOf(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationOptions& options) {
    Counts counts;
    for (const FrameMatch& match : matchFrames(truth, result, options)) {
        counts.tp += match.pairs.size();
        counts.fp += match.false_results.size();
        counts.fn += match.missed.size();
    }
    return counts;
}

BoxRecord detection(double x, double y = 50) {
    return car(0, std::nullopt, x, y);
}

/// Fig. 7.2 of the thesis, upper row: one vehicle, T_ov = 0.2.
TEST(Figure72, OneVehicle) {
    const BoxesByFrame truth = boxes({car(0, 1, 100)});
    const auto found = [&](std::vector<BoxRecord> results) { return countsOf(truth, boxes(results), at(0.2)); };
    for (const double overlap : {0.7, 0.5, 0.3}) {  // pictures 2 to 4
        EXPECT_EQ(found({detection(100 + shiftFor(overlap))}), (Counts{1, 0, 0})) << overlap;
    }
    EXPECT_EQ(found({detection(100 + shiftFor(0.85)), detection(104, 60)}), (Counts{1, 1, 0}));  // 5: and the shadow
    EXPECT_EQ(found({detection(100 + shiftFor(0.05))}), (Counts{0, 1, 1}));                      // 6: the shadow only
}

/// Fig. 7.2, lower row: two vehicles side by side.
TEST(Figure72, TwoVehicles) {
    const double apart = 12;
    const BoxesByFrame truth = boxes({car(0, 1, 100, 50), car(0, 2, 100, 50 + apart)});
    const auto found = [&](std::vector<BoxRecord> results) { return countsOf(truth, boxes(results), at(0.2)); };
    const double close = shiftFor(0.85);
    EXPECT_EQ(found({detection(100 + close, 50), detection(100 - close, 50 + apart)}), (Counts{2, 0, 0}));  // 8
    EXPECT_EQ(found({detection(100 + shiftFor(0.8), 50)}), (Counts{1, 0, 1}));                              // 9

    BoxRecord merged = detection(100, 50 + apart / 2 - 1);  // 10: covers both, the upper one better
    merged.box.width = 22;
    EXPECT_EQ(found({merged}), (Counts{1, 0, 1}));
    const auto match = matchFrames(truth, boxes({merged}), at(0.2));
    EXPECT_EQ(match.at(0).pairs.at(0).truth, 0);

    BoxRecord between = detection(100, 50 + apart / 2);  // 11: the same overlap with both
    EXPECT_NEAR(overlap(between.box, truth.at(0)[0].box), 0.25, 1e-9);
    EXPECT_EQ(found({between}), (Counts{1, 0, 1}));

    const double far = shiftFor(0.18);
    EXPECT_EQ(found({detection(100 + far, 50), detection(100 - far, 50 + apart)}), (Counts{0, 2, 2}));  // 12
}

TEST(Matching, ThresholdItselfCounts) {
    // 15 px of 20 shared horizontally: 150 / 250 = 0.6 exactly
    const BoxesByFrame truth = boxes({car(0, 1, 100)});
    const BoxesByFrame result = boxes({detection(105)});
    EXPECT_EQ(countsOf(truth, result, at(0.6)), (Counts{1, 0, 0}));
    EXPECT_EQ(countsOf(truth, result, at(0.601)), (Counts{0, 1, 1}));
}

TEST(Matching, TurnedBoxesAreComparedAsTheyAre) {
    BoxRecord upwards = detection(100);
    upwards.box.heading = kPi / 2;  // 10 × 10 px shared: 100 / 300
    const BoxesByFrame truth = boxes({car(0, 1, 100)});
    EXPECT_EQ(countsOf(truth, boxes({upwards}), at(0.3)), (Counts{1, 0, 0}));
    EXPECT_EQ(countsOf(truth, boxes({upwards}), at(0.35)), (Counts{0, 1, 1}));
}

TEST(Matching, UprightComparesEnclosingBoxes) {
    BoxRecord truth = car(0, 1, 100);  // as labelled around a car at 45°
    BoxRecord result = detection(100);
    result.box.heading = kPi / 4;
    truth.box = result.box.upright();
    EvaluationOptions options = at(0.9);
    EXPECT_EQ(countsOf(boxes({truth}), boxes({result}), options), (Counts{0, 1, 1}));
    options.upright = true;
    EXPECT_EQ(countsOf(boxes({truth}), boxes({result}), options), (Counts{1, 0, 0}));
}

TEST(Matching, ResultsThatTouchIgnoredObjectsAreNoFalseAlarms) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), ignored(car(0, 2, 200))});
    EXPECT_EQ(countsOf(truth, boxes({detection(100), detection(219)}), at(0.1)), (Counts{1, 0, 0}));
    EXPECT_EQ(countsOf(truth, boxes({detection(100), detection(221)}), at(0.1)), (Counts{1, 1, 0}));
    // A result that touches an ignored object but finds a counting one is still a true positive.
    const BoxesByFrame crowded = boxes({car(0, 1, 100), ignored(car(0, 2, 110))});
    EXPECT_EQ(countsOf(crowded, boxes({detection(100)}), at(0.1)), (Counts{1, 0, 0}));
    const auto match = matchFrames(truth, boxes({detection(219)}), at(0.1)).at(0);
    EXPECT_EQ(match.ignored_results, std::vector<int>{0});
    EXPECT_EQ(match.ignored_truth, std::vector<int>{1});
}

TEST(Matching, NonVehiclesAreIgnoredOnRequest) {
    BoxRecord rider = car(0, 1, 100);
    rider.object_class = "motorcycle";
    EvaluationOptions options = at(0.1);
    EXPECT_EQ(countsOf(boxes({rider}), {}, options), (Counts{0, 0, 1}));
    options.vehicles_only = true;
    EXPECT_EQ(countsOf(boxes({rider}), boxes({detection(102)}), options), (Counts{0, 0, 0}));
}

BoxRecord called(BoxRecord record, const char* object_class) {
    record.object_class = object_class;
    return record;
}

TEST(Matching, OneClassIsMeasuredAlone) {
    const BoxesByFrame truth =
        boxes({car(0, 1, 100), called(car(0, 2, 200), "motorcycle"), called(car(0, 3, 300), "person")});
    EvaluationOptions options = at(0.1);
    options.one_class = TrackClass::two_wheeler;
    EXPECT_EQ(countsOf(truth, {}, options), (Counts{0, 0, 1})) << "the motorcycle alone counts";
    const auto result = boxes({called(detection(100), ""), called(detection(200), ""), called(detection(300), ""),
                               called(detection(400), "")});
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 1, 0}))
        << "results without a class take part; what lies on others counts neither way, what lies on nothing is false";
    options.one_class = TrackClass::person;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 1, 0}));
    options.one_class = TrackClass::vehicle;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 1, 0}));
}

TEST(Matching, ResultsOfAnotherClassAreLeftOutWhereOneIsMeasured) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), called(car(0, 2, 200), "bicycle")});
    const auto result =
        boxes({called(detection(100), "person"), called(detection(200), "two_wheeler"), called(detection(300), "bus")});
    EvaluationOptions options = at(0.1);
    EXPECT_EQ(countsOf(truth, result, options), (Counts{2, 1, 0})) << "together classes do not matter";
    options.one_class = TrackClass::vehicle;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{0, 1, 1})) << "the car was called a person";
    EXPECT_EQ(matchFrames(truth, result, options).at(0).other_class_results, (std::vector<int>{0, 1}));
    options.one_class = TrackClass::two_wheeler;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 0, 0}));
    options.one_class = TrackClass::person;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{0, 0, 0})) << "the false person lies on a car";
    options.one_class.reset();
    options.vehicles_only = true;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 1, 0})) << "--vehicles looks at the ground truth alone";
}

TEST(Matching, ClassesToBeMeasuredAreWords) {
    EXPECT_FALSE(scoredClass("all"));
    for (const std::string& word : scoredClassWords()) EXPECT_EQ(wordOfScored(scoredClass(word)), word);
    EXPECT_EQ(scoredClass("two_wheelers"), TrackClass::two_wheeler);
    try {
        scoredClass("bikes");
        FAIL() << "there is no such class";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        EXPECT_NE(std::string(error.what()).find("\"bikes\""), std::string::npos) << error.what();
        EXPECT_NE(std::string(error.what()).find("two_wheelers"), std::string::npos) << error.what();
    }
    EvaluationOptions options = at(0.1);
    options.one_class = TrackClass::person;
    options.vehicles_only = true;
    EXPECT_THROW(check(options), Error) << "nothing would count";
    options.one_class = TrackClass::vehicle;
    EXPECT_NO_THROW(check(options));
    options.vehicles_only = false;
    options.one_class = TrackClass::unknown;
    EXPECT_THROW(check(options), Error);
}

TEST(Matching, ForTrackEvalResultsOnIgnoredObjectsAreFalseAlarms) {
    EvaluationOptions options = at(0.1);
    options.convention = Convention::trackeval;
    const BoxesByFrame truth = boxes({car(0, 1, 100), ignored(car(0, 2, 200))});
    EXPECT_EQ(countsOf(truth, boxes({car(0, 1, 100), car(0, 2, 200)}), options), (Counts{1, 1, 0}));
}

TEST(Matching, ResultsAtTheBorderAreLeftOut) {
    EvaluationOptions options = at(0.1);
    options.border = 3;
    options.image_size = {200, 100};
    // The right edge of the car lies at x + 10; the last pixel is 199, so 196 is the limit.
    EXPECT_EQ(countsOf(boxes({car(0, 1, 100)}), boxes({detection(186)}), options), (Counts{0, 1, 1}));
    EXPECT_EQ(countsOf(boxes({car(0, 1, 100)}), boxes({detection(186.01)}), options), (Counts{0, 0, 1}));
    EXPECT_EQ(countsOf(boxes({car(0, 1, 100)}), boxes({detection(12.99)}), options), (Counts{0, 0, 1}));
    EXPECT_EQ(matchFrames(boxes({car(0, 1, 100)}), boxes({detection(190)}), options).at(0).border_results,
              std::vector<int>{0});
}

TEST(Matching, TracksKeepTheirObjectAgainstABetterOne) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(1, 1, 100)});
    const BoxesByFrame result = boxes({car(0, 7, 100), car(1, 8, 100), car(1, 7, 100 + shiftFor(0.25))});
    for (const Convention convention : {Convention::thesis, Convention::trackeval}) {
        EvaluationOptions options = at(0.2);
        options.convention = convention;
        const auto matches = matchFrames(truth, result, options);
        ASSERT_EQ(matches.at(1).pairs.size(), 1u);
        EXPECT_EQ(matches[1].pairs[0].result, 1) << nameOf(convention);
        options.overlap = 0.3;  // below T_ov nothing is kept
        EXPECT_EQ(matchFrames(truth, result, options).at(1).pairs.at(0).result, 0) << nameOf(convention);
    }
}

TEST(Matching, FramesWithoutTruthCountOnlyForTrackEval) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(2, 1, 100)});
    const BoxesByFrame result = boxes({car(0, 1, 100), car(1, 1, 100), car(2, 1, 100), car(9, 1, 100)});
    EvaluationOptions options = at(0.5);
    EXPECT_EQ(countsOf(truth, result, options), (Counts{2, 0, 0}));
    EXPECT_EQ(prepareEvaluation(truth, result, options).results_not_counted, 2);
    options.convention = Convention::trackeval;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{2, 1, 0}));
    EXPECT_EQ(prepareEvaluation(truth, result, options).results_not_counted, 1);
    options.frame_count = 10;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{2, 2, 0}));
}

TEST(Matching, OrderOfTheBoxesDoesNotMatter) {
    std::vector<BoxRecord> truth;
    std::vector<BoxRecord> result;
    for (int k = 0; k < 9; ++k) {
        truth.push_back(car(0, k, 100 + 13 * k, 50 + 3 * k));
        result.push_back(detection(104 + 12.1 * k, 51 + 3.7 * k));
    }
    const Counts forwards = countsOf(boxes(truth), boxes(result), at(0.3));
    std::reverse(truth.begin(), truth.end());
    std::rotate(result.begin(), result.begin() + 4, result.end());
    EXPECT_EQ(countsOf(boxes(truth), boxes(result), at(0.3)), forwards);
}

TEST(EvaluationOptions, BadOnesAreRefused) {
    EXPECT_THROW(matchFrames({}, {}, at(0)), Error);
    EXPECT_THROW(matchFrames({}, {}, at(1.5)), Error);
    EXPECT_THROW(matchFrames({}, {}, at(std::nan(""))), Error);
    EvaluationOptions border = at(0.1);
    border.border = 3;
    EXPECT_THROW(matchFrames({}, {}, border), Error);
}

TEST(EvaluationInput, TrackEvalRefusesAnIdTwiceInAFrame) {
    EvaluationOptions options = at(0.1);
    const BoxesByFrame truth = boxes({car(3, 1, 100)});
    const BoxesByFrame result = boxes({car(3, 5, 100), car(3, 5, 140)});
    EXPECT_EQ(prepareEvaluation(truth, result, options).repeated_ids, 1);
    options.convention = Convention::trackeval;
    try {
        prepareEvaluation(truth, result, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_NE(std::string(error.what()).find("id 5 occurs twice in frame 3"), std::string::npos) << error.what();
    }
}

TEST(Matching, EverySideOfTheImageHasItsBorder) {
    EvaluationOptions options = at(0.1);
    options.border = 3;
    options.image_size = {200, 100};
    // A car is 20 × 10; the last pixels are 199 and 99.
    const auto leftOut = [&](double x, double y) {
        return !matchFrames(boxes({car(0, 1, 100)}), boxes({detection(x, y)}), options).at(0).border_results.empty();
    };
    EXPECT_FALSE(leftOut(13, 50));
    EXPECT_TRUE(leftOut(12.99, 50));
    EXPECT_FALSE(leftOut(186, 50));
    EXPECT_TRUE(leftOut(186.01, 50));
    EXPECT_FALSE(leftOut(100, 8));
    EXPECT_TRUE(leftOut(100, 7.99));
    EXPECT_FALSE(leftOut(100, 91));
    EXPECT_TRUE(leftOut(100, 91.01));
}

TEST(Matching, TrackEvalEndsWithTheLastFrameOfTheVideo) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(2, 1, 100)});
    const BoxesByFrame result = boxes({car(2, 1, 100), car(3, 1, 100)});
    EvaluationOptions options = at(0.5);
    options.convention = Convention::trackeval;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 0, 1})) << "frame 3 lies behind the truth";
    options.frame_count = 4;
    EXPECT_EQ(countsOf(truth, result, options), (Counts{1, 1, 1}));
}

TEST(Matching, MorePairsComeBeforeLargerOverlaps) {
    // Eq. 7.1: the first result lies on both cars, but the second car has no other.
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(0, 2, 110)});
    const auto match = matchFrames(truth, boxes({detection(101), detection(86)}), at(0.1)).at(0);
    ASSERT_EQ(match.pairs.size(), 2U);
    EXPECT_TRUE(match.missed.empty());
    for (const MatchedPair& pair : match.pairs) EXPECT_EQ(pair.result, pair.truth == 0 ? 1 : 0);
}

}  // namespace
}  // namespace eyrie::matching_test

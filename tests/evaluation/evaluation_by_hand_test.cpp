// Options, input and list of errors on both sides of each limit.
#include <gtest/gtest.h>

#include <limits>

#include "core/error.h"
#include "evaluation/error_list.h"
#include "evaluation/evaluation_boxes.h"

namespace eyrie::evaluation_by_hand_test {
namespace {

using test::boxes;
using test::car;
using test::shiftFor;

std::vector<ResultError> errorsOf(ResultErrorKind kind, const BoxesByFrame& truth, const BoxesByFrame& result,
                                  const EvaluationOptions& options = {}) {
    const EvaluationInput input = prepareEvaluation(truth, result, options);
    std::vector<ResultError> errors = listErrors(truth, result, input, matchFrames(input, options), options);
    std::erase_if(errors, [&](const ResultError& error) { return error.kind != kind; });
    return errors;
}

/// From `left` to `right`, 10 px wide, about y = 50.
BoxRecord span(FrameIndex frame, std::optional<int> id, double left, double right) {
    BoxRecord record = car(frame, id, (left + right) / 2);
    record.box.length = right - left;
    return record;
}

template <class Change>
EvaluationOptions with(const Change& change) {
    EvaluationOptions options;
    change(options);
    return options;
}

bool refused(const EvaluationOptions& options) {
    try {
        check(options);
        return false;
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        return true;
    }
}

}  // namespace

TEST(EvaluationByHand, OptionsAreRefusedBeyondTheirLimits) {
    EXPECT_FALSE(refused({}));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) { o.overlap = 1; })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) { o.overlap = 0.001; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) { o.overlap = 0; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) { o.overlap = 1.001; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) { o.overlap = -0.1; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) { o.one_class = TrackClass::unknown; })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) { o.one_class = TrackClass::person; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) {
        o.vehicles_only = true;
        o.one_class = TrackClass::person;
    })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) {
        o.vehicles_only = true;
        o.one_class = TrackClass::vehicle;
    })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) { o.vehicles_only = true; })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) { o.frame_count = 1; })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) { o.frame_count = 0; })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) {
        o.border = 3;
        o.image_size = {1, 1};
    })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) {
        o.border = 3;
        o.image_size = {0, 100};
    })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) {
        o.border = 3;
        o.image_size = {100, 0};
    })));
    EXPECT_TRUE(refused(with([](EvaluationOptions& o) {
        o.border = std::numeric_limits<double>::infinity();
        o.image_size = {100, 100};
    })));
    EXPECT_FALSE(refused(with([](EvaluationOptions& o) {
        o.image_size = {100, 0};
    }))) << "without a border no size is needed";
    EXPECT_EQ(scoredClass("all"), std::nullopt);
    EXPECT_EQ(scoredClass("vehicles"), TrackClass::vehicle);
    EXPECT_EQ(scoredClass("two_wheelers"), TrackClass::two_wheeler);
    EXPECT_EQ(scoredClass("persons"), TrackClass::person);
    EXPECT_THROW(scoredClass("cars"), Error);
    EXPECT_EQ(wordOfScored(std::nullopt), "all");
    EXPECT_EQ(wordOfScored(TrackClass::person), "persons");
    EXPECT_EQ(countedText({}), "");
    EXPECT_EQ(countedText(with([](EvaluationOptions& o) { o.vehicles_only = true; })), ", vehicles only");
    EXPECT_EQ(countedText(with([](EvaluationOptions& o) { o.one_class = TrackClass::person; })),
              ", persons only, without results of other classes");
    EXPECT_STREQ(nameOf(Convention::thesis), "thesis");
    EXPECT_STREQ(nameOf(Convention::trackeval), "trackeval");
}

TEST(EvaluationByHand, InputCountsFramesIdsAndWhatIsLeftOut) {
    // True in frames 0, 2 and 5; results in 2, 3, 5 and 7.
    const BoxesByFrame truth = boxes({car(0, 4, 100), car(2, 9, 100), car(2, 4, 150), car(5, 9, 100)});
    const BoxesByFrame result = boxes({car(2, 30, 100), car(2, 20, 150), car(3, 30, 100), car(5, 20, 100),
                                       car(5, 40, 180), car(7, 50, 100), car(7, 60, 100)});
    const EvaluationInput thesis = prepareEvaluation(truth, result, {});
    EXPECT_EQ(thesis.frame_count, 3) << "those that the truth names";
    ASSERT_EQ(thesis.frames.size(), 3U);
    EXPECT_EQ(thesis.frames[1].frame, 2);
    EXPECT_EQ(thesis.frames[2].frame, 5);
    EXPECT_EQ(thesis.shared_frames, 2);
    EXPECT_EQ(thesis.results_not_counted, 3) << "one of frame 3, two of frame 7";
    EXPECT_TRUE(thesis.has_tracks);
    EXPECT_EQ(thesis.truth_ids, (std::vector<int>{4, 9}));
    EXPECT_EQ(thesis.result_ids, (std::vector<int>{20, 30, 40}));
    EXPECT_EQ(thesis.frames[1].truth_tracks, (std::vector<int>{1, 0}));
    EXPECT_EQ(thesis.frames[1].result_tracks, (std::vector<int>{1, 0}));
    EXPECT_EQ(thesis.frames[2].result_tracks, (std::vector<int>{0, 2}));
    EXPECT_NEAR(thesis.frames[1].overlap(0, 0), 1, 1e-9);
    EXPECT_NEAR(thesis.frames[1].overlap(0, 1), 0, 1e-9);
    EvaluationOptions options;
    options.convention = Convention::trackeval;
    const EvaluationInput trackeval = prepareEvaluation(truth, result, options);
    EXPECT_EQ(trackeval.frame_count, 6) << "0 … 5";
    EXPECT_EQ(trackeval.frames.size(), 4U) << "0, 2, 3 and 5";
    EXPECT_EQ(trackeval.results_not_counted, 2);
    options.frame_count = 8;
    EXPECT_EQ(prepareEvaluation(truth, result, options).frames.size(), 5U);
    EXPECT_EQ(prepareEvaluation(truth, result, options).results_not_counted, 0);
    options.frame_count = 3;
    EXPECT_EQ(prepareEvaluation(truth, result, options).frames.size(), 2U) << "0 and 2";
    EXPECT_EQ(prepareEvaluation(truth, result, options).results_not_counted, 5);
    EXPECT_EQ(prepareEvaluation({}, result, {}).frame_count, 0);
    const EvaluationInput nameless = prepareEvaluation(boxes({car(0, std::nullopt, 100)}), boxes({car(0, 1, 100)}), {});
    EXPECT_FALSE(nameless.has_tracks);
    EXPECT_TRUE(nameless.truth_ids.empty());
    EXPECT_EQ(prepareEvaluation(boxes({car(0, 4, 100), car(0, 4, 150), car(0, 4, 190)}), boxes({car(0, 1, 100)}), {})
                  .repeated_ids,
              2);
}

TEST(EvaluationByHand, BoxesWithoutAnIdAreOneThingFromAnOverlapOfThreeTenths) {
    const auto misses = [](double overlap) {
        return errorsOf(ResultErrorKind::miss,
                        boxes({car(0, std::nullopt, 100), car(1, std::nullopt, 100 + shiftFor(overlap))}), {});
    };
    ASSERT_EQ(misses(0.32).size(), 1U);
    EXPECT_EQ(misses(0.32)[0].count(), 2);
    EXPECT_EQ(misses(0.32)[0].first_frame, 0);
    EXPECT_EQ(misses(0.32)[0].last_frame, 1);
    ASSERT_EQ(misses(0.28).size(), 2U);
    EXPECT_EQ(misses(0.28)[0].count(), 1);
    EXPECT_EQ(misses(0.28)[1].first_frame, 1);
    // With ids they alone tell.
    EXPECT_EQ(errorsOf(ResultErrorKind::miss, boxes({car(0, 1, 100), car(1, 1, 150)}), {}).size(), 1U);
    EXPECT_EQ(errorsOf(ResultErrorKind::miss, boxes({car(0, 1, 100), car(1, 2, 100)}), {}).size(), 2U);
}

TEST(EvaluationByHand, PartsLieByHalfInTheirObjectAndByLessThanHalfOnEachOther) {
    // The car reaches from 90 to 110; one part fills its rear half.
    const auto splits = [](double left, double right) {
        return errorsOf(ResultErrorKind::split, boxes({car(0, 1, 100)}),
                        boxes({span(0, 5, 90, 100), span(0, 6, left, right)}));
    };
    ASSERT_EQ(splits(104.5, 114.5).size(), 1U) << "5.5 of 10 px lie inside";
    EXPECT_EQ(splits(104.5, 114.5)[0].tracks, (std::vector<int>{5, 6}));
    EXPECT_EQ(splits(104.5, 114.5)[0].objects, std::vector<int>{1});
    EXPECT_EQ(splits(104.5, 114.5)[0].places.at(0).results, (std::vector<int>{0, 1}));
    EXPECT_TRUE(splits(105.5, 115.5).empty()) << "4.5 of 10";
    EXPECT_EQ(splits(95.5, 105.5).size(), 1U) << "4.5 of 10 px lie on the other part";
    EXPECT_TRUE(splits(94.5, 104.5).empty()) << "5.5 of 10";
}

TEST(EvaluationByHand, AMergeCoversHalfOfEachObjectAndMissesOne) {
    // Cars from 90 to 110 and from 115 to 135.
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(0, 2, 125)});
    const auto merges = [&](double right, bool second_found = false) {
        std::vector<BoxRecord> results{span(0, 5, 90, right)};
        if (second_found) results.push_back(car(0, 6, 125));
        return errorsOf(ResultErrorKind::merge, truth, boxes(results));
    };
    ASSERT_EQ(merges(126).size(), 1U) << "11 of 20 px";
    EXPECT_EQ(merges(126)[0].objects, (std::vector<int>{1, 2}));
    EXPECT_EQ(merges(126)[0].tracks, std::vector<int>{5});
    EXPECT_EQ(merges(126)[0].places.at(0).truth, (std::vector<int>{0, 1}));
    EXPECT_TRUE(merges(124).empty()) << "9 of 20 px";
    EXPECT_TRUE(merges(126, true).empty()) << "both were found";
}

TEST(EvaluationByHand, ErrorsComeByTheirFirstFrameThenTheirKind) {
    const BoxesByFrame truth = boxes({car(0, 1, 100), car(1, 1, 100), car(1, 2, 150)});
    const BoxesByFrame result = boxes({car(0, 5, 100), car(0, 6, 190), car(1, 7, 100), car(1, 6, 190)});
    const EvaluationInput input = prepareEvaluation(truth, result, {});
    const auto errors = listErrors(truth, result, input, matchFrames(input, {}), {});
    ASSERT_EQ(errors.size(), 3U);
    // The switch begins where the object had its old id last.
    EXPECT_EQ(errors[0].kind, ResultErrorKind::false_alarm);
    EXPECT_EQ(errors[0].count(), 2);
    EXPECT_EQ(errors[0].tracks, std::vector<int>{6});
    EXPECT_EQ(errors[1].kind, ResultErrorKind::id_switch);
    EXPECT_EQ(errors[1].first_frame, 0);
    EXPECT_EQ(errors[1].last_frame, 1);
    EXPECT_EQ(errors[1].tracks, (std::vector<int>{5, 7}));
    EXPECT_EQ(errors[1].places.at(0).frame, 1);
    EXPECT_EQ(errors[2].kind, ResultErrorKind::miss);
    EXPECT_EQ(errors[2].first_frame, 1);
    EXPECT_EQ(errors[2].objects, std::vector<int>{2});
}

}  // namespace eyrie::evaluation_by_hand_test

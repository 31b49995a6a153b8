/// What is told of switches and fragments, and which frame stands for an entry: from tracks that are written down.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "diagnosis/diagnoser.h"
#include "evaluation/evaluation_boxes.h"

namespace eyrie::identity_causes_test {
namespace {

using test::boxes;
using test::car;
using testing::HasSubstr;

/// What a run stored, made up by hand, and what is told of its errors.
class IdentityCausesTest : public testing::Test {
 protected:
    std::vector<DiagnosedError> all(const BoxesByFrame& truth, const BoxesByFrame& result) {
        DiagnosisSource source;
        source.options.motion.min_age = 5;
        source.options.clustering.min_density_share = 0;
        if (!stored.empty())
            source.frame_result = [this](FrameIndex frame) -> std::optional<FrameResult> {
                const auto found = stored.find(frame);
                return found == stored.end() ? std::nullopt : std::optional(found->second);
            };
        const EvaluationInput input = prepareEvaluation(truth, result, options);
        const auto matches = matchFrames(input, options);
        return Diagnoser(source).diagnose(listErrors(truth, result, input, matches, options),
                                          {truth, result, input, matches, options});
    }
    std::vector<DiagnosedError> of(ResultErrorKind kind, const BoxesByFrame& truth, const BoxesByFrame& result) {
        std::vector<DiagnosedError> errors = all(truth, result);
        std::erase_if(errors, [kind](const DiagnosedError& one) { return one.error.kind != kind; });
        return errors;
    }
    DiagnosedError only(ResultErrorKind kind, const BoxesByFrame& truth, const BoxesByFrame& result) {
        const auto errors = of(kind, truth, result);
        EXPECT_EQ(errors.size(), 1U);
        return errors.empty() ? DiagnosedError{} : errors.front();
    }
    /// A registered frame with a standing corner at each of these places.
    void store(FrameIndex frame, std::vector<cv::Point2f> corners = {}) {
        FrameResult& result = stored[frame];
        result.motion.frame = frame;
        result.motion.image_size = {640, 480};
        result.motion.registration.state = RegistrationState::registered;
        result.motion.registration.current_from_previous.from_frame = frame - 1;
        result.motion.registration.current_from_previous.to_frame = frame;
        result.motion.stationary_corners = std::move(corners);
    }
    EvaluationOptions options;
    std::map<FrameIndex, FrameResult> stored;
};

/// An object that stands at x in these frames.
void add(std::vector<BoxRecord>& records, int id, double x, FrameIndex first, FrameIndex last) {
    for (FrameIndex frame = first; frame <= last; ++frame) records.push_back(car(frame, id, x));
}

TEST_F(IdentityCausesTest, ATrackThatFollowedAnotherBeforeWasSwapped) {
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 5);
    add(truth, 2, 150, 0, 2);
    add(result, 7, 50, 0, 2);
    add(result, 8, 150, 0, 2);
    add(result, 8, 50, 3, 5);
    const DiagnosedError swapped = only(ResultErrorKind::id_switch, boxes(truth), boxes(result));
    EXPECT_EQ(swapped.cause, ErrorCause::swapped);
    EXPECT_EQ(swapped.text, "track 8 followed object 2");
    EXPECT_EQ(swapped.frames_of_cause, 1);
}

TEST_F(IdentityCausesTest, ATrackThatNowFollowsAnotherWasSwapped) {
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 5);
    add(truth, 2, 150, 3, 5);
    add(result, 7, 50, 0, 2);
    add(result, 7, 150, 3, 5);
    add(result, 8, 50, 3, 5);
    const DiagnosedError swapped = only(ResultErrorKind::id_switch, boxes(truth), boxes(result));
    EXPECT_EQ(swapped.cause, ErrorCause::swapped);
    EXPECT_EQ(swapped.text, "track 7 now follows object 2");
}

TEST_F(IdentityCausesTest, ATrackThatGoesOnWithoutAnObjectLeft) {
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 5);
    add(result, 7, 50, 0, 2);
    add(result, 7, 300, 3, 4);
    add(result, 8, 50, 3, 5);
    const DiagnosedError left = only(ResultErrorKind::id_switch, boxes(truth), boxes(result));
    EXPECT_EQ(left.cause, ErrorCause::track_left);
    EXPECT_EQ(left.text, "track 7 goes on to frame 4");
}

TEST_F(IdentityCausesTest, ATrackThatEndedSaysWhyTheObjectWasMissedThen) {
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 25);
    add(result, 7, 50, 0, 9);
    add(result, 8, 50, 14, 25);
    EXPECT_EQ(only(ResultErrorKind::id_switch, boxes(truth), boxes(result)).text,
              "track 7 ends in frame 9, then: unknown");
    for (FrameIndex frame = 10; frame < 14; ++frame) store(frame, {{50, 50}});
    const DiagnosedError ended = only(ResultErrorKind::id_switch, boxes(truth), boxes(result));
    EXPECT_EQ(ended.cause, ErrorCause::track_ended);
    EXPECT_EQ(ended.text, "track 7 ends in frame 9, then: too slow");
    std::vector<BoxRecord> at_once;
    add(at_once, 7, 50, 0, 9);
    add(at_once, 8, 50, 10, 25);
    EXPECT_EQ(only(ResultErrorKind::id_switch, boxes(truth), boxes(at_once)).text, "track 7 ends in frame 9");
}

TEST_F(IdentityCausesTest, OnlyMissesOfTheObjectInTheGapExplainIt) {
    // Object 1 is missed in three frames at its beginning, in two in the gap, in three at its end; 2 throughout.
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 25);
    add(truth, 2, 300, 0, 25);
    add(result, 7, 50, 3, 9);
    add(result, 7, 50, 12, 22);
    for (FrameIndex frame = 0; frame <= 25; ++frame) store(frame);
    for (const FrameIndex frame : {10, 11}) store(frame, {{50, 50}});
    const auto fragments = of(ResultErrorKind::fragment, boxes(truth), boxes(result));
    ASSERT_EQ(fragments.size(), 2U);
    EXPECT_EQ(fragments[0].cause, ErrorCause::too_slow);
    EXPECT_EQ(fragments[0].text, "1 corners, none counts as moving");
    EXPECT_EQ(fragments[0].frames_of_cause, 1);
    EXPECT_EQ(fragments[1].cause, ErrorCause::no_corners);
}

TEST_F(IdentityCausesTest, TheMiddleOneOfTheFramesWithTheCauseIsShown) {
    const auto missedFor = [&](const std::vector<FrameIndex>& slow, FrameIndex last) {
        std::vector<BoxRecord> truth, result;
        add(truth, 1, 50, 0, last);
        add(result, 7, 50, 0, 9);
        stored.clear();
        for (FrameIndex frame = 10; frame <= last; ++frame) store(frame);
        for (const FrameIndex frame : slow) store(frame, {{50, 50}, {48, 50}});
        const DiagnosedError miss = only(ResultErrorKind::miss, boxes(truth), boxes(result));
        EXPECT_EQ(miss.text.empty(), miss.cause == ErrorCause::no_corners);
        return std::tuple(miss.cause, miss.frames_of_cause, miss.error.places[miss.place].frame);
    };
    EXPECT_EQ(missedFor({10, 12, 14}, 14), std::tuple(ErrorCause::too_slow, 3, 12));
    EXPECT_EQ(missedFor({11, 14}, 13), std::tuple(ErrorCause::no_corners, 3, 12));
    EXPECT_EQ(missedFor({12, 13}, 13), std::tuple(ErrorCause::no_corners, 2, 11)) << "of equals the earlier";
    EXPECT_EQ(missedFor({10, 11}, 13), std::tuple(ErrorCause::too_slow, 2, 11));
    EXPECT_EQ(missedFor({13}, 13), std::tuple(ErrorCause::no_corners, 3, 11));
}

TEST_F(IdentityCausesTest, AnExplanationHoweverRareIsBetterThanNone) {
    std::vector<BoxRecord> truth, result;
    add(truth, 1, 50, 0, 14);
    add(result, 7, 50, 0, 9);
    store(12, {{50, 50}});
    const DiagnosedError miss = only(ResultErrorKind::miss, boxes(truth), boxes(result));
    EXPECT_EQ(miss.cause, ErrorCause::too_slow) << "of the other four frames nothing is stored";
    EXPECT_EQ(miss.frames_of_cause, 1);
    EXPECT_EQ(miss.error.places[miss.place].frame, 12);
    stored.clear();
    const DiagnosedError unknown = only(ResultErrorKind::miss, boxes(truth), boxes(result));
    EXPECT_EQ(unknown.cause, ErrorCause::unknown);
    EXPECT_EQ(unknown.error.places[unknown.place].frame, 12) << "the middle";
}

TEST_F(IdentityCausesTest, ThreeFramesAfterOneThatWasNotRegisteredAreExplainedByIt) {
    std::vector<BoxRecord> truth, result;
    for (const FrameIndex frame : {2, 4, 5}) {
        add(truth, 1, 50, frame, frame);
        add(result, 7, 50, frame, frame);
        add(result, 10 + frame, 300, frame, frame);
        store(frame);
    }
    stored[2].motion.registration.state = RegistrationState::failed;
    stored[2].motion.registration.failure = {.fault = RegistrationFault::too_few_agree, .count = 12, .of = 40};
    for (const DiagnosedError& one : of(ResultErrorKind::false_alarm, boxes(truth), boxes(result))) {
        EXPECT_EQ(one.cause, ErrorCause::unregistered) << one.error.first_frame;
        if (one.error.first_frame > 2) continue;
        EXPECT_THAT(one.text, HasSubstr("12 of 40"));
    }
    add(truth, 1, 50, 6, 6);
    add(result, 7, 50, 6, 6);
    add(result, 16, 300, 6, 6);
    store(6);
    EXPECT_EQ(of(ResultErrorKind::false_alarm, boxes(truth), boxes(result)).back().cause, ErrorCause::unknown);
}

TEST_F(IdentityCausesTest, AResultThatIsNoPartOfASplitIsNoneOfItsFalseAlarms) {
    BoxRecord rear = car(0, 7, 45), front = car(0, 8, 55), alone = car(0, 9, 300);
    rear.box.length = front.box.length = 9;
    for (const DiagnosedError& one :
         of(ResultErrorKind::false_alarm, boxes({car(0, 1, 50)}), boxes({alone, rear, front})))
        EXPECT_EQ(one.cause, one.error.tracks.front() == 9 ? ErrorCause::unknown : ErrorCause::split);
}

}  // namespace
}  // namespace eyrie::identity_causes_test

#include "diagnosis/diagnoser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "evaluation/evaluation_boxes.h"

namespace eyrie::diagnoser_test {
namespace {

using test::boxes;
using test::car;
using testing::HasSubstr;

/// Frames of a run, made up by hand; counts how often it was read.
struct StoredFrames {
    std::map<FrameIndex, FrameResult> frames;
    int reads = 0;

    FrameResult& operator[](FrameIndex frame) {
        FrameResult& result = frames[frame];
        result.motion.frame = frame;
        result.motion.image_size = {640, 480};
        result.motion.registration.state = RegistrationState::registered;
        result.motion.registration.current_from_previous.from_frame = frame - 1;
        result.motion.registration.current_from_previous.to_frame = frame;
        return result;
    }
    DiagnosisSource source() {
        DiagnosisSource source;
        source.options.clustering.min_members = 3;
        source.options.clustering.min_density_share = 0;
        source.options.motion.min_age = 5;
        source.frame_result = [this](FrameIndex frame) -> std::optional<FrameResult> {
            ++reads;
            const auto found = frames.find(frame);
            return found == frames.end() ? std::nullopt : std::optional(found->second);
        };
        return source;
    }
};

void addVectors(FrameResult& result, int count, double x, double y = 50) {
    for (int i = 0; i < count; ++i) {
        MotionVector vector;
        vector.id = static_cast<CornerId>(result.motion.motion_vectors.size());
        vector.position = {static_cast<float>(x - 3 + i), static_cast<float>(y)};
        vector.velocity = {2, 0};
        result.motion.motion_vectors.push_back(vector);
    }
}

void addCluster(FrameResult& result, std::vector<int> members, const OrientedBox& box) {
    MotionCluster cluster;
    cluster.box = box;
    cluster.members = std::move(members);
    result.clusters.push_back(cluster);
}

void addDetection(FrameResult& result, const OrientedBox& box, Rejection rejection = Rejection::none) {
    Detection detection;
    detection.box = box;
    detection.rejection = rejection;
    result.detections.push_back(detection);
}

void addTrack(FrameResult& result, TrackId id, const OrientedBox& box, TrackStatus status) {
    TrackState state;
    state.id = id;
    state.box = box;
    state.status = status;
    result.tracks.push_back(state);
}

BoxRecord moving(BoxRecord record, double vx, double vy = 0) {
    record.velocity = {vx, vy};
    return record;
}

class Causes : public testing::Test {
 protected:
    std::vector<DiagnosedError> diagnose(const BoxesByFrame& truth, const BoxesByFrame& result) {
        Diagnoser diagnoser(stored.source());
        return diagnoseWith(diagnoser, truth, result);
    }
    std::vector<DiagnosedError> diagnoseWith(Diagnoser& diagnoser, const BoxesByFrame& truth,
                                             const BoxesByFrame& result) const {
        const EvaluationInput input = prepareEvaluation(truth, result, options);
        const auto matches = matchFrames(input, options);
        return diagnoser.diagnose(listErrors(truth, result, input, matches, options),
                                  {truth, result, input, matches, options});
    }
    /// The only error of a kind.
    DiagnosedError theOnly(ResultErrorKind kind, const BoxesByFrame& truth, const BoxesByFrame& result) {
        std::vector<DiagnosedError> found;
        for (const DiagnosedError& one : diagnose(truth, result))
            if (one.error.kind == kind) found.push_back(one);
        EXPECT_EQ(found.size(), 1u);
        return found.empty() ? DiagnosedError{} : found.front();
    }
    /// An object in view since frame 0 that is missed in frame 20.
    DiagnosedError missedCar() {
        BoxesByFrame truth = boxes({car(0, 1, 50), car(20, 1, 50)});
        BoxesByFrame result = boxes({car(0, 7, 50)});
        for (const DiagnosedError& one : diagnose(truth, result))
            if (one.error.kind == ResultErrorKind::miss) return one;
        ADD_FAILURE() << "nothing is missed";
        return {};
    }
    DiagnosedError falseAlarm(const BoxRecord& alarm) {
        return theOnly(ResultErrorKind::false_alarm, boxes({car(alarm.frame, 1, 50)}),
                       boxes({car(alarm.frame, 7, 50), alarm}));
    }
    EvaluationOptions options;
    StoredFrames stored;
    const OrientedBox box = car(0, 1, 50).box;
};

TEST_F(Causes, aMissInAFrameThatWasNotRegistered) {
    FrameResult& frame = stored[20];
    frame.motion.registration.state = RegistrationState::failed;
    frame.motion.registration.failure = {.fault = RegistrationFault::too_few_corners, .count = 12, .of = 40};
    const auto miss = missedCar();
    EXPECT_EQ(miss.cause, ErrorCause::unregistered);
    EXPECT_THAT(miss.text, HasSubstr("12 of 40"));
}

TEST_F(Causes, aMissWithoutCorners) {
    stored[20].motion.stationary_corners = {{150, 50}};
    EXPECT_EQ(missedCar().cause, ErrorCause::no_corners);
}

TEST_F(Causes, aMissWithStandingCorners) {
    stored[20].motion.stationary_corners = {{48, 50}, {52, 51}, {150, 50}};
    const auto miss = missedCar();
    EXPECT_EQ(miss.cause, ErrorCause::too_slow);
    EXPECT_THAT(miss.text, HasSubstr("2 corners"));
}

TEST_F(Causes, aMissOfWhatJustCameIntoView) {
    stored[2];
    const auto miss =
        theOnly(ResultErrorKind::miss, boxes({car(0, 2, 300), car(1, 2, 300), car(1, 1, 50), car(2, 1, 50)}),
                boxes({car(0, 7, 300), car(1, 7, 300)}));
    EXPECT_EQ(miss.cause, ErrorCause::too_new);
}

TEST_F(Causes, aMissWithTooFewMotionVectors) {
    addVectors(stored[20], 2, 50);
    const auto miss = missedCar();
    EXPECT_EQ(miss.cause, ErrorCause::too_few_vectors);
    EXPECT_EQ(miss.text, "2 motion vectors, 3 are needed (clustering.min_members)");
}

TEST_F(Causes, aMissWhoseMotionVectorsWereNotLinked) {
    addVectors(stored[20], 4, 50);
    for (MotionVector& vector : stored.frames[20].motion.motion_vectors)
        if (vector.id > 1) vector.velocity.x += 0.5F * static_cast<float>(vector.id);
    const auto miss = missedCar();
    EXPECT_EQ(miss.cause, ErrorCause::not_clustered);
    EXPECT_EQ(miss.text, "4 motion vectors lie here, but only 2 are linked (clustering.velocity_share)");
}

TEST_F(Causes, aMissThatTheDetectorMade) {
    addVectors(stored[20], 4, 50);
    addCluster(stored.frames[20], {0, 1, 2, 3}, box);
    EXPECT_EQ(missedCar().cause, ErrorCause::not_detected);
}

TEST_F(Causes, aMissThatRemovalMade) {
    const std::pair<Rejection, ErrorCause> pairs[] = {{Rejection::duplicate, ErrorCause::removed_duplicate},
                                                      {Rejection::outlier, ErrorCause::removed_outlier},
                                                      {Rejection::size, ErrorCause::removed_size}};
    for (const auto& [rejection, cause] : pairs) {
        stored.frames.clear();
        addDetection(stored[20], box, rejection);
        EXPECT_EQ(missedCar().cause, cause);
    }
}

TEST_F(Causes, aMissThatTrackingMade) {
    addDetection(stored[20], box);
    EXPECT_EQ(missedCar().cause, ErrorCause::not_associated);
    addTrack(stored.frames[20], 5, box, TrackStatus::tentative);
    EXPECT_EQ(missedCar().cause, ErrorCause::tentative);
}

TEST_F(Causes, aMissThatFinishingMade) {
    addDetection(stored[20], box);
    stored.frames[20].dropped.push_back({5, box, TrackDrop::shadow, 2});
    EXPECT_EQ(missedCar().cause, ErrorCause::track_dropped);
    EXPECT_EQ(missedCar().text,
              "track 5 drives beside track 2 as if fixed to it, as its shadow or side would (finishing.drop_shadows)");
    stored.frames[20].dropped.front().why = TrackDrop::unconfirmed;
    EXPECT_EQ(missedCar().cause, ErrorCause::tentative);
}

TEST_F(Causes, aMissByABoxThatIsTooFarOff) {
    stored[0];
    // Shifted by 17 of 20 px: (20 − 17) / (20 + 17) = 0.08.
    const auto miss = theOnly(ResultErrorKind::miss, boxes({car(0, 1, 50)}), boxes({car(0, 7, 67)}));
    EXPECT_EQ(miss.cause, ErrorCause::box_off);
    EXPECT_THAT(miss.text, HasSubstr("0.08"));
    const auto alarm = theOnly(ResultErrorKind::false_alarm, boxes({car(0, 1, 50)}), boxes({car(0, 7, 67)}));
    EXPECT_EQ(alarm.cause, ErrorCause::box_off);
}

TEST_F(Causes, aMissAtTheBorder) {
    stored[0];
    options.border = 3;
    options.image_size = {640, 480};
    const auto miss = theOnly(ResultErrorKind::miss, boxes({car(0, 1, 11)}), boxes({car(0, 7, 11)}));
    EXPECT_EQ(miss.cause, ErrorCause::at_border);
}

TEST_F(Causes, aMissByAResultOfAnotherClass) {
    stored[0];
    options.one_class = TrackClass::vehicle;
    BoxRecord result = car(0, 7, 50);
    result.object_class = "two_wheeler";
    const auto miss = theOnly(ResultErrorKind::miss, boxes({car(0, 1, 50)}), boxes({result}));
    EXPECT_EQ(miss.cause, ErrorCause::other_class);
    EXPECT_EQ(miss.text, "called two_wheeler");
}

TEST_F(Causes, missesInMergesAndSplits) {
    stored[0];
    BoxRecord wide = car(0, 7, 61);
    wide.box.length = 42;
    const auto merged = theOnly(ResultErrorKind::miss, boxes({car(0, 1, 50), car(0, 2, 72)}), boxes({wide}));
    EXPECT_EQ(merged.cause, ErrorCause::merged);
    BoxRecord rear = car(0, 7, 44);
    BoxRecord front = car(0, 8, 56);
    rear.box.length = front.box.length = 8;
    options.overlap = 0.5;
    const auto split = theOnly(ResultErrorKind::miss, boxes({car(0, 1, 50)}), boxes({rear, front}));
    EXPECT_EQ(split.cause, ErrorCause::split);
}

TEST_F(Causes, splitsByClusteringOrBySegmentation) {
    FrameResult& frame = stored[0];
    addVectors(frame, 4, 46);
    addVectors(frame, 4, 56);
    addCluster(frame, {0, 1, 2, 3}, box);
    addCluster(frame, {4, 5, 6, 7}, box);
    BoxRecord rear = car(0, 7, 45);
    BoxRecord front = car(0, 8, 55);
    rear.box.length = front.box.length = 9;
    const auto found = boxes({rear, front});
    EXPECT_EQ(theOnly(ResultErrorKind::split, boxes({car(0, 1, 50)}), found).cause, ErrorCause::clustered_apart);
    // The second part is a false alarm, because it is a part.
    EXPECT_EQ(theOnly(ResultErrorKind::false_alarm, boxes({car(0, 1, 50)}), found).cause, ErrorCause::split);
    frame.clusters.pop_back();
    EXPECT_EQ(theOnly(ResultErrorKind::split, boxes({car(0, 1, 50)}), found).cause, ErrorCause::segmented_apart);
}

TEST_F(Causes, mergesByClusteringSegmentationOrTracking) {
    FrameResult& frame = stored[0];
    const auto truth = boxes({car(0, 1, 50), car(0, 2, 72)});
    BoxRecord wide = car(0, 7, 61);
    wide.box.length = 42;
    addVectors(frame, 4, 50);
    addVectors(frame, 4, 72);
    addDetection(frame, car(0, 1, 50).box);
    addDetection(frame, car(0, 1, 72).box);
    EXPECT_EQ(theOnly(ResultErrorKind::merge, truth, boxes({wide})).cause, ErrorCause::tracked_together);
    addDetection(frame, wide.box);
    EXPECT_EQ(theOnly(ResultErrorKind::merge, truth, boxes({wide})).cause, ErrorCause::segmented_together);
    addCluster(frame, {0, 1, 2, 3, 4, 5, 6, 7}, wide.box);
    EXPECT_EQ(theOnly(ResultErrorKind::merge, truth, boxes({wide})).cause, ErrorCause::clustered_together);
}

TEST_F(Causes, falseAlarms) {
    stored[3];
    EXPECT_EQ(falseAlarm(car(3, 8, 300)).cause, ErrorCause::unknown);
    EXPECT_EQ(falseAlarm(car(3, 8, 55)).cause, ErrorCause::duplicate);
    EXPECT_EQ(falseAlarm(car(3, 8, 650)).cause, ErrorCause::outside_image);
    BoxRecord predicted = car(3, 8, 300);
    predicted.origin = StateOrigin::predicted;
    EXPECT_EQ(falseAlarm(predicted).cause, ErrorCause::coasting);
    addVectors(stored.frames[3], 5, 300);
    const auto steady = falseAlarm(moving(car(3, 8, 300), 2));
    EXPECT_EQ(steady.cause, ErrorCause::unlabelled);
    EXPECT_THAT(steady.text, HasSubstr("5 motion vectors"));
    stored.frames[3].motion.registration.state = RegistrationState::failed;
    EXPECT_EQ(falseAlarm(car(3, 8, 300)).cause, ErrorCause::unregistered);
}

TEST_F(Causes, aFalseAlarmThatMovesAlongWithTheGround) {
    FrameResult& frame = stored[3];
    frame.motion.registration.current_from_previous.matrix(0, 2) = -2;
    addVectors(frame, 5, 300);
    EXPECT_EQ(falseAlarm(moving(car(3, 8, 300), 0.5)).cause, ErrorCause::parallax);       // along, slower
    EXPECT_EQ(falseAlarm(moving(car(3, 8, 300), 0, 0.5)).cause, ErrorCause::unlabelled);  // across
    EXPECT_EQ(falseAlarm(moving(car(3, 8, 300), 5)).cause, ErrorCause::unlabelled);       // faster
}

TEST_F(Causes, aFalseAlarmBesideAnObjectThatMovesAlike) {
    stored[3];
    const auto truth = boxes({car(3, 1, 50)});
    const auto with = [&](double speed) {
        return theOnly(ResultErrorKind::false_alarm, truth,
                       boxes({moving(car(3, 7, 50), 4), moving(car(3, 8, 55, 66), speed)}));
    };
    EXPECT_EQ(with(4).cause, ErrorCause::shadow);
    EXPECT_THAT(with(4).text, HasSubstr("object 1"));
    EXPECT_NE(with(-4).cause, ErrorCause::shadow);
    EXPECT_NE(with(12).cause, ErrorCause::shadow);
}

TEST_F(Causes, aFalseAlarmBesideWhatDoesNotCount) {
    stored[0];
    BoxRecord person = car(0, 2, 300);
    person.object_class = "person";
    options.vehicles_only = true;
    const auto alarm =
        theOnly(ResultErrorKind::false_alarm, boxes({car(0, 1, 50), person}), boxes({car(0, 7, 50), car(0, 8, 325)}));
    EXPECT_EQ(alarm.cause, ErrorCause::ignored_object);
    EXPECT_THAT(alarm.text, HasSubstr("person"));
}

TEST_F(Causes, switches) {
    const auto truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50)});
    const auto ended = theOnly(ResultErrorKind::id_switch, truth, boxes({car(0, 7, 50), car(2, 8, 50)}));
    EXPECT_EQ(ended.cause, ErrorCause::track_ended);
    EXPECT_THAT(ended.text, HasSubstr("track 7 ends in frame 0"));
    const auto left = theOnly(ResultErrorKind::id_switch, truth,
                              boxes({car(0, 7, 50), car(1, 7, 50), car(2, 7, 200), car(2, 8, 50)}));
    EXPECT_EQ(left.cause, ErrorCause::track_left);

    const auto two = boxes({car(0, 1, 50), car(1, 1, 50), car(0, 2, 150), car(1, 2, 150)});
    const auto swapped = diagnose(two, boxes({car(0, 7, 50), car(0, 8, 150), car(1, 8, 50), car(1, 7, 150)}));
    int switches = 0;
    for (const DiagnosedError& one : swapped) {
        if (one.error.kind != ResultErrorKind::id_switch) continue;
        ++switches;
        EXPECT_EQ(one.cause, ErrorCause::swapped);
    }
    EXPECT_EQ(switches, 2);
}

TEST_F(Causes, aFragmentHasTheCauseOfItsMisses) {
    stored[1].motion.stationary_corners = {{50, 50}};
    const auto truth = boxes({car(-9, 1, 50), car(0, 1, 50), car(1, 1, 50), car(2, 1, 50)});
    const auto fragment =
        theOnly(ResultErrorKind::fragment, truth, boxes({car(-9, 7, 50), car(0, 7, 50), car(2, 7, 50)}));
    EXPECT_EQ(fragment.cause, ErrorCause::too_new);  // frames before the run's first do not count
    DiagnosisSource source = stored.source();
    source.first_frame = -9;
    Diagnoser diagnoser(source);
    for (const DiagnosedError& one :
         diagnoseWith(diagnoser, truth, boxes({car(-9, 7, 50), car(0, 7, 50), car(2, 7, 50)})))
        EXPECT_EQ(one.cause, ErrorCause::too_slow);
}

TEST_F(Causes, theMostFrequentCauseOfAnEntryIsShownAtATypicalFrame) {
    std::vector<BoxRecord> truth{car(0, 1, 50)};
    for (int frame = 20; frame < 25; ++frame) {
        truth.push_back(car(frame, 1, 50));
        if (frame > 20) stored[frame].motion.stationary_corners = {{50, 50}};
    }
    stored[20];
    for (const DiagnosedError& one : diagnose(boxes(truth), boxes({car(0, 7, 50)}))) {
        if (one.error.kind != ResultErrorKind::miss) continue;
        EXPECT_EQ(one.cause, ErrorCause::too_slow);
        EXPECT_EQ(one.frames_of_cause, 4);
        EXPECT_EQ(one.error.places[one.place].frame, 23);
    }
}

TEST_F(Causes, scoringAgainReadsNothingThatIsKnown) {
    for (int frame = 0; frame < 3; ++frame) stored[frame];
    Diagnoser diagnoser(stored.source());
    const auto truth = boxes({car(0, 1, 50), car(1, 1, 50), car(2, 1, 50)});
    diagnoseWith(diagnoser, truth, boxes({car(0, 7, 50)}));
    const int reads = stored.reads;
    EXPECT_EQ(reads, 2);
    diagnoseWith(diagnoser, truth, boxes({car(0, 7, 50)}));
    EXPECT_EQ(stored.reads, reads);
}

TEST_F(Causes, withoutAStoredRunOnlyWhatTheBoxesTell) {
    Diagnoser diagnoser(DiagnosisSource{});
    const auto all = diagnoseWith(diagnoser, boxes({car(0, 1, 50), car(0, 2, 150)}), boxes({car(0, 7, 67)}));
    ASSERT_EQ(all.size(), 3u);
    EXPECT_EQ(all[0].cause, ErrorCause::box_off);
    EXPECT_EQ(all[1].cause, ErrorCause::unknown);
}

TEST_F(Causes, everyCauseHasWordsAndASentence) {
    std::set<std::string> names;
    for (int i = 0; i < kErrorCauses; ++i) {
        const auto cause = static_cast<ErrorCause>(i);
        EXPECT_STRNE(explanationOf(cause), "");
        EXPECT_TRUE(names.insert(nameOf(cause)).second) << nameOf(cause);
    }
}

}  // namespace
}  // namespace eyrie::diagnoser_test

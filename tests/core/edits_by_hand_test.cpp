#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/labels/annotation_edit.h"
#include "core/labels/box_record.h"
#include "core/review/event_kind.h"
#include "core/review/review_edit.h"
#include "core/values/dropped_state.h"
#include "core/values/last_frame.h"
#include "core/values/registration_failure.h"
#include "core/values/track_state.h"

/// What labels and reviews may hold: each limit from both sides.
namespace eyrie::edits_by_hand_test {
namespace {

const double kNone = std::numeric_limits<double>::quiet_NaN();
const OrientedBox kCar{{30, 40}, 20, 10, 0.5};

template <class Value>
using Spoil = std::function<void(Value&)>;

/// Each of these makes a good value one that is refused.
template <class Value>
void expectRefused(const Value& good, void (*check)(const Value&), const std::vector<Spoil<Value>>& spoils) {
    ASSERT_NO_THROW(check(good));
    for (std::size_t i = 0; i < spoils.size(); ++i) {
        Value bad = good;
        spoils[i](bad);
        EXPECT_THROW(check(bad), Error) << i;
    }
}

template <class Value>
void expectTaken(const Value& good, void (*check)(const Value&), const std::vector<Spoil<Value>>& changes) {
    for (std::size_t i = 0; i < changes.size(); ++i) {
        Value other = good;
        changes[i](other);
        EXPECT_NO_THROW(check(other)) << i;
    }
}

LabelledObject car(int id) {
    LabelledObject object;
    object.id = id;
    object.keyframes = {{0, kCar}, {5, kCar}};
    object.last_frame = 8;
    return object;
}

IgnoreRegion region(int id) {
    IgnoreRegion made;
    made.id = id;
    made.polygon = {{0, 0}, {9, 0}, {9, 9}};
    return made;
}

TEST(LabelsByHand, AnObjectIsFiniteAndAscends) {
    using Object = LabelledObject;
    expectTaken<Object>(car(1), checkObject,
                        {[](Object& o) { o.keyframes.pop_back(); }, [](Object& o) { o.last_frame = 0; },
                         [](Object& o) { o.keyframes[1].box.length = o.keyframes[1].box.width = 0; },
                         [](Object& o) { o.keyframes[1].frame = 1; }});
    expectRefused<Object>(
        car(1), checkObject,
        {[](Object& o) { o.id = 0; }, [](Object& o) { o.keyframes.clear(); },
         [](Object& o) { o.keyframes[0].frame = -1; }, [](Object& o) { o.keyframes[1].frame = 0; },
         [](Object& o) { o.keyframes[1].box.centre.x = kNone; }, [](Object& o) { o.keyframes[1].box.centre.y = kNone; },
         [](Object& o) { o.keyframes[1].box.length = kNone; }, [](Object& o) { o.keyframes[1].box.width = kNone; },
         [](Object& o) { o.keyframes[1].box.heading = kNone; }, [](Object& o) { o.keyframes[1].box.length = -1; },
         [](Object& o) { o.keyframes[1].box.width = -1; },
         [](Object& o) { o.keyframes[0].frame = 2, o.last_frame = 1; }});
}

TEST(LabelsByHand, ARegionHasThreeCornersAndARange) {
    using Region = IgnoreRegion;
    expectTaken<Region>(
        region(1), checkRegion,
        {[](Region& r) { r.first_frame = r.last_frame = 7; }, [](Region& r) { r.reference_frame = 7; }});
    expectRefused<Region>(region(1), checkRegion,
                          {[](Region& r) { r.id = 0; }, [](Region& r) { r.polygon.pop_back(); },
                           [](Region& r) { r.polygon[2].x = kNone; }, [](Region& r) { r.polygon[2].y = kNone; },
                           [](Region& r) { r.first_frame = -1; }, [](Region& r) { r.first_frame = 1; },
                           [](Region& r) { r.reference_frame = -1; }});
}

TEST(LabelsByHand, AnEditStartsFromWhatIsThereAndIsTakenBack) {
    AnnotationSet set;
    set.objects[1] = car(1);
    set.reviews.resize(3);
    set.reviews[2].object = 7;
    AnnotationEdit edit;
    edit.objects = {{car(1), {}}, {{}, car(2)}};
    edit.regions = {{{}, region(4)}};
    edit.reviews = TailChange<ReviewMark>{2, {set.reviews[2]}, {}};
    edit.classes = Change<std::vector<ObjectClass>>{{}, std::vector<ObjectClass>{{"tractor", true, 0, 5, 2}}};
    AnnotationSet after = set;
    applyEdit(after, edit);
    EXPECT_EQ(after.objects.size(), 1U);
    EXPECT_TRUE(after.objects.contains(2));
    EXPECT_TRUE(after.regions.contains(4));
    EXPECT_EQ(after.reviews.size(), 2U);
    EXPECT_EQ(after.classes.size(), 1U);
    EXPECT_THROW(applyEdit(after, edit), Error) << "it is made already";
    applyEdit(after, inverseOf(edit));
    EXPECT_TRUE(after.objects.contains(1));
    EXPECT_FALSE(after.objects.contains(2));
    EXPECT_TRUE(after.regions.empty());
    ASSERT_EQ(after.reviews.size(), 3U);
    EXPECT_EQ(after.reviews[2].object, 7);
    EXPECT_TRUE(after.classes.empty());
}

TEST(LabelsByHand, EditsThatCannotBeMadeAreRefused) {
    AnnotationSet set;
    set.objects[1] = car(1);
    set.reviews.resize(3);
    const auto refused = [&](const AnnotationEdit& edit) {
        AnnotationSet copy = set;
        EXPECT_THROW(applyEdit(copy, edit), Error);
        EXPECT_EQ(copy.objects.size(), 1U) << "nothing is changed";
    };
    const auto ofObjects = [](std::vector<Change<LabelledObject>> changes) {
        AnnotationEdit edit;
        edit.objects = std::move(changes);
        return edit;
    };
    refused(ofObjects({{{}, {}}}));
    refused(ofObjects({{car(1), car(2)}}));
    refused(ofObjects({{{}, car(1)}}));
    refused(ofObjects({{car(2), {}}}));
    refused(ofObjects({{car(1), car(1)}, {car(1), {}}}));
    refused(ofObjects({{{}, car(2)}, {{}, car(2)}}));
    AnnotationEdit marks;
    marks.reviews = TailChange<ReviewMark>{1, {ReviewMark{}}, {}};
    refused(marks);
    for (const ObjectClass& bad : {ObjectClass{"a", true, 0, kNone, 2}, ObjectClass{"a", true, 0, 5, kNone}}) {
        AnnotationEdit classes;
        classes.classes = Change<std::vector<ObjectClass>>{{}, std::vector<ObjectClass>{bad}};
        refused(classes);
    }
}

TEST(LabelsByHand, UprightIsAlongEitherAxis) {
    const auto upright = [](double heading) {
        BoxesByFrame boxes;
        boxes[0].resize(1);
        boxes[3].resize(1);
        boxes[0][0].box = {{5, 5}, 4, 2, 0};
        boxes[3][0].box = {{5, 5}, 4, 2, heading};
        return allUpright(boxes);
    };
    for (const double heading : {0.0, kPi / 2, kPi, -kPi / 2, 1e-7}) EXPECT_TRUE(upright(heading)) << heading;
    for (const double heading : {kPi / 4, kPi / 3, -0.1, 1e-5}) EXPECT_FALSE(upright(heading)) << heading;
    EXPECT_TRUE(allUpright({}));
}

Verdict verdict(int id) {
    Verdict made;
    made.id = id;
    made.subject.first_frame = 10;
    made.subject.frame = 12;
    made.subject.last_frame = 20;
    made.tags = {"gate 3", "lorry"};
    return made;
}

std::string textOf(std::size_t characters) {
    return std::string(characters, 'a');
}

TEST(ReviewByHand, AVerdictIsAboutFramesThatAreInOrder) {
    expectTaken<Verdict>(verdict(1), checkVerdict,
                         {[](Verdict& v) { v.subject.frame = 10; }, [](Verdict& v) { v.subject.frame = 20; },
                          [](Verdict& v) { v.subject.first_frame = v.subject.frame = v.subject.last_frame = 0; },
                          [](Verdict& v) { v.note = textOf(kLongestReviewText); }});
    expectRefused<Verdict>(
        verdict(1), checkVerdict,
        {[](Verdict& v) { v.id = 0; }, [](Verdict& v) { v.subject.frame = 9; },
         [](Verdict& v) { v.subject.frame = 21; }, [](Verdict& v) { v.subject.first_frame = -1; },
         [](Verdict& v) { v.subject.last_frame = 9; }, [](Verdict& v) { v.subject.ground_frame = -1; },
         [](Verdict& v) { v.subject.first_s = kNone; }, [](Verdict& v) { v.subject.last_s = kNone; },
         [](Verdict& v) { v.subject.place.x = kNone; }, [](Verdict& v) { v.subject.place.y = kNone; },
         [](Verdict& v) { v.subject.ground.x = kNone; }, [](Verdict& v) { v.subject.ground.y = kNone; },
         [](Verdict& v) { v.note = textOf(kLongestReviewText + 1); },
         [](Verdict& v) { v.person = textOf(kLongestReviewText + 1); }, [](Verdict& v) { v.tags = {"a,b"}; },
         [](Verdict& v) {
             v.tags = {"a", "a"};
         },
         [](Verdict& v) { v.tags = {" a"}; }});
}

StoredZone zone(int id, const std::string& name) {
    StoredZone made;
    made.id = id;
    made.zone.name = name;
    made.zone.points = {{0, 0}, {30, 0}, {30, 20}};
    return made;
}

TEST(ReviewByHand, AZoneHasANameAColourAndAFrame) {
    using Stored = StoredZone;
    const auto circle = [](std::size_t corners) {
        std::vector<cv::Point2d> points;
        for (std::size_t i = 0; i < corners; ++i) {
            const double at = 2 * kPi * static_cast<double>(i) / static_cast<double>(corners);
            points.emplace_back(500 * std::cos(at), 500 * std::sin(at));
        }
        return points;
    };
    expectTaken<Stored>(zone(1, "gate"), checkZone,
                        {[](Stored& z) { z.zone.frame = kLastFrame; }, [](Stored& z) { z.colour = 0xffffff; },
                         [](Stored& z) { z.colour = 0; }, [&](Stored& z) { z.zone.points = circle(kMostZonePoints); }});
    expectRefused<Stored>(
        zone(1, "gate"), checkZone,
        {[](Stored& z) { z.id = 0; }, [](Stored& z) { z.zone.frame = -1; },
         [](Stored& z) { z.zone.frame = kLastFrame + 1; }, [](Stored& z) { z.colour = 0x1000000; },
         [](Stored& z) { z.colour = -2; }, [](Stored& z) { z.zone.name = ""; },
         [](Stored& z) { z.zone.points.pop_back(); }, [&](Stored& z) { z.zone.points = circle(kMostZonePoints + 1); }});
}

TEST(ReviewByHand, ABookmarkIsAtATimeAndMayBeAtAPlace) {
    Bookmark good;
    good.id = 1;
    expectTaken<Bookmark>(good, checkBookmark,
                          {[](Bookmark& b) { b.frame = kLastFrame; },
                           [](Bookmark& b) {
                               b.place = {3, 4};
                           }});
    expectRefused<Bookmark>(good, checkBookmark,
                            {[](Bookmark& b) { b.id = 0; }, [](Bookmark& b) { b.frame = -1; },
                             [](Bookmark& b) { b.frame = kLastFrame + 1; }, [](Bookmark& b) { b.seconds = kNone; },
                             [](Bookmark& b) {
                                 b.place = {kNone, 4};
                             },
                             [](Bookmark& b) {
                                 b.place = {3, kNone};
                             }});
}

TrackCorrection correction(CorrectionKind kind) {
    TrackCorrection made;
    made.id = 1;
    made.kind = kind;
    made.frame = 10;
    made.track = {{8, kCar}, {12, kCar}};
    if (kind == CorrectionKind::join) made.other = {{14, kCar}};
    return made;
}

TEST(ReviewByHand, SightingsAreBoxesInAscendingFrames) {
    const auto boxed = [](double x, double y, double length, double width, double heading = 0) {
        return areSightings({{5, {{x, y}, length, width, heading}}});
    };
    EXPECT_TRUE(boxed(1e6, -1e6, 1e6, 0.1));
    for (const bool bad : {boxed(1.1e6, 0, 4, 2), boxed(0, -1.1e6, 4, 2), boxed(0, 0, 0, 2), boxed(0, 0, 4, 0),
                           boxed(0, 0, 1.1e6, 2), boxed(0, 0, 4, 1.1e6), boxed(kNone, 0, 4, 2), boxed(0, kNone, 4, 2),
                           boxed(0, 0, kNone, 2), boxed(0, 0, 4, kNone), boxed(0, 0, 4, 2, kNone)})
        EXPECT_FALSE(bad);
    EXPECT_TRUE(areSightings({}));
    EXPECT_TRUE(areSightings({{0, kCar}, {1, kCar}, {kLastFrame, kCar}}));
    EXPECT_FALSE(areSightings({{-1, kCar}}));
    EXPECT_FALSE(areSightings({{3, kCar}, {3, kCar}}));
    EXPECT_FALSE(areSightings({{kLastFrame + 1, kCar}}));
    EXPECT_TRUE((Sighting{3, kCar} == Sighting{3, kCar}));
    for (const Sighting& other : {Sighting{4, kCar},
                                  {3, {{31, 40}, 20, 10, 0.5}},
                                  {3, {{30, 40}, 21, 10, 0.5}},
                                  {3, {{30, 40}, 20, 11, 0.5}},
                                  {3, {{30, 40}, 20, 10, 0.6}}})
        EXPECT_FALSE((Sighting{3, kCar} == other));
}

TEST(ReviewByHand, ACorrectionNamesTheTracksThatItsKindNeeds) {
    using Correction = TrackCorrection;
    for (const CorrectionKind kind :
         {CorrectionKind::add, CorrectionKind::join, CorrectionKind::split, CorrectionKind::reject}) {
        expectRefused<Correction>(correction(kind), checkCorrection,
                                  {[](Correction& c) { c.id = 0; }, [](Correction& c) { c.frame = -1; },
                                   [](Correction& c) { c.frame = kLastFrame + 1; },
                                   [](Correction& c) { c.track.clear(); }, [](Correction& c) { c.track[1].frame = 8; },
                                   [](Correction& c) {
                                       c.other = {{9, kCar}, {9, kCar}};
                                   },
                                   [](Correction& c) { c.person = textOf(kLongestReviewText + 1); },
                                   [](Correction& c) { c.when_utc = textOf(kLongestReviewText + 1); }});
    }
    const auto withOther = [](Correction& c) { c.other = {{9, kCar}}; };
    const auto withoutOther = [](Correction& c) { c.other.clear(); };
    const auto longPerson = [](Correction& c) { c.person = textOf(kLongestReviewText); };
    expectRefused<Correction>(correction(CorrectionKind::add), checkCorrection, {withOther});
    expectTaken<Correction>(correction(CorrectionKind::add), checkCorrection,
                            {longPerson, [](Correction& c) { c.frame = kLastFrame; }});
    expectRefused<Correction>(correction(CorrectionKind::join), checkCorrection, {withoutOther});
    expectTaken<Correction>(correction(CorrectionKind::reject), checkCorrection, {withOther, withoutOther});
    const auto cutAt = [](FrameIndex frame) { return [=](Correction& c) { c.frame = frame; }; };
    expectTaken<Correction>(correction(CorrectionKind::split), checkCorrection, {cutAt(9), cutAt(12)});
    expectRefused<Correction>(correction(CorrectionKind::split), checkCorrection, {cutAt(8), cutAt(13), withOther});
}

TEST(ReviewByHand, AStepStartsFromWhatIsThereAndIsTakenBack) {
    ReviewSet set;
    set.verdicts[1] = verdict(1);
    set.zones[1] = zone(1, "gate");
    ReviewEdit edit;
    edit.verdicts = {{verdict(1), {}}, {{}, verdict(2)}};
    edit.zones = {{zone(1, "gate"), zone(1, "yard")}, {{}, zone(2, "gate")}};
    edit.corrections = {{{}, correction(CorrectionKind::add)}};
    Bookmark mark;
    mark.id = 3;
    edit.bookmarks = {{{}, mark}};
    ReviewSet after = set;
    applyEdit(after, edit);
    EXPECT_FALSE(after.verdicts.contains(1));
    EXPECT_TRUE(after.verdicts.contains(2));
    EXPECT_EQ(after.zones.at(1).zone.name, "yard");
    EXPECT_EQ(after.zones.at(2).zone.name, "gate") << "a name that became free in the same step";
    EXPECT_EQ(after.bookmarks.size(), 1U);
    EXPECT_EQ(after.corrections.size(), 1U);
    applyEdit(after, inverseOf(edit));
    EXPECT_EQ(after.verdicts, set.verdicts);
    EXPECT_EQ(after.zones, set.zones);
    EXPECT_TRUE(after.bookmarks.empty());
    EXPECT_TRUE(after.corrections.empty());
}

TEST(ReviewByHand, StepsThatCannotBeMadeAreRefused) {
    ReviewSet set;
    set.verdicts[1] = verdict(1);
    set.zones[1] = zone(1, "gate");
    const auto refusedVerdicts = [&](std::vector<Change<Verdict>> changes) {
        ReviewEdit edit;
        edit.verdicts = std::move(changes);
        EXPECT_THROW(checkEdit(set, edit), Error);
    };
    Verdict starred = verdict(1);
    starred.starred = true;
    refusedVerdicts({{{}, {}}});
    refusedVerdicts({{verdict(1), verdict(2)}});
    refusedVerdicts({{{}, verdict(1)}});
    refusedVerdicts({{verdict(2), {}}});
    refusedVerdicts({{starred, {}}});
    refusedVerdicts({{verdict(1), starred}, {verdict(1), {}}});
    const auto zonesAreTaken = [&](std::vector<Change<StoredZone>> changes) {
        ReviewEdit edit;
        edit.zones = std::move(changes);
        try {
            checkEdit(set, edit);
            return true;
        } catch (const Error&) {
            return false;
        }
    };
    EXPECT_TRUE(zonesAreTaken({{{}, zone(2, "yard")}}));
    EXPECT_FALSE(zonesAreTaken({{{}, zone(2, "gate")}})) << "the name of another";
    EXPECT_FALSE(zonesAreTaken({{{}, zone(2, "yard")}, {{}, zone(3, "yard")}}));
    EXPECT_TRUE(zonesAreTaken({{zone(1, "gate"), {}}, {{}, zone(2, "gate")}}));
}

TEST(WordsByHand, AreReadBack) {
    for (const EventKind kind : allEventKinds()) EXPECT_EQ(eventKindOf(nameOf(kind)), kind);
    EXPECT_EQ(allEventKinds().size(), 17U);
    EXPECT_EQ(eventKindOf("turns-back"), EventKind::turns_back);
    EXPECT_EQ(eventKindOf("against_the_flow"), EventKind::against_flow);
    EXPECT_THROW(eventKindOf("explodes"), Error);
    for (const StateOrigin origin : {StateOrigin::detected, StateOrigin::reconstructed, StateOrigin::predicted,
                                     StateOrigin::standing, StateOrigin::by_hand})
        EXPECT_EQ(stateOriginOf(nameOf(origin)), origin);
    EXPECT_FALSE(stateOriginOf("guessed"));
}

TEST(WordsByHand, AFailureIsToldWithItsFiguresWhereItHasAny) {
    EXPECT_EQ(describe(RegistrationFailure{RegistrationFault::too_few_agree, PictureQuality::blurred, 12, 40}),
              "blurred picture: too few corners agree (12 of 40)");
    EXPECT_EQ(describe(RegistrationFailure{RegistrationFault::too_few_corners, PictureQuality::clear, 0, 1}),
              "too few corners (0 of 1)");
    EXPECT_EQ(describe(RegistrationFailure{RegistrationFault::impossible_motion}),
              "the motion found is impossible for a camera");
    EXPECT_EQ(describe(RegistrationFailure{}), "");
    EXPECT_EQ(nameOf(RegistrationFault::none, PictureQuality::blank), "");
    EXPECT_EQ(textOf(DroppedState{12, {}, TrackDrop::shares_place, 7}),
              "track 12 lies on track 7, which was detected more often");
}

}  // namespace
}  // namespace eyrie::edits_by_hand_test

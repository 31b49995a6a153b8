#pragma once

#include "core/review/review_edit.h"

/// Made-up verdicts for the tests of the store.
namespace eyrie::test {

/// A verdict in which every field differs from its default.
inline Verdict sampleVerdict(int id) {
    Verdict verdict;
    verdict.id = id;
    verdict.subject.kind = static_cast<EventKind>(id % kEventKinds);
    if (id % 10 == 9) verdict.subject.kind.reset();
    verdict.subject.first_frame = 100 + id;
    verdict.subject.last_frame = 150 + id;
    verdict.subject.first_s = 4 + id * 0.04;
    verdict.subject.last_s = 6 + id * 0.04;
    verdict.subject.frame = 120 + id;
    verdict.subject.place = {320.25 + id, 110.5};
    verdict.subject.ground_frame = 7;
    verdict.subject.ground = {-40.125, 600.75 + id};
    verdict.subject.zone = "yard \"ost\"";
    verdict.subject.sense = CrossingSense::to_left;
    verdict.judgement = static_cast<Judgement>(1 + id % 3);
    verdict.note = "wendet, fährt zurück";
    verdict.tags = {"lorry", "gate 3"};
    verdict.starred = true;
    verdict.person = "Ada";
    verdict.when_utc = "2026-11-21T08:00:00Z";
    return verdict;
}

inline Bookmark sampleBookmark(int id) {
    return {id, 50 + id, 2 + id * 0.04, cv::Point2d(20.5, 30.25 + id), "look here", "Bo", "2026-11-21T09:00:00Z"};
}

/// Every third one is a line, every fourth an arrow.
inline StoredZone sampleZone(int id) {
    StoredZone zone;
    zone.id = id;
    zone.zone.name = "yard " + std::to_string(id);
    zone.zone.shape = id % 3 == 0 ? ZoneShape::line : id % 4 == 0 ? ZoneShape::arrow : ZoneShape::area;
    zone.zone.anchor = id % 2 == 0 ? ZoneAnchor::image : ZoneAnchor::ground;
    zone.zone.frame = 3 + id;
    zone.zone.points = {{10.25, 20}, {80, 20.5}, {80.125, 60. + id}};
    zone.colour = 0x2090f0;
    zone.shown = false;
    zone.person = "Ada";
    zone.when_utc = "2026-11-21T10:00:00Z";
    return zone;
}

inline ReviewEdit sampleZoning(int id) {
    ReviewEdit edit;
    edit.name = "Add zone " + std::to_string(id);
    edit.zones.push_back({std::nullopt, sampleZone(id)});
    return edit;
}

/// They join, split, reject and add in turn.
inline TrackCorrection sampleCorrection(int id) {
    TrackCorrection correction;
    correction.id = id;
    correction.kind = static_cast<CorrectionKind>(id % 4);
    correction.frame = 12 + id;
    for (int i = 0; i < 5; ++i) correction.track.push_back({10 + id + i, {{20.125 + i, 30.5}, 12.25, 6.5, 0.1 * i}});
    if (correction.kind == CorrectionKind::join) correction.other = {{40 + id, {{90.125, 31.5}, 12, 6, -0.25}}};
    correction.person = "Bo";
    correction.when_utc = "2026-11-21T11:00:00Z";
    return correction;
}

inline ReviewEdit sampleCorrecting(int id) {
    ReviewEdit edit;
    edit.name = "Correct tracks " + std::to_string(id);
    edit.corrections.push_back({std::nullopt, sampleCorrection(id)});
    return edit;
}

inline ReviewEdit sampleJudging(int id) {
    ReviewEdit edit;
    edit.name = "Judge event " + std::to_string(id);
    edit.verdicts.push_back({std::nullopt, sampleVerdict(id)});
    return edit;
}

inline ReviewEdit sampleBookmarking(int id) {
    ReviewEdit edit;
    edit.name = "Add bookmark " + std::to_string(id);
    edit.bookmarks.push_back({std::nullopt, sampleBookmark(id)});
    return edit;
}

}  // namespace eyrie::test

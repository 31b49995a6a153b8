#include "store/review/packed_review.h"

#include "core/error.h"
#include "store/labels/label_bytes.h"
#include "store/review/review_words.h"

namespace eyrie {
namespace {

constexpr std::uint8_t kReviewFormat = 1;
constexpr std::uint8_t kReviewFormatWithZones = 2;
constexpr std::uint8_t kReviewFormatWithCorrections = 3;
constexpr std::uint8_t kSightingsFormat = 1;
// Bytes that the smallest verdict, bookmark, zone and correction take.
constexpr std::size_t kLeastVerdict = 97;
constexpr std::size_t kLeastBookmark = 29;
constexpr std::size_t kLeastZone = 41;
constexpr std::size_t kLeastCorrection = 75;
constexpr std::size_t kSightingBytes = 44;
constexpr std::size_t kPointBytes = 2 * sizeof(double);

template <class Value, std::size_t count>
void putWord(LabelBytesOut& out, const std::array<stored::Word<Value>, count>& words, const Value& value) {
    for (const auto& entry : words) {
        if (entry.value == value) return out.text(std::string(entry.word));
    }
    throw Error(ErrorKind::internal, "an enumerator has no word in the project file");
}

template <class Value, std::size_t count>
Value takeWord(LabelBytesIn& in, const std::array<stored::Word<Value>, count>& words) {
    const std::string found = in.text();
    for (const auto& entry : words) {
        if (entry.word == found) return entry.value;
    }
    in.refuse();
    return {};
}

void putPoint(LabelBytesOut& out, cv::Point2d point) {
    out.number(point.x);
    out.number(point.y);
}

cv::Point2d takePoint(LabelBytesIn& in) {
    const auto x = in.number<double>();
    return {x, in.number<double>()};
}

void put(LabelBytesOut& out, const Verdict& verdict) {
    const ReviewSubject& subject = verdict.subject;
    out.number<std::int32_t>(verdict.id);
    putWord(out, stored::kSubjectKinds, subject.kind);
    out.number<std::int32_t>(subject.first_frame);
    out.number<std::int32_t>(subject.last_frame);
    out.number(subject.first_s);
    out.number(subject.last_s);
    out.number<std::int32_t>(subject.frame);
    putPoint(out, subject.place);
    out.number<std::int32_t>(subject.ground_frame);
    putPoint(out, subject.ground);
    out.text(subject.zone);
    putWord(out, stored::kCrossingSenses, subject.sense);
    putWord(out, stored::kJudgements, verdict.judgement);
    out.text(verdict.note);
    out.text(tagText(verdict.tags));
    out.number(static_cast<std::uint8_t>(verdict.starred));
    out.text(verdict.person);
    out.text(verdict.when_utc);
}

void take(LabelBytesIn& in, Verdict& verdict) {
    ReviewSubject& subject = verdict.subject;
    verdict.id = in.number<std::int32_t>();
    subject.kind = takeWord(in, stored::kSubjectKinds);
    subject.first_frame = in.number<std::int32_t>();
    subject.last_frame = in.number<std::int32_t>();
    subject.first_s = in.number<double>();
    subject.last_s = in.number<double>();
    subject.frame = in.number<std::int32_t>();
    subject.place = takePoint(in);
    subject.ground_frame = in.number<std::int32_t>();
    subject.ground = takePoint(in);
    subject.zone = in.text();
    subject.sense = takeWord(in, stored::kCrossingSenses);
    verdict.judgement = takeWord(in, stored::kJudgements);
    verdict.note = in.text();
    verdict.tags = tagsOf(in.text());
    verdict.starred = in.number<std::uint8_t>() != 0;
    verdict.person = in.text();
    verdict.when_utc = in.text();
    if (!in.broken()) checkVerdict(verdict);
}

void put(LabelBytesOut& out, const Bookmark& bookmark) {
    out.number<std::int32_t>(bookmark.id);
    out.number<std::int32_t>(bookmark.frame);
    out.number(bookmark.seconds);
    out.number(static_cast<std::uint8_t>(bookmark.place.has_value()));
    if (bookmark.place) putPoint(out, *bookmark.place);
    out.text(bookmark.note);
    out.text(bookmark.person);
    out.text(bookmark.when_utc);
}

void take(LabelBytesIn& in, Bookmark& bookmark) {
    bookmark.id = in.number<std::int32_t>();
    bookmark.frame = in.number<std::int32_t>();
    bookmark.seconds = in.number<double>();
    if (in.number<std::uint8_t>() != 0) bookmark.place = takePoint(in);
    bookmark.note = in.text();
    bookmark.person = in.text();
    bookmark.when_utc = in.text();
    if (!in.broken()) checkBookmark(bookmark);
}

void put(LabelBytesOut& out, const StoredZone& zone) {
    out.number<std::int32_t>(zone.id);
    out.text(zone.zone.name);
    putWord(out, stored::kZoneShapes, zone.zone.shape);
    putWord(out, stored::kZoneAnchors, zone.zone.anchor);
    out.number<std::int32_t>(zone.zone.frame);
    out.count(zone.zone.points.size());
    for (const cv::Point2d& point : zone.zone.points) putPoint(out, point);
    out.number<std::int32_t>(zone.colour);
    out.number(static_cast<std::uint8_t>(zone.shown));
    out.text(zone.person);
    out.text(zone.when_utc);
}

void take(LabelBytesIn& in, StoredZone& zone) {
    zone.id = in.number<std::int32_t>();
    zone.zone.name = in.text();
    zone.zone.shape = takeWord(in, stored::kZoneShapes);
    zone.zone.anchor = takeWord(in, stored::kZoneAnchors);
    zone.zone.frame = in.number<std::int32_t>();
    for (std::size_t left = in.count(kPointBytes); left > 0 && !in.broken(); --left)
        zone.zone.points.push_back(takePoint(in));
    zone.colour = in.number<std::int32_t>();
    zone.shown = in.number<std::uint8_t>() != 0;
    zone.person = in.text();
    zone.when_utc = in.text();
    if (!in.broken()) checkZone(zone);
}

void put(LabelBytesOut& out, const Sighting& sighting) {
    out.number<std::int32_t>(sighting.frame);
    putPoint(out, sighting.box.centre);
    out.number(sighting.box.length);
    out.number(sighting.box.width);
    out.number(sighting.box.heading);
}

Sighting takeSighting(LabelBytesIn& in) {
    Sighting sighting;
    sighting.frame = in.number<std::int32_t>();
    sighting.box.centre = takePoint(in);
    sighting.box.length = in.number<double>();
    sighting.box.width = in.number<double>();
    sighting.box.heading = in.number<double>();
    return sighting;
}

void put(LabelBytesOut& out, const std::vector<Sighting>& sightings) {
    out.count(sightings.size());
    for (const Sighting& sighting : sightings) put(out, sighting);
}

void take(LabelBytesIn& in, std::vector<Sighting>& sightings) {
    for (std::size_t left = in.count(kSightingBytes); left > 0 && !in.broken(); --left)
        sightings.push_back(takeSighting(in));
}

void put(LabelBytesOut& out, const TrackCorrection& correction) {
    out.number<std::int32_t>(correction.id);
    putWord(out, stored::kCorrectionKinds, correction.kind);
    out.number<std::int32_t>(correction.frame);
    put(out, correction.track);
    put(out, correction.other);
    out.text(correction.person);
    out.text(correction.when_utc);
}

void take(LabelBytesIn& in, TrackCorrection& correction) {
    correction.id = in.number<std::int32_t>();
    correction.kind = takeWord(in, stored::kCorrectionKinds);
    correction.frame = in.number<std::int32_t>();
    take(in, correction.track);
    take(in, correction.other);
    correction.person = in.text();
    correction.when_utc = in.text();
    if (!in.broken()) checkCorrection(correction);
}

/// One byte tells which of the two sides follow: 1 before, 2 after.
template <class Value>
void putChanges(LabelBytesOut& out, const std::vector<Change<Value>>& changes) {
    out.count(changes.size());
    for (const auto& change : changes) {
        out.number(static_cast<std::uint8_t>((change.before ? 1 : 0) + (change.after ? 2 : 0)));
        if (change.before) put(out, *change.before);
        if (change.after) put(out, *change.after);
    }
}

template <class Value>
std::vector<Change<Value>> takeChanges(LabelBytesIn& in, std::size_t least) {
    std::vector<Change<Value>> changes;
    for (std::size_t left = in.count(least); left > 0 && !in.broken(); --left) {
        const auto sides = in.number<std::uint8_t>();
        if (sides < 1 || sides > 3) in.refuse();
        Change<Value> change;
        if ((sides & 1) != 0) take(in, change.before.emplace());
        if ((sides & 2) != 0) take(in, change.after.emplace());
        if (sides == 3 && change.before->id != change.after->id) in.refuse();
        changes.push_back(std::move(change));
    }
    return changes;
}

}  // namespace

Bytes packReview(const ReviewEdit& edit) {
    LabelBytesOut out;
    const std::uint8_t format = !edit.corrections.empty() ? kReviewFormatWithCorrections
                                : !edit.zones.empty()     ? kReviewFormatWithZones
                                                          : kReviewFormat;
    out.number(format);
    putChanges(out, edit.verdicts);
    putChanges(out, edit.bookmarks);
    if (format >= kReviewFormatWithZones) putChanges(out, edit.zones);
    if (format >= kReviewFormatWithCorrections) putChanges(out, edit.corrections);
    return out.take();
}

std::optional<ReviewEdit> unpackReview(ByteView bytes) {
    LabelBytesIn in(bytes);
    const auto format = in.number<std::uint8_t>();
    if (format < kReviewFormat || format > kReviewFormatWithCorrections) return std::nullopt;
    ReviewEdit edit;
    try {
        edit.verdicts = takeChanges<Verdict>(in, kLeastVerdict);
        edit.bookmarks = takeChanges<Bookmark>(in, kLeastBookmark);
        if (format >= kReviewFormatWithZones) edit.zones = takeChanges<StoredZone>(in, kLeastZone);
        if (format >= kReviewFormatWithCorrections)
            edit.corrections = takeChanges<TrackCorrection>(in, kLeastCorrection);
    } catch (const Error&) {
        return std::nullopt;
    }
    if (!in.complete()) return std::nullopt;
    return edit;
}

Bytes packSightings(const std::vector<Sighting>& sightings) {
    LabelBytesOut out;
    out.number(kSightingsFormat);
    for (const Sighting& sighting : sightings) put(out, sighting);
    return out.take();
}

std::optional<std::vector<Sighting>> unpackSightings(ByteView bytes) {
    LabelBytesIn in(bytes);
    if (in.number<std::uint8_t>() != kSightingsFormat || in.left() % kSightingBytes != 0) return std::nullopt;
    std::vector<Sighting> sightings;
    sightings.reserve(in.left() / kSightingBytes);
    while (in.left() > 0 && !in.broken()) sightings.push_back(takeSighting(in));
    if (!in.complete() || !areSightings(sightings)) return std::nullopt;
    return sightings;
}

}  // namespace eyrie

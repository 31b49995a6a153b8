#include "core/review/review_edit.h"

#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/values/last_frame.h"

namespace eyrie {
namespace {

[[noreturn]] void refuseStep(const std::string& what) {
    throw Error(ErrorKind::internal, "this step of the review cannot be made: " + what);
}

void checkText(const std::string& text, const char* what) {
    if (text.size() <= kLongestReviewText) return;
    throw Error(ErrorKind::parameter, std::string(what) + " of " + std::to_string(text.size()) +
                                          " characters is too long; up to " + std::to_string(kLongestReviewText) +
                                          " are kept");
}

void checkTime(double seconds, const std::string& who) {
    if (!std::isfinite(seconds)) refuseStep(who + " has an invalid time");
}

void checkPoint(cv::Point2d point, const std::string& who) {
    if (!std::isfinite(point.x) || !std::isfinite(point.y)) refuseStep(who + " has an invalid place");
}

template <class Value, class Check>
void checkSteps(const std::map<int, Value>& present, const std::vector<Change<Value>>& changes, const char* noun,
                const Check& check) {
    std::set<int> seen;
    for (const auto& change : changes) {
        if (!change.before && !change.after) refuseStep(std::string("a change of no ") + noun);
        if (change.before && change.after && change.before->id != change.after->id) {
            refuseStep(std::string(noun) + " " + std::to_string(change.before->id) + " would change its number");
        }
        const int id = change.before ? change.before->id : change.after->id;
        const std::string who = std::string(noun) + " " + std::to_string(id);
        const auto there = present.find(id);
        if (change.before && there == present.end()) refuseStep(who + " is not there");
        if (!change.before && there != present.end()) refuseStep(who + " is there already");
        if (change.before && !(there->second == *change.before)) refuseStep(who + " was changed in the meantime");
        if (!seen.insert(id).second) refuseStep(who + " would be changed twice");
        if (change.after) check(*change.after);
    }
}

template <class Value>
void carryOut(std::map<int, Value>& present, const std::vector<Change<Value>>& changes) {
    for (const auto& change : changes) {
        if (change.after) {
            present[change.after->id] = *change.after;
        } else {
            present.erase(change.before->id);
        }
    }
}

/// Events name their zone, so no two may have one name.
void checkZoneNames(const std::map<int, StoredZone>& present, const std::vector<Change<StoredZone>>& changes) {
    std::set<int> changed;
    for (const auto& change : changes) changed.insert(change.before ? change.before->id : change.after->id);
    std::set<std::string> names;
    for (const auto& [id, zone] : present) {
        if (!changed.contains(id)) names.insert(zone.zone.name);
    }
    for (const auto& change : changes) {
        if (!change.after || names.insert(change.after->zone.name).second) continue;
        throw Error(ErrorKind::parameter,
                    "there is a zone \"" + change.after->zone.name + "\" already; give this one another name");
    }
}

}  // namespace

ReviewEdit inverseOf(ReviewEdit edit) {
    for (auto& change : edit.verdicts) std::swap(change.before, change.after);
    for (auto& change : edit.bookmarks) std::swap(change.before, change.after);
    for (auto& change : edit.zones) std::swap(change.before, change.after);
    for (auto& change : edit.corrections) std::swap(change.before, change.after);
    return edit;
}

void checkEdit(const ReviewSet& set, const ReviewEdit& edit) {
    checkSteps(set.verdicts, edit.verdicts, "verdict", checkVerdict);
    checkSteps(set.bookmarks, edit.bookmarks, "bookmark", checkBookmark);
    checkSteps(set.zones, edit.zones, "zone", checkZone);
    checkSteps(set.corrections, edit.corrections, "correction", checkCorrection);
    if (!edit.zones.empty()) checkZoneNames(set.zones, edit.zones);
}

void applyEdit(ReviewSet& set, const ReviewEdit& edit) {
    checkEdit(set, edit);
    carryOut(set.verdicts, edit.verdicts);
    carryOut(set.bookmarks, edit.bookmarks);
    carryOut(set.zones, edit.zones);
    carryOut(set.corrections, edit.corrections);
}

void checkVerdict(const Verdict& verdict) {
    const std::string who = "verdict " + std::to_string(verdict.id);
    const ReviewSubject& subject = verdict.subject;
    if (verdict.id < 1) refuseStep(who + " has no number above 0");
    if (subject.first_frame < 0 || subject.last_frame < subject.first_frame || subject.frame < subject.first_frame ||
        subject.frame > subject.last_frame || subject.ground_frame < 0) {
        refuseStep(who + " has an invalid range of frames");
    }
    checkTime(subject.first_s, who);
    checkTime(subject.last_s, who);
    checkPoint(subject.place, who);
    checkPoint(subject.ground, who);
    checkText(subject.zone, "a name of a zone");
    checkText(verdict.note, "a note");
    checkText(verdict.person, "a name");
    checkText(verdict.when_utc, "a date");
    const std::string tags = tagText(verdict.tags);
    checkText(tags, "a list of tags");
    if (tagsOf(tags) != verdict.tags) {
        throw Error(ErrorKind::parameter, "each tag is given once, without commas and without blanks at its ends");
    }
}

void checkZone(const StoredZone& zone) {
    const std::string who = "zone " + std::to_string(zone.id);
    if (zone.id < 1) refuseStep(who + " has no number above 0");
    if (zone.zone.frame < 0 || zone.zone.frame > kLastFrame) {
        throw Error(ErrorKind::parameter, "zone \"" + zone.zone.name + "\" belongs to frame " +
                                              std::to_string(zone.zone.frame) + ", which no video has");
    }
    if (zone.colour < StoredZone::kColourByNumber || zone.colour > 0xffffff) refuseStep(who + " has an invalid colour");
    if (zone.zone.name.empty()) throw Error(ErrorKind::parameter, "a zone needs a name");
    checkText(zone.zone.name, "a name of a zone");
    checkText(zone.person, "a name");
    checkText(zone.when_utc, "a date");
    if (zone.zone.points.size() > kMostZonePoints) {
        throw Error(ErrorKind::parameter, "zone \"" + zone.zone.name + "\" has " +
                                              std::to_string(zone.zone.points.size()) + " points; up to " +
                                              std::to_string(kMostZonePoints) + " are kept");
    }
    const std::string fault = faultOf(zone.zone);
    if (!fault.empty()) throw Error(ErrorKind::parameter, "zone \"" + zone.zone.name + "\": " + fault);
}

void checkBookmark(const Bookmark& bookmark) {
    const std::string who = "bookmark " + std::to_string(bookmark.id);
    if (bookmark.id < 1) refuseStep(who + " has no number above 0");
    if (bookmark.frame < 0 || bookmark.frame > kLastFrame) refuseStep(who + " has an invalid frame");
    checkTime(bookmark.seconds, who);
    if (bookmark.place) checkPoint(*bookmark.place, who);
    checkText(bookmark.note, "a note");
    checkText(bookmark.person, "a name");
    checkText(bookmark.when_utc, "a date");
}

}  // namespace eyrie

#include "events/zones/zone_edits.h"

#include <algorithm>

namespace eyrie {
namespace {

bool isThere(const ReviewSet& set, const Zone& zone) {
    return std::any_of(set.zones.begin(), set.zones.end(),
                       [&](const auto& stored) { return stored.second.zone == zone; });
}

}  // namespace

ReviewEdit addZones(const ReviewSet& set, const std::vector<Zone>& zones, const Judge& judge, const NewId& new_id) {
    ReviewEdit edit;
    for (const Zone& zone : zones) {
        if (isThere(set, zone)) continue;
        StoredZone stored;
        stored.id = new_id();
        stored.zone = zone;
        stored.person = judge.person;
        stored.when_utc = judge.when_utc;
        edit.zones.push_back({std::nullopt, std::move(stored)});
    }
    if (edit.zones.size() == 1) {
        const Zone& only = edit.zones.front().after->zone;
        edit.name = std::string("Add ") + nameOf(only.shape) + " \"" + only.name + "\"";
    } else {
        edit.name = "Add " + std::to_string(edit.zones.size()) + " zones";
    }
    return edit;
}

ReviewEdit changeZone(const ReviewSet& set, int id, const std::function<void(StoredZone&)>& change,
                      const Judge& judge) {
    ReviewEdit edit;
    const auto found = set.zones.find(id);
    if (found == set.zones.end()) return edit;
    const StoredZone& before = found->second;
    StoredZone after = before;
    change(after);
    if (after == before) return edit;
    after.person = judge.person;
    after.when_utc = judge.when_utc;
    const bool renamed = after.zone.name != before.zone.name;
    edit.name =
        std::string(renamed ? "Rename " : "Change ") + nameOf(before.zone.shape) + " \"" + before.zone.name + "\"";
    // Verdicts know their zone by its name.
    for (const auto& [verdict_id, verdict] : set.verdicts) {
        if (!renamed || verdict.subject.zone != before.zone.name) continue;
        Verdict moved = verdict;
        moved.subject.zone = after.zone.name;
        edit.verdicts.push_back({verdict, std::move(moved)});
    }
    edit.zones.push_back({before, std::move(after)});
    return edit;
}

ReviewEdit removeZones(const ReviewSet& set, const std::vector<int>& ids) {
    ReviewEdit edit;
    for (const int id : ids) {
        const auto found = set.zones.find(id);
        if (found != set.zones.end()) edit.zones.push_back({found->second, std::nullopt});
    }
    if (edit.zones.size() == 1) {
        const Zone& only = edit.zones.front().before->zone;
        edit.name = std::string("Delete ") + nameOf(only.shape) + " \"" + only.name + "\"";
    } else {
        edit.name = "Delete " + std::to_string(edit.zones.size()) + " zones";
    }
    return edit;
}

std::string newZoneName(const ReviewSet& set, ZoneShape shape) {
    for (int number = 1;; ++number) {
        std::string name = std::string(nameOf(shape)) + " " + std::to_string(number);
        if (std::none_of(set.zones.begin(), set.zones.end(),
                         [&](const auto& stored) { return stored.second.zone.name == name; }))
            return name;
    }
}

}  // namespace eyrie

#include "core/review/event_kind.h"

#include <algorithm>
#include <array>

#include "core/error.h"
#include "core/text.h"

namespace eyrie {
namespace {

constexpr std::array<const char*, kEventKinds> kKindNames = {
    "appears",          "leaves",          "lost",       "starts",      "stops",  "stands",  "turns back",
    "against the flow", "leaves the flow", "over speed", "under speed", "convoy", "meeting", "loiters",
    "enters",           "exits",           "crosses"};

}  // namespace

const char* nameOf(EventKind kind) {
    return kKindNames.at(static_cast<std::size_t>(kind));
}

std::vector<EventKind> allEventKinds() {
    std::vector<EventKind> kinds;
    kinds.reserve(kEventKinds);
    for (int i = 0; i < kEventKinds; ++i) kinds.push_back(static_cast<EventKind>(i));
    return kinds;
}

EventKind eventKindOf(const std::string& name) {
    std::string wanted = name;
    std::replace_if(
        wanted.begin(), wanted.end(), [](char c) { return c == '-' || c == '_'; }, ' ');
    std::string all;
    for (const EventKind kind : allEventKinds()) {
        if (wanted == nameOf(kind)) return kind;
        all += (all.empty() ? "" : ", ") + std::string(nameOf(kind));
    }
    const auto nearest = nearestWord(wanted, {kKindNames.begin(), kKindNames.end()});
    throw Error(ErrorKind::parameter, "there is no kind of event \"" + name + "\"; " +
                                          (nearest ? "the nearest is \"" + *nearest + "\"" : "there are: " + all));
}

const char* nameOf(CrossingSense sense) {
    switch (sense) {
        case CrossingSense::none:
            break;
        case CrossingSense::to_right:
            return "to the right";
        case CrossingSense::to_left:
            return "to the left";
    }
    return "";
}

}  // namespace eyrie

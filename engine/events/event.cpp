#include "events/event.h"

#include <algorithm>
#include <array>
#include <cstdio>

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

const char* nameOf(FigureUnit unit) {
    switch (unit) {
        case FigureUnit::none:
            break;
        case FigureUnit::km_per_hour:
            return "km/h";
        case FigureUnit::px_per_frame:
            return "px/frame";
        case FigureUnit::seconds:
            return "s";
        case FigureUnit::degrees:
            return "°";
        case FigureUnit::metres:
            return "m";
        case FigureUnit::px:
            return "px";
        case FigureUnit::vehicles:
            return "vehicles";
    }
    return "";
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

std::string figureText(const Event& event) {
    int decimals = 0;
    if (event.unit == FigureUnit::none) return "";
    if (event.unit == FigureUnit::px_per_frame) decimals = 2;
    if (event.unit == FigureUnit::seconds) decimals = 1;
    char text[64];
    std::snprintf(text, sizeof text, "%.*f%s%s", decimals, event.figure, event.unit == FigureUnit::degrees ? "" : " ",
                  nameOf(event.unit));
    return text;
}

}  // namespace eyrie

#include "events/event.h"

#include <cstdio>

namespace eyrie {
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

const char* figureNameOf(EventKind kind) {
    switch (kind) {
        case EventKind::appears:
            return "From the border";
        case EventKind::leaves:
        case EventKind::lost:
            return "Speed at the end";
        case EventKind::starts:
            return "Speed after";
        case EventKind::stops:
            return "Speed before";
        case EventKind::stands:
            return "Stood";
        case EventKind::turns_back:
            return "Turned by";
        case EventKind::against_flow:
        case EventKind::leaves_flow:
            return "Drove so";
        case EventKind::over_speed:
            return "Highest speed";
        case EventKind::under_speed:
            return "Lowest speed";
        case EventKind::convoy:
            return "Convoy of";
        case EventKind::meeting:
        case EventKind::loiters:
            return "Lasted";
        case EventKind::enters:
        case EventKind::crosses:
            return "Speed there";
        case EventKind::exits:
            return "Was inside";
    }
    return "Figure";
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

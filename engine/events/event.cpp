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

#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/geometry/local_plane.h"

namespace eyrie {

/// A place as maps take it, "48.137154, 11.576124": latitude and longitude in degrees, to a tenth of a metre, with a
/// point whatever the locale.
std::string placeText(const GeoPoint& place);

/// A place as people copy it from maps: "48.137154, 11.576124", "48,137154 11,576124", "48.1372° N 11.5761° E",
/// "48°08'13.8\"N 11°34'34\"E". Latitude first unless letters say otherwise; nothing for what is no place on the earth.
std::optional<GeoPoint> placeOfText(std::string_view text);

}  // namespace eyrie

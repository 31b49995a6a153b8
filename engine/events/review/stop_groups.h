#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "events/event.h"

namespace eyrie {

/// Which events tell of one and the same stop: that a vehicle stops, stands and starts again. By event: the number of
/// its stop, the same for all events of it; nothing for events that are of no stop, or the only one of theirs.
std::vector<std::optional<std::size_t>> stopsOf(const std::vector<Event>& events);

}  // namespace eyrie

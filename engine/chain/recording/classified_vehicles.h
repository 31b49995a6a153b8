#pragma once

#include <utility>

#include "chain/chain_options.h"

namespace eyrie {

/// `boxes_at` for the finishing of tracks; nothing where no classifier takes part, since then a box that nobody took
/// for a vehicle says nothing either.
inline BoxesAt classifiedVehicles(const ChainOptions& options, BoxesAt boxes_at) {
    return looksThroughWindows(options.detection.method) ? std::move(boxes_at) : BoxesAt();
}

}  // namespace eyrie

#pragma once

#include <utility>

#include "chain/chain_options.h"

namespace eyrie {

/// `classified_at` for the finishing of tracks; nothing where no classifier takes part, since then a box that nobody
/// took for a vehicle says nothing either.
inline ClassifiedAt classifiedVehicles(const ChainOptions& options, ClassifiedAt classified_at) {
    return looksThroughWindows(options.detection.method) ? std::move(classified_at) : ClassifiedAt();
}

}  // namespace eyrie

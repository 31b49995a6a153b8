#pragma once

#include "core/parameter.h"
#include "peer/sort/sort_tracker.h"

namespace eyrie {

/// Parameters of the peer. All lengths are pixels: it knows no scale. Of some dozens of sets the defaults, and those of
/// SORT, have the largest mean f-score over the clips of docs/figures.md, so that it is not put at a disadvantage.
struct PeerOptions {
    int gap = 3;            ///< pictures between those that are compared
    double blur = 0;        ///< px, deviation of the Gaussian before differences are taken
    double threshold = 16;  ///< pixels move from this difference on, grey values
    double joining = 5;     ///< areas closer than this are one object; 0: none are joined
    int min_area = 40;      ///< px²; smaller objects are dropped
    SortOptions sort;

    /// Group "peer".
    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie

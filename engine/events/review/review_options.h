#pragma once

#include "core/parameter.h"

namespace eyrie {

/// How events are put before an operator, and how her verdicts find them again in another run.
struct ReviewOptions {
    // which event of another run is the same one
    double carry_time_s = 2;
    double carry_distance_m = 5;
    double carry_picture = 30;
    // the order of the queue
    double join_unsearched_s = 1;
    int rare = 5;
    double unsure_score = 0.9;

    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie

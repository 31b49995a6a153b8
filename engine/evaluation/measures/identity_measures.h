#pragma once

#include "evaluation/evaluation_input.h"
#include "evaluation/matching.h"

namespace eyrie {

/// How well identities are kept: the tracks of truth and result are paired one to one over the whole sequence so that
/// as many boxes as possible agree (Ristani et al., ECCV workshops 2016; definitions as in TrackEval).
struct IdentityMeasures {
    int idtp = 0;
    int idfp = 0;
    int idfn = 0;
    double idp = 0;
    double idr = 0;
    double idf1 = 0;
};

/// Results that `matches` ignores are left out. `input.has_tracks` must hold.
IdentityMeasures identityMeasures(const EvaluationInput& input, const std::vector<FrameMatch>& matches,
                                  const EvaluationOptions& options);

}  // namespace eyrie

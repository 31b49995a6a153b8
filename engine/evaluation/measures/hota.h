#pragma once

#include <array>

#include "evaluation/evaluation_input.h"

namespace eyrie {

/// The overlaps at which HOTA is taken: 0.05, 0.10 … 0.95.
inline constexpr int kHotaThresholds = 19;
double hotaThreshold(int index);

/// One value per overlap threshold.
using HotaCurve = std::array<double, kHotaThresholds>;
double meanOf(const HotaCurve& curve);

/// Higher order tracking accuracy (Luiten et al., IJCV 2021; definitions as in TrackEval). HOTA = √(DetA · AssA) at
/// each threshold; the figure to quote is the mean over all.
struct HotaMeasures {
    HotaCurve hota{};
    HotaCurve det_a{};  ///< share of boxes found
    HotaCurve ass_a{};  ///< how well identities are kept among the found ones
    HotaCurve loc_a{};  ///< mean overlap of the found ones
    HotaCurve det_re{};
    HotaCurve det_pr{};
    HotaCurve ass_re{};
    HotaCurve ass_pr{};
    HotaCurve owta{};
    HotaCurve true_positives{};
    HotaCurve false_positives{};
    HotaCurve false_negatives{};
};

/// HOTA does not depend on T_ov. Under the convention thesis results are left out that touch an ignored object, unless
/// they are paired with a counting one in a one-to-one match at the lowest threshold. `input.has_tracks` must hold.
HotaMeasures hotaMeasures(const EvaluationInput& input);

}  // namespace eyrie

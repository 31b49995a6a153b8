#pragma once

#include <QString>
#include <vector>

#include "tune/evaluate/evaluation_session.h"

namespace eyrie::ui {

/// Precision and recall over a sliding window; NaN where nothing is defined.
struct WindowedRatios {
    std::vector<double> precision;
    std::vector<double> recall;
};
/// `window`: frames of the list, centred.
WindowedRatios windowedRatios(const std::vector<FrameCounts>& frames, int window);

/// "f-score 0.940 (0.921 – 0.956)" … and, where another run is compared, whether the difference is real.
QString certaintyText(const RunEvaluation& evaluation);

/// "run 3, night" as it stands in lists and sentences.
QString evaluatedRunName(const RunRecord& run);

}  // namespace eyrie::ui

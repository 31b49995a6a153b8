#pragma once

#include <string>
#include <vector>

#include "evaluation/measures/score_curve.h"

namespace eyrie::cli {

/// threshold,tracks,tp,fp,fn,precision,recall,f_score: a line for every point.
std::string scoreCurveCsv(const std::vector<ScorePoint>& curve);

}  // namespace eyrie::cli

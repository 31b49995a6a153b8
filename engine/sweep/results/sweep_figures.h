#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "evaluation/evaluate.h"

namespace eyrie {

/// What was measured at one point on one sequence, of detections or tracks, at one T_ov.
struct SweepFigures {
    int clip = 0;         ///< position in the plan
    bool tracks = false;  ///< otherwise detections
    double overlap = 0;
    std::vector<std::pair<std::string, double>> values;  ///< keys of listMeasures()

    std::optional<double> at(const std::string& key) const;
};

/// Of one sequence, `clip` in the plan, what listMeasures() tells of its tracks or of its detections.
SweepFigures figuresOf(const Measures& measures, int clip, bool tracks);

/// As text for files (JSON) and back. Throws Error(project) naming `where`.
std::string textOf(const std::vector<SweepFigures>& figures);
std::vector<SweepFigures> figuresFrom(const std::string& text, const std::string& where);

/// What people read about a measure; the label is the key itself where nothing is known.
struct MeasureText {
    std::string key;
    std::string group;
    std::string label;
    std::string help;
    int decimals = 4;
    bool higher_is_better = true;
};
/// All measures of a point, in the order of listMeasures().
const std::vector<MeasureText>& sweepMeasures();
const MeasureText& measureText(const std::string& key);

}  // namespace eyrie

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evaluation/comparison/method_difference.h"
#include "evaluation/evaluate.h"

namespace eyrie::cli {

/// One result of a comparison at one T_ov.
struct ComparisonRow {
    std::string method;  ///< "gradient"
    bool stacking = false;
    bool tracking = false;
    double ms_per_frame = 0;  ///< median, of everything after the motion vectors
    Measures measures;
    BootstrapInterval f_score;
    std::string compared_with;                   ///< name of the row that `difference` refers to
    std::optional<MethodDifference> difference;  ///< this − that row; empty for the first row

    /// "gradient + stacking + tracking".
    std::string name() const;
};

/// All that `compare` has to say: one block of rows for each T_ov.
struct ComparisonReport {
    std::string sequence;
    std::string ground_truth;
    int frames = 0;
    EvaluationOptions options;
    std::vector<std::vector<ComparisonRow>> blocks;
    std::vector<std::string> remarks;
    std::string published;  ///< sequence whose figures in the thesis are told, too; empty: none. Not in the CSV
};

/// Tables for people: the rows of tables 7.3 and 7.5–7.10 as columns, a line per method.
std::string tableText(const ComparisonReport& report);
/// A line per method and T_ov with its parts as columns.
std::string csvText(const ComparisonReport& report);
std::string jsonText(const ComparisonReport& report);

}  // namespace eyrie::cli

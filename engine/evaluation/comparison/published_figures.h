#pragma once

#include <optional>
#include <string>
#include <vector>

namespace eyrie {

/// T_ov of all published figures.
inline constexpr double kPublishedOverlap = 0.1;

/// What the thesis publishes about a method on one of its sequences (Teutsch §7.3 and §7.4, tables 7.3 and 7.5
/// to 7.10). N-MODP and MOTP are mean overlaps.
struct PublishedFigures {
    /// As comparisons call it, "gradient + stacking + tracking", or the authors of a paper. A classifier other than
    /// that of the other tables follows: "sliding_window_joint_11, hog + svm".
    std::string method;
    std::string source;  ///< "table 7.7", or "their paper, in table 7.7"; a method may stand in several tables
    std::optional<int> true_positives;
    std::optional<int> false_positives;
    std::optional<int> false_negatives;
    double precision = 0;
    double recall = 0;
    double f_score = 0;
    std::optional<double> n_moda;
    std::optional<double> n_modp;
    std::optional<double> mota;
    std::optional<double> motp;
    std::optional<int> mostly_tracked;
    std::optional<int> partially_tracked;
    std::optional<int> mostly_lost;
    std::optional<int> fragments;
};

/// "seq1", "seq2", "egtest01".
const std::vector<std::string>& publishedSequences();
/// In the order of the tables. Throws Error(parameter) naming the sequences.
const std::vector<PublishedFigures>& publishedFigures(const std::string& sequence);
/// A table for people, a line per method; "-" where nothing is published.
std::string publishedText(const std::string& sequence);

}  // namespace eyrie

#pragma once

#include <deque>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/batch/batch_rows.h"

namespace eyrie::cli {

/// Summary and log of a batch. The work is worth more than its record: what cannot be written is told, kept, and
/// written with what comes next.
class BatchRecord {
 public:
    /// Writes `base`.csv and `base`.jsonl.
    explicit BatchRecord(std::filesystem::path base) : base_(std::move(base)) {}

    void log(const BatchRow& row);
    void summarise(const std::vector<BatchRow>& rows);
    /// Why the log, or else the summary, is not what it should be; empty when both are.
    const std::string& fault() const { return log_fault_.empty() ? summary_fault_ : log_fault_; }

 private:
    std::filesystem::path base_;  ///< without its ending
    std::deque<BatchRow> unlogged_;
    std::string log_fault_;
    std::string summary_fault_;
};

}  // namespace eyrie::cli

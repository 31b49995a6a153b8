#pragma once

#include <deque>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/batch/batch_inputs.h"
#include "cli/batch/batch_rows.h"
#include "store/database/file_lock.h"

namespace eyrie::cli {

/// Summary and log of a batch. The work is worth more than its record: what cannot be written is told, kept, and
/// written with what comes next.
class BatchRecord {
 public:
    /// Writes `name`.csv and `name`.jsonl in a folder. Throws Error(output) while a batch or watch works there that may
    /// do the same work: any but the other shards of the same division.
    BatchRecord(const std::filesystem::path& out, const std::string& name, const Shard& shard);

    void log(const BatchRow& row);
    void summarise(const std::vector<BatchRow>& rows);
    /// Why the log, or else the summary, is not what it should be; empty when both are.
    const std::string& fault() const { return log_fault_.empty() ? summary_fault_ : log_fault_; }

 private:
    std::filesystem::path base_;      ///< without its ending
    std::unique_ptr<FileLock> lock_;  ///< none on a disk that cannot lock
    std::deque<BatchRow> unlogged_;
    std::string log_fault_;
    std::string summary_fault_;
};

}  // namespace eyrie::cli

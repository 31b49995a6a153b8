#include "cli/batch/batch_record.h"

#include "core/error.h"

namespace eyrie::cli {

void BatchRecord::log(const BatchRow& row) {
    unlogged_.push_back(row);
    try {
        for (; !unlogged_.empty(); unlogged_.pop_front()) addToBatchLog(base_.string() + ".jsonl", unlogged_.front());
        log_fault_.clear();
    } catch (const Error& error) {
        log_fault_ = error.what();
    }
}

void BatchRecord::summarise(const std::vector<BatchRow>& rows) {
    try {
        writeBatchSummary(base_.string() + ".csv", rows);
        summary_fault_.clear();
    } catch (const Error& error) {
        summary_fault_ = error.what();
    }
}

}  // namespace eyrie::cli

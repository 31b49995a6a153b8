#include "cli/batch/batch_record.h"

#include <utility>

#include "core/error.h"

namespace eyrie::cli {

BatchRecord::BatchRecord(std::filesystem::path base) : base_(std::move(base)) {
    FileLock::Attempt attempt = FileLock::tryTake(base_.string() + ".lock");
    if (attempt.outcome == FileLock::Outcome::held) {
        throw Error(ErrorKind::output, base_.string() + ".csv is being written by another batch, " + attempt.words +
                                           "; let it end first, or give --out another folder");
    }
    lock_ = std::move(attempt.lock);
}

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

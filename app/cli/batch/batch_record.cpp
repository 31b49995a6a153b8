#include "cli/batch/batch_record.h"

#include <system_error>

#include "core/error.h"

namespace eyrie::cli {

namespace {

namespace fs = std::filesystem;

constexpr const char* kLockBegin = "batch";
constexpr const char* kLockEnding = ".lock";

std::string divisionOf(const Shard& shard) {
    return "-of-" + std::to_string(shard.parts) + kLockEnding;
}

/// Whoever works on everything, be it told to look once or to wait for more, has the same.
std::string lockOf(const Shard& shard) {
    return shard.parts == 1 ? std::string(kLockBegin) + kLockEnding
                            : std::string(kLockBegin) + "-" + std::to_string(shard.part) + divisionOf(shard);
}

[[noreturn]] void refuseBesideAnother(const fs::path& out, const std::string& holder) {
    throw Error(ErrorKind::output, out.string() + " is being written to by another batch or watch, " + holder +
                                       "; let it end first, or give --out another folder");
}

/// Looked for by those who have their own lock, so that of two that begin at once at least one sees the other.
void refuseOtherDivisions(const fs::path& out, const Shard& shard) {
    std::error_code failed;
    for (const auto& entry : fs::directory_iterator(out, failed)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(kLockBegin) || !name.ends_with(kLockEnding) || name == lockOf(shard)) continue;
        if (shard.parts > 1 && name.ends_with(divisionOf(shard))) continue;
        if (const auto holder = FileLock::holderOf(entry.path())) refuseBesideAnother(out, *holder);
    }
}

}  // namespace

BatchRecord::BatchRecord(const fs::path& out, const std::string& name, const Shard& shard) : base_(out / name) {
    FileLock::Attempt attempt = FileLock::tryTake(out / lockOf(shard));
    if (attempt.outcome == FileLock::Outcome::held) refuseBesideAnother(out, attempt.words);
    lock_ = std::move(attempt.lock);
    refuseOtherDivisions(out, shard);
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

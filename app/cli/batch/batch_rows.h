#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/batch/batch_inputs.h"

namespace eyrie::cli {

/// How far one file of a batch is.
enum class BatchState {
    waiting,
    working,
    done,
    done_before,  ///< its project held a finished run with the same options
    stopped,      ///< it goes on where it was when the batch is started again
    failed
};
/// The word in tables and logs: "done before".
const char* nameOf(BatchState state);

/// An input of a batch and what has become of it.
struct BatchRow {
    BatchInput input;
    std::filesystem::path project;
    bool anew = false;        ///< a file that was worked on before has other contents now
    bool may_differ = false;  ///< it may, and is begun anew if its unfinished run cannot be gone on with
    BatchState state = BatchState::waiting;
    std::string message;  ///< why it failed or stopped; of a finished one what else its run says
    double seconds = 0;   ///< that it took in this batch
    int frames = 0;
    int unregistered = 0;  ///< of the frames
    int tracks = 0;
};

/// A table of all rows: file, project, state, frames, unregistered, tracks, seconds, message. Replaces the one that a
/// batch wrote before. Throws Error(output).
void writeBatchSummary(const std::filesystem::path& path, const std::vector<BatchRow>& rows);

/// Adds a line of JSON to a log: time (UTC), file, project, event, and for a file that has ended what is in its row.
/// Several batches may add to one log. Throws Error(output).
void addToBatchLog(const std::filesystem::path& path, const BatchRow& row);

}  // namespace eyrie::cli

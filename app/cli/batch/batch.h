#pragma once

#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/arguments/run_choice.h"
#include "cli/batch/batch_record.h"
#include "cli/batch/batch_rows.h"
#include "cli/child_program.h"

namespace eyrie::cli {

/// What a batch is asked to do.
struct BatchOptions {
    std::filesystem::path out;           ///< folder for projects, summary and log; made where it is missing
    std::string record = "batch";        ///< how summary (.csv) and log (.jsonl) are called
    Shard shard;                         ///< what of the inputs is worked on
    int jobs = 1;                        ///< files at once
    std::vector<std::string> run_words;  ///< what every `eyrie-cli run` is told besides
    ResumeWishes wishes;                 ///< the same, for finding out what is done
};

/// Works on many inputs, each by an `eyrie-cli run` of its own that goes on where an earlier one was left. What fails
/// is told and kept for the end; the others go on. Not for use by several threads.
class Batch {
 public:
    explicit Batch(BatchOptions options);
    ~Batch();
    Batch(const Batch&) = delete;
    Batch& operator=(const Batch&) = delete;

    /// What falls to the shard of inputs in the order of findInputs(), to be worked on after those that wait. `anew`:
    /// they were worked on before and have changed.
    void add(const std::vector<BatchInput>& inputs, bool anew = false);
    /// Looks after those at work and begins others; returns at once. False when nothing is left to do.
    bool step();
    /// Asks those at work to stop and begins no more; step() as before until it says false.
    void stop();

    const std::vector<BatchRow>& rows() const { return rows_; }
    /// Share of the bytes of all inputs that is done, and the seconds that the rest will take; −1: not known yet.
    double share() const;
    double secondsLeft() const;
    /// Why summary or log are not what they should be; empty when they are.
    const std::string& recordFault() const { return record_.fault(); }

 private:
    using Clock = std::chrono::steady_clock;
    struct Work {
        std::unique_ptr<ChildProgram> program;
        Clock::time_point begun;
        double share = 0;  ///< of the input, as of `looked`
        Clock::time_point looked;
    };

    std::filesystem::path projectFor(const BatchInput& input);
    void collect();
    bool atWork(const std::filesystem::path& project) const;
    void begin(std::size_t row);
    void end(std::size_t row, const ChildEnd& how);
    void close(std::size_t row, BatchState state, const std::string& message);
    void lookAt(Work& work, const BatchRow& row);

    BatchOptions options_;
    BatchRecord record_;
    std::vector<BatchRow> rows_;
    std::map<std::filesystem::path, std::filesystem::path> projects_;  ///< which input each is for
    std::size_t next_ = 0;                                             ///< the first that waits
    std::map<std::size_t, Work> works_;
    Clock::time_point begun_ = Clock::now();
    bool stopping_ = false;
    bool summary_due_ = false;
};

}  // namespace eyrie::cli

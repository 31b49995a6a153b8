#pragma once

#include <string>
#include <vector>

#include "cli/batch/batch.h"

namespace eyrie::cli {

/// Tells a person how a batch goes: a line on standard output for each input that has ended, and on a terminal one that
/// rewrites itself on standard error.
class BatchConsole {
 public:
    /// `quiet`: only what failed is told.
    explicit BatchConsole(bool quiet);
    ~BatchConsole();
    BatchConsole(const BatchConsole&) = delete;
    BatchConsole& operator=(const BatchConsole&) = delete;

    /// To be called often.
    void show(const Batch& batch);
    /// The last words: how many ended how, and what failed.
    void finish(const Batch& batch);

 private:
    void clear();

    bool quiet_;
    bool terminal_;
    bool drawn_ = false;
    std::vector<bool> told_;  ///< by row
    std::string fault_;
};

}  // namespace eyrie::cli

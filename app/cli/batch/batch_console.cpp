#include "cli/batch/batch_console.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>

#include "cli/reports/console_progress.h"

namespace eyrie::cli {
namespace {

std::size_t countOf(const Batch& batch, BatchState state) {
    return static_cast<std::size_t>(std::count_if(batch.rows().begin(), batch.rows().end(),
                                                  [&](const BatchRow& row) { return row.state == state; }));
}

void tell(const BatchRow& row) {
    const std::string name = row.input.name.string();
    std::printf("%-11s  %s", nameOf(row.state), name.c_str());
    if (row.state == BatchState::done || row.state == BatchState::done_before) {
        std::printf(": %d track%s in %d frames", row.tracks, row.tracks == 1 ? "" : "s", row.frames);
        if (row.unregistered > 0) std::printf(", %d not registered", row.unregistered);
    }
    if (row.state == BatchState::done) std::printf(" (%s)", clockText(row.seconds).c_str());
    if (!row.message.empty()) std::printf(": %s", row.message.c_str());
    std::printf("\n");
}

}  // namespace

BatchConsole::BatchConsole(bool quiet) : quiet_(quiet), terminal_(!quiet && isatty(STDERR_FILENO) != 0) {}

BatchConsole::~BatchConsole() {
    clear();
}

void BatchConsole::clear() {
    if (drawn_) std::fputs("\r\033[K", stderr);
    drawn_ = false;
}

void BatchConsole::show(const Batch& batch) {
    told_.resize(batch.rows().size());
    for (std::size_t at = 0; at < told_.size(); ++at) {
        const BatchState state = batch.rows()[at].state;
        if (told_[at] || state == BatchState::waiting || state == BatchState::working) continue;
        told_[at] = true;
        if (quiet_ && state != BatchState::failed) continue;
        clear();
        tell(batch.rows()[at]);
        std::fflush(stdout);
    }
    if (batch.recordFault() != fault_) {
        fault_ = batch.recordFault();
        clear();
        if (!fault_.empty()) std::fprintf(stderr, "eyrie-cli: %s; the work goes on\n", fault_.c_str());
    }
    if (!terminal_) return;
    const std::size_t working = countOf(batch, BatchState::working);
    const std::size_t ended = batch.rows().size() - working - countOf(batch, BatchState::waiting);
    const double left = batch.secondsLeft();
    const std::string time = left < 0 ? "" : ", " + clockText(left) + " left";
    std::fprintf(stderr, "\r%zu of %zu files, %zu running, %zu failed, %.0f %%%s\033[K", ended, batch.rows().size(),
                 working, countOf(batch, BatchState::failed), 100 * batch.share(), time.c_str());
    drawn_ = true;
}

void BatchConsole::finish(const Batch& batch) {
    show(batch);
    clear();
    if (!quiet_) {
        std::string text;
        for (const BatchState state : {BatchState::done, BatchState::done_before, BatchState::failed,
                                       BatchState::stopped, BatchState::waiting}) {
            const std::size_t count = countOf(batch, state);
            if (count > 0) text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + nameOf(state);
        }
        std::printf("%zu file%s: %s\n", batch.rows().size(), batch.rows().size() == 1 ? "" : "s",
                    text.empty() ? "nothing to do" : text.c_str());
    }
}

}  // namespace eyrie::cli

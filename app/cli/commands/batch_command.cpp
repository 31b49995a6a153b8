#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <map>
#include <memory>
#include <thread>
#include <utility>

#include "cli/batch/batch.h"
#include "cli/batch/batch_arguments.h"
#include "cli/batch/batch_console.h"
#include "cli/command.h"
#include "cli/interrupt.h"
#include "core/error.h"

namespace eyrie::cli {
namespace {

constexpr std::chrono::milliseconds kBetweenSteps{100};
constexpr std::chrono::seconds kBetweenListings{2};

bool any(const Batch& batch, BatchState state) {
    return std::any_of(batch.rows().begin(), batch.rows().end(),
                       [&](const BatchRow& row) { return row.state == state; });
}

int end(BatchConsole& console, const Batch& batch, bool stopped) {
    console.finish(batch);
    if (!batch.recordFault().empty()) return exit_output;
    if (stopped) return exit_stopped;
    if (any(batch, BatchState::failed)) return exit_input;
    return any(batch, BatchState::stopped) ? exit_stopped : exit_ok;
}

int runBatch(const BatchArguments& arguments, const std::string& shard_text) {
    const Shard shard = shard_text.empty() ? Shard() : shardFrom(shard_text);
    const std::string record =
        shard.parts == 1 ? "batch" : "batch-" + std::to_string(shard.part) + "-of-" + std::to_string(shard.parts);
    const std::vector<BatchInput> inputs = findInputs(arguments.places);
    // An archive that is not mounted looks so, and a job that does nothing every night should not be called good.
    if (inputs.empty()) {
        throw Error(ErrorKind::input, "there is no video in " + arguments.places.front() +
                                          (arguments.places.size() > 1 ? " or the other places" : "") +
                                          "; check the folder, or whether its disk is mounted");
    }
    BatchOptions options = arguments.options(record);
    options.shard = shard;
    Batch batch(std::move(options));
    const InterruptGuard interrupt;
    batch.add(inputs);
    BatchConsole console(arguments.quiet);
    while (batch.step()) {
        if (interrupt.token().stop_requested()) batch.stop();
        console.show(batch);
        std::this_thread::sleep_for(kBetweenSteps);
    }
    const bool stopped = interrupt.token().stop_requested();
    if (stopped && !arguments.quiet) std::fprintf(stderr, "stopped; the same command continues\n");
    return end(console, batch, stopped);
}

/// Files as they come into folders: each is taken once it has not changed for a while, and again when it changes later.
class Arrivals {
 public:
    explicit Arrivals(double settle_s) : settle_(settle_s) {}
    void look(const std::vector<std::string>& places, Batch& batch) {
        const auto now = Clock::now();
        for (const BatchInput& input : findInputs(places, files_)) {
            if (!input.fault.empty()) continue;  // a folder that cannot be read now may be readable later
            Seen& seen = seen_.try_emplace(input.path, Seen{input, now}).first->second;
            if (!(seen.input == input)) seen.input = input, seen.since = now, seen.waits = true;
            if (!seen.waits || now - seen.since < settle_) continue;
            batch.add({input}, seen.taken);
            seen.waits = false;
            seen.taken = true;
        }
    }

 private:
    using Clock = std::chrono::steady_clock;
    struct Seen {
        BatchInput input;
        Clock::time_point since;
        bool waits = true;
        bool taken = false;
    };
    std::chrono::duration<double> settle_;
    std::map<std::filesystem::path, Seen> seen_;
    KnownFiles files_;
};

int runWatch(const BatchArguments& arguments, double settle_s) {
    Batch batch(arguments.options("watch"));
    const InterruptGuard interrupt;
    Arrivals arrivals(settle_s);
    BatchConsole console(arguments.quiet);
    auto looked = std::chrono::steady_clock::time_point{};
    for (bool working = true; working || !interrupt.token().stop_requested();) {
        const auto now = std::chrono::steady_clock::now();
        if (interrupt.token().stop_requested()) batch.stop();
        if (now - looked >= kBetweenListings && !interrupt.token().stop_requested()) {
            arrivals.look(arguments.places, batch);
            looked = now;
        }
        working = batch.step();
        console.show(batch);
        std::this_thread::sleep_for(kBetweenSteps);
    }
    return end(console, batch, true);
}

}  // namespace

void addBatchCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<BatchArguments>();
    const auto shard = std::make_shared<std::string>();
    CLI::App* command = app.add_subcommand(
        "batch", "Process all videos of folders, one project each; started again, it continues and skips what is done");
    arguments->addTo(*command);
    command
        ->add_option("--shard", *shard,
                     "Only part PART of PARTS, for several machines on the same folders: every file falls to one of "
                     "them, e.g. $SLURM_ARRAY_TASK_ID/8 with sbatch --array=1-8")
        ->type_name("PART/PARTS");
    command->callback([arguments, shard, &exit_code] { exit_code = runBatch(*arguments, *shard); });
}

void addWatchCommand(CLI::App& app, int& exit_code) {
    const auto arguments = std::make_shared<BatchArguments>();
    const auto settle = std::make_shared<double>(10);
    CLI::App* command =
        app.add_subcommand("watch", "Process videos as they arrive in folders, one project each, until Ctrl-C");
    arguments->addTo(*command);
    command->add_option("--settle", *settle, "Seconds for which a file must not have changed before it is taken (10)")
        ->check(CLI::Range(0.0, 86400.0));
    command->callback([arguments, settle, &exit_code] { exit_code = runWatch(*arguments, *settle); });
}

}  // namespace eyrie::cli

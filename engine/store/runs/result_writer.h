#pragma once

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "core/values/frame_result.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// Asked before a run is added, when nobody else can add or change one: throws Error where it must not be.
using MayAddRun = std::function<void(const RunStore&)>;

/// Writes the frames of one run as they come, each committed when write() returns: a killed process leaves all of them,
/// and each is there whole or not at all. Holds no lock between the calls, so that others may write to the project
/// while a run works. Used by one thread; opens its own connection.
class ResultWriter {
 public:
    /// Adds sequence (unless a row of the same path and size exists), run and parameters, committed at once. `run.id`,
    /// `run.sequence.id` and the start are filled in: `run.started_us`, else `run.started_utc`, else now.
    /// `run.last_frame` kLastFrame: the end is not known before, and run and video end at the newest frame that is
    /// there; until there is one, before the first. `may_add`: what it throws is thrown, and nothing is added. Throws
    /// Error(project | output).
    ResultWriter(const std::filesystem::path& project, RunRecord run,
                 const std::vector<std::pair<std::string, std::string>>& parameters, const MayAddRun& may_add = {});
    /// Goes on with a run that ended early, from the frame after `last`; see RunStateStore::takeUp. Throws
    /// Error(project | output), also when another program writes it.
    ResultWriter(const std::filesystem::path& project, int run_id, FrameIndex last);
    /// Leaves the state `running` unless finish() was called.
    ~ResultWriter();
    ResultWriter(const ResultWriter&) = delete;
    ResultWriter& operator=(const ResultWriter&) = delete;

    int runId() const;
    /// Every frame once; one that is left from before the run was taken up is replaced. Throws Error(output) when the
    /// disk is full, Error(project) when the run was removed meanwhile; frames written before stay. The milliseconds it
    /// took are returned, and stored with the next frame or the end of the run: what `result` says of it is not.
    float write(const FrameResult& result);
    /// Keeps what the chain remembers after a frame that was written, for going on with the run. The same errors.
    void keepState(FrameIndex frame, const std::string& bytes);
    /// Records how the run ended. What is kept for going on with it goes when it is finished.
    void finish(RunState state, const std::string& message);

 private:
    struct Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace eyrie

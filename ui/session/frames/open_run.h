#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>

#include "io/video/frame_source.h"
#include "rerun/replay.h"
#include "session/project/media.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// A stored run and where its pictures come from.
struct ReplayRun {
    Media media;
    std::filesystem::path project;
    int run_id = 0;
};

/// A stored run with its own connection to project and video. For one thread; touches nothing before it is made. Throws
/// Error.
class OpenRun {
 public:
    OpenRun(const ReplayRun& run, const std::stop_token& stop);

    /// What the engine needs to do parts of the run again; must not outlive this. `about_to_read`, if given, is told
    /// every frame whose pixels are read.
    ReplaySource source(std::function<void(FrameIndex)> about_to_read = {});
    std::optional<FrameResult> result(FrameIndex frame) const { return store_.frameResult(run_id_, frame); }
    /// Throws Error(project) when the run is gone.
    RunRecord record() const;

 private:
    std::unique_ptr<FrameSource> pictures_;
    ProjectFile project_;
    RunStore store_;
    int run_id_;
};

}  // namespace eyrie::ui

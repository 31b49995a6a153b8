#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>

#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"

namespace eyrie::test {

/// Writes a finished run over `run.sequence.frame_count` frames, all registered, into the project, which is made where
/// there is none. `fill` completes each frame's result.
inline RunRecord writeRun(const std::filesystem::path& project, RunRecord run,
                          const std::function<void(int frame, FrameResult&)>& fill) {
    ProjectFile::openOrCreate(project);
    run.last_frame = run.sequence.frame_count - 1;
    ResultWriter writer(project, run, {});
    for (int frame = 0; frame <= run.last_frame; ++frame) {
        FrameResult result;
        result.motion.frame = frame;
        result.motion.image_size = run.sequence.size;
        Registration& registration = result.motion.registration;
        registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
        registration.current_from_previous.from_frame = std::max(0, frame - 1);
        registration.current_from_previous.to_frame = frame;
        fill(frame, result);
        writer.write(result);
    }
    writer.finish(RunState::finished, "");
    ProjectFile file = ProjectFile::open(project, ProjectFile::Mode::read_only);
    return RunStore(file).runs().back();
}

/// The same over a clip of 320×240 px and so many frames.
inline RunRecord writeRun(const std::filesystem::path& project, int frames,
                          const std::function<void(int frame, FrameResult&)>& fill) {
    RunRecord run;
    run.sequence = {.path = "/nowhere/clip.mp4", .size = {320, 240}, .frame_count = frames, .frame_rate_hz = 25};
    return writeRun(project, run, fill);
}

}  // namespace eyrie::test

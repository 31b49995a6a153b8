#pragma once

#include <algorithm>
#include <filesystem>
#include <functional>

#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"

namespace eyrie::test {

/// Writes a finished run over a clip of 320×240 px and so many frames, all registered, into the project, which is made
/// where there is none. `fill` completes each frame's result.
inline RunRecord writeRun(const std::filesystem::path& project, int frames,
                          const std::function<void(int frame, FrameResult&)>& fill) {
    ProjectFile::openOrCreate(project);
    RunRecord run;
    run.sequence = {.path = "/nowhere/clip.mp4", .size = {320, 240}, .frame_count = frames, .frame_rate_hz = 25};
    run.last_frame = frames - 1;
    ResultWriter writer(project, run, {});
    for (int frame = 0; frame < frames; ++frame) {
        FrameResult result;
        result.motion.frame = frame;
        result.motion.image_size = {320, 240};
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

}  // namespace eyrie::test

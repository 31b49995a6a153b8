#pragma once

#include <filesystem>

#include "formats/label_stream.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// What was written.
struct VmtiReport {
    int frames = 0;   ///< sets: one for each frame from the first to the last that has a track
    int targets = 0;  ///< target packs in them
    int without_place = 0;
    int without_stamp = 0;                   ///< frames left out: their pictures have no stamp in the container
    std::string clock_origin, place_origin;  ///< empty: not known
};

/// What is worth knowing about it, one sentence each: where times and places come from, what was left out. `no_place`:
/// why places are not known, where they are not.
std::vector<std::string> remarksOn(const VmtiReport& report, const std::string& no_place);

/// Writes a copy of the video as a transport stream with what is in `labels` as MISB ST 0903 VMTI: one local set a
/// frame, in a track of its own. `labels.about.world` must tell times and be there; places are written where they are
/// known. `video` must be a file. Throws Error(input) where times are not known or the video cannot be copied,
/// Error(output).
VmtiReport writeVmti(const LabelStream& labels, const FrameSource& video, const std::filesystem::path& to,
                     const IndexProgress& progress = {}, const std::stop_token& stop = {});

}  // namespace eyrie

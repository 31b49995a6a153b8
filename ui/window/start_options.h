#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "window/theme.h"
#include "workspace/workspace_kind.h"

namespace eyrie::ui {

/// What the window was asked to do when it was started.
struct StartOptions {
    std::filesystem::path input;                       ///< video, folder of images or project; empty: none
    std::vector<std::filesystem::path> further_parts;  ///< video files that are one video with `input`
    double gsd_m_per_px = 0;                           ///< 0: not given
    double frame_rate_hz = 0;                          ///< 0: the video's own
    bool demo = false;                                 ///< show the demo scene
    bool run = false;                                  ///< start a run even if there is a finished one
    std::filesystem::path screenshot;                  ///< write a picture of the window here and quit
    int after_frames = 1;                              ///< … once this many frames with results were shown
    std::optional<WorkspaceKind> workspace;            ///< none: the one that was shown last
    ThemeChoice theme = ThemeChoice::system;
};

}  // namespace eyrie::ui

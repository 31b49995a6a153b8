#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>

#include "io/frame_source.h"

namespace eyrie::ui {

/// Something that can be played: a video file, a folder of images or a rendered scene. A value that several threads may
/// open, each for itself.
struct Media {
    std::string name;      ///< for people: the file name
    std::string identity;  ///< what a project stores: the absolute path, or "scene:demo"
    /// Metres per pixel if the media knows them, else 0. May take its time: not for the window thread.
    std::function<double()> gsd_m_per_px;
    std::function<std::unique_ptr<FrameSource>(const IndexProgress&, std::stop_token)> open;
};

/// A video file or folder of images; `frame_rate_hz` > 0 overrides its own rate.
Media videoMedia(const std::filesystem::path& path, double frame_rate_hz = 0);

/// A built-in scene, rendered as it is played. Throws Error(parameter) for an unknown one.
Media sceneMedia(const std::string& scene);

/// What a project's sequence path stands for.
Media mediaOfIdentity(const std::string& identity, double frame_rate_hz = 0);

}  // namespace eyrie::ui

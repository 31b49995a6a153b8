#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <stop_token>
#include <string>
#include <vector>

#include "core/scene_name.h"
#include "io/video/frame_source.h"

namespace eyrie::ui {

/// Something that can be played: a video file, several in a row, a folder of images or a rendered scene. A value that
/// several threads may open, each for itself.
struct Media {
    std::string name;          ///< for people: the file name, of several parts without the ending of their list
    std::string identity;      ///< what a project stores: the absolute path, or "scene:demo"
    double given_rate_hz = 0;  ///< frames per second that a person gave; 0: nobody did
    /// Metres per pixel if the media knows them, else 0. May take its time: not for the window thread.
    std::function<double()> gsd_m_per_px;
    std::function<std::unique_ptr<FrameSource>(const IndexProgress&, std::stop_token)> open;
    /// Opening it makes or changes a list of parts, which from then on is the media: VideoInfo::path.
    bool becomes_list = false;
};

/// The frames per second of a video, if they are not its own.
struct FrameRate {
    double given_hz = 0;       ///< by a person, now; 0: not
    double remembered_hz = 0;  ///< what a project knows; 0: nothing
};

/// A video file, a list of parts or a folder of images.
Media videoMedia(const std::filesystem::path& path, FrameRate rate = {});

/// Video files that are one video in a row, in the natural order of their names. Their list is kept beside the first
/// of them, or in the data folder where that cannot be written.
Media partsMedia(std::vector<std::filesystem::path> files, FrameRate rate = {});

/// What a project knew as `missing`, with what somebody chose instead: of a list of parts some of which are gone, they
/// or one of them; else the video itself.
Media locatedMedia(const std::filesystem::path& missing, std::vector<std::filesystem::path> chosen,
                   FrameRate rate = {});

/// A built-in scene, rendered as it is played. Throws Error(parameter) for an unknown one.
Media sceneMedia(const std::string& scene);

/// What a project's sequence path stands for.
Media mediaOfIdentity(const std::string& identity, FrameRate rate = {});

/// The grey pictures of a video, empty where one cannot be read. The source must outlive it.
std::function<cv::Mat(FrameIndex)> grayReader(FrameSource& source);

}  // namespace eyrie::ui

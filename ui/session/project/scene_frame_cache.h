#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>

#include "io/video/frame_source.h"

namespace eyrie {
class SceneRenderer;
}

namespace eyrie::ui {

/// A built-in scene whose frames are rendered once and then kept as files (without loss), so that playing it again is
/// quick. Frames kept by another build of the program are thrown away; a folder that cannot be written costs time only.
/// May be used by several threads; the renderer, which takes seconds to make, is shared and made when a frame is
/// missing.
class SceneFrameCache : public std::enable_shared_from_this<SceneFrameCache> {
 public:
    /// What must be known without rendering.
    struct Facts {
        cv::Size size;
        int frame_count = 0;
        double frame_rate_hz = 25;
        double gsd_m_per_px = 0;
    };

    /// `folder` is shared by all scenes. Touches nothing yet.
    SceneFrameCache(std::string scene, const std::filesystem::path& folder);
    ~SceneFrameCache();

    /// The scene as a video. Throws Error(parameter) for an unknown scene.
    std::unique_ptr<FrameSource> open();
    /// Throws Error(parameter) for an unknown scene.
    Facts facts();
    /// Gray and colour.
    Frame frame(FrameIndex index);

 private:
    const SceneRenderer& renderer();
    std::filesystem::path fileOf(FrameIndex index) const;

    std::string scene_;
    std::filesystem::path parent_;
    std::filesystem::path folder_;
    std::mutex mutex_;  ///< guards the making of the renderer
    std::unique_ptr<const SceneRenderer> renderer_;
};

/// Where scenes are kept: `<user's cache folder>/eyrie/scenes`.
std::filesystem::path sceneFolder();

}  // namespace eyrie::ui

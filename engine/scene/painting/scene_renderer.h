#pragma once

#include <memory>
#include <opencv2/core/matx.hpp>
#include <vector>

#include "core/geometry/homography.h"
#include "core/values/frame.h"
#include "scene/scene_description.h"
#include "scene/scene_truth.h"

namespace eyrie {

/// A painted frame with its exact ground truth.
struct RenderedFrame {
    Frame frame;  ///< gray and colour are always there
    std::vector<SceneObject> truth;
    cv::Matx33d frame_from_ground;  ///< m on the ground → px; of any scale
    Homography first_from_frame;    ///< px → px in frame 0
};

/// Paints the frames of a scene and knows their truth. Frames may be asked for in any order and from several threads
/// at once; equal descriptions give equal frames.
class SceneRenderer {
 public:
    /// Paints the ground (a second or two for a large scene). Throws Error when the description contradicts itself.
    explicit SceneRenderer(SceneDescription scene);
    ~SceneRenderer();
    SceneRenderer(SceneRenderer&&) noexcept;
    SceneRenderer& operator=(SceneRenderer&&) noexcept;

    const SceneDescription& scene() const;
    int frameCount() const;
    /// Frame `index` in [0, frameCount()); throws Error(parameter) outside.
    RenderedFrame render(FrameIndex index) const;

    /// Parts of `render`, without painting.
    std::vector<SceneObject> truth(FrameIndex index) const;
    cv::Matx33d frameFromGround(FrameIndex index) const;
    Homography firstFromFrame(FrameIndex index) const;

 private:
    struct World;
    std::unique_ptr<const World> world_;
};

}  // namespace eyrie

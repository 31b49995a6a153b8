#pragma once

#include <vector>

#include "core/geometry/oriented_box.h"
#include "scene/scene_description.h"
#include "scene/towns/static_world.h"

namespace eyrie {

/// One object of the ground truth in one frame.
struct SceneObject {
    int id = 0;
    ObjectKind kind = ObjectKind::car;
    OrientedBox box;             ///< smallest box along the heading around the whole body as seen in the image, px
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, in image axes
    double speed = 0;            ///< m/s, mean over ten frames before and after
    double visibility = 1;       ///< share of the body that nothing standing hides, 0 … 1
    double inside = 1;           ///< share of the box that lies in the image, 0 … 1
    bool ignore = false;         ///< standing, less than 60 % in the image, less than 40 % visible, or tiny
};

/// Finds the truth of frames without painting them.
class SceneTruth {
 public:
    /// Both must outlive this object.
    SceneTruth(const SceneDescription& scene, const std::vector<StandingThing>& things);

    /// Everything of the truth that touches the image in a frame of the video, by id.
    std::vector<SceneObject> objects(FrameIndex frame) const;
    /// The same at a moment of the scene's clock, without testing what hides what (visibility 1).
    std::vector<SceneObject> objectsOnOpenGround(FrameIndex clock) const;

 private:
    std::vector<SceneObject> collect(FrameIndex clock, bool with_visibility) const;
    double visibilityOf(const MovingObject& object, const ObjectPose& pose, cv::Point3d camera) const;

    const SceneDescription& scene_;
    const std::vector<StandingThing>& things_;
    std::vector<std::vector<cv::Point3d>> bodies_;  ///< corners of each object's body
};

}  // namespace eyrie

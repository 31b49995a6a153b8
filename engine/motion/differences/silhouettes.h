#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "core/parameter.h"
#include "core/values/frame.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/differences/registered_frames.h"
#include "motion/vectors/vector_groups.h"

namespace eyrie {

/// Parameters of silhouettes.
struct SilhouetteOptions {
    bool silhouettes = true;
    int silhouette_frames = 28;          ///< pictures kept to see the ground before a vehicle came
    double silhouette_contrast = 16;     ///< grey values by which a vehicle differs from the ground under it …
    double silhouette_noise_factor = 4;  ///< … and times the spread of the ground's own brightness over time
    double silhouette_min_speed_m_s = 2.5;
    double silhouette_max_length_m = 18;  ///< larger silhouettes are no single vehicle
    double silhouette_max_width_m = 3.4;

    void describe(ParameterVisitor& visitor);
};

/// Infers the motion of plain roofs. A roof without corners has no motion vectors, and its vehicle comes apart. But
/// where a moving vehicle is, the picture differs from the same ground before the vehicle came; so its silhouette is
/// grown from the corners that move to all that differs and is no shadow, and its outline gets vectors that move like
/// them. Only as far as the ground was seen: not ahead of the corners, and not on vehicles so slow that they stood
/// there in all pictures kept.
class Silhouettes {
 public:
    Silhouettes(const SilhouetteOptions& options, const SceneScale& scale);

    /// Takes the next frame, failed and repeated ones, too; without a picture everything is forgotten.
    void add(const Frame& frame, const Registration& registration);
    void clear() { frames_.clear(); }
    /// Sets the scale of the frames from now on; the frame rate stays.
    void setScale(const SceneScale& scale) { scale_ = scale; }
    /// Vectors on the outlines of the silhouettes in the newest frame, with ids above those of all corners and of age
    /// 0. `vectors` are those of corners, `chosen` the indices of those that lie on vehicles, the deviation of the
    /// background's speed is in px/frame.
    std::vector<MotionVector> infer(const std::vector<MotionVector>& vectors, const std::vector<int>& chosen,
                                    double background_speed_sigma);

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    class Past;
    /// Places (px) on the outline of the silhouette around the corners of one group; none where there is no silhouette.
    std::vector<cv::Point2d> outlineAround(const VectorGroup& group, const std::vector<cv::Point2d>& corners,
                                           const Past& past) const;

    SilhouetteOptions options_;
    SceneScale scale_;
    RegisteredFrames frames_;
    CornerId next_id_;
};

}  // namespace eyrie

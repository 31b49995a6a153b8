#pragma once

#include <functional>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/vectors/shadow_test.h"

namespace eyrie {

/// Decides which motion vectors that look like a shadow's outline are one. A dark car looks the same, corner by corner;
/// but a shadow lies beside a vehicle that moves like it and reaches only so far from it, and a dark car stands alone.
class ShadowOwners {
 public:
    using LitUpTo = std::function<bool(const OrientedBox& vehicle, cv::Point2f corner)>;

    ShadowOwners(const ShadowTestOptions& options, const SceneScale& scale);

    /// For every vector whether it belongs to a cast shadow. `looks_like_shadow`: 1 where ShadowTest says so.
    /// `lit_up_to(vehicle, corner)`: whether lit ground parts them; see ShadowTest.
    std::vector<char> castShadows(const std::vector<MotionVector>& vectors, const std::vector<char>& looks_like_shadow,
                                  double background_speed_sigma, const LitUpTo& lit_up_to = {}) const;

 private:
    ShadowTestOptions options_;
    SceneScale scale_;
};

}  // namespace eyrie

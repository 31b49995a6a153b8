#pragma once

#include <opencv2/core/types.hpp>
#include <vector>

#include "scene/painting/mesh.h"
#include "scene/scene_description.h"

namespace eyrie {

/// A thing that stands: building, block, post, parked vehicle, tree.
struct StandingThing {
    cv::Point2d centre;
    double reach = 0;   ///< m: nothing of it stands farther from `centre` on the map
    double height = 0;  ///< m: nothing of it is higher
    Mesh mesh;
    std::vector<Ball> balls;                        ///< leaves
    std::vector<std::vector<cv::Point2d>> shadows;  ///< of parked vehicles: painted with each frame
    double sway = 0;                                ///< m: how far the wind moves the leaves
    double sway_phase = 0;                          ///< radians
};

/// Everything that stands, in world coordinates.
std::vector<StandingThing> standingThings(const SceneDescription& scene);

/// Outlines on the ground of the shadows of everything that stands but parked vehicles. Theirs are painted with each
/// frame: bodies look up in the ground map whether the sun reaches them, and would find their own shadow there.
std::vector<std::vector<cv::Point2d>> staticShadows(const SceneDescription& scene);

/// The clumps of leaves of a tree's crown; `direct`: share of the sun's (at night the lamps') light that reaches it.
std::vector<Ball> crownOf(const Tree& tree, const Sun& sun, cv::Vec3f direct = {1, 1, 1});

/// Outlines of the shadow that a mesh's solids cast.
std::vector<std::vector<cv::Point2d>> shadowsOf(const Mesh& mesh, cv::Point2d shadow_per_metre);

}  // namespace eyrie

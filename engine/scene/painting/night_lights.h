#pragma once

#include <opencv2/core/types.hpp>
#include <utility>
#include <vector>

#include "scene/painting/mesh.h"
#include "scene/scene_description.h"

/// What shines at night.
namespace eyrie {

constexpr double kLampReach = 32;  ///< m: no light of a street lamp farther away

/// The ground point below a street lamp's light.
cv::Point2d lightOf(const LampPost& post);

/// Light on the ground `away` from the point below a lamp of this height, 1 right below it.
double lampLight(cv::Point2d away, double height);

/// Light of all street lamps at a ground point, as a share of full sunlight, at most 1.
double lampLightAt(const SceneDescription& scene, cv::Point2d point);

/// The lamps that a vehicle carries.
std::vector<Ball> lampsOf(const ObjectLook& look, const ObjectPose& pose);

/// Areas on the ground before a vehicle, one within the other, and the light that each adds; 1 altogether.
std::vector<std::pair<std::vector<cv::Point2d>, double>> beamsOf(const ObjectLook& look, const ObjectPose& pose);

}  // namespace eyrie

#pragma once

#include "scene/painting/mesh.h"
#include "scene/random.h"
#include "scene/scene_description.h"

namespace eyrie {

/// The body of a vehicle or person: x forward, y to its right, z up, origin on the ground below the centre. Its
/// corners span exactly `look.length` × `look.width`.
Mesh bodyOf(const ObjectLook& look);

/// The body standing at a pose in the world.
Mesh placed(const Mesh& body, const ObjectPose& pose);
cv::Point3d placed(cv::Point3d point, const ObjectPose& pose);

/// A usual specimen of the kind: size and colour as found on European streets.
ObjectLook randomLook(ObjectKind kind, Random& random);

/// A kind of vehicle as often as in town traffic: mostly cars.
ObjectKind randomVehicleKind(Random& random);

}  // namespace eyrie

#pragma once

#include "scene/scene_description.h"

namespace eyrie {

/// A plain square seen straight from above, 0.3 m/px, without noise, blur, veil, shadows or motion: what tests compare
/// against. Frame centre = world origin.
SceneDescription plainScene(int frame_count = 3);

/// An object that drives straight on at constant speed through `start` at frame 0.
MovingObject driving(int id, ObjectLook look, cv::Point2d start, double heading, double metres_per_second,
                     int frame_count, double frame_rate_hz = 25);

ObjectLook busLook();
ObjectLook carLook();

}  // namespace eyrie

#pragma once

#include <vector>

#include "core/geometry/control_point.h"
#include "store/project/project_file.h"

namespace eyrie {

/// The control points of a video, in the order in which they were given. Throws Error(project).
std::vector<ControlPoint> readControlPoints(ProjectFile& project, int sequence_id);
/// Replaces them all. Throws Error(project | output).
void replaceControlPoints(ProjectFile& project, int sequence_id, const std::vector<ControlPoint>& points);
/// The same, unless they are others than `before` by now, because another program changed them: then it answers false
/// and changes nothing.
bool exchangeControlPoints(ProjectFile& project, int sequence_id, const std::vector<ControlPoint>& before,
                           const std::vector<ControlPoint>& after);

/// Whether a point can be stored and read: finite, and on the earth.
bool isPossible(const ControlPoint& point);

}  // namespace eyrie

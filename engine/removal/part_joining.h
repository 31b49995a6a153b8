#pragma once

#include <vector>

#include "core/parameter.h"
#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "removal/removal_trace.h"

namespace eyrie {

/// Parameters of joining the parts of one vehicle. Plain roofs carry no corners, so front and rear of a vehicle may
/// come as two detections that move alike.
struct PartJoiningOptions {
    bool join_parts = true;
    double part_car_length_m = 5.5;        ///< parts whose union is no longer than a car are joined
    double part_length_m = 2.5;            ///< two parts shorter than this …
    double part_vehicle_length_m = 13;     ///< … are joined up to the length of a bus
    double part_vehicle_width_m = 3.2;     ///< largest width of the union
    double part_silhouette_gap_m = 1.0;    ///< parts on one silhouette without a larger gap are joined …
    double part_silhouette_length_m = 18;  ///< … up to this length
    double part_velocity_floor = 0.04;     ///< px/frame the parts' velocities may differ by …
    double part_velocity_share = 0.05;     ///< … or this share of the speed
    double part_max_turn_deg = 20;         ///< largest difference of headings

    void describe(ParameterVisitor& visitor);
};

/// Fuses parts of one vehicle into their union, the closest pair first. The second of a pair stays in the list with
/// Rejection::duplicate. Velocities become the mean weighted by area; the vectors that detections hold are not touched.
/// `motion` shows which parts lie on one silhouette. `trace`, if given, is added to.
std::vector<Detection> joinParts(std::vector<Detection> detections, const FrameMotion& motion,
                                 const PartJoiningOptions& options, const SceneScale& scale,
                                 RemovalTrace* trace = nullptr);

}  // namespace eyrie

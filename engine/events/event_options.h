#pragma once

#include "core/parameter.h"

namespace eyrie {

/// From when on something is an event. Physical units: without a known GSD the scale that the run worked with makes
/// pixels of them.
struct EventOptions {
    // how motion is measured
    double smooth_s = 1.0;
    double noise = 0.3;  ///< px
    double standing_speed_kmh = 2.5;
    double moving_speed_kmh = 6;
    double min_standing_s = 1;
    double min_way_m = 2;
    // the picture's border and the ends of what was searched
    double border_time_s = 0.6;
    double border_distance_m = 1;
    double edge_time_s = 1;
    // one vehicle
    double stands_s = 3;
    double turn_back_angle_deg = 150;
    double turn_back_time_s = 30;
    double turn_back_way_m = 8;
    double turn_back_offset_m = 30;
    double over_kmh = 100;
    double over_time_s = 1;
    double under_kmh = 12;
    double under_time_s = 5;
    double loiter_radius_m = 30;
    double loiter_time_s = 60;
    // among others
    double flow_radius_m = 2;
    int flow_tracks = 5;
    double flow_share = 0.2;
    double arrow_radius_m = 2.5;
    double against_angle_deg = 120;
    double flow_way_m = 10;
    double off_flow_m = 5;
    double off_flow_seen_s = 10;
    int convoy_vehicles = 3;
    double convoy_time_s = 15;
    double convoy_headway_s = 5;
    double convoy_lane_m = 2.5;
    double convoy_spread = 0.5;
    double meeting_distance_m = 3;
    double meeting_time_s = 5;
    double meeting_angle_deg = 45;
    // zones and lines
    double zone_margin_m = 0.5;

    void describe(ParameterVisitor& visitor);
};

}  // namespace eyrie

#include "motion/clusters/motion_clustering.h"

namespace eyrie {

MotionClusteringOptions MotionClusteringOptions::thesis() {
    MotionClusteringOptions options;
    options.along_m = 3.0;
    options.across_m = 3.0;
    options.roof_length_m = 0;
    options.min_distance = options.min_distance_far = 0;  // distances follow the GSD alone
    options.velocity_share = 0.1;
    options.velocity_noise_factor = 0;
    options.min_members = 1;  // how many vectors an object has is asked by T_out alone
    options.min_density_share = 0;
    options.margin = 0;
    options.split_width_m = 0;
    options.split_length_m = 0;
    options.max_length_m = 0;
    options.max_width_m = 0;
    return options;
}

void MotionClusteringOptions::describe(ParameterVisitor& visitor) {
    const ParameterDeclarer declare(visitor, ChainStage::clustering);
    declare.real("clustering.along", along_m, 0.1, 50,
                 {"m",
                  "Motion vectors are linked up to this distance along their motion. Larger: long vehicles stay "
                  "whole, vehicles one behind the other merge.",
                  "Teutsch §4.2"});
    declare.real("clustering.across", across_m, 0.1, 50,
                 {"m", "Motion vectors are linked up to this distance across their motion. Larger: lanes merge.",
                  "Teutsch §4.2"});
    declare.real("clustering.roof_length", roof_length_m, 0, 50,
                 {"m",
                  "Up to this distance along their motion, vectors that move twice as alike are linked when no "
                  "standing corner lies between them: front and rear of a plain roof. 0: off.",
                  ""});
    declare.real("clustering.min_distance", min_distance, 0, 100,
                 {"px", "Lowest linkage distance, whatever the ground sampling distance.", ""});
    declare.real("clustering.min_distance_far", min_distance_far, 0, 100,
                 {"px",
                  "Lowest linkage distance where a view at an angle shows ground farther away than its middle: there "
                  "corners are sparse for the size of vehicles. Counts where it is more than clustering.min_distance.",
                  ""});
    declare.real("clustering.velocity_share", velocity_share, 0, 1,
                 {"",
                  "Linked vectors may differ in velocity by this share of their speed. About 0.03 for oblique views, "
                  "0.08 for turning vehicles.",
                  ""});
    declare.real("clustering.velocity_floor", velocity_floor, 0, 5,
                 {"px/frame", "Linked vectors may always differ in velocity by this.", ""});
    declare.real("clustering.velocity_noise_factor", velocity_noise_factor, 0, 10,
                 {"",
                  "Linked vectors may always differ in velocity by this many deviations of the background's residual "
                  "speed, too.",
                  ""});
    declare.real("clustering.velocity_noise_limit", velocity_noise_limit, 0, 5,
                 {"px/frame", "The background's noise does not raise the allowed difference beyond this.", ""});
    declare.integer("clustering.min_members", min_members, 1, 1000, {"vectors", "Smaller clusters are dropped.", ""});
    declare.real("clustering.min_density_share", min_density_share, 0, 2,
                 {"",
                  "Clusters with fewer than this share of the vectors expected on a car, at the corner density of the "
                  "frame, are dropped. 0 switches it off.",
                  ""});
    declare.integer("clustering.max_min_members", max_min_members, 1, 1000,
                    {"vectors", "However dense the corners are, that many vectors are enough for a cluster.", ""});
    declare.real("clustering.margin", margin, 0, 20,
                 {"px", "The box around the members is grown by this on every side.", ""});
    declare.real(
        "clustering.split_width", split_width_m, 0, 500,
        {"m",
         "Clusters wider than this are linked again, more and more tightly, until they fall into single vehicles. "
         "0: never.",
         ""});
    declare.real("clustering.split_length", split_length_m, 0, 500,
                 {"m", "Clusters longer than this, too. Small values cut trucks. 0: never.", ""});
    declare.real("clustering.max_length", max_length_m, 0, 500, {"m", "Longer clusters are dropped; 0: no limit.", ""});
    declare.real("clustering.max_width", max_width_m, 0, 500, {"m", "Wider clusters are dropped; 0: no limit.", ""});
}

}  // namespace eyrie

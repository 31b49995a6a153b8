#pragma once

#include "core/parameter.h"
#include "core/values/scene_scale.h"

namespace eyrie {

/// How split and merged detections are recognised (Teutsch §6.2.1, §6.3).
enum class SplitMergeRule {
    none,            ///< not at all: the best fitting pairs are taken
    overlap_matrix,  ///< two ones in a row or column of M_tov, as in the thesis
    containment      ///< parts lie in the predicted box; a merged box covers several predicted boxes and is larger
};

/// Which lost tracks are looked for by what they looked like.
enum class AppearanceUse {
    none,
    stopped,  ///< vehicles that were slow when they got lost
    lost      ///< all reliable ones
};

/// The size of a box that motion vectors rebuild.
enum class RebuiltSize {
    predicted,  ///< the track's own; only the place is measured
    stored      ///< the median of what the vectors stored, each box placed by its vector's own heading; it is
                ///< measured like a detection, as in the thesis
};

/// Parameters of the tracker (Teutsch ch. 6). Metres are turned into pixels once, in the tracker's constructor; pixel
/// values beside them are floors for noise that does not shrink with the object.
struct TrackerOptions {
    // Association of detections.
    double min_overlap = 0.2;
    double distance_gate_m = 0.6;
    double distance_gate_px = 2.0;
    bool visible_overlap = true;
    double max_turn_deg = 90;
    SplitMergeRule split_merge = SplitMergeRule::containment;
    double part_containment = 0.6;
    int split_patience = 8;
    double size_gate = 1.8;
    int size_patience = 10;
    double car_length_m = kCarLength_m;
    double car_width_m = kCarWidth_m;
    double one_vehicle = 1.3;  ///< times the usual car

    // Association of motion vectors and reconstruction.
    bool use_vectors = true;
    bool vectors_first = false;
    RebuiltSize rebuilt_size = RebuiltSize::predicted;
    int max_vectors = 20;
    int min_vectors = 2;
    double agreement = 1.0 / 3;
    double vector_speed_difference = 0.25;
    double relative_position_gain = 0.3;
    int max_reconstructed = 10;
    int supported_hits = 20;
    double max_supported_s = 1.0;

    // Life of a track.
    int confirm_hits = 5;
    int confirm_window = 8;
    int confirm_whole = 2;
    bool follow_rate = true;
    int max_missing_tentative = 2;
    double max_missing_s = 0.3;
    double stop_speed_m_s = 2.0;
    double max_stopped_s = 1.0;
    double max_leaving_s = 3.0;
    AppearanceUse appearance = AppearanceUse::stopped;
    double appearance_agreement = 0.7;
    double appearance_margin = 0.1;
    double max_hidden_s = 2;
    double max_standing_s = 600;
    double max_failed_s = 0.5;
    double min_visible = 0.02;
    bool suppress_duplicates = true;
    double duplicate_overlap = 0.4;
    double duplicate_containment = 0.7;

    // What detections tell the Kalman filter.
    bool complete_at_border = true;
    bool adapt_size = true;
    bool measure_velocity = true;

    // Its noise.
    double acceleration_m_s2 = 4.0;
    double turn_rate_deg = 40;
    double size_rate_m = 0.02;
    double position_noise_m = 0.12;
    double position_noise_px = 0.5;
    double size_noise_m = 0.4;
    double size_noise_px = 1.0;
    double heading_noise_deg = 4;
    double velocity_noise_m_s = 0.4;
    double velocity_noise_px = 0.05;
    double slow_speed_sigmas = 5;

    void describe(ParameterVisitor& visitor);
    /// The text of the thesis to the letter, with its optima.
    static TrackerOptions thesis();
    /// What holds for a video: below 8⅓ frames per second `confirm_hits` shrinks with the rate, to 4 at the least,
    /// where `follow_rate` says so; elsewhere `confirm_whole` is 0.
    TrackerOptions atRate(double frame_rate_hz) const;
    /// Detections without which no track can become reliable.
    int fewestDetections() const;
};

}  // namespace eyrie

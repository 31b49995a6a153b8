#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/values/track_state.h"
#include "tracking/association/vector_association.h"
#include "tracking/box_kalman_filter.h"
#include "tracking/vehicle_template.h"

namespace eyrie {

/// What is known of a vehicle that may stand or stands. Its place is fixed to the ground: registration carries it.
struct Standstill {
    bool begun = false;    ///< seen by its look alone since it was lost
    bool certain = false;  ///< long enough at one place to be taken to stand
    bool agrees = false;   ///< the picture at its place looks like it, as far as was looked last
    OrientedBox place;
    int still = 0;   ///< frames at this place until it is certain
    int frames = 0;  ///< frames since it is certain
    int hidden = 0;  ///< frames in a row in which the place looks different
    int away = 0;    ///< looks in a row that found it beside its place

    template <class Archive>
    void transfer(Archive& archive);
};

/// A living track inside the tracker.
struct Track {
    TrackId id = 0;
    BoxKalmanFilter filter;
    TrackStatus status = TrackStatus::tentative;
    StateOrigin origin = StateOrigin::detected;
    std::vector<AssociatedVector> vectors;
    std::uint64_t history = 1;     ///< one bit a frame, the newest lowest: detected
    int age = 0;                   ///< frames since the first detection
    int hits = 1;                  ///< frames with a real detection
    int missing = 0;               ///< frames since the last real detection
    int reconstructed_streak = 0;  ///< rebuilt boxes since the last real detection
    int predicted_streak = 0;      ///< frames without any evidence
    int size_streak = 0;           ///< detections in a row beyond the size gate
    int growth_streak = 0;         ///< detections in a row that reach beyond the box
    int whole_hits = 0;            ///< detections in one piece
    int parts_streak = 0;          ///< frames in separate parts, less those in one piece
    int abreast_streak = 0;        ///< the same, for parts side by side
    bool merged = false;           ///< its detection covers other tracks, too
    bool stopped = false;          ///< lost while slow
    bool recognised = false;       ///< without a detection in this frame, but found by its appearance
    int recognised_streak = 0;     ///< frames in a row
    int whole_boxes = 0;           ///< detections that a classifier took for a whole vehicle
    cv::Point2d origin_place;      ///< where it was first detected, carried along with the ground, px
    std::optional<VehicleTemplate> look;
    Standstill standstill;

    explicit Track(const BoxMeasurement& first) : filter(first), origin_place(first.box.centre) {}
    /// As the rest of the chain sees it.
    TrackState state() const;

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);
};

}  // namespace eyrie

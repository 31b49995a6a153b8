#pragma once

#include <vector>

#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "core/values/track_state.h"
#include "tracking/measurement_model.h"
#include "tracking/standing_vehicles.h"
#include "tracking/track.h"
#include "tracking/track_manager.h"
#include "tracking/track_vectors.h"
#include "tracking/tracker_options.h"
#include "tracking/tracking_trace.h"

namespace eyrie {

/// Follows objects from frame to frame by their detections and motion vectors (Teutsch ch. 6, fig. 6.6).
class Tracker {
 public:
    /// Throws Error(parameter) when the scale is not positive and finite.
    Tracker(const TrackerOptions& options, const SceneScale& scale);

    /// The states of all living tracks in this frame, tentative ones too, in ascending id. Detections that were
    /// rejected or are not finite are ignored. Frames must come in order; in a frame whose registration failed all
    /// tracks are predicted, in a frozen one nothing moves, and after a cut all tracks end. `trace`, if given, receives
    /// how detections and tracks were joined.
    std::vector<TrackState> next(const FrameMotion& motion, const std::vector<Detection>& detections,
                                 TrackingTrace* trace = nullptr, const PictureOfFrame& picture = {});

    /// Forgets all tracks; ids start from 1 again.
    void reset();

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// Sets what follows from the scale in a frame.
    void zoomTo(double zoom);
    void coastThroughFrozen();
    void coastThroughFailed(const FrameMotion& motion);
    void follow(const FrameMotion& motion, const std::vector<Detection>& detections, TrackingTrace* trace,
                const PictureOfFrame& picture);
    void predict(const FrameMotion& motion);
    std::vector<MovingBox> predictedBoxes() const;
    OverlapMatrix overlapMatrix(const std::vector<MovingBox>& detected, const std::vector<MovingBox>& predicted,
                                cv::Size image) const;
    FrameAssociation associate(const OverlapMatrix& matrix, const std::vector<MovingBox>& detected,
                               const std::vector<MovingBox>& predicted) const;
    void traceAssociation(const OverlapMatrix& matrix, const FrameAssociation& association,
                          const std::vector<MovingBox>& predicted, const std::vector<int>& positions,
                          TrackingTrace& trace) const;
    void traceEnds(cv::Size image, TrackingTrace& trace) const;
    void updateTrack(Track& track, const TrackAssociation& association, const std::vector<const Detection*>& detections,
                     const TrackVectors& carried);
    bool updateByDetection(Track& track, const OrientedBox& box, const Detection& detection);
    void startTracks(const std::vector<const Detection*>& detections, const std::vector<char>& used,
                     std::vector<std::vector<AssociatedVector>> first_vectors, const std::vector<int>& positions,
                     TrackingTrace* trace);

    /// px that a detection may lie from where a track at a place is expected; 0: no gate.
    double gateAt(cv::Point2d place) const;

    TrackerOptions options_;
    SceneScale first_scale_;  ///< of the first frame
    double zoom_ = 1;         ///< of the frame in hand
    SceneScale scale_;        ///< likewise
    MeasurementModel model_;
    TrackManager manager_;
    std::vector<Track> tracks_;
    TrackId next_id_ = 1;
    int frozen_frames_ = 0;  ///< in a row, up to now
    int failed_frames_ = 0;  ///< in a row, up to now
    int frames_ = 0;
    bool classified_ = false;  ///< detections of a classifier were seen
};

}  // namespace eyrie

#pragma once

#include <functional>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "tracking/measurement_model.h"
#include "tracking/track.h"
#include "tracking/track_manager.h"
#include "tracking/tracker_options.h"

namespace eyrie {

/// The grey picture of the frame, CV_8UC1. Asked for only where a vehicle stops or stands, so that detections can be
/// tracked anew without reading the whole video.
using PictureOfFrame = std::function<cv::Mat()>;

/// Asks for the picture when it is first needed. Refers to the source, which must outlive it.
class PictureWhenNeeded {
 public:
    explicit PictureWhenNeeded(const PictureOfFrame& source) : source_(source) {}
    const cv::Mat& gray() {
        if (!asked_ && source_) gray_ = source_();
        asked_ = true;
        return gray_;
    }

 private:
    const PictureOfFrame& source_;
    cv::Mat gray_;
    bool asked_ = false;
};

/// Keeps vehicles that stop, for one frame: by what they looked like when they were last detected. All it refers to
/// must outlive it; what is remembered is in the tracks.
class StandingVehicles {
 public:
    /// `classified`: see TrackManager.
    StandingVehicles(const TrackerOptions& options, const TrackManager& manager, const MeasurementModel& model,
                     bool classified)
        : options_(options), manager_(manager), model_(model), classified_(classified) {}

    /// Looks whether those that stand are still there, before detections are joined with tracks.
    void lookAtPlaces(std::vector<Track>& tracks, const std::vector<MovingBox>& detected, int frames,
                      PictureWhenNeeded& picture) const;
    /// Looks for a track that has no evidence, after detections and vectors were: `reach` px around its prediction.
    void lookAround(Track& track, PictureWhenNeeded& picture, double reach) const;

 private:
    void keep(Track& track) const;
    std::optional<OrientedBox> found(const Track& track, PictureWhenNeeded& picture, const OrientedBox& expected,
                                     double reach) const;

    const TrackerOptions& options_;
    const TrackManager& manager_;
    const MeasurementModel& model_;
    bool classified_;
};

}  // namespace eyrie

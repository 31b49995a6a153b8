#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "core/values/scene_scale.h"
#include "tracking/association/split_merge.h"
#include "tracking/track.h"
#include "tracking/tracker_options.h"
#include "tracking/tracking_trace.h"

namespace eyrie {

/// Life and death of tracks (Teutsch §6.4): tentative, confirmed, coasting, deleted.
class TrackManager {
 public:
    TrackManager(const TrackerOptions& options, const SceneScale& scale);

    /// Counts the evidence of a frame (`track.origin`) and moves the track's status on.
    void count(Track& track, double slow_speed) const;
    /// What count() compares to confirm a track.
    TracedTentative confirmationOf(const Track& track) const;
    /// Whether the track may be rebuilt from motion vectors once more.
    bool mayBeReconstructed(const Track& track) const;
    /// Whether a track without evidence in this frame may be looked for by its appearance. `classified`: a classifier
    /// takes part, which has known vehicles when it saw them.
    bool mayBeRecognised(const Track& track, double slow_speed, bool classified) const;
    /// Whether it is worth remembering what the track looks like.
    bool worthRemembering(const Track& track, double slow_speed, bool classified) const;
    /// Counts whether a lost track was found at its place by its look, `away` px from there; nothing: not found.
    void countStandstill(Track& track, std::optional<double> away, const OrientedBox& found) const;
    /// Lets a standing track go on when its detections lead away from its place.
    void countDeparture(Track& track) const;
    /// Frames from one look at a standing vehicle to the next.
    int lookInterval() const { return look_interval_; }
    /// px from its place within which a detection may belong to a vehicle that is seen to stand there.
    static double reachOf(const OrientedBox& place);
    /// px/frame above which a detection cannot be of a vehicle that just stood.
    double fastestStart(cv::Point2d place, double slow_speed) const;
    /// Whether the track's size is known well enough to judge detections by it.
    bool established(const Track& track) const { return track.hits >= confirm_hits_; }
    /// Whether the track was in separate parts for so long that it must be several objects.
    bool givesUpParts(const Track& track) const;
    /// What ended a track's life.
    struct End {
        const char* parameter;
        double value;  ///< frames without evidence, or share of the box in the image; compared with …
        double limit;
    };
    /// Whether the track's life is over, and why.
    std::optional<End> endOf(const Track& track, cv::Size image) const;
    bool ended(const Track& track, cv::Size image) const { return endOf(track, image).has_value(); }
    /// Deletes the younger of two tracks that lie on each other and move alike, and tracks that hold several reliable
    /// ones. `slow_speed`: px/frame below which speeds do not differ.
    void suppressDuplicates(std::vector<Track>& tracks, double slow_speed) const;
    /// The parameter by which a new box would be a duplicate of a track that has evidence in this frame; null: it would
    /// not be one.
    const char* wouldDuplicate(const OrientedBox& box, cv::Point2d velocity, const std::vector<Track>& tracks,
                               double slow_speed) const;
    /// Size of a box that holds one vehicle at most.
    const VehicleLimit& oneVehicle() const { return one_vehicle_; }
    /// Frames with failed registration after which all tracks end.
    int maxFailedFrames() const { return max_failed_; }

 private:
    /// px/frame below which the track counts as stopped.
    double stopSpeedOf(const Track& track) const;
    bool hasDriven(const Track& track, bool classified) const;
    /// The parameter by which both are one object; null: they are not.
    const char* alike(const OrientedBox& a, cv::Point2d velocity_a, const OrientedBox& b, cv::Point2d velocity_b,
                      double slow_speed) const;
    bool leaving(const Track& track, cv::Size image) const;
    std::vector<char> mergeBeliefs(const std::vector<Track>& tracks, double slow_speed) const;

    int confirm_hits_;
    int confirm_window_;
    int confirm_whole_;
    int max_missing_tentative_;
    int max_missing_;
    int max_stopped_;
    int max_standing_;
    int max_hidden_;
    int sure_hits_;
    int settle_;
    int max_creeping_;
    int look_interval_;
    AppearanceUse appearance_;
    int max_leaving_;
    int max_failed_;
    int max_reconstructed_;
    int max_supported_;
    int supported_hits_;
    int split_patience_;
    double stop_speed_m_s_;
    SceneScale scale_;
    double min_visible_;
    bool suppress_duplicates_;
    double duplicate_overlap_;
    double duplicate_containment_;
    VehicleLimit one_vehicle_;
};

}  // namespace eyrie

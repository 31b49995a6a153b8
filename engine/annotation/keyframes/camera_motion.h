#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/geometry/homography.h"
#include "core/values/corner.h"

namespace eyrie {

/// How the camera moved over the ground: maps between any two frames of a video, from the maps between neighbours.
/// Built once, never changed, safe to share between threads.
///
/// Products are kept per aligned block of frames (1, 2, 4, … long), so that a map over n frames takes 2·log2(n)
/// multiplications and depends on the frames between its ends only: its accuracy does not fade with the distance from
/// some first frame.
class CameraMotion {
 public:
    /// Knows nothing: no two frames are connected.
    CameraMotion() = default;
    /// From maps between neighbouring frames (`to_frame` = `from_frame` + 1), in any order; others, and matrices that
    /// are not finite or not invertible, are passed over and break the chain there.
    explicit CameraMotion(const std::vector<Homography>& steps);
    /// The same of a run's registration; frames whose registration failed break the chain.
    static CameraMotion fromRegistrations(const std::vector<Registration>& registrations);
    /// From maps of each frame into one common frame (as in homography.csv).
    static CameraMotion fromCommonFrame(const std::vector<Homography>& common_from_frame);
    /// A camera that stands still over [first, last].
    static CameraMotion standing(FrameIndex first, FrameIndex last);

    bool empty() const { return steps_ == 0; }
    /// Whether every frame between the two (both included) was registered onto its neighbour. A frame is connected with
    /// itself, known or not.
    bool connects(FrameIndex a, FrameIndex b) const;
    /// The map of the ground from one frame into another; nothing where they are not connected or the map degenerates.
    std::optional<Homography> map(FrameIndex from, FrameIndex to) const;

 private:
    void build(const std::vector<std::optional<cv::Matx33d>>& steps);

    FrameIndex first_ = 0;     ///< frame that the first step starts from
    std::size_t steps_ = 0;    ///< number of steps, broken ones included
    std::vector<int> broken_;  ///< broken steps before each step
    /// levels_[k][i]: product of the steps [i·2^k, (i+1)·2^k), whole blocks only
    std::vector<std::vector<cv::Matx33d>> levels_;
};

}  // namespace eyrie

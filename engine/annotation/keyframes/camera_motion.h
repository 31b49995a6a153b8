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
/// some first frame. Only for frames whose steps are known: however far apart these are, what lies between costs
/// nothing.
class CameraMotion {
 public:
    /// Knows nothing: no two frames are connected.
    CameraMotion() = default;
    /// From maps between neighbouring frames (`to_frame` = `from_frame` + 1), in any order; others, and matrices that
    /// are not finite or not invertible, are skipped and break the chain there.
    explicit CameraMotion(const std::vector<Homography>& steps);
    /// The same of a run's registration; frames whose registration failed break the chain.
    static CameraMotion fromRegistrations(const std::vector<Registration>& registrations);
    /// A camera that stands still over [first, last].
    static CameraMotion standing(FrameIndex first, FrameIndex last);

    bool empty() const { return empty_; }
    /// Whether every frame between the two (both included) was registered onto its neighbour. A frame is connected with
    /// itself, known or not.
    bool connects(FrameIndex a, FrameIndex b) const;
    /// The map of the ground from one frame into another; nothing where they are not connected or the map degenerates.
    std::optional<Homography> map(FrameIndex from, FrameIndex to) const;

 private:
    /// Products of the steps [i·2^k, (i+1)·2^k), whole blocks only, from i = `first` on.
    struct Level {
        std::size_t first = 0;
        std::vector<cv::Matx33d> blocks;
    };
    /// Steps [begin, end) none of which is missing.
    struct Stretch {
        std::size_t begin = 0;
        std::size_t end = 0;
        std::vector<Level> levels;  ///< by k
    };
    void add(std::size_t begin, std::vector<cv::Matx33d> steps);
    /// The stretch with all steps between two frames, a < b; null for none.
    const Stretch* between(FrameIndex a, FrameIndex b) const;

    FrameIndex first_ = 0;  ///< frame that step 0 starts from
    bool empty_ = true;
    std::vector<Stretch> stretches_;  ///< ascending
};

}  // namespace eyrie

#pragma once

#include <opencv2/core/types.hpp>
#include <optional>
#include <vector>

#include "core/values/ids.h"
#include "core/values/motion_vector.h"

namespace eyrie {

/// Place and direction of a master vector in one frame.
struct MasterPose {
    cv::Point2d position{0, 0};  ///< px
    double heading = 0;          ///< radians, clockwise on screen from +x
    cv::Point2d velocity{0, 0};  ///< px/frame relative to the ground, median over the related vectors
};

/// A virtual motion vector that stands for a group of real ones and owns an image stack (Teutsch §5.3). Each related
/// vector remembers where the master vector lies as seen from itself, and suggests its pose in later frames.
class MasterVector {
 public:
    MasterVector(int id, const MasterPose& pose) : id_(id), pose_(pose) {}

    int id() const { return id_; }
    const MasterPose& pose() const { return pose_; }
    /// Ids of the related vectors, ascending.
    std::vector<CornerId> related() const;

    /// Relates a vector at its present place; `direction` is its heading after smoothing by its cluster.
    void relate(const MotionVector& vector, double direction);

    /// One related vector as it is in the current frame.
    struct Suggestion {
        const MotionVector* vector = nullptr;
        double direction = 0;  ///< radians, smoothed by the vector's cluster
    };
    /// Drops the related vectors that are not among `present` and moves to the median of what the others suggest.
    /// False when none is left: the master vector is to be deleted (Teutsch §5.3.2).
    bool update(const std::vector<Suggestion>& present);

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    struct Related {
        CornerId id = 0;
        cv::Point2d offset;  // master position in the vector's own axes, px
        double turn = 0;     // master heading minus the vector's direction

        template <class Archive>
        void transfer(Archive& archive);
    };
    int id_;
    MasterPose pose_;
    std::vector<Related> related_;
};

/// Lower median; `values` must not be empty.
double lowerMedian(std::vector<double> values);
/// Median direction: the median of the turns away from the mean direction. `headings` must not be empty.
double medianHeading(const std::vector<double>& headings);

}  // namespace eyrie

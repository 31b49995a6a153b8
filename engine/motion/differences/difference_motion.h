#pragma once

#include <opencv2/core/mat.hpp>
#include <vector>

#include "core/values/frame.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "motion/differences/difference_image.h"
#include "motion/differences/difference_options.h"

namespace eyrie {

/// What moves in one frame according to a difference image.
struct DifferenceResult {
    std::vector<MotionCluster> clusters;  ///< by the place of their first pixel in reading order
    DifferenceImage difference;           ///< empty where nothing could be compared
    cv::Mat moving;                       ///< CV_8UC1, the areas, those of the clusters
    double noise = 0;                     ///< deviation of the frame's own differences, grey values
    double threshold = 0;                 ///< lowest difference that counted, grey values
};

/// Independent motion by difference images (Teutsch §2.2): stands in for the clustering of motion vectors. An area's
/// velocity is the median of the motion vectors inside; without any it is 0, and the heading that of the area's longer
/// axis. The 3-frame difference tells of the picture `gap` frames ago; areas with motion vectors are moved on to where
/// these are now, others lag. A frozen picture repeats the last answer; frames that were not registered have none.
class DifferenceMotion {
 public:
    /// `options.method` must not be `vectors`.
    DifferenceMotion(const DifferenceOptions& options, const SceneScale& scale);

    /// Frames must come in ascending order. `motion` gives the registration and the motion vectors of the frame.
    DifferenceResult next(const Frame& frame, const FrameMotion& motion);
    /// Takes a frame that nobody asks about: later ones are compared with it.
    void remember(const Frame& frame, const FrameMotion& motion) { frames_.add(frame, motion.registration); }

    /// What is remembered of the frames so far, written or read; see core/state_archive.h. To be read into one of the
    /// same options.
    template <class Archive>
    void transfer(Archive& archive);

 private:
    /// Sets what follows from the scale in a frame.
    void zoomTo(double zoom);
    DifferenceImage compare() const;
    void findClusters(const FrameMotion& motion, DifferenceResult& result) const;
    /// Frames between the picture that the areas belong to and the newest one.
    int delay() const { return options_.method == MotionMethod::three_frame_difference ? options_.gap : 0; }
    MotionCluster clusterOf(const std::vector<cv::Point>& pixels, const FrameMotion& motion) const;
    bool isGhost(const std::vector<cv::Point>& pixels, const cv::Mat& gradient) const;

    DifferenceOptions options_;
    SceneScale first_scale_;  ///< of the first frame
    SceneScale scale_;        ///< of the frame in hand
    cv::Mat opening_;
    cv::Mat closing_;
    RegisteredFrames frames_;
    DifferenceResult last_;
};

/// The frame with the difference in red and what lies outside the overlap tinted red (fig. 2.2, 4.2), CV_8UC3.
cv::Mat differenceView(const cv::Mat& gray, const DifferenceImage& difference);

}  // namespace eyrie

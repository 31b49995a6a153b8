#pragma once

#include <vector>

#include "core/parameter.h"
#include "core/values/detection.h"
#include "core/values/motion_vector.h"
#include "core/values/scene_scale.h"
#include "removal/removal_trace.h"

namespace eyrie {

/// Parameters of outlier removal (Teutsch §5.5.2).
struct OutlierRemovalOptions {
    int min_vectors = 3;              ///< T_out: detections with fewer motion vectors inside are rejected
    double min_density_share = 0.25;  ///< T_out is also this share of the vectors expected on a car
    int max_min_vectors = 12;         ///< however dense the corners are, that many are enough
    double vector_margin = 1;         ///< vectors up to this far outside count as inside: corners lie on outlines
    bool compare_velocity = true;     ///< only vectors that move like the detection count
    double min_area = 10;             ///< px², smaller boxes are rejected
    double min_length_m = 1.2;        ///< shorter boxes are rejected; 0: no limit
    double max_length_m = 30;         ///< longer boxes are rejected; 0: no limit
    double max_width_m = 10;          ///< wider boxes are rejected; 0: no limit
    bool inside_image = false;        ///< boxes that reach beyond the image are rejected

    /// The text to the letter: T_out = 4 whatever the density, boxes of at least 10 px² that lie in the image (§7.4.3).
    static OutlierRemovalOptions thesis();
    void describe(ParameterVisitor& visitor);
};

/// T_out in a frame of this density of corners. `scale`: that of the detection's place, SceneScale::at().
int vectorsNeeded(const FrameMotion& motion, const OutlierRemovalOptions& options, const SceneScale& scale);

/// The first limit of size or place that a box breaks; nothing when it is possible. `image`: size of the picture;
/// empty: everywhere is inside.
std::optional<BrokenLimit> brokenSizeLimit(const OrientedBox& box, const OutlierRemovalOptions& options,
                                           const SceneScale& scale, cv::Size image = {});

/// Why a detection that removeOutliers() has been over was rejected, or how many vectors kept it. Says `rejection` and
/// no more where something else rejected it: it is a duplicate, or the run had other rules than these.
RemovalVerdict whyRemoved(const Detection& detection, const FrameMotion& motion, const OutlierRemovalOptions& options,
                          const SceneScale& scale);

/// Rejects detections without enough motion vectors inside, of an impossible size, or (if wanted) not wholly in the
/// image; they stay in the list with Rejection::outlier or Rejection::size. Sets vectors and velocity from the vectors
/// inside, and the score of detections that have none: vectors inside per vector expected there at the corner density
/// of the frame.
std::vector<Detection> removeOutliers(std::vector<Detection> detections, const FrameMotion& motion,
                                      const OutlierRemovalOptions& options, const SceneScale& scale);

}  // namespace eyrie

#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame_result.h"
#include "core/values/scene_scale.h"
#include "motion/clusters/clustering_trace.h"
#include "removal/removal_trace.h"

namespace eyrie {

/// The box of a result that overlaps a place, and how much.
struct NearBox {
    int index = -1;      ///< into the frame's detections or tracks; −1: none overlaps
    double overlap = 0;  ///< |A ∩ B| / |A ∪ B|
};

/// What a run stored about the place where an object is, or a result was, in one frame, stage by stage.
struct BoxFacts {
    RegistrationState registration = RegistrationState::registered;
    RegistrationFailure failure;  ///< why the frame could not be registered
    SceneScale scale;             ///< at the place
    cv::Size image;               ///< px
    cv::Point2d flow;             ///< px, how the ground moves through the image at the place since the frame before

    int corners = 0;               ///< in the box, standing and moving
    int motion_vectors = 0;        ///< in the box
    cv::Point2d velocity;          ///< px/frame, mean of the motion vectors in the box
    ClusteringVerdict clustering;  ///< on the motion vectors in the box, where none of them is in a cluster
    bool by_differences = false;   ///< clusters come from difference images instead
    std::vector<int> clusters;  /**< indices of the clusters at the place, those with most motion vectors in it first */
    std::vector<int> covering;  ///< indices of the kept detections that cover half of the box or more
    NearBox kept;               ///< the kept detection that overlaps most
    NearBox rejected;           ///< the rejected one
    RemovalVerdict removal;     ///< why
    NearBox dropped;            ///< the state left out when tracks were finished
    DroppedState drop;          ///< that state
    NearBox tentative;          ///< the track that was never confirmed so far
    DroppedState unconfirmed;   ///< that track, as finishing would leave it out
    NearBox confirmed;          ///< the confirmed or coasting one
};

/// Looks places of one frame up. `upright`: enclosing upright boxes are compared, as in the evaluation.
class FrameFacts {
 public:
    FrameFacts(FrameResult result, const ChainOptions& options, const SceneScale& scale, bool upright)
        : result_(std::move(result)),
          options_(options),
          scale_(scale.zoomed(result_.motion.registration.zoom)),
          upright_(upright) {}
    BoxFacts at(const OrientedBox& box);

 private:
    void judgeClustering(BoxFacts& facts, const std::vector<int>& vectors);

    FrameResult result_;
    const ChainOptions& options_;
    SceneScale scale_;  ///< of the frame
    bool upright_;
    std::optional<ClusteringTrace> clustering_;  ///< made when it is asked for
};

}  // namespace eyrie

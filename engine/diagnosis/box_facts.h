#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chain/chain_options.h"
#include "core/values/frame_result.h"

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
    cv::Size image;               ///< px
    cv::Point2d flow;             ///< px, how the ground moves through the image at the place since the frame before

    int corners = 0;            ///< in the box, standing and moving
    int motion_vectors = 0;     ///< in the box
    cv::Point2d velocity;       ///< px/frame, mean of the motion vectors in the box
    int vectors_needed = 0;     ///< for a cluster in this frame
    std::vector<int> clusters;  /**< indices of the clusters with motion vectors or moving points in the box, those with
                                   most first */
    std::vector<int> covering;  ///< indices of the kept detections that cover half of the box or more
    NearBox kept;               ///< the kept detection that overlaps most
    NearBox rejected;           ///< the rejected one
    Rejection rejection = Rejection::none;  ///< why
    int rejected_vectors = 0;               ///< motion vectors in it
    NearBox dropped;                        ///< the state left out when tracks were finished
    DroppedState drop;                      ///< that state
    NearBox tentative;                      ///< the track that was never confirmed so far
    NearBox confirmed;                      ///< the confirmed or coasting one
};

/// Looks the place up. `upright`: enclosing upright boxes are compared, as in the evaluation.
BoxFacts factsAt(const OrientedBox& box, const FrameResult& result, const ChainOptions& options,
                 const SceneScale& scale, bool upright = false);

}  // namespace eyrie

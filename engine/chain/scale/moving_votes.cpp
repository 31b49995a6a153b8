#include "chain/scale/moving_votes.h"

#include <opencv2/core/utility.hpp>

namespace eyrie {

std::vector<ScaleVote> votesIn(const Frame& frame, const FrameMotion& motion, const MotionClustering& clustering,
                               const ScaleLooker& looker, const ScaleRange& scales) {
    const std::vector<MotionCluster> clusters = clustering.cluster(motion);
    std::vector<std::vector<ScaleVote>> votes(clusters.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(clusters.size())), [&](const cv::Range& part) {
        for (int i = part.start; i < part.end; ++i) {
            const MotionCluster& cluster = clusters[static_cast<std::size_t>(i)];
            std::vector<cv::Point2f> places;
            for (const int member : cluster.members)
                places.push_back(motion.motion_vectors[static_cast<std::size_t>(member)].position);
            votes[static_cast<std::size_t>(i)] = looker.votesOn(frame.gray, cluster.box, places, scales);
        }
    });
    std::vector<ScaleVote> given;
    for (const auto& of_cluster : votes) given.insert(given.end(), of_cluster.begin(), of_cluster.end());
    return given;
}

}  // namespace eyrie

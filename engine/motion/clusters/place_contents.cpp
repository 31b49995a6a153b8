#include "motion/clusters/place_contents.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace eyrie {

std::vector<int> vectorsAtPlace(const OrientedBox& place, const FrameMotion& motion) {
    std::vector<int> inside;
    for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
        if (place.contains(motion.motion_vectors[i].position, kOutlineMargin_px)) inside.push_back(static_cast<int>(i));
    }
    return inside;
}

std::vector<int> clustersAtPlace(const OrientedBox& place, const FrameMotion& motion,
                                 const std::vector<MotionCluster>& clusters) {
    const std::vector<int> inside = vectorsAtPlace(place, motion);
    std::vector<std::pair<std::ptrdiff_t, int>> found;  // −vectors, cluster
    for (std::size_t k = 0; k < clusters.size(); ++k) {
        const MotionCluster& cluster = clusters[k];
        const auto vectors = std::count_if(cluster.members.begin(), cluster.members.end(), [&](int member) {
            return std::binary_search(inside.begin(), inside.end(), member);
        });
        if (vectors > 0 || (cluster.members.empty() && atPlace(cluster.box, place)))
            found.emplace_back(-vectors, static_cast<int>(k));
    }
    std::sort(found.begin(), found.end());
    std::vector<int> indices;
    for (const auto& entry : found) indices.push_back(entry.second);
    return indices;
}

}  // namespace eyrie

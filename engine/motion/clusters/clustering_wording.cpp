#include "motion/clusters/clustering_wording.h"

#include "core/measure_text.h"

namespace eyrie {

std::string textOf(const ClusteringVerdict& verdict, const SceneScale& here) {
    const std::size_t linked = verdict.group.size();
    const std::string size = pxText(verdict.value, here);
    const std::string limit = pxText(verdict.limit, here);
    switch (verdict.refusal) {
        case ClusterRefusal::too_few:
            return countText(linked, "motion vector", "motion vectors") + ", " + std::to_string(verdict.needed) +
                   " are needed";
        case ClusterRefusal::not_linked:
            return std::to_string(verdict.here) + " motion vectors lie here, but only " + std::to_string(linked) +
                   " are linked";
        case ClusterRefusal::split_off:
            return "the vectors here were left over when a cluster of " + size + ", more than " + limit + ", was split";
        case ClusterRefusal::too_long:
            return "the vectors linked here are " + size + " long, " + limit + " are allowed";
        case ClusterRefusal::too_wide:
            return "the vectors linked here are " + size + " wide, " + limit + " are allowed";
        case ClusterRefusal::not_finite:
        case ClusterRefusal::none:
            break;
    }
    return {};
}

}  // namespace eyrie

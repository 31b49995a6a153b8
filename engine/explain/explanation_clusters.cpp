#include <algorithm>

#include "explain/explanation_steps.h"
#include "motion/clusters/clustering_wording.h"
#include "motion/clusters/place_contents.h"

namespace eyrie::explaining {
namespace {

std::string gapText(const LinkageGap& gap, const Linkage& linkage, const Story& story) {
    return numberText(gap.ahead) + " px ahead and " + numberText(gap.aside) + " px aside (linkage " +
           numberText(linkage.along) + " × " + numberText(linkage.across) + " px), velocities differ by " +
           story.speedText(gap.difference) + " (allowed " + numberText(gap.allowed) + ")";
}

/// How many are linked, and how many make a cluster.
std::string linkedText(const ClusteringVerdict& verdict) {
    return countText(verdict.group.size(), "motion vector is", "motion vectors are") + " linked here, " +
           std::to_string(verdict.needed) + " are needed";
}

/// Why linked vectors were too few.
void tellTooFew(Story& story, const ClusteringVerdict& verdict, const MotionClustering& clustering) {
    const FrameMotion& motion = story.evidence.result.motion;
    const Linkage linkage = clustering.linkageFor(motion.background_speed_sigma).at(story.evidence.area.centre);
    story.fail("clustering", linkedText(verdict), story.evidence.clustering.needed_parameter);
    constexpr double kNear = 10;  // linkage distances
    const LinkageGap gap = clustering.gapOutside(motion, verdict.group);
    if (gap.other >= 0 && gap.distance < kNear)
        story.note("clustering", "the next vector is " + gapText(gap, linkage, story), gap.parameter);
    const bool apart = verdict.refusal == ClusterRefusal::not_linked;
    story.decide(textOf(verdict, story.here) + (apart ? ": the next is " + gapText(gap, linkage, story) : ""),
                 verdict.parameter);
}

/// Why linked vectors are no cluster though there were enough, also before a larger one was split.
void tellRefused(Story& story, const ClusteringVerdict& verdict) {
    if (verdict.refusal != ClusterRefusal::split_off)
        story.pass("clustering", linkedText(verdict), story.evidence.clustering.needed_parameter);
    const std::string text = textOf(verdict, story.here);
    story.fail("clustering", text, verdict.parameter);
    story.decide(text, verdict.parameter);
}

/// Why vectors that lie here are in no cluster.
void tellNoCluster(Story& story, const std::vector<int>& here, const MotionClustering& clustering) {
    const ClusteringVerdict verdict =
        clustering.verdictOn(here, story.evidence.result.motion, story.evidence.clustering);
    switch (verdict.refusal) {
        case ClusterRefusal::too_few:
        case ClusterRefusal::not_linked:
            return tellTooFew(story, verdict, clustering);
        case ClusterRefusal::too_long:
        case ClusterRefusal::too_wide:
        case ClusterRefusal::split_off:
            return tellRefused(story, verdict);
        case ClusterRefusal::not_finite:
        case ClusterRefusal::none:
            break;
    }
    story.fail("clustering", "the motion vectors here are in no cluster");
    story.decide("The motion vectors here are in no cluster", {});
}

/// What held the vectors of a cluster together and what keeps the next one out.
void tellLinks(Story& story, int cluster, const MotionClustering& clustering) {
    const FrameResult& result = story.evidence.result;
    const Linkage linkage = clustering.linkageFor(result.motion.background_speed_sigma).at(story.evidence.area.centre);
    const std::vector<int>& members = result.clusters[static_cast<std::size_t>(cluster)].members;
    const LinkageGap inside = clustering.gapInside(result.motion, members);
    if (inside.other >= 0)
        story.note("clustering",
                   (inside.distance > 1 ? "front and rear of a plain roof: no standing corner in a gap of "
                                        : "held together at its weakest link by ") +
                       gapText(inside, linkage, story),
                   inside.parameter);
    constexpr double kNear = 4;  // linkage distances
    const LinkageGap outside = clustering.gapOutside(result.motion, members);
    if (outside.other < 0 || outside.distance >= kNear) return;
    const auto& groups = story.evidence.clustering.groups;
    const auto traced =
        std::find_if(groups.begin(), groups.end(), [&](const TracedGroup& group) { return group.cluster == cluster; });
    const bool split = outside.joined && traced != groups.end() && !traced->split_by.empty();
    story.note("clustering",
               "the nearest vector outside is " + gapText(outside, linkage, story) +
                   (split ? "; they came apart when a cluster that was too large was split" : ""),
               split ? traced->split_by : outside.parameter);
}

}  // namespace

bool tellClusters(Story& story, std::vector<int>& clusters) {
    const FrameResult& result = story.evidence.result;
    const OrientedBox& area = story.evidence.area;
    clusters = clustersAtPlace(area, result.motion, result.clusters);
    const bool by_vectors = story.options.difference.method == MotionMethod::vectors;
    if (clusters.empty() && !by_vectors) {
        story.fail("clustering", kNoMovingArea, "motion.method");
        story.decide(kNoMovingArea, "motion.method");
        return false;
    }
    const MotionClustering clustering(story.options.clustering, story.scale);
    if (clusters.empty()) {
        tellNoCluster(story, vectorsAtPlace(area, result.motion), clustering);
        return false;
    }
    for (const int k : clusters) {
        const MotionCluster& cluster = result.clusters[static_cast<std::size_t>(k)];
        const std::string size = story.lengthText(cluster.box.length) + " × " + story.lengthText(cluster.box.width);
        const std::string vectors = "cluster " + std::to_string(k + 1) + ": " +
                                    countText(cluster.members.size(), "motion vector", "motion vectors");
        if (!by_vectors) {
            story.pass("clustering", vectors + ", " + size, "motion.method");
            continue;
        }
        story.pass("clustering",
                   vectors + " (" + std::to_string(clustering.minMembersFor(result.motion, cluster.box.centre)) +
                       " are needed), " + size,
                   "clustering.min_members");
        tellLinks(story, k, clustering);
    }
    if (clusters.size() > 1)
        story.note("clustering", "the vectors here belong to " + std::to_string(clusters.size()) + " clusters",
                   by_vectors ? "clustering.along" : "");
    return true;
}

}  // namespace eyrie::explaining

#include "chain/scale/stretch_look.h"

#include <algorithm>
#include <opencv2/core/utility.hpp>

#include "chain/chain.h"
#include "chain/scale/camera_slope.h"
#include "core/error.h"

namespace eyrie {

StretchLooker::StretchLooker(const ChainOptions& options, const SceneScale& scale, const ScaleRange& scales)
    : options_(options),
      scale_(scale),
      scales_(scales),
      looker_(options.detection.sliding_window),
      clustering_(options.clustering, scale) {}

StretchLook StretchLooker::look(FrameSource& source, const Stretch& stretch, const std::function<bool(int)>& votes_at,
                                const std::stop_token& stop, LookProgress& progress) const {
    StretchLook look;
    MotionHalf motion_half(options_, scale_);
    CameraWay way;
    for (; look.frames < stretch.count && !stop.stop_requested(); ++look.frames) {
        Frame frame;
        try {
            frame = source.read(stretch.first + look.frames, false);
        } catch (const Error&) {
            break;
        }
        StageTimes times{};
        const FrameMotion motion = motion_half.next(frame, times);
        progress.step();
        way.add(motion.registration);
        if (!votes_at(look.frames)) continue;
        const std::vector<ScaleVote> found = votesIn(frame, motion);
        look.most_at_once = std::max(look.most_at_once, found.size());
        look.votes.insert(look.votes.end(), found.begin(), found.end());
    }
    look.steps = way.steps();
    return look;
}

std::vector<ScaleVote> StretchLooker::votesIn(const Frame& frame, const FrameMotion& motion) const {
    const std::vector<MotionCluster> clusters = clustering_.cluster(motion);
    std::vector<std::vector<ScaleVote>> votes(clusters.size());
    // Written by index, so that the result does not depend on the number of threads.
    cv::parallel_for_(cv::Range(0, static_cast<int>(clusters.size())), [&](const cv::Range& part) {
        for (int i = part.start; i < part.end; ++i) {
            const MotionCluster& cluster = clusters[static_cast<std::size_t>(i)];
            std::vector<cv::Point2f> places;
            for (const int member : cluster.members)
                places.push_back(motion.motion_vectors[static_cast<std::size_t>(member)].position);
            votes[static_cast<std::size_t>(i)] = looker_.votesOn(frame.gray, cluster.box, places, scales_);
        }
    });
    std::vector<ScaleVote> given;
    for (const auto& of_cluster : votes) given.insert(given.end(), of_cluster.begin(), of_cluster.end());
    return given;
}

}  // namespace eyrie

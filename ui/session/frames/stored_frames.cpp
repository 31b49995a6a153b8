#include "session/frames/stored_frames.h"

#include <algorithm>

#include "correction/corrected_run.h"
#include "session/frames/trail_history.h"
#include "store/runs/doubtful_tracks.h"
#include "store/runs/stored_light.h"

namespace eyrie::ui {

namespace {

constexpr std::size_t kResultBudget = std::size_t{96} << 20U;

std::size_t bytesOf(const FrameResult& result) {
    std::size_t bytes = sizeof(FrameResult) + result.motion.motion_vectors.size() * sizeof(MotionVector) +
                        result.motion.stationary_corners.size() * sizeof(cv::Point2f) +
                        result.rois.size() * sizeof(OrientedBox) + result.tracks.size() * sizeof(TrackState);
    for (const MotionCluster& cluster : result.clusters)
        bytes += sizeof(cluster) + cluster.members.size() * sizeof(int);
    for (const Detection& d : result.detections) bytes += sizeof(d) + d.vectors.size() * sizeof(int);
    return bytes;
}

}  // namespace

StoredFrames::StoredFrames(const std::filesystem::path& project, int run_id, int trail_length,
                           std::shared_ptr<const CorrectedTracks> corrected, HomographyBlocks blocks)
    : project_(ProjectFile::open(project, ProjectFile::Mode::read_only)),
      store_(project_),
      run_id_(run_id),
      trail_length_(trail_length),
      corrected_(corrected ? std::move(corrected) : std::make_shared<const CorrectedTracks>()),
      results_(kResultBudget),
      blocks_(blocks) {
    if (const auto run = store_.run(run_id)) scale_ = run->scale;
}

void StoredFrames::addTo(ViewFrame& frame) {
    frame.result = result(frame.index);
    if (!frame.result) return;
    if (frame.image.isNull()) frame.time_us = frame.result->motion.time_us;
    frame.scale = scale_.zoomed(frame.result->motion.registration.zoom);
    frame.doubtful = store_.doubtful().statesIn(run_id_, frame.index);
    frame.shadow = StoredLight(project_).shadowIn(run_id_, frame.index);
    frame.trails = trails(frame.index);
}

bool StoredFrames::prepare(FrameIndex frame) {
    return result(frame) != nullptr;
}

std::shared_ptr<const FrameResult> StoredFrames::result(FrameIndex frame) {
    if (const auto* known = results_.find(frame)) return *known;
    auto stored = store_.frameResult(run_id_, frame);
    // A frame that is missing may still come: the run may be at work. So only what exists is remembered.
    if (!stored) return nullptr;
    stored->tracks = corrected_->in(frame, std::move(stored->tracks));
    auto shared = std::make_shared<const FrameResult>(std::move(*stored));
    results_.put(frame, shared, bytesOf(*shared));
    return shared;
}

const Homography* StoredFrames::homography(FrameIndex frame) {
    // Of a run of hours only what lies about the frames looked at is read, and kept.
    const int number = frame / blocks_.frames;
    if (!homographies_.contains(number) && homographies_.size() >= blocks_.most) homographies_.clear();
    HomographyBlock& block = homographies_[number];
    if (!block.known.contains(frame)) {
        const FrameIndex first = std::max(block.next, number * blocks_.frames);
        for (Homography& h : store_.homographies(run_id_, first, (number + 1) * blocks_.frames - 1)) {
            block.next = h.to_frame + 1;
            block.known[h.to_frame] = h;
        }
    }
    const auto found = block.known.find(frame);
    return found == block.known.end() ? nullptr : &found->second;
}

std::vector<Trail> StoredFrames::trails(FrameIndex frame) {
    if (trail_length_ < 2) return {};
    TrailHistory history(trail_length_);
    TrailStep step;
    const auto finish = [&](FrameIndex index) {
        if (const Homography* known = homography(index)) step.current_from_previous = *known;
        step.frame = index;
        history.add(std::move(step));
        step = {};
    };
    FrameIndex current = -1;
    std::vector<TrackFrame> states = trackStatesUpTo(store_, run_id_, frame, trail_length_, *corrected_);
    const auto doubtful = store_.doubtful().statesUpTo(run_id_, frame, trail_length_);
    const auto kept = static_cast<std::ptrdiff_t>(states.size());
    states.insert(states.end(), doubtful.begin(), doubtful.end());
    std::inplace_merge(states.begin(), states.begin() + kept, states.end(),
                       [](const TrackFrame& a, const TrackFrame& b) {
                           return std::pair(a.frame, a.state.id) < std::pair(b.frame, b.state.id);
                       });
    for (const TrackFrame& state : states) {
        for (; current >= 0 && current < state.frame; ++current) finish(current);
        current = state.frame;
        step.centres.emplace_back(state.state.id, cv::Point2f(state.state.box.centre));
    }
    for (; current >= 0 && current <= frame; ++current) finish(current);
    return history.trails();
}

}  // namespace eyrie::ui

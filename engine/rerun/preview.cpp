#include "rerun/preview.h"

#include <algorithm>
#include <utility>

#include "chain/chain.h"
#include "chain/parameter_stage.h"
#include "core/error.h"
#include "tracking/tracker.h"

namespace eyrie {
namespace {

constexpr std::size_t kMostFrames = 160;  ///< kept in memory
constexpr double kSameTrack = 0.3;        ///< overlap from which a previewed track is the run's

bool reachesBack(const ChainOptions& options) {
    return options.stacking.enabled || options.difference.method != MotionMethod::vectors;
}

}  // namespace

Preview::Preview(ReplaySource source) : source_(std::move(source)) {}

Preview::Known* Preview::known(FrameIndex frame) {
    const auto found = frames_.find(frame);
    if (found != frames_.end()) return &found->second;
    auto stored = source_.result_of(frame);
    if (!stored) return nullptr;
    // The frames farthest away are the least likely to be wanted again.
    while (frames_.size() >= kMostFrames) {
        const auto before = frames_.begin();
        const auto after = std::prev(frames_.end());
        frames_.erase(frame - before->first > after->first - frame ? before : after);
    }
    Known& made = frames_[frame];
    made.stored = std::move(*stored);
    return &made;
}

void Preview::makeWindows(const ChainOptions& options) {
    const std::string registration = signatureUpTo(options, ChainStage::registration);
    if (windows_for_ == registration && window_) return;
    window_ = std::make_unique<MotionWindow>(options.registration, source_.scale);
    track_window_ = std::make_unique<MotionWindow>(options.registration, source_.scale);
    windows_for_ = registration;
}

void Preview::warmUp(FrameIndex frame, const std::stop_token& stop) {
    if (frame < source_.first_frame) return;
    makeWindows(source_.options);
    window_->cover(std::max(0, frame - MotionWindow::reachFor(source_.options.motion, source_.scale)), frame,
                   source_.pixels, stop);
}

bool Preview::prepareMotion(FrameIndex frame, const ChainOptions& options, int range, const std::stop_token& stop) {
    const std::string wanted = signatureUpTo(options, ChainStage::motion);
    if (wanted == signatureUpTo(source_.options, ChainStage::motion)) {
        if (!motions_.empty()) frames_.clear();
        motions_.clear();
        motions_for_.clear();
        return true;
    }
    const FrameIndex first = std::max(source_.first_frame, frame - range);
    if (motions_for_ == wanted && motions_.count(frame) > 0 && motions_.count(first) > 0) return true;
    makeWindows(options);
    MotionWindow& window = range == 0 ? *window_ : *track_window_;
    const FrameIndex begin = std::max(0, first - MotionWindow::reachFor(options.motion, source_.scale));
    if (!window.cover(begin, frame, source_.pixels, stop)) return false;
    motions_.clear();
    for (auto& [index, kept] : frames_) kept.clusters_for.clear();  // corners are numbered anew in another window
    for (FrameMotion& motion : window.motions(options.motion, frame - first + 1)) {
        const FrameIndex index = motion.frame;
        motions_[index] = std::move(motion);
    }
    motions_for_ = wanted;
    return true;
}

const FrameMotion& Preview::motionOf(const Known& known) const {
    const auto found = motions_.find(known.stored.motion.frame);
    return found == motions_.end() ? known.stored.motion : found->second;
}

FrameResult Preview::secondHalf(Known& known, const ChainOptions& options) {
    FrameResult result;
    result.motion = motionOf(known);
    const std::string clusters_for = signatureUpTo(options, ChainStage::clustering);
    if (known.clusters_for != clusters_for) {
        const SceneScale scale = source_.scale.zoomed(result.motion.registration.zoom);
        known.clusters = MotionClustering(options.clustering, scale).cluster(result.motion);
        known.clusters_for = clusters_for;
        known.found_for.clear();
    }
    const std::string found_for = signatureOf(options, ChainStage::detection, ChainStage::detection);
    if (known.found_for != found_for) {
        if (!search_ || search_for_ != found_for) {
            search_ = std::make_unique<ClusterSearch>(options.detection, source_.scale);
            search_for_ = found_for;
        }
        if (known.frame.gray.empty()) known.frame = source_.pixels(result.motion.frame);
        known.found = search_->search(known.frame, result.motion, known.clusters);
        known.found_for = found_for;
    }
    result.clusters = known.clusters;
    result.rois = known.found.rois;
    result.detections = removed(known.found.detections, result.motion, options, source_.scale);
    return result;
}

cv::Mat Preview::pictureOf(Known& known) {
    if (known.frame.gray.empty()) known.frame = source_.pixels(known.stored.motion.frame);
    return known.frame.gray;
}

std::optional<PreviewedFrame> Preview::byReplay(FrameIndex frame, const ChainOptions& options,
                                                const std::stop_token& stop) {
    const std::string wanted = signatureUpTo(options, ChainStage::finishing);
    if (!replay_ || replay_for_ != wanted) {
        ReplaySource source = source_;
        source.options = options;
        source.motion_of = [this](FrameIndex index) -> std::optional<FrameMotion> {
            const Known* known = this->known(index);
            if (known == nullptr) return std::nullopt;
            return motionOf(*known);
        };
        replay_ = std::make_unique<Replay>(std::move(source));
        replay_for_ = wanted;
    }
    const ReplayedFrame* replayed = replay_->at(frame, stop);
    if (replayed == nullptr) return std::nullopt;
    PreviewedFrame previewed;
    previewed.result = replayed->result;
    return previewed;
}

void Preview::adoptIds(std::vector<TrackState>& tracks, const std::vector<TrackState>& stored) const {
    TrackId next = 1;
    for (const TrackState& state : stored) next = std::max(next, state.id + 1);
    std::vector<char> taken(stored.size(), 0);
    for (TrackState& track : tracks) {
        double best = kSameTrack;
        std::size_t found = stored.size();
        for (std::size_t i = 0; i < stored.size(); ++i) {
            const double shared = taken[i] ? 0 : overlap(track.box, stored[i].box);
            if (shared <= best) continue;
            best = shared;
            found = i;
        }
        if (found < stored.size()) taken[found] = 1;
        track.id = found < stored.size() ? stored[found].id : next++;
    }
    std::sort(tracks.begin(), tracks.end(), [](const TrackState& a, const TrackState& b) { return a.id < b.id; });
}

std::optional<PreviewedFrame> Preview::now(FrameIndex frame, const ChainOptions& options, int range,
                                           const std::stop_token& stop) {
    if (known(frame) == nullptr)
        throw Error(ErrorKind::project, "the run has not processed frame " + std::to_string(frame));
    if (!prepareMotion(frame, options, 0, stop) || stop.stop_requested()) return std::nullopt;
    PreviewedFrame previewed;
    if (reachesBack(options)) {
        auto replayed = byReplay(frame, options, stop);
        if (!replayed) return std::nullopt;
        previewed = std::move(*replayed);
    } else {
        previewed.result = secondHalf(*known(frame), options);
    }
    previewed.start = firstDifference(source_.options, options);
    previewed.approximate = !motions_.empty();
    if (stop.stop_requested()) return std::nullopt;
    Tracker tracker(options.tracking, source_.scale);
    for (FrameIndex before = std::max(source_.first_frame, frame - range); before < frame; ++before) {
        Known* past = known(before);
        if (past == nullptr) continue;
        tracker.next(past->stored.motion, past->stored.detections, nullptr, [&] { return pictureOf(*past); });
    }
    previewed.result.tracks = tracker.next(previewed.result.motion, previewed.result.detections, nullptr,
                                           [&] { return pictureOf(*known(frame)); });
    previewed.tracks_final = previewed.start >= ChainStage::tracking;
    if (const Known* present = known(frame)) adoptIds(previewed.result.tracks, present->stored.tracks);
    return previewed;
}

std::optional<PreviewedFrame> Preview::withTracks(FrameIndex frame, const ChainOptions& options, int range,
                                                  const std::stop_token& stop,
                                                  const std::function<void(int)>& progress) {
    auto previewed = now(frame, options, range, stop);
    if (!previewed || previewed->tracks_final || reachesBack(options)) return previewed;
    if (!prepareMotion(frame, options, range, stop)) return std::nullopt;
    Tracker tracker(options.tracking, source_.scale);
    for (FrameIndex before = std::max(source_.first_frame, frame - range); before < frame; ++before) {
        if (stop.stop_requested()) return std::nullopt;
        if (progress) progress(frame - before);
        Known* past = known(before);
        if (past == nullptr) continue;
        const FrameResult result = secondHalf(*past, options);
        tracker.next(result.motion, result.detections, nullptr, [&] { return pictureOf(*past); });
    }
    // By the longer window, which is nearer to a run.
    if (previewed->approximate) previewed->result = secondHalf(*known(frame), options);
    previewed->result.tracks = tracker.next(previewed->result.motion, previewed->result.detections, nullptr,
                                            [&] { return pictureOf(*known(frame)); });
    previewed->tracks_final = true;
    if (const Known* present = known(frame)) adoptIds(previewed->result.tracks, present->stored.tracks);
    return previewed;
}

}  // namespace eyrie

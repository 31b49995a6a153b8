#include "rerun/replay.h"

#include <algorithm>

#include "core/error.h"

namespace eyrie {
namespace {

constexpr int kSpareFrames = 8;       ///< for frames that could not be registered and count for nothing
constexpr int kLongestReach = 200;    ///< beyond that nobody wants to wait
constexpr int kWholeFrames = 2;       ///< done as a whole before the wanted one, which may repeat their answer
constexpr int kStackGenerations = 2;  ///< a stack is full after one capacity, and rests on detections made with others

}  // namespace

int framesBefore(const ChainOptions& options) {
    int reach = 0;
    const DifferenceOptions& difference = options.difference;
    switch (difference.method) {
        case MotionMethod::vectors:
            break;
        case MotionMethod::three_frame_difference:
            reach = 2 * difference.gap + kSpareFrames;
            break;
        case MotionMethod::median_background:
            reach = difference.background_frames * difference.background_step + kSpareFrames;
            break;
        case MotionMethod::two_frame_difference:
        case MotionMethod::difference_ghosts:
            reach = difference.gap + kSpareFrames;
            break;
    }
    if (options.stacking.enabled) reach = std::max(reach, kStackGenerations * options.stacking.capacity);
    return std::min(reach, kLongestReach);
}

Replay::Replay(ReplaySource source)
    : source_(std::move(source)), reach_(framesBefore(source_.options)), half_(source_.options, source_.scale) {
    restart(source_.first_frame);
}

void Replay::restart(FrameIndex first) {
    half_ = TrackHalf(source_.options, source_.scale);
    started_ = first;
    next_ = first;
    present_valid_ = false;
}

bool Replay::advance(FrameIndex wanted) {
    std::optional<FrameMotion> motion = source_.motion_of(next_);
    if (!motion) return false;
    present_valid_ = false;
    present_.frame = source_.pixels(next_);
    if (!source_.options.stacking.enabled && next_ < wanted - kWholeFrames) {
        half_.remember(present_.frame, *motion);
        ++next_;
        return true;
    }
    present_.result = half_.next(present_.frame, std::move(*motion), {});
    present_valid_ = true;
    ++next_;
    return true;
}

const ReplayedFrame* Replay::at(FrameIndex frame, const std::stop_token& stop) {
    if (frame < source_.first_frame) return nullptr;
    const bool is_present = present_valid_ && next_ == frame + 1;
    if (!is_present) {
        // Going on is right only while it is no longer than starting anew.
        if (next_ > frame || next_ < frame - reach_) restart(std::max(source_.first_frame, frame - reach_));
        while (next_ <= frame) {
            if (stop.stop_requested() || !advance(frame)) return nullptr;
        }
    }
    present_.differences.reset();
    if (const DifferenceResult* differences = half_.differences()) present_.differences = *differences;
    present_.exact = started_ == source_.first_frame || !source_.options.stacking.enabled;
    return &present_;
}

std::vector<StackView> Replay::stacks(StackPictures pictures) const {
    return present_valid_ ? half_.stackViews(present_.frame, pictures) : std::vector<StackView>{};
}

ClusteringTrace Replay::clustering() const {
    return present_valid_ ? half_.clustering(present_.result.motion) : ClusteringTrace{};
}

std::vector<SearchTrace> Replay::trace(int cluster) const {
    const auto& clusters = present_.result.clusters;
    if (!present_valid_ || cluster < 0 || cluster >= static_cast<int>(clusters.size())) return {};
    return half_.trace(present_.frame, present_.result.motion, clusters[static_cast<std::size_t>(cluster)], cluster);
}

}  // namespace eyrie

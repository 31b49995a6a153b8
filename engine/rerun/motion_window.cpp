#include "rerun/motion_window.h"

#include <algorithm>

namespace eyrie {
namespace {

constexpr int kLongestWayOn = 30;  ///< frames; farther on, starting anew is as quick
constexpr int kSettling = 12;      ///< frames until the corners are spread as in the middle of a run

}  // namespace

int MotionWindow::reachFor(const IndependentMotionOptions& options, const SceneScale& scale) {
    const int speeds =
        std::max({options.baseline, options.min_age, options.find_slow ? options.slow_baseline : 0}) + kSettling;
    const int silhouettes = options.silhouettes.silhouettes ? options.silhouettes.silhouette_frames : 0;
    const int areas = options.areas.areas ? 2 * options.areas.gapFrames(scale) : 0;
    return std::max({speeds, silhouettes, areas});
}

bool MotionWindow::cover(FrameIndex first, FrameIndex last, const std::function<Frame(FrameIndex)>& pixels,
                         const std::stop_token& stop) {
    const bool covered = !frames_.empty() && frames_.front().index <= first && frames_.back().index == last;
    if (covered) return true;
    const bool goes_on = !frames_.empty() && frames_.front().index <= first && frames_.back().index < last &&
                         last - frames_.back().index <= kLongestWayOn;
    if (!goes_on) {
        frames_.clear();
        registered_.clear();
        registrar_.emplace(options_, scale_, scale_.zoom.at(first));
    }
    for (FrameIndex frame = goes_on ? frames_.back().index + 1 : first; frame <= last; ++frame) {
        if (stop.stop_requested()) return false;
        Frame read = pixels(frame);
        registered_.push_back(registrar_->next(read));
        frames_.push_back(std::move(read));
    }
    const auto spare =
        std::min(frames_.size() - 1, static_cast<std::size_t>(std::max(0, first - frames_.front().index)));
    frames_.erase(frames_.begin(), frames_.begin() + static_cast<std::ptrdiff_t>(spare));
    registered_.erase(registered_.begin(), registered_.begin() + static_cast<std::ptrdiff_t>(spare));
    return true;
}

std::vector<FrameMotion> MotionWindow::motions(const IndependentMotionOptions& options, int count,
                                               CornerVerdicts* verdicts) const {
    IndependentMotion motion(options, scale_);
    std::vector<FrameMotion> motions;
    const auto total = static_cast<int>(registered_.size());
    for (int i = 0; i < total; ++i) {
        const auto at = static_cast<std::size_t>(i);
        // A frozen frame repeats the one before it, so a few more are done.
        const bool may_be_repeated = i >= total - count - 3;
        if (!may_be_repeated) {
            motion.remember(registered_[at], frames_[at]);
            continue;
        }
        FrameMotion found = motion.next(registered_[at], frames_[at], i + 1 == total ? verdicts : nullptr);
        if (i >= total - count) motions.push_back(std::move(found));
    }
    return motions;
}

}  // namespace eyrie

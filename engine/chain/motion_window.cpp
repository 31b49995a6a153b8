#include "chain/motion_window.h"

#include <algorithm>

namespace eyrie {
namespace {

constexpr int kSettling = 12;  ///< frames until the corners are spread as in the middle of a run

}  // namespace

int MotionWindow::reachFor(const IndependentMotionOptions& options) {
    return std::max({options.baseline, options.min_age, options.find_slow ? options.slow_baseline : 0}) + kSettling;
}

bool MotionWindow::cover(FrameIndex first, FrameIndex last, const std::function<Frame(FrameIndex)>& pixels,
                         const std::stop_token& stop) {
    const bool covered = !frames_.empty() && frames_.front().index <= first && frames_.back().index == last;
    if (covered) return true;
    std::vector<Frame> frames;
    std::vector<RegisteredFrame> registered;
    Registrar registrar(options_, scale_);
    for (FrameIndex frame = first; frame <= last; ++frame) {
        if (stop.stop_requested()) return false;
        frames.push_back(pixels(frame));
        registered.push_back(registrar.next(frames.back()));
    }
    frames_ = std::move(frames);
    registered_ = std::move(registered);
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
            motion.remember(registered_[at]);
            continue;
        }
        FrameMotion found = motion.next(registered_[at], frames_[at], i + 1 == total ? verdicts : nullptr);
        if (i >= total - count) motions.push_back(std::move(found));
    }
    return motions;
}

}  // namespace eyrie

#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/values/frame.h"
#include "core/values/motion_vector.h"
#include "motion/vectors/independent_motion.h"
#include "registration/registrar.h"

namespace eyrie {

/// The first half of the chain once more over a few frames, to look at what a run does not store: how each corner was
/// judged, and what other parameters of independent motion would make of it. The registration of the frames is kept, so
/// that other parameters are tried in milliseconds. Corners are found anew at the start, so that single ones may differ
/// from the run's. For one thread.
class MotionWindow {
 public:
    MotionWindow(const RegistrationOptions& options, const SceneScale& scale) : options_(options), scale_(scale) {}

    /// Frames before the wanted one that are needed for motion to be measured as in a run.
    static int reachFor(const IndependentMotionOptions& options, const SceneScale& scale);

    /// Registers the frames from `first` to `last` unless that was done, going on from where it is if it can; false
    /// when `stop` was requested meanwhile. Throws Error(input) when pixels cannot be read.
    bool cover(FrameIndex first, FrameIndex last, const std::function<Frame(FrameIndex)>& pixels,
               const std::stop_token& stop);

    /// Motion of the last `count` frames covered, ascending; `verdicts`, if given, receives those on the last frame.
    std::vector<FrameMotion> motions(const IndependentMotionOptions& options, int count,
                                     CornerVerdicts* verdicts = nullptr) const;

 private:
    RegistrationOptions options_;
    SceneScale scale_;
    std::vector<Frame> frames_;
    std::vector<RegisteredFrame> registered_;
    std::optional<Registrar> registrar_;  ///< as it is after the last of them
};

}  // namespace eyrie

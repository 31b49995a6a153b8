#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "chain/recording/run_recorder.h"
#include "core/values/scale_basis.h"
#include "io/video/frame_source.h"

namespace eyrie {

/// What a look at the traffic says about the scale of a video.
struct ScaleEstimate {
    double gsd_m_per_px = 0;  ///< metres per pixel at which the vehicles have the length of usual cars
    double uncertainty = 1;   ///< factor ≥ 1: in nine of ten videos the truth lies between GSD / this and GSD × this
    int vehicles = 0;         ///< tracks it rests on
};

/// Frames of one look; where no more are there, what these show decides.
inline constexpr int kFramesOfLook = 40;

/// Receives the progress of the look, on the thread that looks.
using ScaleProgress = std::function<void(const RunProgress&)>;

/// The scale of a run: the given GSD, or for `gsd_m_per_px` ≤ 0 an estimate, or 0.25 m/px where that fails.
///
/// The estimate: the chain runs over a few dozen frames under finer to coarser assumptions, and the one under which
/// most of what moves looks to the classifier like vehicles, and has a car's size, is taken. Relief and glare look like
/// vehicles under none. Right to a fifth where cars drive; it fails when too little looks like vehicles or `stop` is
/// requested. Takes some seconds; `told`, if any, learns after every frame how far the look is. Where the first frames
/// show few vehicles, those in the middle and at the end are looked at, too, and what shows traffic is taken together:
/// a queue that stands and one rider that drives past it would settle the scale otherwise. With
/// `view.oblique` it is looked how the scale changes over the picture, too. An estimate gives the chain's lengths a
/// footing; `gsd_known` stays false, so that nobody is shown metres that were guessed. `estimated`, if any, receives
/// what the estimate rests on; nothing where the scale is none. Where no classifier can be loaded and the run itself
/// needs none, nothing is looked for, and `why_not`, if any, receives the reason. Throws Error(input) where the run
/// needs it.
SceneScale chooseScale(FrameSource& source, FrameRange range, const ChainOptions& options, double gsd_m_per_px,
                       const std::stop_token& stop, const ScaleProgress& told = {},
                       std::optional<ScaleEstimate>* estimated = nullptr, std::string* why_not = nullptr);

/// How a scale that is known in the middle of the picture changes over it, where `view.oblique` asks for that; flat
/// otherwise, and where nothing of the scale is known. Part of what chooseScale() does.
ScaleSlope slopeFor(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                    const std::stop_token& stop, const ScaleProgress& told = {});

/// Where a scale comes from that chooseScale() chose, with what it said about its estimate. A known one counts as
/// given: that it is the metadata's only knows who took it from there.
ScaleBasis basisOf(const SceneScale& scale, const std::optional<ScaleEstimate>& estimated);

}  // namespace eyrie

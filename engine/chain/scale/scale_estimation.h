#pragma once

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "chain/recording/run_recorder.h"
#include "chain/scale/scale_outcomes.h"
#include "core/values/scale_basis.h"
#include "io/video/frame_source.h"
#include "metadata/metadata_scale.h"

namespace eyrie {

/// Receives the progress of the look, from one thread at a time, which need not be the one that asked.
using ScaleProgress = std::function<void(const RunProgress&)>;

/// The scale of a run, and where it comes from.
struct ChosenScale {
    SceneScale scale;
    ScaleBasis basis;
    /// The scale that was stated or estimated, where it is that of the vehicles' places in an oblique view rather than
    /// of its middle; m/px.
    std::optional<double> gsd_of_vehicles;
    std::optional<ScaleEstimate> estimate;  ///< what was read off the traffic, where nothing else was known
    /// Where nothing was looked for, as no classifier can be loaded and the run itself needs none: the reason, for
    /// people.
    std::string why_not;
};

/// The scale of a run: the stated GSD, or where there is none an estimate, or 0.25 m/px where that fails.
///
/// The estimate: the chain runs over a few dozen frames under finer to coarser assumptions, and the one under which
/// most of what moves looks to the classifier like vehicles, and has a car's size, is taken. Where that is doubtful,
/// the speeds of cars have a say. Relief and glare look like vehicles under none. Right to a fifth where cars drive; it
/// fails when too little looks like vehicles or `stop` is requested. Takes some seconds; `told`, if any, learns after
/// every frame how far the look is. Where the first frames show few vehicles, those in the middle and at the end are
/// looked at, too, and what shows traffic is taken together: a queue that stands and one rider that drives past it
/// would settle the scale otherwise. With `view.oblique` it is looked how the scale changes over the picture, too. An
/// estimate gives the chain's lengths a footing; `gsd_known` stays false, so that nobody is shown metres that were
/// guessed. Throws Error(input) where the run needs a classifier that cannot be loaded.
ChosenScale chooseScale(FrameSource& source, FrameRange range, const ChainOptions& options, const StatedScale& stated,
                        const std::stop_token& stop, const ScaleProgress& told = {});

/// How a scale that is known in the middle of the picture changes over it, where `view.oblique` asks for that; flat
/// otherwise, and where nothing of the scale is known. Part of what chooseScale() does. The scale is that of the
/// slope's centre, which may lie where the vehicles are; see fitSlope().
ScaleSlope slopeFor(FrameSource& source, FrameRange range, const ChainOptions& options, const SceneScale& scale,
                    const std::stop_token& stop, const ScaleProgress& told = {});

}  // namespace eyrie

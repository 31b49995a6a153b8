#pragma once

#include <optional>
#include <string>

#include "core/values/scene_scale.h"

namespace eyrie {

/// Where the metres per pixel of a run come from.
enum class ScaleOrigin {
    given,      ///< by a person, or known to the source itself
    metadata,   ///< stated by the metadata of the video
    estimated,  ///< read off the traffic
    assumed     ///< none of these: the chain needs some scale to work with
};
/// As JSON has it: "given", "metadata", "estimated", "assumed".
const char* nameOf(ScaleOrigin origin);

/// Whether metres may be shown where the scale comes from there: SceneScale::gsd_known.
bool isKnownScale(ScaleOrigin origin);

/// Where the metres per pixel of a run come from, and how sure they are.
struct ScaleBasis {
    ScaleOrigin origin = ScaleOrigin::assumed;
    /// Factor ≥ 1, of an estimate: in nine of ten videos the truth lies between GSD / this and GSD × this.
    std::optional<double> uncertainty = std::nullopt;
    int vehicles = 0;  ///< that an estimate rests on; 0: not kept

    bool operator==(const ScaleBasis&) const = default;
};

/// What can be told of a scale of which nothing else was kept: a known one was given, the value that stands in where
/// nothing is found was assumed, any other estimated.
ScaleBasis basisOf(const SceneScale& scale);

/// `basis`, unless it contradicts whether the scale is known; then basisOf(scale).
ScaleBasis agreeing(const ScaleBasis& basis, const SceneScale& scale);

/// For people: "as given", "from the video's metadata", "estimated from 14 vehicles, right to within a factor of 1.2".
std::string describe(const ScaleBasis& basis);

/// For people: "0.21 m/px, estimated from 14 vehicles, right to within a factor of 1.2". Nothing else words it.
std::string describe(double gsd_m_per_px, const ScaleBasis& basis);

/// The same of a scale that may change over a picture of this size: "0.08 m/px in the middle of an oblique view (0.3 at
/// its upper edge, 0.05 at its lower edge), from what was given".
std::string describe(const SceneScale& scale, const ScaleBasis& basis, cv::Size picture);

}  // namespace eyrie

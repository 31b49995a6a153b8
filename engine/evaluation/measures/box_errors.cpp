#include "evaluation/measures/box_errors.h"

#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {

BoxErrors boxErrors(const BoxesByFrame& truth, const BoxesByFrame& result, const std::vector<FrameMatch>& matches,
                    bool upright) {
    BoxErrors errors;
    errors.has_headings = !upright;
    for (const FrameMatch& match : matches) {
        if (match.pairs.empty()) continue;
        const auto& objects = truth.at(match.frame);
        const auto& results = result.at(match.frame);
        for (const MatchedPair& pair : match.pairs) {
            OrientedBox a = objects.at(static_cast<std::size_t>(pair.truth)).box;
            OrientedBox b = results.at(static_cast<std::size_t>(pair.result)).box;
            errors.heading_degrees += std::abs(turnBetween(a.heading, b.heading)) * 180 / kPi;
            errors.heading_axis_degrees += std::abs(axisTurnBetween(a.heading, b.heading)) * 180 / kPi;
            if (upright) {
                a = a.upright();
                b = b.upright();
            }
            errors.centre_px += std::hypot(a.centre.x - b.centre.x, a.centre.y - b.centre.y);
            errors.length_px += std::abs(b.length - a.length);
            errors.width_px += std::abs(b.width - a.width);
            errors.length_bias_px += b.length - a.length;
            errors.width_bias_px += b.width - a.width;
            ++errors.pairs;
        }
    }
    if (errors.pairs == 0) return errors;
    for (double* sum : {&errors.centre_px, &errors.length_px, &errors.width_px, &errors.length_bias_px,
                        &errors.width_bias_px, &errors.heading_degrees, &errors.heading_axis_degrees}) {
        *sum /= errors.pairs;
    }
    return errors;
}

}  // namespace eyrie

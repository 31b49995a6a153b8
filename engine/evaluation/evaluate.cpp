#include "evaluation/evaluate.h"

namespace eyrie {

std::vector<Measures> evaluateAt(const std::vector<double>& overlaps, const BoxesByFrame& truth,
                                 const BoxesByFrame& result, const EvaluationOptions& options) {
    EvaluationOptions at = options;
    for (const double overlap : overlaps) {
        at.overlap = overlap;
        check(at);
    }
    const EvaluationInput input = prepareEvaluation(truth, result, at);
    std::optional<HotaMeasures> hota;
    if (input.has_tracks) hota = hotaMeasures(input);

    std::vector<Measures> all;
    for (const double overlap : overlaps) {
        at.overlap = overlap;
        const std::vector<FrameMatch> matches = matchFrames(input, at);
        Measures m;
        m.convention = at.convention;
        m.overlap = overlap;
        m.detection = detectionMeasures(input, matches);
        m.boxes = boxErrors(truth, result, matches, at.upright);
        if (input.has_tracks) {
            m.tracks = tallyTracks(input, matches, at);
            m.tracking = trackingMeasures(m.tracks, m.detection, at);
            m.identity = identityMeasures(input, matches, at);
        }
        m.hota = hota;
        m.results_not_counted = input.results_not_counted;
        m.shared_frames = input.shared_frames;
        m.repeated_ids = input.repeated_ids;
        all.push_back(std::move(m));
    }
    return all;
}

Measures evaluate(const BoxesByFrame& truth, const BoxesByFrame& result, const EvaluationOptions& options) {
    return evaluateAt({options.overlap}, truth, result, options).front();
}

}  // namespace eyrie

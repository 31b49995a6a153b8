#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"
#include "explain/explanation_steps.h"
#include "tracking/finishing/flow_comparison.h"
#include "tracking/finishing/track_score.h"

namespace eyrie::explaining {
namespace {

constexpr double kHardly = 0.1;        ///< log-odds that speak neither way
constexpr double kStillCamera = 0.05;  ///< px/frame
constexpr double kSameProbability = 0.005;

std::string percentText(double share) {
    return std::to_string(std::lround(100 * share)) + " %";
}

std::string signedText(double value) {
    const std::string text = numberText(std::abs(std::round(100 * value) / 100));
    return (value < 0 ? "−" : "+") + text;
}

/// "… : speaks for a vehicle, +1.8".
void tellPart(Story& story, const std::string& what, double part) {
    if (part > kHardly)
        story.pass("score", what + ": speaks for a moving vehicle, " + signedText(part));
    else if (part < -kHardly)
        story.note("score", what + ": speaks against it, " + signedText(part));
    else
        story.note("score", what + ": tells nothing, " + signedText(part));
}

std::string motionText(const Story& story, const TrackEvidence& evidence) {
    if (evidence.flow_px < kStillCamera) return "the camera hardly moves there";
    const double angle = degreesFromRadians(std::acos(std::clamp(evidence.alignment, -1.0, 1.0)));
    // What rises to a share h of the flight height seems to move h / (1 − h) of the ground's motion more than it.
    const double along = evidence.flow_ratio * evidence.alignment;
    const std::string height =
        evidence.alignment > kAlongFlow
            ? "; a standing thing would have to be " + numberText(along / (1 + along)) + " of the flight height tall"
            : "";
    return "over the ground it moves " + numberText(evidence.flow_ratio) + " times as fast as the ground through the " +
           "picture (" + story.speedText(evidence.flow_px) + "), " + std::to_string(std::lround(angle)) +
           "° off that direction" + height;
}

std::string looksText(const TrackEvidence& evidence) {
    const std::string whole = evidence.looked_alike > 0 ? "it was found as a whole vehicle in " +
                                                              percentText(evidence.looked_alike) + " of its detections"
                                                        : std::string("it was never found as a whole vehicle");
    if (std::isnan(evidence.decision)) return "the classifier was never asked about its boxes; " + whole;
    return "the classifier gives its boxes " + signedText(evidence.decision) +
           " on average, where vehicles lie above 0; " + whole;
}

}  // namespace

void tellScore(Story& story, TrackId track, StepVerdict fate) {
    const auto found = story.evidence.judged.find(track);
    if (found == story.evidence.judged.end()) return;
    const TrackEvidence& evidence = found->second;
    const double needed = story.options.finishing.min_score;
    const std::string text = "track " + std::to_string(track) + " is a moving vehicle with a probability of " +
                             numberText(evidence.score) + ", at least " + numberText(needed) + " is needed";
    story.told.steps.push_back({"score", fate, text, "finishing.min_score"});
    const ScoreParts parts = partsOf(evidence);
    tellPart(story, looksText(evidence), parts.looks);
    tellPart(story, "it was detected in " + percentText(evidence.detected) + " of its frames", parts.detected);
    tellPart(story, "it was followed for " + numberText(evidence.life_s) + " s", parts.life);
    tellPart(story, motionText(story, evidence), parts.motion);
    const double by_sum = probabilityOf(evidence);
    // What a run of an earlier version knows of its tracks was weighed otherwise then.
    const bool as_then = std::abs(by_sum - evidence.score) < kSameProbability;
    story.note("score", "together " + signedText(parts.sum()) + ", which is a probability of " + numberText(by_sum) +
                            " (1 / (1 + exp(−sum)))" +
                            (as_then ? "" : "; the version of Eyrie that made the run weighed this differently"));
}

}  // namespace eyrie::explaining

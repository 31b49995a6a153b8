#include "diagnosis/error_cause.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "motion/clusters/clustering_wording.h"
#include "removal/removal_wording.h"

namespace eyrie {
namespace {

constexpr double kNearMiss = 0.25;      ///< of T_ov: from here on a box is off rather than elsewhere
constexpr double kOnObject = 0.3;       ///< share of a false box on a found object
constexpr double kBesideIgnored = 1.6;  ///< boxes grown by this still touch what does not count
constexpr double kShadowReach = 2.0;    ///< lengths of the object
constexpr double kShadowTurn = 0.45;    ///< radians
constexpr double kShadowSpeed = 0.4;    ///< share by which speeds may differ
constexpr double kParallaxTurn = 0.35;  ///< radians from the direction in which the ground moves
constexpr double kParallaxFlow = 0.3;   ///< px/frame, a camera that stands still shows no parallax
constexpr double kSlowest = 0.02;       ///< px/frame, below that a velocity has no direction

double length(cv::Point2d v) {
    return std::hypot(v.x, v.y);
}

/// Angle between two directions in [0, π]; π where one has none.
double angleBetween(cv::Point2d a, cv::Point2d b) {
    const double product = length(a) * length(b);
    if (length(a) < kSlowest || length(b) < kSlowest) return 3.15;
    return std::acos(std::clamp((a.x * b.x + a.y * b.y) / product, -1.0, 1.0));
}

std::string number(double value, int decimals) {
    char text[48];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

const BoxRecord& at(const std::vector<BoxRecord>& records, int index) {
    return records[static_cast<std::size_t>(index)];
}

std::string nameOf(const char* what, const std::optional<int>& id) {
    return id ? std::string(what) + " " + std::to_string(*id) : std::string("another ") + what;
}

const MatchedPair* pairOfResult(const FrameMatch& match, int result) {
    for (const MatchedPair& pair : match.pairs)
        if (pair.result == result) return &pair;
    return nullptr;
}

/// The result that overlaps a missed object most.
struct Candidate {
    int result = -1;
    double overlap = 0;
    const MatchedPair* taken = nullptr;  ///< the object it found instead
};
Candidate nearestResult(const OrientedBox& box, const ErrorEvidence& evidence, bool taken) {
    Candidate best;
    for (const int index : evidence.frame.results) {
        const MatchedPair* pair = pairOfResult(evidence.match, index);
        if ((pair != nullptr) != taken) continue;
        const OrientedBox& other = at(evidence.result, index).box;
        const double shared = evidence.upright ? overlap(box.upright(), other.upright()) : overlap(box, other);
        if (shared > best.overlap) best = {index, shared, pair};
    }
    return best;
}

std::string offText(double overlap, double needed) {
    return "overlap " + number(overlap, 2) + ", " + number(needed, 2) + " is needed";
}

/// " (finishing.min_score)", or nothing where no parameter decided.
std::string by(const std::string& parameter) {
    return parameter.empty() ? std::string() : " (" + parameter + ")";
}

CauseHere leftOut(const DroppedState& dropped) {
    return {causeOf(dropped.why), textOf(dropped) + by(parameterOf(dropped.why))};
}

/// What removal told of the detection.
CauseHere removedBy(const BoxFacts& facts) {
    const RemovalVerdict& verdict = facts.removal;
    return {causeOf(verdict.rejection), textOf(verdict, facts.scale) + by(verdict.parameter)};
}

/// What clustering told of motion vectors that are in no cluster.
CauseHere notClustered(const BoxFacts& facts) {
    const ClusteringVerdict& verdict = facts.clustering;
    const std::string vectors = std::to_string(facts.motion_vectors) + " motion vectors";
    if (facts.by_differences)
        return {ErrorCause::not_clustered, vectors + ", but " + kNoMovingArea + by("motion.method")};
    const bool too_few = verdict.refusal == ClusterRefusal::too_few;
    const std::string told = textOf(verdict, facts.scale);
    return {too_few ? ErrorCause::too_few_vectors : ErrorCause::not_clustered,
            told.empty() ? vectors : told + by(verdict.parameter)};
}

/// What the stages before tracking tell of a missed object.
CauseHere stageThatLost(const BoxFacts& facts, const ErrorEvidence& evidence) {
    const double needed = evidence.min_overlap;
    if (facts.tentative.overlap >= needed) return leftOut(facts.unconfirmed);
    if (facts.dropped.overlap >= needed) return leftOut(facts.drop);
    if (facts.kept.overlap >= needed)
        return {ErrorCause::not_associated, "a detection overlaps it by " + number(facts.kept.overlap, 2)};
    if (facts.rejected.overlap >= needed) return removedBy(facts);
    if (facts.kept.overlap >= kNearMiss * needed)
        return {ErrorCause::box_off, "detection: " + offText(facts.kept.overlap, needed)};
    if (facts.registration == RegistrationState::failed)
        return {ErrorCause::unregistered, describe(facts.failure) + by(parameterOf(facts.failure))};
    if (!facts.clusters.empty())
        return {ErrorCause::not_detected, std::to_string(facts.motion_vectors) + " motion vectors in a cluster"};
    if (facts.motion_vectors > 0) return notClustered(facts);
    if (evidence.frames_in_view < evidence.frames_needed)
        return {ErrorCause::too_new, "came into view " + std::to_string(evidence.frames_in_view) +
                                         " frames before, corners are judged after " +
                                         std::to_string(evidence.frames_needed)};
    if (facts.corners > 0)
        return {ErrorCause::too_slow, std::to_string(facts.corners) + " corners, none counts as moving"};
    return {ErrorCause::no_corners, ""};
}

/// The counting object that a false result moves along with, −1: none.
int companionOf(const BoxRecord& alarm, cv::Point2d velocity, const ErrorEvidence& evidence) {
    for (const MatchedPair& pair : evidence.match.pairs) {
        const BoxRecord& found = at(evidence.result, pair.result);
        const OrientedBox& box = at(evidence.truth, pair.truth).box;
        const double reach = kShadowReach * std::max(box.length, box.width);
        if (length(alarm.box.centre - box.centre) > reach) continue;
        const double speed = length(found.velocity);
        if (angleBetween(found.velocity, velocity) > kShadowTurn) continue;
        if (std::abs(speed - length(velocity)) > kShadowSpeed * speed) continue;
        return pair.truth;
    }
    return -1;
}

bool looksLikeParallax(cv::Point2d flow, cv::Point2d velocity) {
    if (length(flow) < kParallaxFlow || length(velocity) > length(flow)) return false;
    const double turn = angleBetween(flow, velocity);
    return turn < kParallaxTurn || (turn < 3.1416 && turn > 3.14159 - kParallaxTurn);
}

/// What a false alarm has to do with objects of the ground truth.
std::optional<CauseHere> relationToTruth(const BoxRecord& alarm, const ErrorEvidence& evidence) {
    if (evidence.in_split) return CauseHere{ErrorCause::split, "a part of an object"};
    for (const MatchedPair& pair : evidence.match.pairs) {
        const BoxRecord& object = at(evidence.truth, pair.truth);
        if (containment(alarm.box, object.box) >= kOnObject)
            return CauseHere{ErrorCause::duplicate, nameOf("object", object.id) + " is found by " +
                                                        nameOf("track", at(evidence.result, pair.result).id)};
    }
    double best = 0;
    int nearest = -1;
    for (const int missed : evidence.match.missed) {
        const double shared = overlap(alarm.box, at(evidence.truth, missed).box);
        if (shared <= best) continue;
        best = shared;
        nearest = missed;
    }
    if (nearest >= 0)
        return CauseHere{ErrorCause::box_off,
                         nameOf("object", at(evidence.truth, nearest).id) + ": " + offText(best, evidence.min_overlap)};
    for (const int index : evidence.frame.ignored_truth) {
        const BoxRecord& ignored = at(evidence.truth, index);
        if (overlap(alarm.box.scaled(kBesideIgnored, kBesideIgnored),
                    ignored.box.scaled(kBesideIgnored, kBesideIgnored)) > 0)
            return CauseHere{ErrorCause::ignored_object,
                             ignored.object_class.empty() ? std::string()
                                                          : "beside an ignored object (" + ignored.object_class + ")"};
    }
    return std::nullopt;
}

}  // namespace

ErrorCause causeOf(Rejection rejection) {
    switch (rejection) {
        case Rejection::duplicate:
            return ErrorCause::removed_duplicate;
        case Rejection::outlier:
            return ErrorCause::removed_outlier;
        case Rejection::size:
            return ErrorCause::removed_size;
        case Rejection::none:
            break;
    }
    return ErrorCause::unknown;
}

ErrorCause causeOf(TrackDrop why) {
    return why == TrackDrop::unconfirmed ? ErrorCause::tentative : ErrorCause::track_dropped;
}

CauseHere causeOfMiss(const ErrorPlace& place, const ErrorEvidence& evidence) {
    if (evidence.in_split) return {ErrorCause::split, ""};
    const Candidate taken = nearestResult(place.box, evidence, true);
    const Candidate free = nearestResult(place.box, evidence, false);
    if (evidence.in_merge || taken.overlap >= evidence.min_overlap) {
        if (taken.taken == nullptr) return {ErrorCause::merged, ""};
        return {ErrorCause::merged, "its box went to " + nameOf("object", at(evidence.truth, taken.taken->truth).id)};
    }
    const auto found = [&](int index) {
        const OrientedBox& other = at(evidence.result, index).box;
        return (evidence.upright ? overlap(place.box.upright(), other.upright()) : overlap(place.box, other)) >=
               evidence.min_overlap;
    };
    const std::vector<int>& at_border = evidence.frame.border_results;
    if (std::any_of(at_border.begin(), at_border.end(), found)) return {ErrorCause::at_border, ""};
    for (const int index : evidence.frame.other_class_results) {
        if (found(index)) return {ErrorCause::other_class, "called " + at(evidence.result, index).object_class};
    }
    if (free.overlap >= kNearMiss * evidence.min_overlap)
        return {ErrorCause::box_off, offText(free.overlap, evidence.min_overlap)};
    if (evidence.facts == nullptr) return {};
    return stageThatLost(*evidence.facts, evidence);
}

CauseHere causeOfFalseAlarm(const ErrorPlace& place, const ErrorEvidence& evidence) {
    const BoxRecord& alarm = at(evidence.result, place.results.front());
    const BoxFacts* facts = evidence.facts;
    if (facts != nullptr && !facts->image.empty() &&
        !cv::Rect2d(-0.5, -0.5, facts->image.width, facts->image.height).contains(alarm.box.centre))
        return {ErrorCause::outside_image, ""};
    if (const auto related = relationToTruth(alarm, evidence)) return *related;
    if (evidence.recently_unregistered || (facts != nullptr && facts->registration == RegistrationState::failed))
        return {ErrorCause::unregistered, facts != nullptr ? describe(facts->failure) : std::string()};
    if (alarm.origin == StateOrigin::predicted) return {ErrorCause::coasting, ""};
    const bool has_own = length(alarm.velocity) >= kSlowest || facts == nullptr;
    const cv::Point2d velocity = has_own ? alarm.velocity : facts->velocity;
    if (const int companion = companionOf(alarm, velocity, evidence); companion >= 0)
        return {ErrorCause::shadow, "moves along beside " + nameOf("object", at(evidence.truth, companion).id)};
    if (facts == nullptr) return {};
    if (looksLikeParallax(facts->flow, velocity))
        return {ErrorCause::parallax, number(length(velocity), 2) + " px/frame along the camera's own motion of " +
                                          number(length(facts->flow), 2)};
    if (facts->motion_vectors > 0)
        return {ErrorCause::unlabelled, std::to_string(facts->motion_vectors) + " motion vectors of " +
                                            number(length(facts->velocity), 2) + " px/frame"};
    return {};
}

CauseHere causeOfSplit(const ErrorPlace&, const ErrorEvidence& evidence) {
    if (evidence.facts == nullptr) return {};
    const std::size_t clusters = evidence.facts->clusters.size();
    if (clusters == 0) return {};
    if (clusters > 1) return {ErrorCause::clustered_apart, std::to_string(clusters) + " clusters"};
    return {ErrorCause::segmented_apart, ""};
}

CauseHere causeOfMerge(const ErrorPlace&, const ErrorEvidence& evidence) {
    if (evidence.object_facts.size() < 2) return {};
    const auto shared = [&](auto list) {
        for (const int index : list(*evidence.object_facts.front())) {
            std::size_t others = 0;
            for (const BoxFacts* facts : evidence.object_facts) {
                const std::vector<int>& own = list(*facts);
                others += std::find(own.begin(), own.end(), index) != own.end() ? 1 : 0;
            }
            if (others > 1) return true;
        }
        return false;
    };
    if (shared([](const BoxFacts& f) -> const std::vector<int>& { return f.clusters; }))
        return {ErrorCause::clustered_together, ""};
    if (shared([](const BoxFacts& f) -> const std::vector<int>& { return f.covering; }))
        return {ErrorCause::segmented_together, ""};
    return {ErrorCause::tracked_together, ""};
}

}  // namespace eyrie

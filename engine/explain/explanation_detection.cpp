#include <algorithm>
#include <cmath>

#include "detection/detection_options.h"
#include "explain/explanation_steps.h"
#include "removal/outlier_removal.h"
#include "removal/removal_wording.h"

namespace eyrie::explaining {
namespace {

/// A box in a search area as it lies in the image.
OrientedBox inImage(const MotionRoi& roi, const cv::Rect2d& box) {
    const cv::Matx23d& map = roi.image_from_roi;
    const cv::Point2d centre(box.x + box.width / 2, box.y + box.height / 2);
    OrientedBox result = roi.box;
    result.centre = {map(0, 0) * centre.x + map(0, 1) * centre.y + map(0, 2),
                     map(1, 0) * centre.x + map(1, 1) * centre.y + map(1, 2)};
    result.length = box.height;
    result.width = box.width;
    return result;
}

bool concerns(const DetectionTrace::Check& check, const MotionRoi& roi, const OrientedBox& area) {
    return check.box.area() <= 0 || atPlace(inImage(roi, check.box), area);
}

std::string checkText(const DetectionTrace::Check& check) {
    return check.what + ": " + numberText(check.value) + (check.at_most ? ", at most " : ", at least ") +
           numberText(check.limit);
}

/// Checks of one kind that ended alike.
struct Alike {
    const DetectionTrace::Check* first = nullptr;
    int count = 0;
    double lowest = 0;
    double highest = 0;
};

void addTo(std::vector<Alike>& groups, const DetectionTrace::Check& check) {
    for (Alike& group : groups) {
        if (group.first->what != check.what || group.first->passed != check.passed) continue;
        ++group.count;
        group.lowest = std::min(group.lowest, check.value);
        group.highest = std::max(group.highest, check.value);
        return;
    }
    groups.push_back({&check, 1, check.value, check.value});
}

std::string groupText(const Alike& group) {
    if (group.count == 1) return checkText(*group.first);
    const std::string values = group.lowest < group.highest
                                   ? numberText(group.lowest) + " … " + numberText(group.highest)
                                   : numberText(group.lowest);
    return group.first->what + ", " + std::to_string(group.count) + " times: " + values +
           (group.first->at_most ? ", at most " : ", at least ") + numberText(group.first->limit);
}

/// How far a failed check stayed from its limit, as a share of it.
double gapOf(const DetectionTrace::Check& check) {
    return std::abs(check.value - check.limit) / std::max(std::abs(check.limit), 1.0);
}

}  // namespace

bool tellDetection(Story& story, const std::vector<int>& clusters, std::vector<int>& detections) {
    const PlaceEvidence& evidence = story.evidence;
    const auto& found = evidence.result.detections;
    for (std::size_t i = 0; i < found.size(); ++i) {
        const bool of_cluster = std::find(clusters.begin(), clusters.end(), found[i].cluster) != clusters.end();
        const bool here = atPlace(found[i].box, evidence.area);
        if (here && of_cluster) detections.push_back(static_cast<int>(i));
    }
    const DetectionTrace::Check* decider = nullptr;
    for (const SearchTrace& search : evidence.searches) {
        if (std::find(clusters.begin(), clusters.end(), search.roi.cluster) == clusters.end()) continue;
        story.note("search area",
                   story.lengthText(search.roi.box.length) + " × " + story.lengthText(search.roi.box.width) +
                       (search.roi.stack_layers > 0
                            ? ", from a stack of " + std::to_string(search.roi.stack_layers) + " layers"
                            : std::string()),
                   "detection.extend_along");
        std::vector<Alike> groups;
        for (const DetectionTrace::Check& check : search.trace.checks) {
            if (!concerns(check, search.roi, evidence.area)) continue;
            addTo(groups, check);
            if (!check.passed && (decider == nullptr || gapOf(check) <= gapOf(*decider))) decider = &check;
        }
        for (const Alike& group : groups) {
            const std::string& parameter = group.first->parameter;
            if (group.first->passed)
                story.pass("detection", groupText(group), parameter);
            else if (detections.empty())
                story.fail("detection", groupText(group), parameter);
            else  // where others passed, a failed one is no more than a remark
                story.note("detection", groupText(group), parameter);
        }
    }
    if (!detections.empty()) {
        for (const int index : detections) {
            const Detection& detection = found[static_cast<std::size_t>(index)];
            story.pass("detection", std::string(nameOf(story.options.detection.method)) + " delivers a box of " +
                                        story.lengthText(detection.box.length) + " × " +
                                        story.lengthText(detection.box.width));
        }
        return true;
    }
    story.fail("detection", "no box here");
    if (decider != nullptr) {
        story.decide("The detector found no box here; closest was: " + checkText(*decider), decider->parameter);
    } else {
        story.decide("The cluster was searched, but the detector put no box here", "detection.method");
    }
    return false;
}

namespace {

/// What is told of a rejected detection: a step, and the sentence should it decide.
struct Refusal {
    std::string step;
    std::string sentence;
    std::string parameter;
};

Refusal refusedAsDuplicate(const Story& story, int index, const RemovalVerdict& verdict) {
    const auto& pairs = story.evidence.removal.duplicates;
    const auto pair =
        std::find_if(pairs.begin(), pairs.end(), [&](const RemovedDuplicate& d) { return d.removed == index; });
    if (pair == pairs.end()) {
        const std::string text = textOf(verdict, story.here);
        return {text, "The detection here was " + text, "duplicates.threshold"};
    }
    const bool parts = pair->parameter != "duplicates.threshold";
    const std::string text = parts
                                 ? "joined with another part of a vehicle: together " + story.lengthText(pair->value) +
                                       " long, up to " + story.lengthText(pair->limit) + " are one vehicle"
                                 : "removed as a duplicate: overlaps another detection by " + numberText(pair->value) +
                                       ", duplicates overlap by " + numberText(pair->limit);
    return {text, "The detection here was " + text, pair->parameter};
}

Refusal refusedBySize(const Story& story, const RemovalVerdict& verdict) {
    const std::string text = textOf(verdict, story.here);
    if (verdict.parameter == "outliers.inside_image")
        return {text, "The detection here reaches beyond the picture: " + text, verdict.parameter};
    if (text.empty()) return {"an impossible size of the box", "The detection here has an impossible size", {}};
    return {"size of the box: " + text, "The detection here has an impossible size: " + text, verdict.parameter};
}

Refusal refusalOf(const Story& story, int index, const RemovalVerdict& verdict) {
    switch (verdict.rejection) {
        case Rejection::duplicate:
            return refusedAsDuplicate(story, index, verdict);
        case Rejection::size:
            return refusedBySize(story, verdict);
        case Rejection::outlier:
        case Rejection::none:
            break;
    }
    const std::string why = "The detection here was removed as an outlier";
    const std::string text = textOf(verdict, story.here);
    if (text.empty()) return {"removed as an outlier", why, {}};
    return {text, why + ": " + text, verdict.parameter};
}

}  // namespace

bool tellRemoval(Story& story, std::vector<int>& detections) {
    const FrameResult& result = story.evidence.result;
    std::vector<int> kept;
    Refusal nearest;  // of the rejected ones that which lies best on the place decides
    std::optional<Rejection> rejection;
    double most = -1;
    for (const int index : detections) {
        const Detection& detection = result.detections[static_cast<std::size_t>(index)];
        const RemovalVerdict verdict = whyRemoved(detection, result.motion, story.options.outliers, story.scale);
        if (verdict.rejection == Rejection::none) {
            if (!verdict.parameter.empty()) story.pass("removal", textOf(verdict, story.here), verdict.parameter);
            if (!std::isnan(detection.probability)) {
                story.note("removal", "a moving vehicle with a probability of " + numberText(detection.probability) +
                                          ", by this frame alone");
            }
            kept.push_back(index);
            continue;
        }
        Refusal refusal = refusalOf(story, index, verdict);
        if (verdict.rejection == Rejection::duplicate)
            story.note("removal", refusal.step, refusal.parameter);
        else
            story.fail("removal", refusal.step, refusal.parameter);
        const double shared = overlap(detection.box, story.evidence.area);
        if (shared <= most) continue;
        most = shared;
        nearest = std::move(refusal);
        rejection = verdict.rejection;
    }
    detections = kept;
    if (!kept.empty()) return true;
    if (story.decide(nearest.sentence, nearest.parameter)) story.told.rejection = rejection;
    return false;
}

}  // namespace eyrie::explaining

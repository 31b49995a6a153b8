#include "explain/explanation.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "explain/explanation_steps.h"
#include "motion/clusters/place_contents.h"

namespace eyrie {
namespace explaining {
namespace {

/// Frames that a corner must have been tracked in this video.
int ageNeeded(const Story& story) {
    return story.options.motion.atRate(story.scale.frame_rate_hz).min_age;
}

/// The parameter's value with its unit, "3 vectors".
std::string settingOf(const ChainOptions& options, const std::string& name) {
    ChainOptions copy = options;
    for (const Parameter& parameter : listParameters(describeOf(copy))) {
        if (parameter.name != name) continue;
        return parameter.text.unit.empty() ? parameter.value : parameter.value + " " + parameter.text.unit;
    }
    return {};
}

const char* fateText(CornerFate fate) {
    switch (fate) {
        case CornerFate::moving:
            return "moving";
        case CornerFate::young:
            return "too young";
        case CornerFate::slow:
            return "too slow";
        case CornerFate::too_fast:
            return "too fast";
        case CornerFate::parallax:
            return "explained by parallax";
        case CornerFate::shadow:
            break;
    }
    return "on a shadow";
}

/// The corner that came closest to its limit among those with this fate.
const CornerVerdict* closestOf(const std::vector<const CornerVerdict*>& corners, CornerFate fate) {
    const CornerVerdict* best = nullptr;
    for (const CornerVerdict* corner : corners) {
        if (corner->fate != fate) continue;
        const bool closer =
            best == nullptr || (fate == CornerFate::young ? corner->age > best->age
                                                          : corner->speed * best->limit > best->speed * corner->limit);
        if (closer) best = corner;
    }
    return best;
}

void decideByFate(Story& story, const std::vector<const CornerVerdict*>& corners) {
    std::array<int, 6> counts{};
    for (const CornerVerdict* corner : corners) ++counts[static_cast<std::size_t>(corner->fate)];
    counts[static_cast<std::size_t>(CornerFate::moving)] = 0;
    // What came furthest decided; of equals the commoner fate.
    constexpr std::array<CornerFate, 5> kFurthest{CornerFate::shadow, CornerFate::parallax, CornerFate::too_fast,
                                                  CornerFate::slow, CornerFate::young};
    CornerFate fate = CornerFate::young;
    for (const CornerFate candidate : kFurthest) {
        const int count = counts[static_cast<std::size_t>(candidate)];
        const bool may_be_outweighed = candidate != CornerFate::slow && candidate != CornerFate::young;
        if (count == 0) continue;
        if (may_be_outweighed && 4 * count < static_cast<int>(corners.size())) continue;
        fate = candidate;
        break;
    }
    const CornerVerdict* closest = closestOf(corners, fate);
    if (closest == nullptr) return;
    switch (fate) {
        case CornerFate::young:
            story.decide("The oldest corner here has been tracked for " + std::to_string(closest->age) + " frames, " +
                             std::to_string(ageNeeded(story)) + " are needed",
                         closest->parameter);
            break;
        case CornerFate::slow:
            story.decide("The fastest corner here moves " + story.speedText(closest->speed) + ", " +
                             story.speedText(closest->limit) + " are needed",
                         closest->parameter);
            break;
        case CornerFate::too_fast:
            story.decide("The corners here move " + story.speedText(closest->speed) + ", at most " +
                             story.speedText(closest->limit) + " are accepted",
                         closest->parameter);
            break;
        case CornerFate::parallax:
            story.decide("The corners here move along the epipolar lines, " + story.speedText(closest->speed) +
                             ", no faster than the parallax of what stands in this scene",
                         closest->parameter);
            break;
        case CornerFate::shadow:
        case CornerFate::moving:
            story.decide("The corners here lie on the outline of a moving shadow", "motion.shadow_test");
            break;
    }
}

/// What was measured on the corners of the place, as steps.
void tellVerdicts(Story& story, const std::vector<const CornerVerdict*>& corners) {
    std::array<int, 6> counts{};
    std::size_t inliers = 0;
    int oldest = 0;
    for (const CornerVerdict* corner : corners) {
        ++counts[static_cast<std::size_t>(corner->fate)];
        inliers += corner->on_background;
        oldest = std::max(oldest, corner->age);
    }
    story.note("corners",
               countText(inliers, "corner agrees", "corners agree") + " with the ground's homography (RANSAC), " +
                   std::to_string(corners.size() - inliers) + " do not",
               "registration.inlier_distance");
    const int needed = ageNeeded(story);
    const std::string ages = "the oldest of " + countText(corners.size(), "corner", "corners") + " has been tracked " +
                             std::to_string(oldest) + " frames, " + std::to_string(needed) + " are needed";
    if (oldest >= needed)
        story.pass("motion", ages, "motion.min_age");
    else
        story.fail("motion", ages, "motion.min_age");
    for (const CornerFate fate : {CornerFate::moving, CornerFate::slow, CornerFate::young, CornerFate::too_fast,
                                  CornerFate::parallax, CornerFate::shadow}) {
        const int count = counts[static_cast<std::size_t>(fate)];
        if (count == 0) continue;
        const CornerVerdict& closest = *closestOf(corners, fate);
        std::string text =
            countText(static_cast<std::size_t>(count), "corner is ", "corners are ") + std::string(fateText(fate));
        if (closest.baseline > 0) {
            text += ": fastest " + story.speedText(closest.speed) + ", threshold " + story.speedText(closest.limit) +
                    " over " + std::to_string(closest.baseline) + " frames";
        }
        if (fate == CornerFate::moving)
            story.pass("motion", text, "motion.min_speed");
        else
            story.note("motion", text, closest.parameter);
    }
}

}  // namespace

void Story::pass(const char* stage, const std::string& text, const std::string& parameter) {
    told.steps.push_back({stage, StepVerdict::passed, text, parameter});
}

void Story::note(const char* stage, const std::string& text, const std::string& parameter) {
    told.steps.push_back({stage, StepVerdict::note, text, parameter});
}

void Story::fail(const char* stage, const std::string& text, const std::string& parameter) {
    told.steps.push_back({stage, StepVerdict::failed, text, parameter});
}

bool Story::decide(const std::string& sentence, const std::string& parameter) {
    if (decided) return false;
    decided = true;
    told.parameter = parameter;
    if (!parameter.empty()) told.setting = settingOf(options, parameter);
    told.sentence = sentence;
    if (!told.sentence.empty())
        told.sentence.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(told.sentence.front())));
    if (!parameter.empty()) told.sentence += ": " + parameter + (told.setting.empty() ? "" : " = " + told.setting);
    told.sentence += ".";
    return true;
}

std::string Story::speedText(double px_per_frame) const {
    std::string text = numberText(px_per_frame) + " px/frame";
    if (here.gsd_known) text += " (" + numberText(here.metresPerSecond(px_per_frame)) + " m/s)";
    return text;
}

std::string Story::lengthText(double px) const {
    return pxText(px, here);
}

bool tellRegistration(Story& story) {
    const Registration& registration = story.evidence.result.motion.registration;
    switch (registration.state) {
        case RegistrationState::first:
            story.fail("registration", "the first frame of the run: there is nothing to register it onto");
            story.decide("This is the first frame of the run, in which nothing can be seen to move", {});
            return false;
        case RegistrationState::failed: {
            const std::string why = describe(registration.failure);
            const std::string parameter = parameterOf(registration.failure);
            story.fail("registration", "not registered: " + why, parameter);
            story.decide("The frame could not be registered (" + why + ")", parameter);
            return false;
        }
        case RegistrationState::frozen:
            story.note("registration", "the picture repeats the one before; nothing moves in it");
            return true;
        case RegistrationState::registered:
            break;
    }
    const Homography& map = registration.current_from_previous;
    story.pass("registration",
               countText(static_cast<std::size_t>(map.inliers), "corner agrees", "corners agree") + ", " +
                   numberText(map.rms_px) + " px rms",
               "registration.min_inliers");
    return true;
}

bool tellCorners(Story& story) {
    const PlaceEvidence& evidence = story.evidence;
    const FrameMotion& motion = evidence.result.motion;
    const std::size_t vectors = vectorsAtPlace(evidence.area, motion).size();
    std::vector<const CornerVerdict*> corners;
    std::size_t found = vectors;
    if (evidence.corners) {
        for (const CornerVerdict& verdict : *evidence.corners) {
            if (evidence.area.contains(verdict.position, kOutlineMargin_px)) corners.push_back(&verdict);
        }
        found = std::max(found, corners.size());
    } else {
        for (const cv::Point2f& corner : motion.stationary_corners)
            found += evidence.area.contains(corner, kOutlineMargin_px);
    }
    if (found == 0) {
        const int most = story.options.registration.corners.mostCorners(motion.image_size);
        const bool full = motion.corner_count >= most * 95 / 100;
        story.fail("corners", "no corner was tracked here",
                   full ? "registration.max_corners" : "registration.corner_deviation");
        if (full)
            story.decide("No corner was tracked here, and the frame has all " + std::to_string(motion.corner_count) +
                             " corners it may have",
                         "registration.max_corners");
        else
            story.decide("No corner was tracked here: there is too little texture for one",
                         "registration.corner_deviation");
        return false;
    }
    story.pass("corners", countText(found, "corner", "corners") + " here, " + std::to_string(motion.corner_count) +
                              " in the frame");
    if (!corners.empty()) tellVerdicts(story, corners);
    if (vectors > 0) {
        story.pass("motion", countText(vectors, "motion vector", "motion vectors") + " here");
        return true;
    }
    // Difference images find what moves without vectors.
    if (story.options.difference.method != MotionMethod::vectors) return true;
    story.fail("motion", "no motion vector here");
    decideByFate(story, corners);
    story.decide("No corner here moves enough to become a motion vector", "motion.min_speed");
    return false;
}

const TrackState* storedTrackAt(const PlaceEvidence& evidence) {
    return bestAt(evidence.result.tracks, evidence.area,
                  [](const TrackState& track) { return track.status != TrackStatus::tentative; });
}

}  // namespace explaining

OrientedBox placeAt(cv::Point2d point, const SceneScale& scale) {
    constexpr double kSmallest = 8;
    const double side = std::max(scale.at(point).px(kCarLength_m), kSmallest);
    return {point, side, side, 0};
}

Explanation explain(const PlaceEvidence& evidence, const ChainOptions& options, const SceneScale& scale) {
    using namespace explaining;
    const SceneScale of_frame = scale.zoomed(evidence.result.motion.registration.zoom);
    Story story{evidence, options, of_frame, of_frame.at(evidence.area.centre)};
    // The last stage that had the object decides: what finishing left out had passed all those before.
    const auto left_out = leftOutAt(evidence);
    if (left_out) decideLeftOut(story, *left_out);
    std::vector<int> clusters;
    std::vector<int> detections;
    const bool detected = tellRegistration(story) && tellCorners(story) && tellClusters(story, clusters) &&
                          tellDetection(story, clusters, detections) && tellRemoval(story, detections);
    // Without a detection a track may still be carried on by its motion vectors or its prediction.
    if (!detected) detections.clear();
    tellTracks(story, detections, left_out);
    const TrackState* stored = storedTrackAt(evidence);
    if (stored != nullptr) {
        const std::string miss = story.told.sentence;
        story.told.found = true;
        story.told.sentence = "Track " + std::to_string(stored->id) + " is here: " + nameOf(stored->status) + ", " +
                              nameOf(stored->origin);
        if (story.decided)
            story.told.sentence += ", but without a detection of its own in this frame. " + miss;
        else
            story.told.sentence += ".";
        if (!story.decided) story.told.parameter.clear();
    }
    return story.told;
}

}  // namespace eyrie

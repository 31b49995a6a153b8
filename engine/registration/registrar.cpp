#include "registration/registrar.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>
#include <utility>

#include "core/error.h"
#include "core/stopwatch.h"
#include "registration/estimation/frames_passed.h"
#include "registration/estimation/point_jacobian.h"
#include "registration/pictures/noise_level.h"
#include "registration/pictures/scaled_to_one.h"

namespace eyrie {
namespace {

// A fit on which fewer agree is tried again with any perspective, and given up for one on which clearly more do.
constexpr double kUnquestionedShare = 0.5;
constexpr double kClearlyMore = 1.2;
constexpr double kNearPx = 1;       ///< off the coarse registration, for a corner that surely agrees with it
constexpr double kFarthestPx = 10;  ///< off the coarse registration, for a corner that was looked for around it
constexpr std::size_t kRecent = 8;  ///< motions that a camera's usual one is told by: single ones tremble
constexpr int kFewestTelling = 8;   ///< corners that drive, to ask for missing pictures …
constexpr int kMostMissing = 3;     ///< … in a row

std::vector<cv::Point2f> positionsOf(const CornerSet& set) {
    std::vector<cv::Point2f> positions;
    positions.reserve(set.corners.size());
    for (const TrackedCorner& corner : set.corners) positions.push_back(corner.position);
    return positions;
}

/// Of what is drawn into the picture no ground can be told.
void removeWhere(CornerSet& set, const PictureMask& mask) {
    if (mask.empty()) return;
    set.removeIf([&](const TrackedCorner& corner) { return mask.marks(corner.position); });
}

}  // namespace

Registrar::Registrar(const RegistrationOptions& options, const SceneScale& scale, double zoom_before)
    : options_(options),
      scale_(scale),
      detector_(options.corners, scale.zoomed(zoom_before)),
      tracker_(options.tracking, scale.zoomed(zoom_before)),
      graphics_(options.graphics),
      zoom_(scale, zoom_before),
      clock_(scale.frame_rate_hz) {}

void Registrar::zoomTo(double zoom) {
    detector_ = CornerDetector(options_.corners, scale_.zoomed(zoom));
    tracker_.setFastest(scale_.zoomed(zoom));
}

void Registrar::reset() {
    anchor_.reset();
    older_.reset();
    estimator_.reset();
    repetition_.reset();
    graphics_.reset();
    zoom_.reset();
    zoomTo(1);
    motion_ = cv::Matx33d::eye();
    recent_.clear();
    repeated_ = 0;
    usual_corners_ = 0;
}

void Registrar::checkFrame(const Frame& frame) const {
    const std::string name = "frame " + std::to_string(frame.index);
    if (frame.gray.empty()) throw Error(ErrorKind::input, name + " is empty; remove it or cut the video before it");
    if (frame.gray.type() != CV_8UC1) throw Error(ErrorKind::input, name + " is not an 8-bit grey picture");
    const cv::Size before = anchor_ ? anchor_->pyramid.size() : frame.gray.size();
    if (frame.gray.size() == before) return;
    throw Error(ErrorKind::input, name + " measures " + std::to_string(frame.gray.cols) + "×" +
                                      std::to_string(frame.gray.rows) + " px, the frames before it " +
                                      std::to_string(before.width) + "×" + std::to_string(before.height) +
                                      "; process the parts of the video one by one");
}

RegisteredFrame Registrar::next(const Frame& frame, StageTimes* times) {
    checkFrame(frame);
    StageTimes own{};
    StageTimes& spent = times != nullptr ? *times : own;
    if (times != nullptr) {
        for (const Stage stage : {Stage::corners, Stage::tracking_corners, Stage::homography}) {
            spent[static_cast<std::size_t>(stage)] = 0;
        }
    }
    RegisteredFrame result;
    const int repeated_before = repeated_;
    bool repeats = false;
    {
        const Stopwatch timer(spent, Stage::tracking_corners);
        current_.build(frame.gray);
        current_noise_ = noiseLevel(current_.level(0));
        current_time_us_ = frame.time_us;
        repeats = anchor_ && repetition_.repeats(difference(anchor_->pyramid.level(0), current_.level(0)));
    }
    if (!anchor_) {
        result = firstFrame(frame, spent);
    } else if (repeats) {
        result = repeatedFrame(frame);
    } else {
        RegistrationFailure failure;
        std::optional<Match> match;
        bool on_older = false;
        if (older_) {
            match = registerOnto(*older_, failure, spent);
            on_older = match.has_value();
        }
        if (!match) match = registerOnto(*anchor_, failure, spent);
        if (match) {
            Anchor anchor = std::move(on_older ? *older_ : *anchor_);
            older_.reset();
            result = registeredFrame(frame, std::move(anchor), *match, spent);
        } else {
            result = failedFrame(frame, failure, spent);
        }
        repeated_ = 0;
    }
    result.graphics = graphics_.mask();
    const double zoom_before = zoom_.zoom();
    result.registration.zoom = zoom_.next(result.registration, frame.gray.size());
    if (result.registration.zoom != zoom_before) zoomTo(result.registration.zoom);
    clock_.next(frame.time_us, result.registration, repeated_before);
    last_frame_ = frame.index;
    return result;
}

Registrar::Anchor Registrar::freshAnchor(const Frame& frame) const {
    return {current_, CornerSet(tracker_.window()), current_noise_, cv::Matx33d::eye(), 0, frame.index, frame.time_us};
}

RegisteredFrame Registrar::firstFrame(const Frame& frame, StageTimes& times) {
    estimator_.emplace(options_.homography, frame.gray.size());
    Anchor anchor = freshAnchor(frame);
    replenish(anchor, times);
    usual_corners_ = anchor.corners.size();
    RegisteredFrame result;
    result.frame = frame.index;
    result.registration.state = RegistrationState::first;
    result.registration.current_from_previous.from_frame = frame.index;
    result.registration.current_from_previous.to_frame = frame.index;
    for (const TrackedCorner& corner : anchor.corners.corners) {
        result.corners.push_back({corner.id, corner.position, corner.position, 0, false});
    }
    anchor_ = std::move(anchor);
    return result;
}

RegisteredFrame Registrar::repeatedFrame(const Frame& frame) {
    ++repeated_;
    RegisteredFrame result;
    result.frame = frame.index;
    result.registration.state = RegistrationState::frozen;
    result.registration.current_from_previous.from_frame = last_frame_;
    result.registration.current_from_previous.to_frame = frame.index;
    for (const TrackedCorner& corner : anchor_->corners.corners) {
        if (!corner.sticks)
            result.corners.push_back({corner.id, corner.position, corner.position, corner.age, corner.on_background});
    }
    return result;
}

std::vector<cv::Matx33d> Registrar::predictionsFor(const Anchor& anchor) const {
    // Over frozen and missing frames the camera either went on or stood still with them.
    std::vector<cv::Matx33d> predictions{scaledToOne(motion_ * anchor.latest_from_anchor)};
    if (const int most = mostPassedSince(anchor); most > 1)
        predictions.push_back(scaledToOne(powerOf(motion_, std::min(most, 21)) * anchor.latest_from_anchor));
    predictions.push_back(anchor.latest_from_anchor);
    if (anchor.frames_ago > 0) predictions.push_back(cv::Matx33d::eye());
    predictions.erase(std::remove_if(predictions.begin(), predictions.end(),
                                     [&](const cv::Matx33d& m) { return !plausibleMotion(m, anchor.pyramid.size()); }),
                      predictions.end());
    if (predictions.empty()) predictions.push_back(cv::Matx33d::eye());
    return predictions;
}

int Registrar::mostPassedSince(const Anchor& anchor) const {
    const int shown = repeated_ + 1;
    if (anchor.frames_ago > 0 || recent_.size() < kRecent) return shown;
    return std::max(shown, clock_.mostPassed(anchor.time_us, current_time_us_));
}

void Registrar::trackMovers(const Anchor& anchor, const cv::Matx33d& start, double noise, Match& match) const {
    int most_there = -1;
    const auto attempt = [&](int elapsed, int other) {
        std::vector<TrackedPosition> found =
            tracker_.track(anchor.corners, anchor.pyramid, current_, start, noise, anchor.frames_ago + elapsed);
        // What moves by itself is found where it has come to.
        const TellingMovers movers = moversAfter(elapsed, other, anchor.corners, found, start);
        if (movers.there > most_there) {
            most_there = movers.there;
            match.elapsed = elapsed;
            match.positions = std::move(found);
        }
        return movers.all;
    };
    const int most = mostPassedSince(anchor);
    if (most > 1 && anchor.frames_ago == 0) {
        for (const int elapsed : framesPassedBy(start, recent_, repeated_, most, anchor.pyramid.size()))
            attempt(elapsed, elapsed == 1 ? most : 1);
        return;
    }
    const int all = attempt(1, 2);
    if (anchor.frames_ago > 0) return;
    // Where most of what moved is gone at once, pictures may be missing.
    for (int elapsed = 2; elapsed <= kMostMissing + 1; ++elapsed) {
        if (all < kFewestTelling || 2 * most_there >= all) return;
        most_there = std::max(most_there, all / 4);
        attempt(elapsed, elapsed - 1);
    }
}

std::optional<Registrar::Match> Registrar::registerOnto(const Anchor& anchor, RegistrationFailure& failure,
                                                        StageTimes& times) const {
    const int corners = anchor.corners.size();
    if (corners < options_.homography.min_inliers) {
        failure = {
            .fault = RegistrationFault::too_few_corners, .count = corners, .of = options_.homography.min_inliers};
        return std::nullopt;
    }
    const double noise = std::max(anchor.noise, current_noise_);
    Match match;
    cv::Matx33d start;
    {
        const Stopwatch timer(times, Stage::tracking_corners);
        const auto coarse = CoarseRegistration(*estimator_, options_.feature_search, graphics_.mask())
                                .find(anchor.corners, anchor.pyramid, current_, predictionsFor(anchor), noise);
        if (!coarse) {
            failure = {.fault = RegistrationFault::no_match};
            return std::nullopt;
        }
        start = coarse->matrix;
        trackMovers(anchor, start, noise, match);
    }
    const Stopwatch timer(times, Stage::homography);
    const Correspondences points =
        tracker_.correspondences(anchor.corners, match.positions, anchor.pyramid.size(), noise);
    const int tracked = static_cast<int>(
        std::count_if(match.positions.begin(), match.positions.end(), [](const auto& p) { return p.found; }));
    if (tracked < options_.homography.min_inliers || tracked * 8 < corners) {
        failure = {.fault = RegistrationFault::too_few_found_again, .count = tracked, .of = corners};
        return std::nullopt;
    }
    auto fit = estimator_->refine(points, start);
    const auto inliersOf = [](const std::optional<HomographyFit>& each) { return each ? each->inliers : 0; };
    if (!fit || fit->inlier_share < kUnquestionedShare) {
        const HomographyEstimator free = estimator_->anyPerspective();
        const auto consider = [&](const std::optional<HomographyFit>& other) {
            if (inliersOf(other) > kClearlyMore * inliersOf(fit)) fit = other;
        };
        // Graphics that are drawn into the picture are so sharp that they outweigh a dull ground.
        consider(estimator_->refine(points, start, 1, kNearPx));
        consider(free.refine(points, start, 1, kFarthestPx));
        if (!fit || !estimator_->trustworthy(*fit)) {
            const auto sampled = free.search(points, MotionModel::homography, options_.homography.inlier_distance);
            if (sampled) consider(free.refine(points, *sampled));
        }
    }
    if (!fit || !estimator_->trustworthy(*fit)) {
        failure = {.fault = RegistrationFault::too_few_agree, .count = inliersOf(fit), .of = tracked};
        return std::nullopt;
    }
    if (!plausibleMotion(fit->matrix, anchor.pyramid.size())) {
        failure = {.fault = RegistrationFault::impossible_motion};
        return std::nullopt;
    }
    match.fit = *fit;
    return match;
}

RegisteredFrame Registrar::registeredFrame(const Frame& frame, Anchor anchor, const Match& match, StageTimes& times) {
    RegisteredFrame result;
    result.frame = frame.index;
    result.registration.state = RegistrationState::registered;
    result.registration.elapsed = match.elapsed;
    Homography& homography = result.registration.current_from_previous;
    homography.from_frame = last_frame_;
    homography.to_frame = frame.index;
    homography.inliers = match.fit.inliers;
    homography.rms_px = match.fit.rms_px;
    // Across failed frames, whose homographies were guesses, the product of guesses and this one is right again.
    homography.matrix =
        anchor.frames_ago == 0 ? match.fit.matrix : scaledToOne(match.fit.matrix * anchor.latest_from_anchor.inv());

    std::vector<std::pair<CornerId, cv::Point2f>> before;
    before.reserve(anchor.corners.corners.size());
    for (const TrackedCorner& corner : anchor.corners.corners) {
        const cv::Point2f position =
            anchor.frames_ago == 0 ? corner.position : PointJacobian(anchor.latest_from_anchor, corner.position).point;
        before.emplace_back(corner.id, position);
    }
    {
        const Stopwatch timer(times, Stage::tracking_corners);
        tracker_.advance(anchor.corners, match.positions, match.fit, current_.smooth(),
                         anchor.frames_ago + match.elapsed, std::max(1.0, 0.4 * detector_.spacing()));
        graphics_.add(current_, anchor.corners, homography.matrix);
        removeWhere(anchor.corners, graphics_.mask());
    }
    if (anchor.frames_ago == 0 && repeated_ == 0 && match.elapsed == 1) {
        motion_ = match.fit.matrix;
        recent_.push_back(motion_);
        if (recent_.size() > kRecent) recent_.pop_front();
    }
    std::swap(anchor.pyramid, current_);
    anchor.noise = current_noise_;
    anchor.latest_from_anchor = cv::Matx33d::eye();
    anchor.frames_ago = 0;
    anchor.frame = frame.index;
    anchor.time_us = frame.time_us;
    replenish(anchor, times);
    usual_corners_ = 0.9 * usual_corners_ + 0.1 * anchor.corners.size();

    result.corners.reserve(anchor.corners.corners.size());
    std::size_t at = 0;
    for (const TrackedCorner& corner : anchor.corners.corners) {
        if (corner.sticks) continue;
        while (at < before.size() && before[at].first < corner.id) ++at;
        const bool known = at < before.size() && before[at].first == corner.id;
        result.corners.push_back({corner.id, known ? before[at].second : corner.position, corner.position, corner.age,
                                  corner.on_background});
    }
    anchor_ = std::move(anchor);
    return result;
}

RegisteredFrame Registrar::failedFrame(const Frame& frame, RegistrationFailure failure, StageTimes& times) {
    Anchor fresh = freshAnchor(frame);
    replenish(fresh, times);
    graphics_.loseWay();
    RegisteredFrame result;
    result.frame = frame.index;
    result.registration.state = RegistrationState::failed;
    const int seen = fresh.corners.size();
    const bool blank = seen < options_.homography.min_inliers;
    const bool blurred = !blank && seen < 0.35 * usual_corners_;
    failure.picture = blank ? PictureQuality::blank : blurred ? PictureQuality::blurred : PictureQuality::clear;
    if (failure.picture == PictureQuality::clear && failure.fault == RegistrationFault::no_match)
        failure.fault = RegistrationFault::cut;
    result.registration.failure = failure;
    // Through a blank or blurred picture the camera goes on as before; after a cut nothing is known.
    const cv::Matx33d guess = blank || blurred ? motion_ : cv::Matx33d::eye();
    Homography& homography = result.registration.current_from_previous;
    homography.matrix = guess;
    homography.from_frame = last_frame_;
    homography.to_frame = frame.index;

    if (!older_ && anchor_->corners.size() >= options_.homography.min_inliers) older_ = std::move(anchor_);
    if (older_) {
        older_->latest_from_anchor = scaledToOne(guess * older_->latest_from_anchor);
        ++older_->frames_ago;
        if (older_->frames_ago > options_.recovery_frames ||
            !plausibleMotion(older_->latest_from_anchor, older_->pyramid.size())) {
            older_.reset();
        }
    }
    if (!blank && !blurred) {
        motion_ = cv::Matx33d::eye();
        recent_.clear();
    }
    for (const TrackedCorner& corner : fresh.corners.corners) {
        result.corners.push_back({corner.id, corner.position, corner.position, 0, false});
    }
    anchor_ = std::move(fresh);
    return result;
}

void Registrar::replenish(Anchor& anchor, StageTimes& times) {
    const Stopwatch timer(times, Stage::corners);
    CornerSurroundings surroundings;
    surroundings.living = positionsOf(anchor.corners);
    for (const TrackedCorner& corner : anchor.corners.corners) {
        if (corner.moves && !corner.sticks) surroundings.movers.push_back(corner.position);
    }
    surroundings.noise = anchor.noise;
    surroundings.margin = tracker_.margin();
    surroundings.graphics = graphics_.mask();
    tracker_.add(anchor.corners, detector_.detect(anchor.pyramid.level(0), surroundings), anchor.pyramid.smooth(),
                 next_id_);
}

}  // namespace eyrie

#include "motion/vectors/independent_motion.h"

#include <algorithm>
#include <cmath>

#include "motion/vectors/noise_map.h"

namespace eyrie {
namespace {

constexpr double kTurnShare = 0.2;  ///< change of velocity, as a share of the speed, that is surely a turn
constexpr double kTurnSigmas = 2;   ///< … and in deviations of such a change

bool finite(cv::Point2d p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

bool finite(const Homography& homography) {
    return std::all_of(std::begin(homography.matrix.val), std::end(homography.matrix.val),
                       [](double value) { return std::isfinite(value); });
}

double length(cv::Point2d v) {
    return std::sqrt(v.dot(v));
}

}  // namespace

IndependentMotion::IndependentMotion(const IndependentMotionOptions& options, const SceneScale& scale)
    : options_(options.atRate(scale.frame_rate_hz)),
      first_scale_(scale),
      scale_(scale),
      everywhere_(limitsUnder(scale)),
      shadow_test_(options.shadow, scale),
      shadow_owners_(options.shadow, scale),
      local_background_(options.local_background, scale),
      parallax_test_(options.parallax),
      silhouettes_(options.silhouettes, scale),
      areas_(options.areas, scale),
      history_(std::max(options_.baseline, options.find_slow ? options.slow_baseline : 0)) {
    options_.baseline = std::max(options_.baseline, options_.min_age);
    if (options_.baseline > history_.depth()) history_ = CornerHistory(options_.baseline);
}

void IndependentMotion::zoomTo(double zoom) {
    if (zoom == zoom_) return;
    zoom_ = zoom;
    scale_ = first_scale_.zoomed(zoom);
    everywhere_ = limitsUnder(scale_);
    shadow_test_ = ShadowTest(options_.shadow, scale_);
    shadow_owners_ = ShadowOwners(options_.shadow, scale_);
    local_background_ = LocalBackground(options_.local_background, scale_);
    silhouettes_.setScale(scale_);
    areas_.setScale(scale_);
}

void IndependentMotion::reset() {
    restart();
    last_frame_.reset();
    last_motion_ = {};
    silhouettes_.clear();
    areas_.clear();
}

void IndependentMotion::restart() {
    history_.clear();
    paths_.clear();
    newest_ = {};
    any_picture_ = false;
}

bool IndependentMotion::extendPaths(const Registration& registration) {
    const Homography& step = registration.current_from_previous;
    if (!last_frame_ || step.from_frame != *last_frame_ || !finite(step)) return false;
    if (!any_picture_) return true;
    for (Path& path : paths_) path = {step * path.current_from_past, path.frames + registration.framesPassed()};
    newest_ = {step * newest_.current_from_past, newest_.frames + registration.framesPassed()};
    return true;
}

void IndependentMotion::takePicture(const RegisteredFrame& registered) {
    if (any_picture_) paths_.push_front(newest_);
    if (static_cast<int>(paths_.size()) > history_.depth()) paths_.pop_back();
    newest_ = {};
    newest_.current_from_past.from_frame = registered.frame;
    newest_.current_from_past.to_frame = registered.frame;
    any_picture_ = true;
    history_.append(registered.corners);
}

IndependentMotion::Measured IndependentMotion::measure(std::size_t corner, cv::Point2d now, int longest) const {
    int back = std::min(history_.steps(corner), longest);
    while (back > 0 && paths_[static_cast<std::size_t>(back - 1)].frames > longest) --back;
    if (back == 0) return {};
    const Path& path = paths_[static_cast<std::size_t>(back - 1)];
    if (path.frames < options_.min_age) return {};
    const cv::Point2d displacement = now - path.current_from_past.apply(history_.past(corner, back));
    if (!finite(displacement)) return {};
    return {path.frames, displacement / path.frames};
}

cv::Point2d IndependentMotion::presentVelocity(std::size_t corner, cv::Point2d now, cv::Point2d mean,
                                               double sigma) const {
    const int half = options_.baseline / 2;
    if (!options_.follow_turns || half < 3 || history_.steps(corner) < 2 * half) return mean;
    const Path& recent = paths_[static_cast<std::size_t>(half - 1)];
    const Path& whole = paths_[static_cast<std::size_t>(2 * half - 1)];
    if (recent.frames < 3 || whole.frames != 2 * recent.frames || whole.frames > options_.baseline) return mean;
    const cv::Point2d middle = recent.current_from_past.apply(history_.past(corner, half));
    const cv::Point2d begin = whole.current_from_past.apply(history_.past(corner, 2 * half));
    const cv::Point2d late = (now - middle) / recent.frames;
    const cv::Point2d early = (middle - begin) / recent.frames;
    const double speed = length(mean);
    if (!finite(late) || !finite(early) || speed <= 0) return mean;
    // Across the motion only: along it corners scatter far more.
    const cv::Point2d across(-mean.y / speed, mean.x / speed);
    const cv::Point2d change = (late - early).dot(across) * across;
    // Noise of `change` is 3.5 times that of the mean velocity.
    const double certain = std::max(kTurnShare * speed, kTurnSigmas * 3.5 * sigma);
    const double trust = std::clamp(2 * length(change) / certain - 1, 0.0, 1.0);
    return mean + trust * change;
}

IndependentMotion::SpeedLimits IndependentMotion::limitsUnder(const SceneScale& here) const {
    return {std::max(here.pxPerFrame(options_.min_speed_m_s), options_.min_speed_px),
            std::max(here.pxPerFrame(options_.slow_min_speed_m_s), options_.min_speed_px),
            here.gsd_known ? here.pxPerFrame(options_.max_speed_m_s) : 0};
}

double IndependentMotion::speedLimit(double min_speed, double sigma) const {
    return std::max(min_speed, options_.sigma_factor * sigma);
}

CornerVerdict IndependentMotion::verdictOn(const Corner& corner, const Measured& measured, const Measured& slow,
                                           const BackgroundNoise& noise, double noise_here) const {
    CornerVerdict verdict;
    verdict.id = corner.id;
    verdict.position = corner.current;
    verdict.age = corner.age;
    verdict.on_background = corner.on_background;
    const bool young = corner.age < options_.min_age || measured.baseline == 0;
    const auto take = [&](const Measured& m, double min_speed, const char* name) {
        const double sigma = noise_here * noise.sigma(m.baseline);
        const double limit = speedLimit(min_speed, sigma);
        const double speed = length(m.velocity);
        const bool closer = verdict.baseline == 0 || speed * verdict.limit > verdict.speed * limit;
        if (m.baseline == 0 || !closer) return;
        verdict.baseline = m.baseline;
        verdict.speed = speed;
        verdict.limit = limit;
        if (options_.sigma_factor * sigma >= min_speed)
            verdict.parameter = "motion.sigma_factor";
        else
            verdict.parameter = min_speed > options_.min_speed_px ? name : "motion.min_speed_px";
    };
    const SpeedLimits limits = limitsAt(corner.current);
    take(measured, limits.least, "motion.min_speed");
    if (options_.find_slow) take(slow, limits.least_slow, "motion.slow_min_speed");
    verdict.fate = CornerFate::slow;
    if (young) {
        verdict.fate = CornerFate::young;
        verdict.parameter = "motion.min_age";
    } else if (limits.most > 0 && verdict.speed > limits.most) {
        verdict.fate = CornerFate::too_fast;
        verdict.parameter = "motion.max_speed";
        verdict.limit = limits.most;
    }
    return verdict;
}

void IndependentMotion::sortCorners(const RegisteredFrame& registered, const Frame& frame, FrameMotion& motion,
                                    CornerVerdicts* verdicts) {
    const std::vector<Corner>& corners = registered.corners;
    std::vector<Measured> measured(corners.size());
    std::vector<Measured> slow(options_.find_slow ? corners.size() : 0);
    const int depth = history_.depth();
    BackgroundNoise noise(depth);
    const auto background = static_cast<std::size_t>(
        std::count_if(corners.begin(), corners.end(), [](const Corner& corner) { return corner.on_background; }));
    const bool trust_background = background * 4 >= corners.size();
    const auto isGround = [&](const Corner& corner) { return !trust_background || corner.on_background; };

    for (std::size_t i = 0; i < corners.size(); ++i) {
        const cv::Point2d now = corners[i].current;
        measured[i] = measure(i, now, options_.baseline);
        if (options_.find_slow && history_.steps(i) >= options_.slow_min_age) {
            slow[i] = measure(i, now, options_.slow_baseline);
        }
    }
    if (options_.local_background.local_background) {
        local_background_.prepare(frame.gray.empty() ? motion.image_size : frame.gray.size());
        for (std::size_t i = 0; i < corners.size(); ++i) {
            if (measured[i].baseline > 0 && corners[i].on_background)
                local_background_.add(corners[i].current, measured[i].velocity);
        }
        local_background_.finish();
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const cv::Point2d drift = local_background_.at(corners[i].current);
            measured[i].velocity -= drift;
            if (options_.find_slow) slow[i].velocity -= drift;
        }
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (!isGround(corners[i])) continue;
        if (measured[i].baseline > 0) noise.add(measured[i].baseline, length(measured[i].velocity));
        if (options_.find_slow && slow[i].baseline > measured[i].baseline)
            noise.add(slow[i].baseline, length(slow[i].velocity));
    }
    noise.finish();
    motion.background_speed_sigma = noise.sigma(options_.baseline);
    NoiseMap noise_map(frame.gray.empty() ? motion.image_size : frame.gray.size(), options_.noise_cell);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        if (!isGround(corners[i]) || measured[i].baseline == 0) continue;
        const double usual = noise.usual(measured[i].baseline);
        if (usual > 0) noise_map.add(corners[i].current, length(measured[i].velocity) / usual);
    }
    noise_map.finish();

    parallax_test_.clear();
    if (options_.parallax.parallax_test) {
        for (std::size_t i = 0; i < corners.size(); ++i) {
            // Slower than what counts as moving: else vehicles that go one way would vote, too.
            const bool below =
                measured[i].baseline > 0 && length(measured[i].velocity) < limitsAt(corners[i].current).least;
            if (corners[i].on_background && below && measured[i].baseline >= options_.baseline / 2)
                parallax_test_.add(corners[i].current, measured[i].velocity);
        }
        parallax_test_.finish(motion.background_speed_sigma);
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const Corner& corner = corners[i];
        const SpeedLimits limits = limitsAt(corner.current);
        const double noise_here = noise_map.at(corner.current);
        const auto moves = [&](const Measured& m, double min_speed) {
            if (m.baseline == 0 || corner.age < options_.min_age) return false;
            const double speed = length(m.velocity);
            if (limits.most > 0 && speed > limits.most) return false;
            return speed >= speedLimit(min_speed, noise_here * noise.sigma(m.baseline));
        };
        const Measured* found = nullptr;
        if (moves(measured[i], limits.least)) {
            found = &measured[i];
        } else if (options_.find_slow && moves(slow[i], limits.least_slow)) {
            found = &slow[i];
        }
        const bool parallax = found != nullptr && parallax_test_.explains(corner.current, found->velocity);
        if (verdicts != nullptr) {
            CornerVerdict verdict =
                verdictOn(corner, measured[i], options_.find_slow ? slow[i] : Measured{}, noise, noise_here);
            if (found != nullptr) {
                verdict.fate = parallax ? CornerFate::parallax : CornerFate::moving;
                verdict.parameter = parallax ? "motion.parallax_factor" : "";
            }
            verdicts->push_back(std::move(verdict));
        }
        if (parallax) found = nullptr;
        if (found == nullptr) {
            // Young corners have not been seen to stand yet.
            if (corner.on_background && measured[i].baseline > 0) motion.stationary_corners.push_back(corner.current);
        } else {
            const cv::Point2d velocity =
                presentVelocity(i, corner.current, found->velocity, motion.background_speed_sigma);
            motion.motion_vectors.push_back({corner.id, corner.current, velocity, corner.age});
        }
    }
    std::vector<char> looks_like_shadow = shadowLooks(frame, motion.motion_vectors);
    inferRoofs(motion, looks_like_shadow);
    if (options_.shadow.shadow_test) leaveOutShadows(motion, looks_like_shadow, verdicts);
    const std::vector<MotionVector> starved =
        areas_.infer(motion, [this](cv::Point2d place) { return limitsAt(place).least; });
    motion.motion_vectors.insert(motion.motion_vectors.end(), starved.begin(), starved.end());
}

std::vector<char> IndependentMotion::shadowLooks(const Frame& frame, const std::vector<MotionVector>& vectors) {
    std::vector<char> looks_like_shadow(vectors.size(), 0);
    if (!options_.shadow.shadow_test) return looks_like_shadow;
    shadow_test_.prepare(frame.gray);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        looks_like_shadow[i] = shadow_test_.isShadow(vectors[i].position) ? 1 : 0;
    }
    return looks_like_shadow;
}

void IndependentMotion::inferRoofs(FrameMotion& motion, std::vector<char>& looks_like_shadow) {
    std::vector<MotionVector>& vectors = motion.motion_vectors;
    std::vector<int> lit;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (!looks_like_shadow[i]) lit.push_back(static_cast<int>(i));
    }
    const std::vector<MotionVector> inferred = silhouettes_.infer(vectors, lit, motion.background_speed_sigma);
    vectors.insert(vectors.end(), inferred.begin(), inferred.end());
    looks_like_shadow.resize(vectors.size(), 0);
}

void IndependentMotion::leaveOutShadows(FrameMotion& motion, const std::vector<char>& looks_like_shadow,
                                        CornerVerdicts* verdicts) {
    std::vector<MotionVector>& vectors = motion.motion_vectors;
    const std::vector<char> cast = shadow_owners_.castShadows(
        vectors, looks_like_shadow, motion.background_speed_sigma,
        [this](const OrientedBox& vehicle, cv::Point2f corner) { return shadow_test_.litUpTo(vehicle, corner); });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (!cast[i]) {
            vectors[kept++] = vectors[i];
            continue;
        }
        if (verdicts == nullptr) continue;
        const auto verdict = std::lower_bound(verdicts->begin(), verdicts->end(), vectors[i].id,
                                              [](const CornerVerdict& v, CornerId id) { return v.id < id; });
        verdict->fate = CornerFate::shadow;
        verdict->parameter = "motion.shadow_brightest";
    }
    vectors.resize(kept);
}

bool IndependentMotion::follow(const RegisteredFrame& registered) {
    const bool follows =
        registered.registration.state != RegistrationState::first && extendPaths(registered.registration);
    if (!follows) restart();
    return follows;
}

void IndependentMotion::remember(const RegisteredFrame& registered, const Frame& frame) {
    zoomTo(registered.registration.zoom);
    silhouettes_.add(frame, registered.registration);
    areas_.add(frame, registered.registration, registered.graphics);
    const RegistrationState state = registered.registration.state;
    const bool repeats = follow(registered) && state == RegistrationState::frozen;
    if (!repeats && state != RegistrationState::failed) takePicture(registered);
    last_frame_ = registered.frame;
    last_motion_ = {};
}

FrameMotion IndependentMotion::next(const RegisteredFrame& registered, const Frame& frame, CornerVerdicts* verdicts) {
    if (verdicts != nullptr) verdicts->clear();
    FrameMotion motion;
    motion.frame = registered.frame;
    motion.time_us = frame.time_us;
    motion.image_size = frame.gray.size();
    motion.registration = registered.registration;
    motion.corner_count = static_cast<int>(registered.corners.size());
    motion.graphics = registered.graphics;

    zoomTo(registered.registration.zoom);
    silhouettes_.add(frame, registered.registration);
    areas_.add(frame, registered.registration, registered.graphics);
    const RegistrationState state = registered.registration.state;
    const bool follows = follow(registered);
    if (state == RegistrationState::frozen && follows) {
        motion.motion_vectors = last_motion_.motion_vectors;
        motion.stationary_corners = last_motion_.stationary_corners;
        motion.background_speed_sigma = last_motion_.background_speed_sigma;
    } else if (state != RegistrationState::failed) {
        takePicture(registered);
        if (follows) sortCorners(registered, frame, motion, verdicts);
    }
    last_frame_ = registered.frame;
    last_motion_ = motion;
    return motion;
}

}  // namespace eyrie

#include "tracking/track_manager.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "tracking/finishing/frames_of.h"

namespace eyrie {
namespace {

constexpr int kScoreFrames = 32;      ///< window of TrackState::score
constexpr double kStopping = 0.7;     ///< what is left of a stopping track's velocity after a frame
constexpr double kSoonStopped = 3;    ///< times stop_speed from which a track may stop soon
constexpr double kAlikeSpeeds = 0.3;  ///< difference of velocities that move alike, as a share
constexpr int kStandingHits = 10;     ///< detections after which a track may be taken for a standing vehicle …
constexpr double kStandingWay = 1;    ///< … and vehicle lengths that it drove before
constexpr double kWholeShare = 0.1;   ///< … and share of detections in which a classifier took it for a vehicle …
constexpr double kSureHits_s = 2;     ///< … or, as it knows no lorries, seconds of detections …
constexpr double kSureWay = 2;        ///< … and vehicle lengths
constexpr double kSettle_s = 0.4;     ///< at one place, until a vehicle stands
constexpr double kSettleReach = 0.5;  ///< px by which it may move meanwhile
constexpr double kCreeping_s = 2;     ///< by its look alone from one place to another
constexpr double kLookInterval_s = 0.1;
constexpr double kStandingReach = 0.15;  ///< of the length by which a standing vehicle may be off its place …
constexpr double kSmallestReach = 1.5;   ///< … and px
constexpr int kLooksAway = 3;            ///< looks in a row that find a vehicle off its place: it creeps
constexpr double kPlaceGain = 0.1;  ///< by which its place follows looks, for the ground is not registered exactly …
constexpr double kPlaceDrift = 0.03;  ///< … px a look at most: no vehicle is followed by it
constexpr double kFastestStart = 3;   ///< times stop_speed when a vehicle that stood is detected again

int hitsWithin(std::uint64_t history, int frames) {
    const std::uint64_t mask = frames >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << frames) - 1;
    return std::popcount(history & mask);
}

/// How far in front a track is when one of two must go.
bool outranks(const Track& a, const Track& b) {
    const bool a_known = a.status != TrackStatus::tentative;
    const bool b_known = b.status != TrackStatus::tentative;
    if (a_known != b_known) return a_known;
    if (a.hits != b.hits) return a.hits > b.hits;
    return a.id < b.id;
}

}  // namespace

TrackState Track::state() const {
    TrackState state;
    state.id = id;
    state.box = filter.box();
    state.velocity = filter.velocity();
    state.status = status;
    state.origin = origin;
    state.age = age;
    state.hits = hits;
    const int frames = std::min(age + 1, kScoreFrames);
    state.score = static_cast<double>(hitsWithin(history, frames)) / frames;
    return state;
}

TrackManager::TrackManager(const TrackerOptions& o, const SceneScale& scale)
    : confirm_hits_(o.confirm_hits),
      confirm_window_(std::max(o.confirm_hits, o.confirm_window)),
      confirm_whole_(o.confirm_whole),
      max_missing_tentative_(o.max_missing_tentative),
      max_missing_(std::max(2, framesOf(o.max_missing_s, scale))),
      max_stopped_(framesOf(o.max_stopped_s, scale)),
      max_standing_(framesOf(o.max_standing_s, scale)),
      max_hidden_(framesOf(o.max_hidden_s, scale)),
      sure_hits_(std::max(kStandingHits, framesOf(kSureHits_s, scale))),
      settle_(std::max(5, framesOf(kSettle_s, scale))),
      max_creeping_(framesOf(kCreeping_s, scale)),
      look_interval_(std::max(1, framesOf(kLookInterval_s, scale))),
      appearance_(o.appearance),
      max_leaving_(framesOf(o.max_leaving_s, scale)),
      max_failed_(std::max(3, framesOf(o.max_failed_s, scale))),
      max_reconstructed_(o.max_reconstructed),
      max_supported_(framesOf(o.max_supported_s, scale)),
      supported_hits_(o.supported_hits),
      split_patience_(o.split_patience),
      stop_speed_m_s_(o.stop_speed_m_s),
      scale_(scale),
      min_visible_(o.min_visible),
      suppress_duplicates_(o.suppress_duplicates),
      duplicate_overlap_(o.duplicate_overlap),
      duplicate_containment_(o.duplicate_containment),
      one_vehicle_(VehicleLimit::of(o, scale)) {}

void TrackManager::count(Track& track, double slow_speed) const {
    const bool detected = track.origin == StateOrigin::detected;
    // What stands cannot be detected, which says nothing against it.
    if (track.origin != StateOrigin::standing) track.history = track.history << 1 | (detected ? 1U : 0U);
    track.hits += detected;
    track.missing = detected ? 0 : track.missing + 1;
    if (detected) track.reconstructed_streak = 0;
    if (track.origin == StateOrigin::reconstructed) ++track.reconstructed_streak;
    track.predicted_streak = track.origin == StateOrigin::predicted ? track.predicted_streak + 1 : 0;
    const bool creeps = track.recognised && !track.standstill.certain;
    track.recognised_streak = creeps ? track.recognised_streak + 1 : 0;
    if (track.recognised) track.predicted_streak = 1;

    if (track.status == TrackStatus::tentative) {
        if (detected && confirmationOf(track).reached()) track.status = TrackStatus::confirmed;
    } else {
        track.status = detected ? TrackStatus::confirmed : TrackStatus::coasting;
    }

    if (track.predicted_streak == 0) {
        track.stopped = false;
    } else if (established(track) && stop_speed_m_s_ > 0) {
        track.stopped = track.stopped || track.filter.speed() < std::max(stopSpeedOf(track), slow_speed);
        if (track.stopped) track.filter.slowDown(kStopping);
    }
}

TracedTentative TrackManager::confirmationOf(const Track& track) const {
    return {track.id,
            hitsWithin(track.history, confirm_window_),
            std::min(confirm_window_, track.age + 1),
            confirm_hits_,
            confirm_window_,
            track.whole_boxes,
            confirm_whole_};
}

bool TrackManager::mayBeReconstructed(const Track& track) const {
    const int limit = track.hits >= supported_hits_ ? std::max(max_reconstructed_, max_supported_) : max_reconstructed_;
    return track.reconstructed_streak < limit;
}

bool TrackManager::hasDriven(const Track& track, bool classified) const {
    const OrientedBox box = track.filter.box();
    const cv::Point2d off = box.centre - track.origin_place;
    const double way = std::hypot(off.x, off.y) / box.length;
    const bool known = !classified || track.whole_boxes >= kWholeShare * track.hits;
    return track.hits >= (known ? kStandingHits : sure_hits_) && way >= (known ? kStandingWay : kSureWay);
}

bool TrackManager::mayBeRecognised(const Track& track, double slow_speed, bool classified) const {
    if (appearance_ == AppearanceUse::none || track.status == TrackStatus::tentative || !track.look) return false;
    if (track.standstill.certain) return true;
    if (track.recognised_streak >= max_creeping_) return false;
    if (!hasDriven(track, classified)) return false;
    return appearance_ == AppearanceUse::lost || track.stopped ||
           track.filter.speed() < std::max(stopSpeedOf(track), slow_speed);
}

double TrackManager::reachOf(const OrientedBox& place) {
    return std::max(kSmallestReach, kStandingReach * place.length);
}

double TrackManager::stopSpeedOf(const Track& track) const {
    return scale_.at(track.filter.box().centre).pxPerFrame(stop_speed_m_s_);
}

double TrackManager::fastestStart(cv::Point2d place, double slow_speed) const {
    return kFastestStart * std::max(scale_.at(place).pxPerFrame(stop_speed_m_s_), slow_speed);
}

void TrackManager::countStandstill(Track& track, std::optional<double> away, const OrientedBox& found) const {
    Standstill& stands = track.standstill;
    stands.agrees = away.has_value();
    if (!away) {
        if (!stands.certain) stands = {};
        return;
    }
    stands.hidden = 0;
    if (!stands.certain) {
        const bool at_place = stands.begun && *away <= kSettleReach;
        if (!at_place) stands.place = found;
        stands.still = at_place ? stands.still + 1 : 1;
        stands.begun = true;
        stands.certain = stands.still >= settle_;
        return;
    }
    const bool at_place = *away <= reachOf(stands.place);
    stands.away = at_place ? 0 : stands.away + 1;
    if (stands.away >= kLooksAway) {
        stands = {};
    } else if (at_place) {
        const cv::Point2d step = kPlaceGain * (found.centre - stands.place.centre);
        const double way = std::hypot(step.x, step.y);
        stands.place.centre += step * std::min(1.0, kPlaceDrift / std::max(way, 1e-9));
    }
}

void TrackManager::countDeparture(Track& track) const {
    Standstill& stands = track.standstill;
    if (!stands.certain) {
        stands = {};
        return;
    }
    stands.hidden = 0;
    const cv::Point2d off = track.filter.box().centre - stands.place.centre;
    stands.away = std::hypot(off.x, off.y) <= reachOf(stands.place) ? 0 : stands.away + 1;
    if (stands.away >= kLooksAway) stands = {};
}

bool TrackManager::worthRemembering(const Track& track, double slow_speed, bool classified) const {
    if (appearance_ == AppearanceUse::none || track.status == TrackStatus::tentative || track.merged) return false;
    if (!hasDriven(track, classified)) return false;
    return appearance_ == AppearanceUse::lost ||
           track.filter.speed() < kSoonStopped * std::max(stopSpeedOf(track), slow_speed);
}

bool TrackManager::givesUpParts(const Track& track) const {
    return track.abreast_streak >= split_patience_ ||
           (track.parts_streak >= split_patience_ && track.whole_hits < 3 * track.parts_streak);
}

bool TrackManager::leaving(const Track& track, cv::Size image) const {
    const OrientedBox box = track.filter.box();
    const double visible = areaInImage(box, image);
    if (visible > 0.98 * box.area()) return false;
    OrientedBox later = box;
    later.centre += 3 * track.filter.velocity();
    return areaInImage(later, image) < visible;
}

std::optional<TrackManager::End> TrackManager::endOf(const Track& track, cv::Size image) const {
    const OrientedBox box = track.filter.box();
    if (!std::isfinite(box.centre.x) || !std::isfinite(box.centre.y) || !std::isfinite(box.area()))
        return End{"tracking.min_visible", 0, min_visible_};
    const double visible = image.area() > 0 ? areaInImage(box, image) : box.area();
    if (image.area() > 0 && !(visible > min_visible_ * box.area()))
        return End{"tracking.min_visible", box.area() > 0 ? visible / box.area() : 0, min_visible_};
    if (track.status == TrackStatus::tentative) {
        if (track.missing <= max_missing_tentative_) return std::nullopt;
        return End{"tracking.max_missing_tentative", 1.0 * track.missing, 1.0 * max_missing_tentative_};
    }
    const Standstill& stands = track.standstill;
    if (stands.certain && stands.frames > max_standing_)
        return End{"tracking.max_standing", 1.0 * stands.frames, 1.0 * max_standing_};
    if (stands.certain) {
        if (stands.hidden <= max_hidden_) return std::nullopt;
        return End{"tracking.max_hidden", 1.0 * stands.hidden, 1.0 * max_hidden_};
    }
    int limit = max_missing_;
    const char* parameter = "tracking.max_missing";
    if (track.stopped && max_stopped_ > limit) {
        limit = max_stopped_;
        parameter = "tracking.max_stopped";
    }
    if (max_leaving_ > limit && image.area() > 0 && track.predicted_streak > limit && leaving(track, image)) {
        limit = max_leaving_;
        parameter = "tracking.max_leaving";
    }
    if (track.predicted_streak <= limit) return std::nullopt;
    return End{parameter, 1.0 * track.predicted_streak, 1.0 * limit};
}

const char* TrackManager::alike(const OrientedBox& a, cv::Point2d velocity_a, const OrientedBox& b,
                                cv::Point2d velocity_b, double slow_speed) const {
    const double reach = (std::hypot(a.length, a.width) + std::hypot(b.length, b.width)) / 2;
    if (std::abs(a.centre.x - b.centre.x) > reach || std::abs(a.centre.y - b.centre.y) > reach) return nullptr;
    const double speed = std::max(std::hypot(velocity_a.x, velocity_a.y), std::hypot(velocity_b.x, velocity_b.y));
    const cv::Point2d difference = velocity_a - velocity_b;
    if (std::hypot(difference.x, difference.y) > std::max(slow_speed, kAlikeSpeeds * speed)) return nullptr;
    if (one_vehicle_.holds(unionBox(a, b))) return "tracking.one_vehicle";
    const double smaller = std::min(a.area(), b.area());
    const double shared = intersectionArea(a, b);
    if (shared >= duplicate_overlap_ * (a.area() + b.area() - shared)) return "tracking.duplicate_overlap";
    return shared >= duplicate_containment_ * smaller ? "tracking.duplicate_containment" : nullptr;
}

std::vector<char> TrackManager::mergeBeliefs(const std::vector<Track>& tracks, double slow_speed) const {
    std::vector<char> beliefs(tracks.size(), 0);
    for (std::size_t big = 0; big < tracks.size(); ++big) {
        const OrientedBox box = tracks[big].filter.box();
        std::vector<OrientedBox> held;
        for (std::size_t small = 0; small < tracks.size(); ++small) {
            const Track& other = tracks[small];
            if (small == big || other.status != TrackStatus::confirmed) continue;
            const OrientedBox other_box = other.filter.box();
            if (1.5 * other_box.area() > box.area()) continue;
            if (!alike(box, tracks[big].filter.velocity(), other_box, other.filter.velocity(), slow_speed)) continue;
            const bool apart = std::all_of(held.begin(), held.end(), [&](const OrientedBox& known) {
                return containment(known, other_box) < 0.3;
            });
            if (apart) held.push_back(other_box);
        }
        beliefs[big] = held.size() >= 2;
    }
    return beliefs;
}

void TrackManager::suppressDuplicates(std::vector<Track>& tracks, double slow_speed) const {
    if (!suppress_duplicates_) return;
    std::vector<char> gone = mergeBeliefs(tracks, slow_speed);
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        for (std::size_t j = i + 1; j < tracks.size() && !gone[i]; ++j) {
            if (gone[j]) continue;
            const OrientedBox a = tracks[i].filter.box();
            const OrientedBox b = tracks[j].filter.box();
            if (!alike(a, tracks[i].filter.velocity(), b, tracks[j].filter.velocity(), slow_speed)) continue;
            const bool first_stays = outranks(tracks[i], tracks[j]);
            Track& stays = first_stays ? tracks[i] : tracks[j];
            Track& goes = first_stays ? tracks[j] : tracks[i];
            gone[first_stays ? j : i] = 1;
            // The older one lost its object and the younger one found it: one life, the younger one's evidence.
            if ((stays.predicted_streak >= 2 || stays.recognised) && goes.origin == StateOrigin::detected) {
                stays.filter = goes.filter;
                stays.vectors = std::move(goes.vectors);
                stays.origin = StateOrigin::detected;
                stays.history |= 1U;
                ++stays.hits;
                stays.missing = stays.predicted_streak = stays.reconstructed_streak = 0;
                stays.stopped = stays.recognised = false;
                stays.recognised_streak = 0;
                stays.standstill = {};
                if (stays.status == TrackStatus::coasting) stays.status = TrackStatus::confirmed;
            }
        }
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        if (gone[i]) continue;
        if (kept != i) tracks[kept] = std::move(tracks[i]);
        ++kept;
    }
    tracks.erase(tracks.begin() + static_cast<std::ptrdiff_t>(kept), tracks.end());
}

const char* TrackManager::wouldDuplicate(const OrientedBox& box, cv::Point2d velocity, const std::vector<Track>& tracks,
                                         double slow_speed) const {
    if (!suppress_duplicates_) return nullptr;
    for (const Track& track : tracks) {
        if (track.predicted_streak >= 2 || track.recognised) continue;
        const char* const parameter = alike(box, velocity, track.filter.box(), track.filter.velocity(), slow_speed);
        if (parameter != nullptr) return parameter;
    }
    return nullptr;
}

}  // namespace eyrie

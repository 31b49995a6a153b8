#include "tracking/tracker.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "tracking/association/overlap_matrix.h"
#include "tracking/association/split_merge.h"
#include "tracking/association/vector_association.h"

namespace eyrie {
namespace {

constexpr int kGrowthsToBelieve = 2;  ///< detections in a row beyond the box after which the box was too small
constexpr int kHitsToBeMerged = 3;    ///< detections that show a track beside an established one to be real

const SceneScale& checked(const SceneScale& scale) {
    const auto positive = [](double value) { return std::isfinite(value) && value > 0; };
    if (!positive(scale.gsd_m_per_px) || !positive(scale.frame_rate_hz)) {
        throw Error(ErrorKind::parameter,
                    "the tracker needs a ground sampling distance and a frame rate above 0, got " +
                        std::to_string(scale.gsd_m_per_px) + " m/px and " + std::to_string(scale.frame_rate_hz) +
                        " Hz");
    }
    return scale;
}

bool usable(const Detection& detection) {
    const OrientedBox& box = detection.box;
    return detection.rejection == Rejection::none && std::isfinite(box.centre.x) && std::isfinite(box.centre.y) &&
           std::isfinite(box.length) && std::isfinite(box.width) && std::isfinite(box.heading) && box.length > 0 &&
           box.width > 0 && std::isfinite(detection.velocity.x) && std::isfinite(detection.velocity.y);
}

/// Whether the picture changed to another scene, as far as registration can tell.
bool isCut(const Registration& registration) {
    return registration.state == RegistrationState::first ||
           (registration.state == RegistrationState::failed && registration.failure.fault == RegistrationFault::cut);
}

}  // namespace

Tracker::Tracker(const TrackerOptions& options, const SceneScale& scale)
    : options_(options.atRate(scale.frame_rate_hz)),
      first_scale_(scale),
      scale_(scale),
      model_(options, checked(scale)),
      manager_(options_, scale) {}

void Tracker::zoomTo(double zoom) {
    if (zoom == zoom_) return;
    zoom_ = zoom;
    scale_ = first_scale_.zoomed(zoom);
    model_ = MeasurementModel(options_, scale_);
    manager_ = TrackManager(options_, scale_);
}

double Tracker::gateAt(cv::Point2d place) const {
    return std::max(options_.distance_gate_px, scale_.at(place).px(options_.distance_gate_m));
}

void Tracker::reset() {
    tracks_.clear();
    next_id_ = 1;
    frozen_frames_ = 0;
    failed_frames_ = 0;
    frames_ = 0;
    classified_ = false;
}

std::vector<TrackState> Tracker::next(const FrameMotion& motion, const std::vector<Detection>& detections,
                                      TrackingTrace* trace, const PictureOfFrame& picture) {
    if (trace != nullptr) *trace = {};
    zoomTo(motion.registration.zoom);
    model_.startFrame(motion.image_size, motion.background_speed_sigma);
    if (isCut(motion.registration)) tracks_.clear();
    switch (motion.registration.state) {
        case RegistrationState::frozen:
            coastThroughFrozen();
            break;
        case RegistrationState::failed:
            coastThroughFailed(motion);
            break;
        case RegistrationState::first:
        case RegistrationState::registered:
            follow(motion, detections, trace, picture);
            break;
    }
    std::vector<TrackState> states;
    states.reserve(tracks_.size());
    for (const Track& track : tracks_) {
        states.push_back(track.state());
        if (trace != nullptr && track.status == TrackStatus::tentative)
            trace->tentative.push_back(manager_.confirmationOf(track));
    }
    return states;
}

void Tracker::coastThroughFrozen() {
    ++frozen_frames_;
    for (Track& track : tracks_) {
        ++track.age;
        const bool stands = track.standstill.certain && track.standstill.agrees;
        track.origin = stands ? StateOrigin::standing : StateOrigin::predicted;
        if (track.status == TrackStatus::confirmed) track.status = TrackStatus::coasting;
    }
}

void Tracker::coastThroughFailed(const FrameMotion& motion) {
    ++failed_frames_;
    predict(motion);
    for (Track& track : tracks_) {
        // A guessed registration may be off by pixels.
        track.filter.smear({1, 0});
        track.filter.smear({0, 1});
        track.origin = StateOrigin::predicted;
        // It must be found anew, for its place may be off by as much.
        track.standstill = {};
        if (track.status == TrackStatus::confirmed) track.status = TrackStatus::coasting;
    }
    const bool lost = failed_frames_ > manager_.maxFailedFrames();
    std::erase_if(tracks_, [&](const Track& track) { return lost || manager_.ended(track, motion.image_size); });
}

void Tracker::predict(const FrameMotion& motion) {
    for (Track& track : tracks_) {
        const Homography& map = motion.registration.current_from_previous;
        const double area_before = track.filter.box().area();
        // After dropped frames that were filled by repeats the objects have moved on meanwhile, or may have.
        const int elapsed = motion.registration.elapsed;
        if (frozen_frames_ > 0 && elapsed == 1) track.filter.smear(frozen_frames_ * track.filter.velocity());
        for (int frame = 1; frame < elapsed; ++frame)
            track.filter.predict(Homography(), model_.processNoise(track.filter.box().centre));
        track.filter.predict(map, model_.processNoise(track.filter.box().centre));
        const double scale = std::sqrt(track.filter.box().area() / area_before);
        track.origin_place = map.apply(track.origin_place);
        OrientedBox& place = track.standstill.place;
        place.heading = map.turned(place.centre, place.heading);
        place.centre = map.apply(place.centre);
        place.length *= scale;
        place.width *= scale;
        for (AssociatedVector& vector : track.vectors) {
            vector.in_box *= scale;
            vector.length *= scale;
            vector.width *= scale;
        }
        ++track.age;
    }
    frozen_frames_ = 0;
}

void Tracker::follow(const FrameMotion& motion, const std::vector<Detection>& detections, TrackingTrace* trace,
                     const PictureOfFrame& picture) {
    failed_frames_ = 0;
    predict(motion);
    std::vector<const Detection*> found;
    std::vector<MovingBox> detected;
    std::vector<int> positions;  // in `detections`
    for (std::size_t i = 0; i < detections.size(); ++i) {
        const Detection& detection = detections[i];
        if (!usable(detection)) continue;
        classified_ = classified_ || detection.complete;
        found.push_back(&detection);
        detected.push_back({detection.box, detection.velocity, 0, 0});
        positions.push_back(static_cast<int>(i));
    }
    ++frames_;
    PictureWhenNeeded seen(picture);
    const StandingVehicles standing(options_, manager_, model_, classified_);
    standing.lookAtPlaces(tracks_, detected, frames_, seen);
    const std::vector<MovingBox> predicted = predictedBoxes();
    const OverlapMatrix matrix = overlapMatrix(detected, predicted, motion.image_size);
    const FrameAssociation association = associate(matrix, detected, predicted);
    if (trace != nullptr) traceAssociation(matrix, association, predicted, positions, *trace);

    const FrameVectors vectors(motion.motion_vectors);
    const TrackVectors carried(options_, manager_, model_, vectors);
    for (Track& track : tracks_) keepSeenVectors(track.vectors, vectors);
    std::vector<std::vector<AssociatedVector>> first_vectors(found.size());
    const bool vectors_first = options_.use_vectors && options_.vectors_first;
    if (vectors_first) first_vectors = carried.associateByPrediction(tracks_, detected, association.used);
    for (std::size_t j = 0; j < tracks_.size(); ++j) {
        updateTrack(tracks_[j], association.tracks[j], found, carried);
        standing.lookAround(tracks_[j], seen, gateAt(tracks_[j].filter.box().centre));
        manager_.count(tracks_[j], model_.slowSpeed());
    }
    if (trace != nullptr) traceEnds(motion.image_size, *trace);
    std::erase_if(tracks_, [&](const Track& track) { return manager_.ended(track, motion.image_size); });
    manager_.suppressDuplicates(tracks_, model_.slowSpeed());
    if (trace != nullptr) {
        for (TracedTrack& traced : trace->tracks) {
            const bool lives =
                std::any_of(tracks_.begin(), tracks_.end(), [&](const Track& track) { return track.id == traced.id; });
            if (!lives && traced.ended_by.empty()) traced.ended_by = "tracking.suppress_duplicates";
        }
    }
    startTracks(found, association.used, std::move(first_vectors), positions, trace);
    if (vectors_first) {
        carried.storePlacesOf(tracks_);
    } else if (options_.use_vectors) {
        carried.associateByUpdate(tracks_);
    }
}

std::vector<MovingBox> Tracker::predictedBoxes() const {
    std::vector<MovingBox> boxes;
    for (const Track& track : tracks_) {
        MovingBox moving{track.filter.box(), track.filter.velocity(), 0, 0};
        const double gate = gateAt(moving.box.centre);
        if (gate > 0) {
            const cv::Point2d along = moving.box.direction();
            moving.gate_along = gate + 2 * track.filter.positionDeviation(along);
            moving.gate_across = gate + 2 * track.filter.positionDeviation({-along.y, along.x});
        }
        if (track.standstill.certain) {
            moving.fastest = manager_.fastestStart(moving.box.centre, model_.slowSpeed());
            // As long as the vehicle is seen at its place, what moves elsewhere is another one.
            if (track.standstill.agrees) moving.farthest = 2 * TrackManager::reachOf(track.standstill.place);
        }
        boxes.push_back(moving);
    }
    return boxes;
}

OverlapMatrix Tracker::overlapMatrix(const std::vector<MovingBox>& detected, const std::vector<MovingBox>& predicted,
                                     cv::Size image) const {
    OverlapGate gate;
    gate.min_overlap = options_.min_overlap;
    gate.max_turn = options_.max_turn_deg >= 180 ? 2 * kPi : radiansFromDegrees(options_.max_turn_deg);
    gate.slow_speed = model_.slowSpeed();
    if (options_.visible_overlap) gate.image = image;
    return OverlapMatrix(detected, predicted, gate);
}

FrameAssociation Tracker::associate(const OverlapMatrix& matrix, const std::vector<MovingBox>& detected,
                                    const std::vector<MovingBox>& predicted) const {
    std::vector<TrackAuthority> authority;
    for (const Track& track : tracks_) {
        authority.push_back({track.status != TrackStatus::tentative, manager_.established(track),
                             track.hits >= kHitsToBeMerged, manager_.givesUpParts(track)});
    }
    return associateDetections(matrix, detected, predicted, authority, options_.split_merge, options_.part_containment,
                               manager_.oneVehicle());
}

void Tracker::traceAssociation(const OverlapMatrix& matrix, const FrameAssociation& association,
                               const std::vector<MovingBox>& predicted, const std::vector<int>& positions,
                               TrackingTrace& trace) const {
    trace.min_overlap = options_.min_overlap;
    const auto position = [&](int detection) { return positions[static_cast<std::size_t>(detection)]; };
    for (const BoxRelation& relation : matrix.relations()) {
        trace.relations.push_back({position(relation.detection), tracks_[static_cast<std::size_t>(relation.track)].id,
                                   relation.overlap, relation.accepted});
    }
    for (std::size_t j = 0; j < tracks_.size(); ++j) {
        TracedTrack traced;
        traced.id = tracks_[j].id;
        traced.predicted = predicted[j].box;
        traced.gate_px = gateAt(predicted[j].box.centre);
        traced.kind = association.tracks[j].kind;
        if (association.tracks[j].detection >= 0)
            traced.detections.push_back(position(association.tracks[j].detection));
        for (const int part : association.tracks[j].parts) traced.detections.push_back(position(part));
        trace.tracks.push_back(std::move(traced));
    }
}

void Tracker::traceEnds(cv::Size image, TrackingTrace& trace) const {
    for (std::size_t j = 0; j < tracks_.size(); ++j) {
        if (const auto end = manager_.endOf(tracks_[j], image)) {
            trace.tracks[j].ended_by = end->parameter;
            trace.tracks[j].ended_value = end->value;
            trace.tracks[j].ended_limit = end->limit;
        }
    }
}

void Tracker::updateTrack(Track& track, const TrackAssociation& association,
                          const std::vector<const Detection*>& detections, const TrackVectors& carried) {
    const auto detectionAt = [&](int index) -> const Detection& {
        return *detections[static_cast<std::size_t>(index)];
    };
    track.merged = association.kind == AssociationKind::merged;
    track.origin = StateOrigin::predicted;
    if (association.in_parts) {
        if (manager_.givesUpParts(track)) {
            // Not one object after all: become the best fitting part, the others start tracks.
            track.filter.forgetSize(track.filter.box().length / 2);
            track.size_streak = options_.size_patience;
            track.parts_streak = 0;
            track.abreast_streak = 0;
            track.vectors.clear();
        } else {
            ++track.parts_streak;
            track.abreast_streak += association.abreast;
        }
    }
    bool updated = false;
    if (association.kind == AssociationKind::matched) {
        const Detection& detection = detectionAt(association.detection);
        if (!association.in_parts) {
            ++track.whole_hits;
            track.parts_streak = std::max(0, track.parts_streak - 1);
            track.abreast_streak = std::max(0, track.abreast_streak - 1);
        }
        updated = updateByDetection(track, detection.box, detection);
    } else if (association.kind == AssociationKind::split && !association.parts.empty()) {
        OrientedBox fused{detectionAt(association.parts.front()).box.centre, 0, 0, track.filter.box().heading};
        const Detection* largest = nullptr;
        for (const int part : association.parts) {
            const Detection& detection = detectionAt(part);
            fused = unionBox(fused, detection.box);
            if (!largest || detection.box.area() > largest->box.area()) largest = &detection;
        }
        updated = updateByDetection(track, fused, *largest);
    }
    if (updated) {
        track.origin = StateOrigin::detected;
        track.whole_boxes +=
            association.kind == AssociationKind::matched && detectionAt(association.detection).complete;
    } else if (options_.use_vectors && carried.update(track)) {
        track.origin = StateOrigin::reconstructed;
    }
    track.filter.pointForward(model_.slowSpeed());
}

bool Tracker::updateByDetection(Track& track, const OrientedBox& box, const Detection& detection) {
    const bool size_known = manager_.established(track) && track.size_streak < options_.size_patience;
    const MeasurementModel::Update update = model_.update(box, detection, track.filter.box(), size_known);
    if (update.size_differs) {
        ++track.size_streak;
        if (!size_known && manager_.established(track)) track.filter.forgetSize(track.filter.box().width / 2);
    } else {
        track.size_streak = std::max(0, track.size_streak - 1);
    }
    // The first boxes are often parts of the object: what was seen last counts half.
    if (options_.adapt_size && !manager_.established(track) && !update.by_ends)
        track.filter.forgetSize(model_.sizeDeviation(box.centre));
    track.growth_streak = update.grows ? track.growth_streak + 1 : 0;
    if (track.growth_streak >= kGrowthsToBelieve) {
        track.filter.loosenEnds(update.grows_front, update.grows_rear, update.grows_left, update.grows_right);
    }
    if (update.size_growth > 0) {
        track.filter.forgetSize(update.size_growth);
        track.filter.smear(update.shift);
    }
    return track.filter.update(update.measurement);
}

void Tracker::startTracks(const std::vector<const Detection*>& detections, const std::vector<char>& used,
                          std::vector<std::vector<AssociatedVector>> first_vectors, const std::vector<int>& positions,
                          TrackingTrace* trace) {
    const std::size_t known = tracks_.size();
    std::vector<Track> born;
    for (std::size_t i = 0; i < detections.size(); ++i) {
        const Detection& detection = *detections[i];
        if (used[i]) continue;
        const char* const doubled_by =
            manager_.wouldDuplicate(detection.box, detection.velocity, tracks_, model_.slowSpeed());
        if (doubled_by != nullptr) {
            if (trace != nullptr) trace->doubled.push_back({positions[i], doubled_by});
            continue;
        }
        Track track(model_.first(detection));
        track.id = next_id_++;
        if (trace != nullptr) trace->started.emplace_back(positions[i], track.id);
        track.vectors = std::move(first_vectors[i]);
        track.whole_hits = 1;
        track.whole_boxes = detection.complete;
        track.filter.pointForward(model_.slowSpeed());
        if (manager_.confirmationOf(track).reached()) track.status = TrackStatus::confirmed;
        born.push_back(std::move(track));
    }
    tracks_.reserve(known + born.size());
    for (Track& track : born) tracks_.push_back(std::move(track));
}

}  // namespace eyrie

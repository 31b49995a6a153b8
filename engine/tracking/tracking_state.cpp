// What the tracker remembers between frames, as bytes and back.
#include "core/state_values.h"
#include "tracking/tracker.h"

namespace eyrie {

template <class Archive>
void transfer(Archive& archive, AssociatedVector& vector) {
    archive(vector.id, vector.in_box, vector.heading_offset, vector.index, vector.length, vector.width);
}

template <class Archive>
void BoxKalmanFilter::transfer(Archive& archive) {
    archive.numbers(state_.data(), std::size_t(kSize));
    archive.numbers(covariance_.data(), std::size_t(kSize * kSize));
    archive.require(state_.allFinite() && covariance_.allFinite(), "a track that is nowhere");
}

template <class Archive>
void VehicleTemplate::transfer(Archive& archive) {
    archive(chip_, box_, step_);
    archive.require(chip_.type() == CV_8UC1 && !chip_.empty() && step_ > 0, "a track that looks like nothing");
}

template <class Archive>
void Standstill::transfer(Archive& archive) {
    archive(begun, certain, agrees, place, still, frames, hidden, away);
}

template <class Archive>
void Track::transfer(Archive& archive) {
    archive.word(status, TrackStatus::coasting);
    archive.word(origin, StateOrigin::standing);
    archive(id, filter, vectors, history, age, hits, missing, reconstructed_streak, predicted_streak, size_streak,
            growth_streak, whole_hits, parts_streak, abreast_streak, merged, stopped, recognised, recognised_streak,
            whole_boxes, origin_place, look, standstill);
}

template <class Archive>
void Tracker::transfer(Archive& archive) {
    archive.items(tracks_, [] { return Track(BoxMeasurement{}); });
    archive(next_id_, frozen_frames_, failed_frames_, frames_, classified_);
    for (const Track& track : tracks_) archive.require(track.id < next_id_, "a track from the future");
}

template void Tracker::transfer(StateWriter&);
template void Tracker::transfer(StateReader&);

}  // namespace eyrie

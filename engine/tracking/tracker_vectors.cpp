// How tracks get motion vectors and are carried on by them (Teutsch §6.2.2, §6.3).
#include "tracking/association/split_merge.h"
#include "tracking/association/vector_association.h"
#include "tracking/tracker.h"

namespace eyrie {

bool Tracker::updateByVectors(Track& track, const FrameVectors& vectors) {
    if (!manager_.mayBeReconstructed(track)) return false;
    const auto rebuilt = reconstructBox(track.vectors, vectors, track.filter.box(), options_.min_vectors,
                                        model_.slowSpeed(), options_.agreement, options_.rebuilt_size);
    return rebuilt && track.filter.update(model_.reconstructed(*rebuilt));
}

VectorLimits Tracker::vectorLimits() const {
    VectorLimits limits;
    limits.max_vectors = options_.max_vectors;
    limits.speed_difference = options_.vector_speed_difference;
    limits.speed_floor = 5 * model_.backgroundSpeedSigma();
    limits.slow_speed = model_.slowSpeed();
    limits.relative_position_gain = options_.relative_position_gain;
    return limits;
}

std::vector<std::vector<AssociatedVector>> Tracker::associateByPrediction(const std::vector<MovingBox>& detected,
                                                                          const std::vector<char>& used,
                                                                          const FrameVectors& vectors) {
    std::vector<std::vector<AssociatedVector>> first_vectors(detected.size());
    std::vector<VectorClaim> claims;
    for (Track& track : tracks_) {
        claims.push_back({track.filter.box(), track.filter.velocity(), true, false, &track.vectors});
    }
    for (std::size_t i = 0; i < detected.size(); ++i) {
        if (used[i]) continue;
        claims.push_back({detected[i].box, detected[i].velocity, true, false, &first_vectors[i]});
    }
    associateVectors(claims, vectors, vectorLimits());
    return first_vectors;
}

void Tracker::storeVectorPlaces(const FrameVectors& vectors) {
    for (Track& track : tracks_) {
        // The heading of a new track may have been turned round.
        const double gain = track.age == 0 ? 1 : options_.relative_position_gain;
        storePlaces(track.vectors, track.filter.box(), vectors, gain, model_.slowSpeed());
    }
}

void Tracker::associateByUpdate(const FrameVectors& vectors) {
    std::vector<VectorClaim> claims;
    for (Track& track : tracks_) {
        VectorClaim claim{track.filter.box(), track.filter.velocity(), true, true, &track.vectors};
        claim.may_gain = track.origin == StateOrigin::detected || track.origin == StateOrigin::reconstructed;
        claim.may_gain = claim.may_gain && !track.merged;
        claim.learns = track.origin == StateOrigin::detected;
        claims.push_back(claim);
    }
    associateVectors(claims, vectors, vectorLimits());
}

}  // namespace eyrie

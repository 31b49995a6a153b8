#include "tracking/track_vectors.h"

namespace eyrie {

bool TrackVectors::update(Track& track) const {
    if (!manager_.mayBeReconstructed(track)) return false;
    const auto rebuilt = reconstructBox(track.vectors, vectors_, track.filter.box(), options_.min_vectors,
                                        model_.slowSpeed(), options_.agreement, options_.rebuilt_size);
    return rebuilt && track.filter.update(model_.reconstructed(*rebuilt));
}

VectorLimits TrackVectors::limits() const {
    VectorLimits limits;
    limits.max_vectors = options_.max_vectors;
    limits.speed_difference = options_.vector_speed_difference;
    limits.speed_floor = 5 * model_.backgroundSpeedSigma();
    limits.slow_speed = model_.slowSpeed();
    limits.relative_position_gain = options_.relative_position_gain;
    return limits;
}

std::vector<std::vector<AssociatedVector>> TrackVectors::associateByPrediction(std::vector<Track>& tracks,
                                                                               const std::vector<MovingBox>& detected,
                                                                               const std::vector<char>& used) const {
    std::vector<std::vector<AssociatedVector>> first_vectors(detected.size());
    std::vector<VectorClaim> claims;
    for (Track& track : tracks) {
        claims.push_back({track.filter.box(), track.filter.velocity(), true, false, &track.vectors});
    }
    for (std::size_t i = 0; i < detected.size(); ++i) {
        if (used[i]) continue;
        claims.push_back({detected[i].box, detected[i].velocity, true, false, &first_vectors[i]});
    }
    associateVectors(claims, vectors_, limits());
    return first_vectors;
}

void TrackVectors::storePlacesOf(std::vector<Track>& tracks) const {
    for (Track& track : tracks) {
        // The heading of a new track may have been turned round.
        const double gain = track.age == 0 ? 1 : options_.relative_position_gain;
        storePlaces(track.vectors, track.filter.box(), vectors_, gain, model_.slowSpeed());
    }
}

void TrackVectors::associateByUpdate(std::vector<Track>& tracks) const {
    std::vector<VectorClaim> claims;
    for (Track& track : tracks) {
        VectorClaim claim{track.filter.box(), track.filter.velocity(), true, true, &track.vectors};
        claim.may_gain = track.origin == StateOrigin::detected || track.origin == StateOrigin::reconstructed;
        claim.may_gain = claim.may_gain && !track.merged;
        claim.learns = track.origin == StateOrigin::detected;
        claims.push_back(claim);
    }
    associateVectors(claims, vectors_, limits());
}

}  // namespace eyrie

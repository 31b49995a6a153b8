#pragma once

#include <optional>
#include <string>
#include <vector>

#include "events/event_options.h"
#include "events/ground/ground_stretches.h"
#include "events/stored_events.h"
#include "ground/track_looks.h"

namespace eyrie {

/// How like a track is to a chosen one, by where and how it drove; when it did so does not matter. 0 … 1 each, 1: the
/// same.
///
/// Lengths are metres by the scale at the place. Where no scale is known, they are lengths of vehicles: the median
/// vehicle of the run is taken to be as long as a usual car.
struct TrackLikeness {
    TrackId track = 0;
    /// likenessBy() of what counts where nothing else is said: path^½ · speed^¼ · size^¼.
    double likeness = 0;
    /// Over the stretch that both drove: exp(−½ (d / 3 m)²) · max(0, cos δ), its mean over the way; d: from one path to
    /// the other, δ: between their directions. 3 m are about the width of a lane: the next one counts .6, the
    /// opposite one nothing. Times (common way / longer way)^¼: what drove half of it .84, a tenth .56. Vehicles that
    /// stand all the time are compared by d alone, and are not like one that drives. 0 where no ground carries both.
    double path = 0;
    /// exp(−½ (ln(v / v′) / .4)²) where both drove beside each other, the mean; of whole drives where they never did.
    /// 1 m/s is added to both v. Standstills do not count, as they are no part of the way.
    double speed = 0;
    /// exp(−½ (ln²(l / l′) + ln²(w / w′)) / .3²) of the median length and width: 10 % are .95, 50 % longer .40.
    double size = 0;
    /// lookLikeness(); nothing where the pictures of one of the two are not known: see compareLooks().
    std::optional<double> looks = {};
};

/// What of it counts.
struct LikenessChoice {
    bool path = true;
    bool speed = true;
    bool size = true;
    bool looks = false;  ///< needs pictures to be read

    /// "path", "speed", "size", "looks" make it so. Throws Error(parameter) for other names, and for none.
    static LikenessChoice named(const std::vector<std::string>& names);
    /// The names of what counts, in that order.
    std::vector<std::string> names() const;

    bool any() const { return path || speed || size || looks; }
    bool operator==(const LikenessChoice&) const = default;
};

/// The geometric mean of what counts, path and looks twice: what is unlike in one of them is not like. Looks that are
/// not known are left out of it; 0 where nothing is left.
double likenessBy(const TrackLikeness& parts, const LikenessChoice& counts);

/// Lets what counts be their likeness, and orders them: the most like first; equally like ones by speed and size, then
/// by id.
void orderBy(const LikenessChoice& counts, std::vector<TrackLikeness>& found);

/// Adds the likeness of looks to that of tracks like `chosen`.
void compareLooks(std::vector<TrackLikeness>& found, const LooksByTrack& looks, TrackId chosen);

/// All other tracks of the run, in the order of orderBy() where nothing else is said. What vehicles look like is not
/// known: runs need not keep pictures of them. `ground` must be that of the run's footage. Throws
/// Error(parameter) where the run has no such track.
std::vector<TrackLikeness> tracksLike(const StoredTracks& run, const GroundStretches& ground, TrackId chosen,
                                      const EventOptions& options = {});

}  // namespace eyrie

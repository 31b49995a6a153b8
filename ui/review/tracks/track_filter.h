#pragma once

#include <QString>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <vector>

#include "core/values/scene_scale.h"
#include "ground/track_likeness.h"
#include "review/tracks/time_limit.h"
#include "review/tracks/track_doings.h"
#include "store/runs/run_store.h"

class QJsonObject;

namespace eyrie::ui {

/// What tracks can be narrowed by.
enum class TrackQuality { speed, lowest, highest, life, size, score, direction, event, zone, time, state, like };
inline constexpr int kTrackQualities = 12;
/// Those that are a number between two limits come first.
inline constexpr int kRangedQualities = 6;
/// Whether it asks for what the tracks did (DoingsByTrack).
bool needsDoings(TrackQuality quality);

/// What can be said of a track as a whole, or in the frame shown.
enum class TrackCondition {
    moves_now,   ///< it is in the frame shown, and drives
    stands_now,  ///< it is there, and stands
    lost,        ///< it ended in mid-picture
    corrected,   ///< a person made it, or joined or split it
    rejected     ///< a person said that it is of nothing that drives
};
inline constexpr int kTrackConditions = 5;
/// "moving now", "standing now", "lost", "corrected", "rejected".
QString nameOf(TrackCondition condition);

/// From … to, both included, in the unit shown; nothing: no limit there.
struct TrackRange {
    std::optional<double> from;
    std::optional<double> to;

    bool any() const { return from || to; }
    bool holds(double value) const { return (!from || value >= *from) && (!to || value <= *to); }
    bool operator==(const TrackRange&) const = default;
};

/// How like the tracks of a run are to one of them. Made in the background, then never changed.
struct LikenessByTrack {
    TrackId chosen = 0;
    std::map<TrackId, double> likeness;  ///< of the others, 0 … 1; tracks that are missing are like none

    double of(TrackId track) const;
};

/// Tracks like one of them: so like at least, in what counts.
struct LikeLimit {
    TrackId track = 0;
    double least = 0.5;
    LikenessChoice counts = {};
    bool operator==(const LikeLimit&) const = default;
};

/// What a filter asks for besides a track's summary. What is missing hides nothing.
struct TrackFacts {
    const DoingsByTrack* doings = nullptr;      ///< null while nobody knows
    const LikenessByTrack* likeness = nullptr;  ///< the same
    FrameOfDay frame_of_day = {};               ///< none: nobody knows the time
    std::optional<FrameIndex> now = {};         ///< the frame shown; none: there is none
};

/// Which tracks are listed: those that every chip holds for. A chip without a limit holds for all.
struct TrackFilter {
    std::array<TrackRange, kRangedQualities> ranges;
    std::set<int> eighths;       ///< any of them; none: all
    std::set<EventKind> events;  ///< any of them
    std::set<std::string> zones;
    TimeRange time;                       ///< it is there in some frame of these
    std::set<TrackCondition> conditions;  ///< any of them
    std::optional<LikeLimit> like;        ///< means something in one run alone

    bool has(TrackQuality quality) const;
    bool any() const;
    void clear(TrackQuality quality);
    TrackRange& range(TrackQuality quality) { return ranges.at(static_cast<std::size_t>(quality)); }
    const TrackRange& range(TrackQuality quality) const { return ranges.at(static_cast<std::size_t>(quality)); }
    bool operator==(const TrackFilter&) const = default;

    bool holds(const TrackSummary& track, const SceneScale& scale, const TrackFacts& facts) const;
    /// Whether the answer depends on the frame shown.
    bool asksNow() const {
        return conditions.contains(TrackCondition::moves_now) || conditions.contains(TrackCondition::stands_now);
    }

    /// For settings; without what means something in one run alone.
    QJsonObject json() const;
    /// What is not known is left out.
    static TrackFilter fromJson(const QJsonObject& json);
};

/// The number of a ranged quality as it is shown: km/h or px/frame, s, m or px, 0 … 1. Nothing where it is not known.
std::optional<double> valueOf(const TrackSummary& track, TrackQuality quality, const SceneScale& scale,
                              const TrackDoings& did);
/// "Speed", "Life".
QString nameOf(TrackQuality quality);
/// "km/h"; empty for what has none.
QString unitOf(TrackQuality quality, const SceneScale& scale);
/// "→".
QString arrowOf(int eighth);
/// "Speed 20–60 km/h", "Zone yard, gate", "Time 22:08–22:20 UTC"; the name alone where nothing is limited.
QString chipText(const TrackFilter& filter, TrackQuality quality, const SceneScale& scale);

}  // namespace eyrie::ui

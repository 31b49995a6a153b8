#pragma once

#include <cstdint>
#include <string>

#include "core/labels/box_record.h"
#include "core/values/scene_scale.h"

namespace eyrie {

class ParameterVisitor;

/// The kinds of objects that are told apart (Teutsch ch. 3: "the object class such as vehicle, motorcycle, or person").
/// Bicycles and motorcycles are of one size from above, so they are one class.
enum class TrackClass : std::uint8_t { unknown, vehicle, two_wheeler, person };

/// The word in files: "vehicle", "two_wheeler", "person", or nothing for unknown.
const char* wordOf(TrackClass track_class);

/// The class that the word of a file belongs to: car, truck, bus, van and vehicle; motorcycle, bicycle and two_wheeler;
/// person. Every other word, and none, is unknown.
TrackClass trackClassOf(const std::string& object_class);
/// Among the words that trackClassOf() takes for this class, that of most things seen from above: what a person has to
/// correct least. Nothing for unknown.
const char* commonestWordOf(TrackClass track_class);

/// By what size and speed on the ground a track is taken for something else than a vehicle.
struct TrackClassOptions {
    double person_size_m = 1.2;
    double person_speed_m_s = 3.5;
    double two_wheeler_length_m = 2.5;
    double two_wheeler_width_m = 1.3;
    double min_life_s = 1;

    void describe(ParameterVisitor& visitor);
};

/// How many states a track has so far, and means over them.
struct TrackExtent {
    int states = 0;
    double length_px = 0;
    double width_px = 0;
    double speed_px = 0;  ///< px/frame relative to the ground
};

/// What a track of that extent is. Unknown where lengths in metres mean nothing, for what is smaller than a vehicle and
/// was followed too shortly, and for what is too small for a two-wheeler and too fast for a person: parts of vehicles
/// look like that. Limits of size are a fifth lower where the GSD was estimated.
TrackClass classOf(const TrackExtent& extent, const SceneScale& scale, const TrackClassOptions& options);

/// Writes the class of every track, by all of its boxes, into its boxes. Boxes without id keep theirs. `scale`: with
/// the zoom of all frames.
void nameClasses(BoxesByFrame& tracks, const SceneScale& scale, const TrackClassOptions& options);

}  // namespace eyrie

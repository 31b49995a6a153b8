#include "core/labels/track_class.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/parameter.h"

namespace eyrie {
namespace {

constexpr double kEstimatedLimits = 0.8;  ///< of a limit in metres that counts where the GSD was estimated

}  // namespace

const char* wordOf(TrackClass track_class) {
    switch (track_class) {
        case TrackClass::unknown:
            return "";
        case TrackClass::vehicle:
            return "vehicle";
        case TrackClass::two_wheeler:
            return "two_wheeler";
        case TrackClass::person:
            return "person";
    }
    return "";
}

TrackClass trackClassOf(const std::string& object_class) {
    if (isVehicleClass(object_class)) return TrackClass::vehicle;
    if (object_class == "motorcycle" || object_class == "bicycle" || object_class == wordOf(TrackClass::two_wheeler))
        return TrackClass::two_wheeler;
    return object_class == wordOf(TrackClass::person) ? TrackClass::person : TrackClass::unknown;
}

const char* commonestWordOf(TrackClass track_class) {
    switch (track_class) {
        case TrackClass::unknown:
            return "";
        case TrackClass::vehicle:
            return "car";
        case TrackClass::two_wheeler:
            return "motorcycle";
        case TrackClass::person:
            return "person";
    }
    return "";
}

void TrackClassOptions::describe(ParameterVisitor& v) {
    const ParameterDeclarer declare(v, ChainStage::finishing);
    declare.real("classes.person_size", person_size_m, 0, 100,
                 {"m",
                  "A track whose boxes are on average shorter and narrower, and that is as slow as a person, is one. "
                  "Changes only what tracks are called. 0: none is.",
                  "Teutsch §3, §7.2"});
    declare.real(
        "classes.person_speed", person_speed_m_s, 0, 50,
        {"m/s", "Highest mean speed of a person on foot. Larger values call small parts of vehicles persons.", ""});
    declare.real("classes.two_wheeler_length", two_wheeler_length_m, 0, 100,
                 {"m",
                  "A track that is on average no longer and no wider is a motorcycle or bicycle; a longer or wider one "
                  "is a vehicle. Changes only what tracks are called. 0: none is.",
                  "Teutsch §3, §7.2"});
    declare.real("classes.two_wheeler_width", two_wheeler_width_m, 0, 100,
                 {"m", "The same for the width. Larger values call the fronts and rears of cars two-wheelers.", ""});
    declare.real("classes.min_life", min_life_s, 0, 60,
                 {"s",
                  "A track that is smaller than a vehicle has no class until it was followed for this long: parts of "
                  "vehicles make short tracks.",
                  ""});
}

TrackClass classOf(const TrackExtent& extent, const SceneScale& scale, const TrackClassOptions& options) {
    const double share = scale.gsd_known ? 1 : kEstimatedLimits;
    const double length = scale.metres(extent.length_px) / share;
    const double width = scale.metres(extent.width_px) / share;
    const double speed = scale.metresPerSecond(extent.speed_px);
    if (!hasMetricLimits(scale) || !(length > 0) || !(width > 0) || !(speed >= 0)) return TrackClass::unknown;
    if (length > options.two_wheeler_length_m || width > options.two_wheeler_width_m) return TrackClass::vehicle;
    if (extent.states < options.min_life_s * scale.frame_rate_hz) return TrackClass::unknown;
    if (std::max(length, width) > options.person_size_m) return TrackClass::two_wheeler;
    return speed <= options.person_speed_m_s ? TrackClass::person : TrackClass::unknown;
}

void nameClasses(BoxesByFrame& tracks, const SceneScale& scale, const TrackClassOptions& options) {
    std::map<int, TrackExtent> sums;
    for (const auto& [frame, records] : tracks) {
        for (const BoxRecord& record : records) {
            if (!record.id) continue;
            TrackExtent& sum = sums[*record.id];
            // In pixels of the middle of the first picture.
            const double factor = scale.enlargementAt(frame, record.box.centre);
            sum.length_px += record.box.length / factor;
            sum.width_px += record.box.width / factor;
            sum.speed_px += std::hypot(record.velocity.x, record.velocity.y) / factor;
            ++sum.states;
        }
    }
    std::map<int, const char*> words;
    for (const auto& [id, sum] : sums) {
        const double n = sum.states;
        words[id] =
            wordOf(classOf({sum.states, sum.length_px / n, sum.width_px / n, sum.speed_px / n}, scale, options));
    }
    for (auto& [frame, records] : tracks) {
        for (BoxRecord& record : records) {
            if (record.id) record.object_class = words.at(*record.id);
        }
    }
}

}  // namespace eyrie

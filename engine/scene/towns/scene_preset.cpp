#include "scene/towns/scene_preset.h"

#include <array>

#include "core/error.h"
#include "scene/towns/presets.h"

namespace eyrie {
namespace {

struct Preset {
    const char* name;
    SceneDescription (*make)(std::uint32_t seed);
    std::uint32_t seed;
};

constexpr std::array<Preset, 16> kPresets{{{"seq1", presetSeq1, 1},
                                           {"seq2", presetSeq2, 1},
                                           {"egtest01", presetEgTest01, 1},
                                           {"demo", presetDemo, 1},
                                           {"stops", presetStops, 1},
                                           {"patrol", presetPatrol, 1},
                                           {"road_flight", presetRoadFlight, 1},
                                           {"road_flight_haze", presetRoadFlightHaze, 1},
                                           {"road_flight_dusk", presetRoadFlightDusk, 1},
                                           {"road_flight_night", presetRoadFlightNight, 1},
                                           {"estate", presetEstate, 1},
                                           {"orbit", presetOrbit, 1},
                                           {"city_high", presetCityHigh, 1},
                                           {"thermal", presetThermal, 1},
                                           {"low_rate", presetLowRate, 1},
                                           {"motorway", presetMotorway, 1}}};

}  // namespace

const std::vector<std::string>& scenePresetNames() {
    static const std::vector<std::string> names = [] {
        std::vector<std::string> list;
        for (const Preset& preset : kPresets) list.emplace_back(preset.name);
        return list;
    }();
    return names;
}

SceneDescription scenePreset(const std::string& name, std::uint32_t seed) {
    std::string known;
    for (const Preset& preset : kPresets) {
        if (name == preset.name) return preset.make(seed == 0 ? preset.seed : seed);
        known += (known.empty() ? "" : ", ") + std::string(preset.name);
    }
    throw Error(ErrorKind::parameter, "There is no scene '" + name + "'; the scenes are " + known + ".");
}

}  // namespace eyrie

#pragma once

#include <cstdint>

#include "scene/scene_description.h"

/// The built-in scenes, one function each; see scene_preset.h.
namespace eyrie {

SceneDescription presetSeq1(std::uint32_t seed);
SceneDescription presetSeq2(std::uint32_t seed);
SceneDescription presetEgTest01(std::uint32_t seed);
SceneDescription presetDemo(std::uint32_t seed);
SceneDescription presetStops(std::uint32_t seed);
SceneDescription presetPatrol(std::uint32_t seed);
SceneDescription presetRoadFlight(std::uint32_t seed);
SceneDescription presetRoadFlightHaze(std::uint32_t seed);
SceneDescription presetRoadFlightDusk(std::uint32_t seed);
SceneDescription presetRoadFlightNight(std::uint32_t seed);
SceneDescription presetEstate(std::uint32_t seed);
SceneDescription presetOrbit(std::uint32_t seed);
SceneDescription presetCityHigh(std::uint32_t seed);
SceneDescription presetThermal(std::uint32_t seed);
SceneDescription presetLowRate(std::uint32_t seed);
SceneDescription presetMotorway(std::uint32_t seed);

}  // namespace eyrie

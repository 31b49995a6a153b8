#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <vector>

#include "core/geometry/control_point.h"
#include "formats/track_world.h"
#include "io/video/frame_source.h"
#include "store/runs/run_store.h"

namespace eyrie {

/// When and where the boxes of a run were, by its registration and scale and by the metadata of the video. `pixels` is
/// the video, or null where it cannot be read: then there are no metadata. `start_utc_us`: when the video began, if a
/// person says so; else the metadata or the file say it. `control`: what a person found on the earth; counts more than
/// the metadata. Throws Error(project).
std::shared_ptr<const TrackWorld> trackWorldOf(const RunStore& store, const RunRecord& run, const FrameSource* pixels,
                                               std::optional<std::int64_t> start_utc_us = {},
                                               const std::stop_token& stop = {},
                                               std::vector<ControlPoint> control = {});

}  // namespace eyrie

#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>

#include "metadata/ground_view.h"

namespace eyrie {

/// Writes a row for each set of a stream: number, byte in the file, seconds in the video (empty without `timeline`),
/// UTC, then a column for each tag that occurs, by its name and unit; what a set does not hold is empty. Throws
/// Error(output).
void writeMetadataCsv(const std::filesystem::path& path, const MetadataStream& stream,
                      const MetadataTimeline* timeline);

/// What a stream holds, without its sets.
nlohmann::ordered_json jsonOf(const MetadataStream& stream);
/// Scale, north, footprint and remarks; null for what is not known.
nlohmann::ordered_json jsonOf(const GroundView& view);
/// The values of one moment by name and unit.
nlohmann::ordered_json jsonOf(const MetadataState& state);

}  // namespace eyrie

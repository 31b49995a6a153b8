#pragma once

#include <QString>
#include <vector>

#include "georeference/video_metadata.h"
#include "metadata/ground_view.h"
#include "review/earth/metadata_model.h"

namespace eyrie::ui {

/// A row for what follows from the metadata (scale, direction, footprint), where they tell it, then one for each tag of
/// the stream, in the order of their numbers.
std::vector<MetadataRow> metadataRows(const VideoMetadata& stream, const MetadataState& state,
                                      const std::vector<MetadataPacket::Text>& texts, const GroundView& view);

/// How complete a stream is: sets, share of [0, last_us] covered, what was damaged, its clock. Some lines.
QString streamSummary(const VideoMetadata& stream, std::int64_t last_us);
/// "Stream 0 (track 2, PID 0x1f1)".
QString streamName(const VideoMetadata& stream, std::size_t number);

}  // namespace eyrie::ui

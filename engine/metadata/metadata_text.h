#pragma once

#include <optional>
#include <string>

#include "metadata/metadata_recording.h"

namespace eyrie {

/// A value of a tag as text: with as many decimals as its coding can tell apart, at most seven (a centimetre in a
/// latitude); moments as UTC.
std::string valueText(int tag, double value);
/// The unit that belongs to it as people write it, "°", "m/s"; empty where the value has none or says it itself.
std::string unitText(int tag);
/// Of what was damaged in a stream, why and where: "wrong checksum 12×, cut off 1×; the first near frame 310"; empty
/// where nothing was.
std::string damageText(const MetadataStream& stream);
/// "; the first near frame 310", to stand behind what was counted; empty where no place is known.
std::string firstPlaceText(const std::optional<MetadataPlace>& place);

}  // namespace eyrie

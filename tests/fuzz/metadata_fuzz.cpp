#include <algorithm>
#include <cstdint>
#include <vector>

#include "fuzz/input_file.h"
#include "metadata/metadata_scale.h"

/// Bytes as a stream of KLV: the first says how long the packets are that bring them, and whether they have stamps.
/// What is read is placed in a video, blended and laid onto the ground.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const bool has_stamps = (data[0] & 1) != 0;
    const std::size_t packet_size = 1 + 8 * static_cast<std::size_t>(data[0] >> 1);
    const eyrie::klv::Bytes bytes(data + 1, size - 1);
    eyrie::fuzz::expectAnswer([&] {
        eyrie::MetadataCollector collector({1, 0x101, "klv"});
        int packets = 0;
        for (std::size_t at = 0; at < bytes.size(); at += packet_size, ++packets) {
            const std::int64_t stamp = has_stamps ? 20'000 * packets : eyrie::kNoStamp;
            collector.feed({1, stamp, static_cast<std::int64_t>(at), packets / 2,
                            bytes.subspan(at, std::min(packet_size, bytes.size() - at))});
        }
        const eyrie::MetadataStream stream = collector.finish();
        std::vector<eyrie::PictureStamp> pictures;
        for (int i = 0; i <= packets / 2; ++i) pictures.push_back({40'000 * i, 40'000 * i});
        const eyrie::MetadataTimeline timeline(stream, pictures);
        for (const std::int64_t time : {std::int64_t{0}, pictures.back().time_us / 2, pictures.back().time_us}) {
            const eyrie::GroundView view = groundViewOf(timeline.at(time), {640, 480});
            const auto place = view.placeOf({320, 240});
            if (place) view.pixelOf(*place);
        }
    });
    return 0;
}

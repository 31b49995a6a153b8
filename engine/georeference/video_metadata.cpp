#include "georeference/video_metadata.h"

#include "core/error.h"

namespace eyrie {

FoundMetadata metadataOf(const FrameSource& source, const std::stop_token& stop) {
    const std::vector<PictureStamp> pictures = source.pictureStamps();
    if (pictures.empty()) return {nullptr, "it is no video file, so it carries no metadata (KLV)"};
    try {
        MetadataRecording recording = readMetadata(source.info().path, {}, stop);
        const int chosen = recording.mostUseful();
        if (chosen < 0) return {nullptr, "the video carries no metadata (KLV)"};
        MetadataStream& stream = recording.streams[static_cast<std::size_t>(chosen)];
        if (stream.packets.empty()) return {nullptr, "its metadata (KLV) hold no set that can be read"};
        return {std::make_shared<const VideoMetadata>(std::move(stream), pictures), ""};
    } catch (const Error& error) {
        return {nullptr, error.what()};
    }
}

}  // namespace eyrie

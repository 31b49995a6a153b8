#include "georeference/video_metadata.h"

#include "core/error.h"

namespace eyrie {

FoundMetadata metadataOf(const FrameSource& source, const std::stop_token& stop, const IndexProgress& progress) {
    const std::vector<PictureStamp> pictures = source.pictureStamps();
    if (pictures.empty()) return {nullptr, "it is no video file, so it carries no metadata (KLV)"};
    try {
        MetadataRecording recording = readMetadata(source.info().path, progress, stop);
        const int chosen = recording.mostUseful();
        FoundMetadata found{nullptr, "the video carries no metadata (KLV)"};
        for (MetadataStream& stream : recording.streams)
            found.streams.push_back(std::make_shared<const VideoMetadata>(std::move(stream), pictures));
        if (chosen >= 0) {
            found.metadata = found.streams[static_cast<std::size_t>(chosen)];
            found.why_not.clear();
        } else if (!found.streams.empty()) {
            found.why_not = "its metadata (KLV) hold no set that can be read";
        }
        return found;
    } catch (const Error& error) {
        return {nullptr, error.what()};
    }
}

}  // namespace eyrie

#include "georeference/video_metadata.h"

#include "core/error.h"

namespace eyrie {

FoundMetadata metadataOf(const FrameSource& source, const std::stop_token& stop, const IndexProgress& progress) {
    FoundMetadata found{
        nullptr, "only video files carry metadata (KLV)", {}, source.info().parts, source.info().created_utc_us};
    try {
        const std::vector<PictureStamp> pictures = source.pictureStamps();
        if (pictures.empty()) return found;
        MetadataRecording recording = readMetadata(source.info(), progress, stop);
        const int chosen = recording.mostUseful();
        found.why_not = "the video carries no metadata (KLV)";
        const TimelineOptions options = timelineOptionsOf(source.info());
        for (MetadataStream& stream : recording.streams)
            found.streams.push_back(std::make_shared<const VideoMetadata>(std::move(stream), pictures, options));
        if (chosen >= 0) {
            found.metadata = found.streams[static_cast<std::size_t>(chosen)];
            found.why_not.clear();
        } else if (!found.streams.empty()) {
            found.why_not = "its metadata (KLV) hold no set that can be read";
        }
        return found;
    } catch (const Error& error) {
        found.why_not = error.what();
        return found;
    }
}

}  // namespace eyrie

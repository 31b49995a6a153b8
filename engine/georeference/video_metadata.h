#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "metadata/metadata_timeline.h"

namespace eyrie {

/// A stream of metadata in the time of its video. Never changed once made; may be shared by threads.
class VideoMetadata {
 public:
    VideoMetadata(MetadataStream stream, const std::vector<PictureStamp>& pictures, const TimelineOptions& options = {})
        : stream_(std::move(stream)), timeline_(stream_, pictures, options) {}
    VideoMetadata(const VideoMetadata&) = delete;
    VideoMetadata& operator=(const VideoMetadata&) = delete;

    const MetadataStream& stream() const { return stream_; }
    const MetadataTimeline& timeline() const { return timeline_; }

 private:
    MetadataStream stream_;
    MetadataTimeline timeline_;
};

/// The metadata of a video, or why there are none.
struct FoundMetadata {
    std::shared_ptr<const VideoMetadata> metadata;  ///< the stream that says most; null: none
    std::string why_not;                            ///< for people: "the video carries no metadata (KLV)"
    /// All streams of metadata, `metadata` among them; also those in which no set could be read.
    std::vector<std::shared_ptr<const VideoMetadata>> streams = {};
    std::vector<VideoPart> parts = {};                ///< of the video; none where it is one file
    std::optional<std::int64_t> created_utc_us = {};  ///< VideoInfo::created_utc_us
};

/// Reads the metadata beside the pictures of `source`. Never throws for what is wrong with them: a video is to be
/// worked on all the same. Throws nothing when `stop` is requested either; then there are none. `progress`, if
/// given, is told the share of the file that was read, 0 … 1.
FoundMetadata metadataOf(const FrameSource& source, const std::stop_token& stop = {},
                         const IndexProgress& progress = {});

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/video/frame_source.h"
#include "metadata/metadata_recording.h"

namespace eyrie {

/// How far metadata reach.
struct TimelineOptions {
    double longest_gap_s = 2;   ///< between two sets that are blended
    double longest_hold_s = 1;  ///< that the nearest set counts where they are not
    /// Times at which the parts of the video but the first begin: in each its own sets count (MetadataPacket::part).
    std::vector<std::int64_t> breaks_us = {};
};

/// Those for a video: its parts begin where nothing holds on.
TimelineOptions timelineOptionsOf(const VideoInfo& video);

/// What the metadata say of one moment.
struct MetadataState {
    std::vector<MetadataPacket::Number> numbers;  ///< ascending by tag; those that are known then
    std::optional<std::int64_t> utc_us;

    std::optional<double> number(int tag) const;
};

/// The sets of a stream in the time of the video. A set belongs to the moment that its presentation stamp names,
/// measured from the pictures that lie about it in the file, so that jumps of the container's clock do no harm. A set
/// without a stamp, or with one that fits no picture near it, belongs to the picture before it in the file.
class MetadataTimeline {
 public:
    /// `pictures` are FrameSource::pictureStamps(); `stream` must outlive the timeline.
    MetadataTimeline(const MetadataStream& stream, const std::vector<PictureStamp>& pictures,
                     const TimelineOptions& options = {});

    /// Each value is blended between the last set before `time_us` that has it and the first one after; angles go the
    /// shorter way. Values without a set near enough are left out.
    MetadataState at(std::int64_t time_us) const;
    /// What the texts say then, ascending by tag: of each the last one stated by then, however long ago, else the first
    /// one after. They are sent rarely, and hold for long.
    std::vector<MetadataPacket::Text> textsAt(std::int64_t time_us) const;
    /// How much of [first_us, last_us] has a set near enough to count, 0 … 1.
    double coveredShare(std::int64_t first_us, std::int64_t last_us) const;

    /// Sets that were placed by their stamp, and by where they lie in the file.
    int placedByStamp() const { return by_stamp_; }
    int placedByFile() const { return by_file_; }
    /// Time in the video of the packet `index` of the stream; nothing where the video has no pictures.
    std::optional<std::int64_t> timeOf(std::size_t index) const;

 private:
    struct Place {
        std::int64_t time_us = 0;
        std::size_t packet = 0;
    };
    const MetadataStream& stream_;
    TimelineOptions options_;
    std::vector<Place> places_;  ///< ascending in time
    std::vector<std::int64_t> times_us_;
    std::map<int, std::vector<std::pair<std::int64_t, std::string>>> texts_;  ///< by tag, where they change; ascending
    int by_stamp_ = 0;
    int by_file_ = 0;
};

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "georeference/video_metadata.h"

namespace eyrie {

/// What time it was when a moment of a video was taken.
class VideoClock {
 public:
    enum class Source { none, given, metadata };

    /// Knows no time.
    VideoClock() = default;
    /// The video begins at `utc_us`, µs since 1970-01-01, as a person says.
    static VideoClock startingAt(std::int64_t utc_us);
    /// By the time stamps of the sets. Where nearly all of them (nine in ten, to half a second) agree on when the video
    /// began, that one beginning counts for the whole video, so that no moment is missing and none goes back; else
    /// each moment has the time that is stated near it, if any. No clock where there is no stamp.
    static VideoClock byMetadata(std::shared_ptr<const VideoMetadata> metadata);

    Source source() const { return source_; }
    /// Of `video_us` from the beginning of the video; nothing where it is not known.
    std::optional<std::int64_t> at(std::int64_t video_us) const;
    /// For people: "the start time given", "the video's metadata"; with what is odd about it.
    std::string origin() const;

 private:
    Source source_ = Source::none;
    std::optional<std::int64_t> start_us_;
    std::shared_ptr<const VideoMetadata> metadata_;  ///< where each moment has its own stamp
    int odd_stamps_ = 0;                             ///< that disagree with `start_us_`
};

}  // namespace eyrie

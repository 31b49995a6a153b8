#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "georeference/video_metadata.h"

namespace eyrie {

/// What time it was when a moment of a video was taken.
class VideoClock {
 public:
    /// Of what counts before what: a person, the metadata, when the file was begun.
    enum class Source { none, given, metadata, file };

    /// Knows no time.
    VideoClock() = default;
    /// The video begins at `utc_us`, µs since 1970-01-01, as a person says.
    static VideoClock startingAt(std::int64_t utc_us);
    /// By the time stamps of the sets. Where nearly all of them (nine in ten, to half a second) agree on when the video
    /// began, that one beginning counts for the whole video, so that no moment is missing and none goes back; else
    /// each moment has the time that is stated near it, if any. No clock where there is no stamp.
    static VideoClock byMetadata(std::shared_ptr<const VideoMetadata> metadata);
    /// Of a video in parts each begins when its list says so, else when its own metadata do, as above; so that what
    /// was not recorded between two parts shows. A part of which nothing tells goes on from the one before it, those
    /// before the first that is known lead up to it. `given_us`, when the video began as a person says, moves all of
    /// them together. Of a video that is one file by `given_us`, else by its metadata.
    static VideoClock ofParts(const std::vector<VideoPart>& parts, std::shared_ptr<const VideoMetadata> metadata,
                              std::optional<std::int64_t> given_us);

    /// Of a video by all that is known: as above, and where neither a person nor the metadata tell anything, it began
    /// when its file did, or each part when its own did.
    static VideoClock of(const FoundMetadata& found, std::optional<std::int64_t> given_us);

    Source source() const { return source_; }
    /// Of `video_us` from the beginning of the video; nothing where it is not known.
    std::optional<std::int64_t> at(std::int64_t video_us) const;
    /// For people: "the start time given", "the video's metadata", "the file's creation time"; with what is odd about
    /// it.
    std::string origin() const;

 private:
    /// What holds from a moment of the video on.
    struct Stretch {
        std::int64_t from_us = 0;
        std::optional<std::int64_t> start_us;  ///< of the whole video, if it had run on; none: each moment has its own
    };

    /// `part`: of whose sets; none: of all.
    static std::optional<Stretch> stretchBy(const VideoMetadata& metadata, std::int64_t from_us,
                                            std::optional<int> part, int& odd_stamps);
    static VideoClock byFiles(const FoundMetadata& found);
    /// The same with its gaps, from another beginning.
    static VideoClock begunAt(VideoClock clock, std::int64_t given_us);

    Source source_ = Source::none;
    std::vector<Stretch> stretches_;                 ///< ascending
    std::shared_ptr<const VideoMetadata> metadata_;  ///< where each moment has its own stamp
    int odd_stamps_ = 0;                             ///< that disagree with the start of their stretch
    int listed_parts_ = 0;                           ///< whose start stands in the list
    int stamped_parts_ = 0;                          ///< whose metadata count
    int silent_parts_ = 0;                           ///< of which nothing tells
};

}  // namespace eyrie

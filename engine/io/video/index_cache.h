#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "io/video/video_index.h"

namespace eyrie {

/// What tells one state of a file from another.
struct FileState {
    std::string path;          ///< absolute
    std::uint64_t size = 0;    ///< bytes
    std::int64_t changed = 0;  ///< ticks of the file system's clock
    bool operator==(const FileState&) const = default;
};
/// As it is now; nothing but its path of a file that cannot be looked at.
FileState stateOf(const std::filesystem::path& file);

/// Remembers indexes of videos on disk. A record belongs to a file's absolute path, size and time of change; a record
/// that is missing, damaged or out of date is no error, nor is a folder that cannot be written: then nothing is kept.
class IndexCache {
 public:
    /// An empty folder stands for the user's cache folder ($XDG_CACHE_HOME/eyrie or ~/.cache/eyrie).
    explicit IndexCache(std::filesystem::path folder = {});

    std::optional<VideoIndex> load(const std::filesystem::path& video) const;
    /// `video` as it was before it was indexed: what was written to it meanwhile may not be in the index.
    void save(const FileState& video, const VideoIndex& index) const;
    /// Where the record of a video is kept.
    std::filesystem::path recordOf(const std::filesystem::path& video) const;

 private:
    std::filesystem::path folder_;
};

}  // namespace eyrie

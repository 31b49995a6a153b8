#pragma once

#include <filesystem>
#include <optional>

#include "io/video/video_index.h"

namespace eyrie {

/// Remembers indexes of videos on disk. A record belongs to a file's absolute path, size and time of change; a record
/// that is missing, damaged or out of date is no error, nor is a folder that cannot be written: then nothing is kept.
class IndexCache {
 public:
    /// An empty folder stands for the user's cache folder ($XDG_CACHE_HOME/eyrie or ~/.cache/eyrie).
    explicit IndexCache(std::filesystem::path folder = {});

    std::optional<VideoIndex> load(const std::filesystem::path& video) const;
    void save(const std::filesystem::path& video, const VideoIndex& index) const;
    /// Where the record of a video is kept.
    std::filesystem::path recordOf(const std::filesystem::path& video) const;

 private:
    std::filesystem::path folder_;
};

}  // namespace eyrie

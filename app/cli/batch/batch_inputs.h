#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace eyrie::cli {

/// A video, a list of parts or a folder of images that a batch works on.
struct BatchInput {
    std::filesystem::path path;   ///< absolute
    std::filesystem::path name;   ///< as it is told and where its project goes, relative: "monday/a.mp4"
    std::uintmax_t bytes = 0;     ///< of the file, of all images, or of the list and all its parts
    std::int64_t changed_ns = 0;  ///< when it, or the newest image or part, was last written, since 1970 (UTC)
    std::string fault;            ///< not empty: it cannot be read, and why

    bool operator==(const BatchInput&) const = default;
};

/// What files turned out to be, for who looks again and again: only what changed meanwhile is read once more.
using KnownFiles = std::map<std::filesystem::path, std::pair<BatchInput, bool>>;  ///< as they were; whether videos

/// All videos in the files and folders that were named, and in the folders within, by name. A folder that holds images
/// and no video is one input. A list of parts is one, and none of its parts is one by itself, named or not. Hidden
/// files, and folders reached a second time through links, are left out; what cannot be looked into is an input with a
/// fault. Files that were named themselves are taken for what they are said to be.
std::vector<BatchInput> findInputs(const std::vector<std::string>& places);
std::vector<BatchInput> findInputs(const std::vector<std::string>& places, KnownFiles& files);

/// The name of an input without its ending, of a folder as it is: "monday/a". That of its project, if it is free.
std::filesystem::path nameOf(const BatchInput& input);

/// The same without further endings of videos: "a" of a.mov, a.mp4 and a.mp4.mov, which may all want a.eyrie or
/// a.mp4.eyrie. Inputs that share it are one piece of work, so that one batch alone decides which project is whose.
std::filesystem::path nameOfWork(const BatchInput& input);

/// Part `part` (from 1) of `parts`; together they are everything, once.
struct Shard {
    int part = 1;
    int parts = 1;

    /// Whether a piece of work falls to this part. Its name alone decides, whatever else there is to do, on every
    /// machine the same.
    bool takes(const std::filesystem::path& name_of_work) const;
};
/// "2/8". Throws Error(parameter).
Shard shardFrom(const std::string& text);

}  // namespace eyrie::cli

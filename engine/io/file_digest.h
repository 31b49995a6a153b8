#pragma once

#include <filesystem>
#include <functional>
#include <stop_token>
#include <string>

namespace eyrie {

/// SHA-256 of a file's bytes as 64 hexadecimal digits, as `sha256sum` prints it; of a folder of images, and of a list
/// of parts (video/parts/part_list.h), that of their names (each ended by a zero byte) and bytes, in the order of the
/// frames. `progress` (0 … 1) may be empty. Empty when `stop` was requested. Throws Error(input) for what cannot be
/// read.
std::string sha256Of(const std::filesystem::path& path, const std::function<void(double)>& progress = {},
                     const std::stop_token& stop = {});

/// SHA-256 of how the files lie there that sha256Of() reads, and a list of parts itself: names, sizes and, of pictures
/// in a folder, times of last writing, else edgeDigestOf(), in their order. Tells at once whether pictures or videos
/// were put in, taken away or replaced, by older ones too. Empty for what is no file or folder, or cannot be looked
/// into.
std::string listingDigestOf(const std::filesystem::path& path);

/// SHA-256 of the first and the last 64 KiB of a file, all of it where it is not longer: tells files of one size apart
/// at once, however long they are. Throws Error(input) for what cannot be read.
std::string edgeDigestOf(const std::filesystem::path& path);

}  // namespace eyrie

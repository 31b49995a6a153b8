#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/// A list of parts: a table (CSV) that names video files which are one video in a row, such as a recorder that begins a
/// new file every few minutes writes. It is opened like a video. Column `file`: path, relative to the folder of the
/// list or absolute; the others may be missing or empty: `start_utc`, when the first frame of the part was taken, and
/// `frames`, `bytes`, `digest`, by which a part that was replaced or changed is recognised.
namespace eyrie {

/// How the name of a list of parts ends.
inline constexpr char kPartListEnding[] = ".parts";

/// Whether the name is that of a list of parts, in small letters or capitals.
bool hasPartListName(const std::filesystem::path& path);

/// A row of the list.
struct ListedPart {
    std::filesystem::path file;                ///< absolute
    std::optional<std::int64_t> start_utc_us;  ///< µs since 1970-01-01
    int frames = 0;                            ///< 0: the list does not say
    std::uintmax_t bytes = 0;                  ///< 0: the list does not say
    std::string digest;                        ///< edgeDigestOf(); empty: the list does not say
};

/// The parts of a list in their order. One that is no longer at its place but beside the list, under its name, is
/// answered there. Throws Error(input) naming file, line and remedy for what is no such list.
std::vector<ListedPart> readPartList(const std::filesystem::path& list);

/// Replaces a list whole. Files in the folder of the list and below are named relative to it. Throws Error(output), and
/// Error(input) for a name that a table cannot hold.
void writePartList(const std::filesystem::path& list, const std::vector<ListedPart>& parts);

/// Writes a list at `wish`, or where that names other parts or something else already, at `wish` with -2, -3 … behind
/// its name. A list of the same parts is used as it is. Answers where the list lies. Throws as writePartList() does.
std::filesystem::path keepPartList(const std::filesystem::path& wish, const std::vector<ListedPart>& parts);

/// The name of a list of these files: "rec_001-rec_003.parts".
std::string partListName(const std::vector<std::filesystem::path>& files);

/// The parts with those that are not at their place taken from `chosen`: the file of the same name there, or beside one
/// of them. What is not found stays as it is.
std::vector<ListedPart> relocatedParts(std::vector<ListedPart> parts, const std::vector<std::filesystem::path>& chosen);

/// Throws Error(input) unless part `number` (from 0) of a list is there and, as far as the list says, still the same
/// file.
void checkPart(const std::filesystem::path& list, const std::vector<ListedPart>& parts, std::size_t number);

}  // namespace eyrie

#pragma once

#include <filesystem>
#include <string>

/// A project with something of every kind, for tests of what is done to whole files.
namespace eyrie::test {

inline constexpr int kFullFrames = 40;
inline constexpr int kFullObjects = 12;
inline constexpr int kFullVerdicts = 30;
inline constexpr int kFullZones = 4;
inline constexpr int kFullCorrections = 3;

/// Two runs, labels with steps of work, verdicts, zones, corrections, presets, a sweep and a comparison; one file,
/// without a log. Made once in a program, and the same to the last bit each time.
void writeFullProject(const std::filesystem::path& path);

/// All bytes, of files that no connection has open.
std::string bytesOf(const std::filesystem::path& path);
void writeBytes(const std::filesystem::path& path, const std::string& bytes);

}  // namespace eyrie::test

#pragma once

#include <QString>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/video/frame_source.h"
#include "store/runs/run_store.h"

namespace eyrie::ui {

/// The project in the user's data folder, for what has no folder of its own or one that cannot be written:
/// `<data folder>/eyrie/projects/<name>-<hash>.eyrie`. The hash is that of the identity, so that the same video finds
/// its project again.
std::filesystem::path projectInDataFolder(const std::string& media_name, const std::string& media_identity);

/// Where the project of a video lies when the user named none, the first to be tried first: beside the video
/// (`clip.mp4` → `clip.eyrie`), then the data folder; one that exists comes before one to be made. Built-in scenes have
/// the data folder only. Asks the file system: not for the window's thread.
std::vector<std::filesystem::path> projectPlaces(const std::string& media_name, const std::string& media_identity);

/// Whether a video can be the one a project knows: as many frames of the same size.
bool isSameVideo(const SequenceRecord& known, const VideoInfo& video);
/// What is said where it is not: in what they differ, and what to do. `identity` is that of the video.
QString whyAnotherVideo(const std::string& identity, const VideoInfo& video, const SequenceRecord& known);

/// Where a video that is gone from its place may lie: under its name beside the project. Nothing when there is no such
/// file or folder.
std::optional<std::filesystem::path> movedBeside(const std::filesystem::path& project, const SequenceRecord& known);

/// The video of a project that `video` is, moved or renamed folder: same file name, size and length, and no longer
/// where the project looks for it. Null when there is none, or when the project knows `video` itself.
const SequenceRecord* formerPlaceOf(const VideoInfo& video, const std::string& identity,
                                    const std::vector<SequenceRecord>& known);

}  // namespace eyrie::ui

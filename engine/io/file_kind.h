#pragma once

#include <filesystem>
#include <string>

namespace eyrie {

/// What a file is, as far as it decides whether another may take its place.
enum class FileKind {
    empty,    ///< no bytes: nothing is lost with it
    project,  ///< a project of ours or another database
    video,
    image,
    model,  ///< a trained classifier
    pdf,
    html,
    xml,
    json,
    text,  ///< tables and labels
    other  ///< programs, scripts, archives, whatever we do not know
};

/// With its article, for messages: "a video".
const char* nameOf(FileKind kind);

/// The kind by name for projects (which are not opened) and by the first bytes for everything else; unknown bytes under
/// the name of a video are a video. A regular file that cannot be read is `other`.
FileKind kindOfFile(const std::filesystem::path& path);

/// Whether a file is called what videos are called, whatever its bytes say.
bool hasVideoName(const std::filesystem::path& path);
/// These names as dialogs ask for them: "*.mp4 *.m4v …".
std::string videoFilePatterns();

}  // namespace eyrie

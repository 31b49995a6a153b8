#pragma once

#include <filesystem>
#include <string>

namespace eyrie::ui {

/// Where the project of a video lies when the user named none: `<user's data
/// folder>/eyrie/projects/<name>-<hash>.eyrie`. The hash is that of the identity, so that the same video finds its
/// project again.
std::filesystem::path defaultProjectPath(const std::string& media_name, const std::string& media_identity);

}  // namespace eyrie::ui

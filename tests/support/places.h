#pragma once

#include <filesystem>
#include <string>

/// Where a build found its tree. Said in one source file, so that the same tests in another folder come from the
/// compiler's cache.
namespace eyrie::test {

/// The project's folder.
std::filesystem::path sourceFolder();
/// Real data outside the project; may be absent.
std::filesystem::path sharedFolder();
/// A program of this build, e.g. "eyrie-cli".
std::string programPath(const std::string& name);

}  // namespace eyrie::test

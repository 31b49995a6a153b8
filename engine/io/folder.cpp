#include "io/folder.h"

#include "core/error.h"
#include "core/text.h"

namespace eyrie {

namespace fs = std::filesystem;

bool isFolder(const fs::path& path) {
    std::error_code failed;
    return fs::is_directory(path, failed);
}

bool isFile(const fs::path& path) {
    std::error_code failed;
    return fs::is_regular_file(path, failed);
}

std::vector<fs::path> entriesOf(const fs::path& folder) {
    std::vector<fs::path> entries;
    std::error_code failed;
    for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
        entries.push_back(entry->path());
    if (failed) {
        throw Error(ErrorKind::input, displayText(folder) + ": the folder cannot be read (" + failed.message() +
                                          "); check its permissions");
    }
    return entries;
}

}  // namespace eyrie

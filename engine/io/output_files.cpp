#include "io/output_files.h"

#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <optional>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "io/atomic_file.h"
#include "io/video/parts/part_list.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

/// What SQLite keeps beside a database.
constexpr const char* kCompanions[] = {"-wal", "-shm", "-journal"};

/// A file by its place on the disk, so that links and "./" deceive nobody.
struct Identity {
    fs::path canonical;
    std::optional<std::pair<dev_t, ino_t>> node;  ///< of an existing file
    mode_t type = 0;                              ///< S_IF…; 0: nothing is there
    int obstacle = 0;                             ///< errno where it cannot be told what is there (a link to itself)

    bool exists() const { return type != 0; }
    bool regular() const { return type == S_IFREG; }
    bool folder() const { return type == S_IFDIR; }
    bool same(const Identity& other) const {
        return canonical == other.canonical || (node && other.node && *node == *other.node);
    }
    /// Whether this is a folder with `other` somewhere in it.
    bool contains(const Identity& other) const {
        const auto [mine, its] =
            std::mismatch(canonical.begin(), canonical.end(), other.canonical.begin(), other.canonical.end());
        return folder() && mine == canonical.end() && its != other.canonical.end();
    }
};

Identity identify(const fs::path& path) {
    Identity identity;
    std::error_code failed;
    // Of a name alone that does not exist yet, weakly_canonical() would make no path.
    identity.canonical = fs::weakly_canonical(fs::absolute(path, failed), failed);
    if (failed) identity.canonical = fs::absolute(path, failed).lexically_normal();
    struct stat status {};
    if (::stat(path.c_str(), &status) == 0) {
        identity.node = std::pair(status.st_dev, status.st_ino);
        identity.type = status.st_mode & S_IFMT;
    } else if (errno != ENOENT && errno != ENOTDIR) {
        identity.obstacle = errno;
    }
    return identity;
}

[[noreturn]] void refuse(const fs::path& path, const std::string& why) {
    throw Error(ErrorKind::output, displayText(path) + ": " + why);
}

/// Throws where the file belongs to a database that lies beside it.
void refuseCompanion(const OutputFile& output, const Identity& file, const std::vector<Identity>& databases) {
    const std::string name = file.canonical.string();
    for (const std::string ending : kCompanions) {
        if (!name.ends_with(ending)) continue;
        Identity base;
        base.canonical = name.substr(0, name.size() - ending.size());
        std::error_code failed;
        const bool named = std::any_of(databases.begin(), databases.end(),
                                       [&](const Identity& database) { return database.canonical == base.canonical; });
        if (named || (fs::is_regular_file(base.canonical, failed) && kindOfFile(base.canonical) == FileKind::project))
            refuse(output.path, "belongs to the project " + displayText(base.canonical) + "; choose another name");
    }
}

struct Input {
    fs::path path;
    Identity identity;
};

void refuseInput(const OutputFile& output, const Identity& file, const Input& input) {
    if (output.grows && (!file.same(input.identity) || kindOfFile(input.path) == FileKind::project)) return;
    if (file.same(input.identity) && !file.folder())
        refuse(output.path, "is read by this command and would be overwritten; choose another name");
    if (file.regular() && input.identity.contains(file))
        refuse(output.path, "lies in the folder " + displayText(input.path) +
                                " that is read and would be overwritten; choose another name");
}

/// Refuses a second output of the same name or, through links, in the same file.
class DistinctFiles {
 public:
    void add(const OutputFile& output, const Identity& file) {
        const bool known = !names_.insert(file.canonical).second || (file.node && !nodes_.insert(*file.node).second);
        if (known) refuse(output.path, "is named for two outputs; choose another name for one of them");
    }

 private:
    std::set<fs::path> names_;
    std::set<std::pair<dev_t, ino_t>> nodes_;
};

/// The folder must be there and may be written.
void checkFolder(const OutputFile& output, const Identity& file) {
    fs::path folder = file.canonical.parent_path();
    std::error_code failed;
    while (output.makes_folders && !fs::exists(folder, failed) && folder.has_relative_path())
        folder = folder.parent_path();
    const std::string named = displayText(folder);
    if (!fs::exists(folder, failed)) refuse(output.path, "the folder " + named + " does not exist; make it first");
    if (!fs::is_directory(folder, failed)) refuse(output.path, named + " is not a folder; choose another place");
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        refuse(output.path,
               "the folder " + named + " cannot be written (" + std::strerror(errno) + "); choose another place");
}

/// An existing file that is to grow.
void checkGrowing(const OutputFile& output) {
    const FileKind found = kindOfFile(output.path);
    const bool fits = found == output.kind || (found == FileKind::empty && output.kind != FileKind::project);
    if (!fits) {
        throw Error(output.kind == FileKind::project ? ErrorKind::project : ErrorKind::output,
                    displayText(output.path) + ": is " + nameOf(found) + ", not " + nameOf(output.kind) +
                        "; it was left untouched; choose another name");
    }
    if (::access(output.path.c_str(), W_OK) != 0)
        refuse(output.path, std::string("cannot be written (") + std::strerror(errno) + "); check its permissions");
}

/// Whether an existing file would be replaced by one of its kind.
bool replaces(const OutputFile& output) {
    const FileKind found = kindOfFile(output.path);
    if (found == FileKind::empty) return false;
    if (found == FileKind::project)
        refuse(output.path, "is a project, which is never overwritten; choose another name");
    if (found != output.kind)
        refuse(output.path, std::string("is ") + nameOf(found) + ", which " + nameOf(output.kind) +
                                " does not replace; choose another name");
    return true;
}

/// Lists of parts with the files they name.
std::vector<fs::path> withParts(std::vector<fs::path> inputs) {
    const std::size_t count = inputs.size();
    for (std::size_t i = 0; i < count; ++i) {
        if (!hasPartListName(inputs[i])) continue;
        try {
            for (const ListedPart& part : readPartList(inputs[i])) inputs.push_back(part.file);
        } catch (const Error&) {
            // Told by whoever opens it.
        }
    }
    return inputs;
}

}  // namespace

std::vector<fs::path> filesToReplace(const std::vector<OutputFile>& outputs, const std::vector<fs::path>& inputs) {
    std::vector<Input> read;
    std::vector<Identity> databases;
    for (const fs::path& path : withParts(inputs)) {
        if (path.empty()) continue;
        const Identity identity = identify(path);
        if (!identity.exists()) continue;
        read.push_back({path, identity});
        databases.push_back(identity);
    }
    for (const OutputFile& output : outputs)
        if (output.kind == FileKind::project && !output.path.empty()) databases.push_back(identify(output.path));

    std::vector<fs::path> replaced;
    DistinctFiles files;
    for (const OutputFile& output : outputs) {
        if (output.path.empty()) continue;
        const Identity file = identify(output.path);
        if (file.obstacle != 0)
            refuse(output.path,
                   std::string("cannot be written (") + std::strerror(file.obstacle) + "); choose another name");
        for (const Input& input : read) refuseInput(output, file, input);
        if (file.folder()) refuse(output.path, "is a folder; name a file");
        if (file.exists() && !file.regular()) {
            if (output.kind == FileKind::project)
                throw Error(ErrorKind::project,
                            displayText(output.path) + ": is a pipe or a device, not a project; name a file (*.eyrie)");
            if (::access(output.path.c_str(), W_OK) != 0)
                refuse(output.path,
                       std::string("cannot be written (") + std::strerror(errno) + "); choose another place");
            continue;
        }
        if (isOwnStream(output.path)) continue;
        files.add(output, file);
        refuseCompanion(output, file, databases);
        checkFolder(output, file);
        if (!file.exists()) continue;
        if (output.grows) {
            checkGrowing(output);
        } else if (replaces(output)) {
            replaced.push_back(output.path);
        }
    }
    return replaced;
}

std::string shortList(const std::vector<fs::path>& files) {
    if (files.empty()) return {};
    const std::string first = displayText(files.front());
    return files.size() == 1 ? first : first + " and " + std::to_string(files.size() - 1) + " more";
}

}  // namespace eyrie

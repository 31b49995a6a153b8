#include "detection/sliding_window/model_location.h"

#include <vector>

#include "core/error.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

fs::path programFolder() {
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    return error ? fs::path() : program.parent_path();
}

bool isFile(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

}  // namespace

fs::path modelLocation(const std::string& path) {
    const bool thesis = path == kThesisModelWord;
    if (!path.empty() && !thesis) {
        if (isFile(path)) return path;
        throw Error(ErrorKind::input,
                    path +
                        ": there is no such model; see sliding_window.model, or leave it empty for the"
                        " model that comes with Eyrie");
    }
    const fs::path program = programFolder();
    std::string looked;
    for (const fs::path& folder :
         {program / "classifiers", program / "../share/eyrie/classifiers", fs::path(EYRIE_RESOURCES) / "classifiers"}) {
        const fs::path file = (folder / (thesis ? kThesisModel : kShippedModel)).lexically_normal();
        if (isFile(file)) return file;
        looked += "\n  " + file.string();
    }
    throw Error(ErrorKind::input,
                "the model that comes with Eyrie is missing; make one with eyrie-cli train, or name one in "
                "sliding_window.model. Looked at:" +
                    looked);
}

}  // namespace eyrie

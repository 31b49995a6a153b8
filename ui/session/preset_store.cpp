#include "session/preset_store.h"

#include <QStandardPaths>
#include <algorithm>

#include "core/error.h"
#include "io/preset_file.h"

namespace eyrie::ui {

namespace fs = std::filesystem;

PresetStore::PresetStore(fs::path folder) : folder_(std::move(folder)) {
    if (!folder_.empty()) return;
    const QString config = QStandardPaths::writableLocation(QStandardPaths::GenericConfigLocation);
    folder_ = fs::path(config.toStdString()) / "eyrie" / "presets";
}

fs::path PresetStore::fileOf(const std::string& name) const {
    return folder_ / (name + ".json");
}

std::vector<std::string> PresetStore::names() const {
    std::vector<std::string> own;
    std::error_code no_folder;
    for (const auto& entry : fs::directory_iterator(folder_, no_folder))
        if (entry.path().extension() == ".json") own.push_back(entry.path().stem().string());
    std::sort(own.begin(), own.end());
    std::vector<std::string> names = builtInPresets();
    names.insert(names.end(), own.begin(), own.end());
    return names;
}

ChainOptions PresetStore::load(const std::string& name) const {
    const auto built_in = builtInPresets();
    if (std::find(built_in.begin(), built_in.end(), name) != built_in.end()) return builtInPreset(name);
    ChainOptions options;
    setParameters(describeOf(options), readPreset(fileOf(name)).values);
    return options;
}

void PresetStore::save(const std::string& name, const ChainOptions& options) const {
    const auto built_in = builtInPresets();
    if (name.empty() || name.find('/') != std::string::npos || name.front() == '.')
        throw Error(ErrorKind::parameter, "“" + name + "” cannot be the name of a preset: choose one without a slash");
    if (std::find(built_in.begin(), built_in.end(), name) != built_in.end())
        throw Error(ErrorKind::parameter, "the preset “" + name + "” is built in: choose another name");
    std::error_code ignored;  // writePreset says what is wrong with the folder
    fs::create_directories(folder_, ignored);
    writePreset(fileOf(name), {name, parameterValues(options)});
}

}  // namespace eyrie::ui

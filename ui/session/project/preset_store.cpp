#include "session/project/preset_store.h"

#include <QStandardPaths>
#include <algorithm>

#include "core/error.h"
#include "io/output_files.h"
#include "io/tables/preset_file.h"
#include "store/project/project_presets.h"

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

namespace {

bool isBuiltIn(const std::string& name) {
    const auto built_in = builtInPresets();
    return std::find(built_in.begin(), built_in.end(), name) != built_in.end();
}

void refuseName(const std::string& name) {
    if (name.empty() || name.find('/') != std::string::npos || name.front() == '.')
        throw Error(ErrorKind::parameter, "“" + name + "” cannot be the name of a preset: choose one without a slash");
    if (isBuiltIn(name))
        throw Error(ErrorKind::parameter, "the preset “" + name + "” is built in: choose another name");
}

ChainOptions optionsOf(const std::vector<std::pair<std::string, std::string>>& values) {
    ChainOptions options;
    setParameters(describeOf(options), values);
    return options;
}

}  // namespace

std::vector<PresetStore::Entry> PresetStore::entries() const {
    std::vector<Entry> entries;
    for (const std::string& name : builtInPresets()) entries.push_back({name, Origin::built_in, {}});
    if (!project_.empty()) {
        try {
            ProjectFile project = ProjectFile::open(project_, ProjectFile::Mode::read_only);
            for (const PresetRecord& preset : presets(project))
                entries.push_back({preset.name, Origin::project, preset.saved_utc});
        } catch (const Error&) {
            // The session says what is wrong with the project.
        }
    }
    std::vector<std::string> own;
    std::error_code no_folder;
    for (const auto& entry : fs::directory_iterator(folder_, no_folder))
        if (entry.path().extension() == ".json") own.push_back(entry.path().stem().string());
    std::sort(own.begin(), own.end());
    for (const std::string& name : own) {
        const bool hidden = std::any_of(entries.begin(), entries.end(), [&](const Entry& e) { return e.name == name; });
        if (!hidden) entries.push_back({name, Origin::user, {}});
    }
    return entries;
}

std::vector<std::string> PresetStore::names() const {
    std::vector<std::string> names;
    for (const Entry& entry : entries()) names.push_back(entry.name);
    return names;
}

PresetStore::Entry PresetStore::entryOf(const std::string& name) const {
    for (const Entry& entry : entries())
        if (entry.name == name) return entry;
    throw Error(ErrorKind::parameter, "there is no preset “" + name + "”");
}

ChainOptions PresetStore::load(const std::string& name) const {
    if (isBuiltIn(name)) return builtInPreset(name);
    if (entryOf(name).origin == Origin::user) return optionsOf(readPreset(fileOf(name)).values);
    ProjectFile project = ProjectFile::open(project_, ProjectFile::Mode::read_only);
    const auto found = preset(project, name);
    if (!found) throw Error(ErrorKind::parameter, "there is no preset “" + name + "”");
    return optionsOf(found->values);
}

void PresetStore::save(const std::string& name, const ChainOptions& options) const {
    refuseName(name);
    if (!project_.empty()) {
        ProjectFile project = ProjectFile::open(project_);
        savePreset(project, {name, {}, parameterValues(options)});
        return;
    }
    std::error_code ignored;  // writePreset says what is wrong with the folder
    fs::create_directories(folder_, ignored);
    writePreset(fileOf(name), {name, parameterValues(options)});
}

void PresetStore::rename(const std::string& from, const std::string& to) const {
    refuseName(to);
    const Entry entry = entryOf(from);
    if (from == to) return;
    const auto known = names();
    if (std::find(known.begin(), known.end(), to) != known.end())
        throw Error(ErrorKind::parameter, "there is a preset “" + to + "” already");
    if (entry.origin == Origin::project) {
        ProjectFile project = ProjectFile::open(project_);
        renamePreset(project, from, to);
        return;
    }
    refuseName(from);
    exportFile(from, fileOf(to));
    remove(from);
}

void PresetStore::remove(const std::string& name) const {
    const Entry entry = entryOf(name);
    refuseName(name);
    if (entry.origin == Origin::project) {
        ProjectFile project = ProjectFile::open(project_);
        removePreset(project, name);
        return;
    }
    std::error_code failed;
    fs::remove(fileOf(name), failed);
    if (failed) throw Error(ErrorKind::output, fileOf(name).string() + ": " + failed.message());
}

std::string PresetStore::importFile(const fs::path& file) const {
    const Preset read = readPreset(file);
    const std::string name = read.name.empty() || isBuiltIn(read.name) ? file.stem().string() : read.name;
    save(name, optionsOf(read.values));
    return name;
}

void PresetStore::exportFile(const std::string& name, const fs::path& file) const {
    filesToReplace({{file, FileKind::json}}, {project_});  // the dialog has asked about a preset that is there
    writePreset(file, {file.stem().string(), parameterValues(load(name))});
}

}  // namespace eyrie::ui

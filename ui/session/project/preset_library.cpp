#include "session/project/preset_library.h"

#include <algorithm>
#include <exception>
#include <utility>

namespace eyrie::ui {

PresetLibrary::PresetLibrary(const std::filesystem::path& folder, QObject* parent) : QObject(parent), store_(folder) {
    for (const std::string& name : builtInPresets())
        presets_.push_back(
            {name, PresetStore::Origin::built_in, {}, std::make_shared<const ChainOptions>(builtInPreset(name)), {}});
    refresh();
}

void PresetLibrary::useProject(const std::filesystem::path& project) {
    query_.post([this, project](const BackgroundTask&) { store_.useProject(project); });
    refresh();
}

void PresetLibrary::refresh() {
    post({}, this, {});
}

const PresetLibrary::Preset* PresetLibrary::find(const std::string& name) const {
    const auto found = std::find_if(presets_.begin(), presets_.end(), [&](const Preset& p) { return p.name == name; });
    return found == presets_.end() ? nullptr : &*found;
}

std::vector<PresetLibrary::Preset> PresetLibrary::read(const PresetStore& store) {
    std::vector<Preset> presets;
    for (const PresetStore::Entry& entry : store.entries()) {
        Preset preset{entry.name, entry.origin, entry.saved_utc, {}, {}};
        try {
            preset.options = std::make_shared<const ChainOptions>(store.load(entry.name));
        } catch (const std::exception& error) {
            preset.problem = QString::fromUtf8(error.what());
        }
        presets.push_back(std::move(preset));
    }
    return presets;
}

void PresetLibrary::post(Work work, QObject* receiver, Answer answer) {
    query_.write([this, work = std::move(work), guard = QPointer(receiver),
                  answer = std::move(answer)](const BackgroundTask& task) {
        std::string name;
        QString problem;
        std::vector<Preset> presets;
        try {
            if (work) name = work(store_);
        } catch (const std::exception& error) {
            problem = QString::fromUtf8(error.what());
        }
        try {
            presets = read(store_);
        } catch (const std::exception& error) {
            if (problem.isEmpty()) problem = QString::fromUtf8(error.what());
        }
        task.tell([this, guard, answer, name = QString::fromStdString(name), problem,
                   presets = std::move(presets)]() mutable {
            if (!presets.empty()) presets_ = std::move(presets);
            emit changed();
            if (answer && guard) answer(name, problem);
        });
    });
}

void PresetLibrary::save(const std::string& name, const ChainOptions& options, QObject* receiver, Answer answer) {
    const auto work = [name, options](PresetStore& store) {
        store.save(name, options);
        return name;
    };
    post(work, receiver, std::move(answer));
}

void PresetLibrary::rename(const std::string& from, const std::string& to, QObject* receiver, Answer answer) {
    const auto work = [from, to](PresetStore& store) {
        store.rename(from, to);
        return to;
    };
    post(work, receiver, std::move(answer));
}

void PresetLibrary::remove(const std::string& name, QObject* receiver, Answer answer) {
    const auto work = [name](PresetStore& store) {
        store.remove(name);
        return std::string();
    };
    post(work, receiver, std::move(answer));
}

void PresetLibrary::importFile(const std::filesystem::path& file, QObject* receiver, Answer answer) {
    post([file](PresetStore& store) { return store.importFile(file); }, receiver, std::move(answer));
}

void PresetLibrary::exportFile(const std::string& name, const std::filesystem::path& file, QObject* receiver,
                               Answer answer) {
    const auto work = [name, file](PresetStore& store) {
        store.exportFile(name, file);
        return name;
    };
    post(work, receiver, std::move(answer));
}

}  // namespace eyrie::ui

#include "moc_preset_library.cpp"

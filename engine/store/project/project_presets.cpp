#include "store/project/project_presets.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "store/database/database_error.h"

namespace eyrie {
namespace {

std::vector<PresetRecord> readPresets(ProjectFile& project, const std::string& which) {
    SQLite::Statement statement(project.database(),
                                "SELECT preset.name, saved_utc, preset_value.name, value FROM preset LEFT JOIN "
                                "preset_value ON preset_value.preset = preset.name WHERE ?1 = '' OR preset.name = ?1 "
                                "ORDER BY preset.name, position");
    statement.bind(1, which);
    std::vector<PresetRecord> all;
    while (statement.executeStep()) {
        const std::string name = statement.getColumn(0).getString();
        if (all.empty() || all.back().name != name) all.push_back({name, statement.getColumn(1).getString(), {}});
        if (statement.getColumn(2).isNull()) continue;
        all.back().values.emplace_back(statement.getColumn(2).getString(), statement.getColumn(3).getString());
    }
    return all;
}

void refuseMissing(const std::string& name) {
    throw Error(ErrorKind::parameter, "the project has no preset \"" + name + "\"");
}

void refuseEmpty(const std::string& name) {
    if (name.empty()) throw Error(ErrorKind::parameter, "a preset needs a name");
}

}  // namespace

std::vector<PresetRecord> presets(ProjectFile& project) {
    return guarded(project.path(), "reading the presets", [&] { return readPresets(project, ""); });
}

std::optional<PresetRecord> preset(ProjectFile& project, const std::string& name) {
    if (name.empty()) return std::nullopt;
    return guarded(project.path(), "reading a preset", [&]() -> std::optional<PresetRecord> {
        auto found = readPresets(project, name);
        if (found.empty()) return std::nullopt;
        return std::move(found.front());
    });
}

void savePreset(ProjectFile& project, const PresetRecord& preset) {
    refuseEmpty(preset.name);
    guarded(project.path(), "storing a preset", [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        SQLite::Statement remove(project.database(), "DELETE FROM preset WHERE name = ?");
        remove.bind(1, preset.name);
        remove.exec();
        SQLite::Statement add(project.database(), "INSERT INTO preset (name, saved_utc) VALUES (?, ?)");
        add.bind(1, preset.name);
        add.bind(2, nowUtc());
        add.exec();
        SQLite::Statement value(project.database(),
                                "INSERT INTO preset_value (preset, position, name, value) VALUES (?, ?, ?, ?)");
        for (std::size_t i = 0; i < preset.values.size(); ++i) {
            value.bind(1, preset.name);
            value.bind(2, static_cast<int>(i));
            value.bind(3, preset.values[i].first);
            value.bind(4, preset.values[i].second);
            value.exec();
            value.reset();
        }
        transaction.commit();
    });
}

void renamePreset(ProjectFile& project, const std::string& from, const std::string& to) {
    refuseEmpty(to);
    if (from == to) return;
    guarded(project.path(), "renaming a preset", [&] {
        SQLite::Transaction transaction(project.database(), SQLite::TransactionBehavior::IMMEDIATE);
        if (!readPresets(project, to).empty())
            throw Error(ErrorKind::parameter, "the project has a preset \"" + to + "\" already");
        SQLite::Statement rename(project.database(), "UPDATE preset SET name = ? WHERE name = ?");
        rename.bind(1, to);
        rename.bind(2, from);
        if (rename.exec() == 0) refuseMissing(from);
        transaction.commit();
    });
}

void removePreset(ProjectFile& project, const std::string& name) {
    guarded(project.path(), "removing a preset", [&] {
        SQLite::Statement remove(project.database(), "DELETE FROM preset WHERE name = ?");
        remove.bind(1, name);
        if (remove.exec() == 0) refuseMissing(name);
    });
}

}  // namespace eyrie

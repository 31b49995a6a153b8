#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "chain/chain_options.h"

namespace eyrie::ui {

/// The built-in presets, those of the project, and the user's own, which lie as files in the user's configuration
/// folder. A name of the project hides one of the user's.
class PresetStore {
 public:
    enum class Origin { built_in, project, user };
    struct Entry {
        std::string name;
        Origin origin = Origin::built_in;
        std::string saved_utc;  ///< project only
    };

    /// `folder` empty: the user's own.
    explicit PresetStore(std::filesystem::path folder = {});

    /// New presets go into this project; empty: into the user's folder.
    void useProject(const std::filesystem::path& project) { project_ = project; }

    /// Built-in ones first, then the project's. A project that cannot be read has none.
    std::vector<Entry> entries() const;
    std::vector<std::string> names() const;
    /// Throws Error(parameter | input | project): no such preset, it is damaged or names unknown parameters.
    ChainOptions load(const std::string& name) const;
    /// Throws Error(parameter) for a built-in name or one that cannot be a file, Error(output | project) when it cannot
    /// be written.
    void save(const std::string& name, const ChainOptions& options) const;
    /// Throws Error(parameter) for built-in ones, names that are taken and presets that are not there.
    void rename(const std::string& from, const std::string& to) const;
    void remove(const std::string& name) const;
    /// Takes over a preset file under its own name, or that of the file; answers it. Throws Error(input | parameter).
    std::string importFile(const std::filesystem::path& file) const;
    void exportFile(const std::string& name, const std::filesystem::path& file) const;

 private:
    std::filesystem::path fileOf(const std::string& name) const;
    Entry entryOf(const std::string& name) const;
    std::filesystem::path folder_;
    std::filesystem::path project_;
};

}  // namespace eyrie::ui

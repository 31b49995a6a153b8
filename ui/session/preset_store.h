#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "chain/chain_options.h"

namespace eyrie::ui {

/// The built-in presets and the user's own, which lie as files in the user's configuration folder.
class PresetStore {
 public:
    /// `folder` empty: the user's own.
    explicit PresetStore(std::filesystem::path folder = {});

    /// Built-in ones first.
    std::vector<std::string> names() const;
    /// Throws Error(parameter | input): no such preset, or its file is damaged or names unknown parameters.
    ChainOptions load(const std::string& name) const;
    /// Throws Error(parameter) for a built-in name or one that cannot be a file, Error(output) when it cannot be
    /// written.
    void save(const std::string& name, const ChainOptions& options) const;

 private:
    std::filesystem::path fileOf(const std::string& name) const;
    std::filesystem::path folder_;
};

}  // namespace eyrie::ui

#pragma once

#include <filesystem>
#include <utility>

#include "store/project/project_file.h"

namespace eyrie::test {

/// What a window that may only read does now and then, over a connection of its own; whether it came upon something
/// new.
template <class Store>
bool follows(Store& store, const std::filesystem::path& path, int sequence_id = 1) {
    ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
    auto reading = Store::readIfChanged(project, sequence_id, store.changes());
    return reading && store.follow(std::move(*reading));
}

}  // namespace eyrie::test

#pragma once

#include <filesystem>
#include <optional>

#include "store/backup/project_backup.h"

namespace eyrie {

/// What the file's name says: time and reason. Nothing for a name that no copy has; size and path are left to the
/// caller.
std::optional<ProjectBackup> parseBackupName(const std::filesystem::path& file);
/// "2026-11-21T08-00-00Z-daily.eyrie".
std::string backupFileName(UtcTime made, BackupReason reason);
/// Where the path lies inside a folder of backups.
bool isBackup(const std::filesystem::path& path);

inline constexpr char kBackupsFolder[] = ".eyrie-backups";

}  // namespace eyrie

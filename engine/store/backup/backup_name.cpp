#include "store/backup/backup_name.h"

#include <array>
#include <cstdio>
#include <string_view>

#include "core/project_name.h"

namespace eyrie {
namespace {

struct ReasonWord {
    BackupReason reason;
    std::string_view word;
};
// Part of the files' names, so they never change.
constexpr std::array<ReasonWord, 3> kWords{{{BackupReason::daily, "daily"},
                                            {BackupReason::before_migration, "before-migration"},
                                            {BackupReason::before_restoring, "before-restoring"}}};

std::string format(UtcTime time, const char* pattern) {
    const auto day = std::chrono::floor<std::chrono::days>(time);
    const std::chrono::year_month_day date(day);
    const std::chrono::hh_mm_ss clock(time - day);
    char text[40];
    std::snprintf(text, sizeof text, pattern, static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                  static_cast<unsigned>(date.day()), static_cast<int>(clock.hours().count()),
                  static_cast<int>(clock.minutes().count()), static_cast<int>(clock.seconds().count()));
    return text;
}

}  // namespace

UtcTime utcNow() {
    return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

std::string inWords(UtcTime time) {
    return format(time, "%04d-%02u-%02u %02d:%02d:%02d UTC");
}

const char* nameOf(BackupReason reason) {
    switch (reason) {
        case BackupReason::daily:
            return "first use that day";
        case BackupReason::before_migration:
            return "before an update of the project";
        case BackupReason::before_restoring:
            return "before restoring";
    }
    return "";
}

std::string backupFileName(UtcTime made, BackupReason reason) {
    std::string name = format(made, "%04d-%02u-%02uT%02d-%02d-%02dZ-");
    for (const ReasonWord& entry : kWords) {
        if (entry.reason == reason) name += entry.word;
    }
    return name + kProjectEnding;
}

std::optional<ProjectBackup> parseBackupName(const std::filesystem::path& file) {
    const std::string name = file.filename().string();
    int year = 0;
    unsigned month = 0;
    unsigned day = 0;
    int hour = 0;
    int minute = 0;
    int second = 0;
    if (std::sscanf(name.c_str(), "%4d-%2u-%2uT%2d-%2d-%2dZ-", &year, &month, &day, &hour, &minute, &second) != 6) {
        return std::nullopt;
    }
    const std::chrono::year_month_day date{std::chrono::year(year), std::chrono::month(month), std::chrono::day(day)};
    if (!date.ok()) return std::nullopt;
    ProjectBackup backup;
    backup.path = file;
    backup.made = std::chrono::sys_days(date) + std::chrono::hours(hour) + std::chrono::minutes(minute) +
                  std::chrono::seconds(second);
    for (const ReasonWord& entry : kWords) {
        backup.reason = entry.reason;
        if (name == backupFileName(backup.made, backup.reason)) return backup;
    }
    return std::nullopt;
}

bool isBackup(const std::filesystem::path& path) {
    std::error_code failed;
    const auto whole = std::filesystem::weakly_canonical(path, failed);
    return !failed && whole.parent_path().parent_path().filename() == kBackupsFolder;
}

}  // namespace eyrie

#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "store/project/project_file.h"

namespace eyrie::test {

/// Every row that belongs to a run, to the last bit, without the run's number and the times that stages took.
inline std::vector<std::string> rowsOf(const std::filesystem::path& path, int run_id) {
    ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
    std::vector<std::string> rows;
    for (const std::string table :
         {"frame", "motion_vectors", "stationary_corners", "motion_cluster", "roi", "detection", "track", "track_state",
          "dropped_state", "doubtful_state", "track_evidence", "light_finding", "frame_shadow", "box_trim", "run_state",
          "unfinished_track_state", "unfinished_frame"}) {
        SQLite::Statement statement(project.database(), "SELECT * FROM " + table + " WHERE run_id = ?");
        statement.bind(1, run_id);
        while (statement.executeStep()) {
            std::string row = table + ":";
            for (int i = 0; i < statement.getColumnCount(); ++i) {
                const SQLite::Column column = statement.getColumn(i);
                const std::string name = column.getName();
                if (name == "run_id" || name.ends_with("_ms")) continue;
                row += " " + name + "=";
                if (column.isFloat()) {
                    row += std::to_string(std::bit_cast<std::uint64_t>(column.getDouble()));
                } else if (column.isBlob()) {
                    for (const char byte : column.getString()) row += std::to_string(byte) + ",";
                } else {
                    row += column.isNull() ? "null" : column.getString();
                }
            }
            rows.push_back(std::move(row));
        }
    }
    std::sort(rows.begin(), rows.end());
    return rows;
}

}  // namespace eyrie::test

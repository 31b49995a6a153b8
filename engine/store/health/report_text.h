#pragma once

#include <SQLiteCpp/Database.h>
#include <SQLiteCpp/Statement.h>

#include <cstdint>
#include <string>
#include <vector>

/// Small works of what reports on whole projects.
namespace eyrie {

/// "1 frame", "3 frames"; `many` where the plural is another.
inline std::string counted(std::int64_t number, const std::string& one, const std::string& many = {}) {
    return std::to_string(number) + " " + (number == 1 ? one : many.empty() ? one + "s" : many);
}

/// The first column of all rows.
inline std::vector<std::string> textsOf(SQLite::Database& database, const std::string& query) {
    SQLite::Statement statement(database, query);
    std::vector<std::string> texts;
    while (statement.executeStep()) texts.push_back(statement.getColumn(0).getString());
    return texts;
}

}  // namespace eyrie

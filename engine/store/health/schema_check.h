#pragma once

#include <set>
#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace eyrie {

/// How the tables of a project compare with those that Eyrie makes for its schema number.
struct SchemaCheck {
    std::vector<std::string> faults;  ///< for people: "table run is missing", "there is a foreign trigger x"
    std::set<std::string> tables;     ///< those that are as they should be
};

/// Throws SQLite::Exception when the schema cannot be read.
SchemaCheck checkSchema(SQLite::Database& database);

}  // namespace eyrie

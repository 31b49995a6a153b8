#include "store/health/schema_check.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <map>

#include "store/project/schema.h"

namespace eyrie {
namespace {

struct Entry {
    std::string type;
    std::string sql;
    bool operator==(const Entry&) const = default;
};

/// Tables, indices, views and triggers by name. What SQLite makes for its own use (statistics) is left out.
std::map<std::string, Entry> entriesOf(SQLite::Database& database) {
    SQLite::Statement statement(database, "SELECT name, type, coalesce(sql, '') FROM sqlite_schema");
    std::map<std::string, Entry> entries;
    while (statement.executeStep()) {
        const std::string name = statement.getColumn(0).getString();
        if (name.starts_with("sqlite_stat")) continue;
        entries[name] = {statement.getColumn(1).getString(), statement.getColumn(2).getString()};
    }
    return entries;
}

}  // namespace

SchemaCheck checkSchema(SQLite::Database& database) {
    const auto steps = schema::migrations();
    const int number = std::clamp(schema::numberOf(database), 0, static_cast<int>(steps.size()));
    SQLite::Database sample(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    schema::migrate(sample, steps.first(static_cast<std::size_t>(number)));
    const auto expected = entriesOf(sample);
    const auto found = entriesOf(database);
    SchemaCheck check;
    for (const auto& [name, entry] : expected) {
        const auto same = found.find(name);
        if (same == found.end()) {
            check.faults.push_back(entry.type + " " + name + " is missing");
        } else if (same->second != entry) {
            check.faults.push_back(entry.type + " " + name + " is not as Eyrie makes it");
        } else if (entry.type == "table") {
            check.tables.insert(name);
        }
    }
    for (const auto& [name, entry] : found) {
        if (expected.count(name) == 0) check.faults.push_back("there is a foreign " + entry.type + " " + name);
    }
    return check;
}

}  // namespace eyrie

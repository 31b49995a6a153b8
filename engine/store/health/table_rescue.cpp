#include "store/health/table_rescue.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <deque>
#include <vector>

#include "store/health/report_text.h"

namespace eyrie {
namespace {

// How often a query may fail in a stretch of keys before the rest of it is given up; frames beyond the first hundred
// thousand are rare, so that less is spent there.
constexpr int kFailures = 4096;
constexpr int kFailuresFarOut = 256;
constexpr std::int64_t kFarOut = 1 << 17;
constexpr std::int64_t kLargestKey = std::int64_t{1} << 31;
// And before anything of a group could be read.
constexpr int kFailuresInVain = 5;
// And how many groups are looked into when none can be read as a whole, since then the table has lost its root.
constexpr std::size_t kGroupsInVain = 3;

bool isFailureOfOurs(const SQLite::Exception& exception) {
    const int code = exception.getErrorCode();
    if (code == SQLITE_IOERR) {
        const int extended = exception.getExtendedErrorCode();
        return extended != SQLITE_IOERR_READ && extended != SQLITE_IOERR_SHORT_READ &&
               extended != SQLITE_IOERR_CORRUPTFS;
    }
    return code == SQLITE_INTERRUPT || code == SQLITE_FULL || code == SQLITE_READONLY || code == SQLITE_NOMEM;
}

class Rescue {
 public:
    Rescue(SQLite::Database& database, const std::string& table) : database_(database), table_(table) {
        const std::string shared = " WHERE name IN (SELECT name FROM pragma_table_info('" + table + "', 'damaged'))";
        for (const std::string& name :
             textsOf(database, "SELECT name FROM pragma_table_info('" + table + "', 'main')" + shared)) {
            columns_ += (columns_.empty() ? "" : ", ") + name;
        }
        if (database
                .execAndGet("SELECT count(*) FROM damaged.sqlite_schema WHERE type = 'table' AND sql LIKE 'CREATE "
                            "TABLE%' AND name = '" +
                            table + "'")
                .getInt() != 1) {
            columns_.clear();  // a view, say
        }
        const bool numbered =
            database
                .execAndGet("SELECT sql NOT LIKE '%WITHOUT ROWID%' FROM main.sqlite_schema WHERE name = '" + table +
                            "'")
                .getInt() != 0;
        if (!numbered) {
            keys_ = textsOf(database,
                            "SELECT name FROM pragma_table_info('" + table + "', 'main') WHERE pk > 0 ORDER BY pk");
        }
    }

    TableRescue work() {
        if (columns_.empty()) {
            result_ = {0, false, "the table is missing"};
            return result_;
        }
        if (!copy("")) piecewise();
        result_.rows = database_.execAndGet("SELECT count(*) FROM main." + table_).getInt64();
        return result_;
    }

 private:
    /// Copies the rows for which a condition holds: all of them, or none where one cannot be read.
    bool copy(const std::string& condition, const std::string& more = "") {
        try {
            database_.exec("INSERT OR IGNORE INTO main." + table_ + " (" + columns_ + ") SELECT " + columns_ +
                           " FROM damaged." + table_ + " NOT INDEXED" +
                           (condition.empty() ? "" : " WHERE " + condition) + more);
            return true;
        } catch (const SQLite::Exception& exception) {
            if (isFailureOfOurs(exception)) throw;
            if (result_.whole) result_.fault = exception.what();
            result_.whole = false;
            return false;
        }
    }

    void piecewise() {
        if (keys_.empty()) {
            stretches("", "rowid");
        } else if (keys_.size() == 1) {
            fromBothEnds();
        } else {
            const auto all = groups();
            std::vector<std::string> broken;
            for (const std::string& group : all) {
                const std::string condition = keys_[0] + " = " + group;
                if (!copy(condition)) broken.push_back(condition + " AND ");
            }
            if (broken.size() == all.size()) broken.resize(std::min(broken.size(), kGroupsInVain));
            for (const std::string& group : broken) stretches(group, keys_[1]);
        }
    }

    /// The values that the first column of the key may have: numbers of what was saved before, and some beyond, since
    /// what they belong to may be lost.
    std::vector<std::string> groups() const {
        if (keys_[0] == "preset") return textsOf(database_, "SELECT quote(name) FROM main.preset");
        const std::string owner = keys_[0].substr(0, keys_[0].rfind("_id"));
        const auto highest = database_.execAndGet("SELECT coalesce(max(id), 0) FROM main." + owner).getInt64();
        std::vector<std::string> values;
        constexpr std::int64_t kBeyond = 8;
        for (std::int64_t id = 1; id <= highest + kBeyond; ++id) values.push_back(std::to_string(id));
        return values;
    }

    /// Stretches of keys that double, so that keys near the beginning, where all are, are looked at most closely.
    void stretches(const std::string& group, const std::string& key) {
        const auto all = [&](int near, int far) {
            bool alive = false;
            for (std::int64_t first = 0, last = 1023; first < kLargestKey; first = last + 1, last = 2 * last + 1) {
                if (halve(group + key, first, last, first < kFarOut ? near : far)) alive = true;
            }
            return alive;
        };
        // A row at either end tells that more is to be had; a lost last page spoils every stretch that ends behind it.
        const auto hasEnd = [&](const char* direction) {
            return copy(group + key + " >= 0", " ORDER BY " + key + direction + " LIMIT 1");
        };
        if (hasEnd("") || hasEnd(" DESC") || all(kFailuresInVain, kFailuresInVain)) all(kFailures, kFailuresFarOut);
    }

    /// Halves what cannot be read as a whole until patience ends; the large parts come first, so that those that are
    /// whole are saved before. Answers whether any part could be read.
    bool halve(const std::string& key, std::int64_t first, std::int64_t last, int patience) {
        bool alive = false;
        std::deque<std::pair<std::int64_t, std::int64_t>> ranges{{first, last}};
        for (; !ranges.empty() && patience > 0; ranges.pop_front()) {
            const auto [low, high] = ranges.front();
            const std::string condition = key + " BETWEEN " + std::to_string(low) + " AND " + std::to_string(high);
            if (copy(condition)) {
                alive = true;
                continue;
            }
            --patience;
            if (low == high) {
                // One row: the first may be whole where the look for a second fails.
                if (keys_.size() <= 2) copy(condition, " LIMIT 1");
                continue;
            }
            const std::int64_t middle = low + (high - low) / 2;
            ranges.emplace_back(low, middle);
            ranges.emplace_back(middle + 1, high);
        }
        return alive;
    }

    /// For the few rows of tables by name: row after row until one cannot be read, from either end.
    void fromBothEnds() {
        for (const std::string& direction : {std::string(), std::string(" DESC")}) {
            const auto count = [&] { return database_.execAndGet("SELECT count(*) FROM main." + table_).getInt64(); };
            for (int offset = 0;; ++offset) {
                const auto before = count();
                if (!copy("", " ORDER BY " + keys_[0] + direction + " LIMIT 1 OFFSET " + std::to_string(offset))) break;
                if (count() == before && offset > before) break;
            }
        }
    }

    SQLite::Database& database_;
    const std::string& table_;
    std::string columns_;
    std::vector<std::string> keys_;
    TableRescue result_;
};

}  // namespace

TableRescue rescueTable(SQLite::Database& database, const std::string& table) {
    try {
        return Rescue(database, table).work();
    } catch (const SQLite::Exception& exception) {
        if (isFailureOfOurs(exception)) throw;
        return {0, false, exception.what()};
    }
}

}  // namespace eyrie

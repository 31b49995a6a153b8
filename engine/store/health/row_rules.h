#pragma once

#include <string>
#include <vector>

namespace SQLite {
class Database;
}

namespace eyrie {

/// What must hold for every row that a writer of ours wrote.
struct RowRule {
    std::string table;
    std::string condition;  ///< in SQL over the columns of the table; NULL counts as true
    std::string what;       ///< for people: what is wrong where it does not hold
    int since = 1;          ///< the schema that brought the columns or the words
};

/// All rules, tables in no order. They use functions that addRowFunctions() brings.
std::vector<RowRule> rowRules();

/// The condition of the rule about where the scale of a run comes from: what breaks it costs less than the run.
std::string fittingScaleOrigin();
/// The same for how the scale changes over the picture.
std::string fittingScaleSlope();
/// The same for when a video began.
std::string fittingVideoStart();

/// The same for when in its second a run began.
std::string fittingRunStart();

/// Gives a connection the functions that the rules use: whether packed bytes can be unpacked.
void addRowFunctions(SQLite::Database& database);

}  // namespace eyrie

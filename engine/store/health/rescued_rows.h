#pragma once

#include <string>
#include <vector>

namespace SQLite {
class Database;
}

/// Makes rows that were saved one by one fit together again. Foreign keys must not be enforced meanwhile. All throw
/// SQLite::Exception. Lines are for people and say what was lost.
namespace eyrie {

/// Runs that say something impossible about where their scale comes from tell what those tell that kept nothing of it.
std::vector<std::string> mendScaleOrigins(SQLite::Database& database);

/// Runs whose scale changes over the picture in an impossible way are of one scale.
std::vector<std::string> mendScaleSlopes(SQLite::Database& database);

/// Videos that begin at no time begin nobody knows when.
std::vector<std::string> mendVideoStarts(SQLite::Database& database);

/// Runs that began at no moment of their second began some time in it.
std::vector<std::string> mendRunStarts(SQLite::Database& database);

/// Deletes rows that no writer wrote.
std::vector<std::string> dropImpossibleRows(SQLite::Database& database);

/// Makes rows for the runs and videos that saved rows belong to and that were lost; deletes what belongs to other
/// things that were lost.
std::vector<std::string> mendReferences(SQLite::Database& database);

/// Sums that follow from other rows. Runs that lack frames end as failed, those that were being written as stopped.
/// `frames_whole`: whether all frames could be read, so that only those that were never written are missing.
std::vector<std::string> mendRuns(SQLite::Database& database, bool frames_whole);

/// Steps of work that no longer fit the labels are dropped; numbers of objects are never given twice.
std::vector<std::string> mendLabels(SQLite::Database& database);

/// The same of the review as of labels: next numbers, and steps that fit.
std::vector<std::string> mendReview(SQLite::Database& database);

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace SQLite {
class Database;
}

/// The tables of a project file and how they grew.
namespace eyrie::schema {

/// "EYRI", in the header of every project file.
inline constexpr std::int32_t kApplicationId = 0x45595249;

/// One step of the schema, run inside a transaction of its own. Steps are never changed once released, only added.
using Migration = void (*)(SQLite::Database& database);

/// All steps in order. The schema number of a file is how many of them it has seen.
std::span<const Migration> migrations();

/// The schema number this version writes.
int currentNumber();

/// The schema number of an open file (`user_version`).
int numberOf(SQLite::Database& database);

/// Runs the steps the file has not seen, each with its new number in one transaction: a step that fails or is killed
/// leaves the file at the number before. Two programs may migrate the same file at once.
void migrate(SQLite::Database& database, std::span<const Migration> steps);

/// Turns the sentences that frames of projects before schema 9 have as reasons into words and figures. Not to be called
/// where there are words already.
void wordRegistrationFaults(SQLite::Database& database);

/// Says where the scales of runs come from as far as can be told afterwards, as basisOf(SceneScale) does, of the rows
/// for which `condition` holds: in projects before schema 12 a scale of the metadata counts as given.
void tellScaleOrigins(SQLite::Database& database, const std::string& condition = "TRUE");

/// Whether all tables and columns of the newest schema are there; what else is there does not matter. Throws
/// MalformedRow naming what is missing, SQLite::Exception.
void checkTables(SQLite::Database& database);

}  // namespace eyrie::schema

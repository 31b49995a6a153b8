#pragma once

namespace SQLite {
class Database;
}

/// The steps by which the tables of a project file grew, in their order (schema.h); each is run once in a file's life
/// and never changed once released. What a step is for is said where it is written.
namespace eyrie::schema {

void addRuns(SQLite::Database& database);
void addLabels(SQLite::Database& database);
void addComparisonsAndCompleteBoxes(SQLite::Database& database);
void addSweeps(SQLite::Database& database);
void addPresets(SQLite::Database& database);
void addDroppedStates(SQLite::Database& database);
void addRemovalOfRuns(SQLite::Database& database);
void addRunStates(SQLite::Database& database);
void addRegistrationFaults(SQLite::Database& database);
void addViews(SQLite::Database& database);
void addReview(SQLite::Database& database);
void addScaleOrigins(SQLite::Database& database);
void addZones(SQLite::Database& database);
void addScaleSlopes(SQLite::Database& database);
void addKeptDetails(SQLite::Database& database);
void addEvidence(SQLite::Database& database);
void addCorrections(SQLite::Database& database);
void addLocalScales(SQLite::Database& database);
void addAssumedRates(SQLite::Database& database);
void addCompactStates(SQLite::Database& database);
void addVideoStarts(SQLite::Database& database);
void addArrows(SQLite::Database& database);
void addDoubtfulIndex(SQLite::Database& database);
void addDecisions(SQLite::Database& database);
void addRejectedProposals(SQLite::Database& database);
void addStartFractions(SQLite::Database& database);
void addSourceDigests(SQLite::Database& database);
void addLight(SQLite::Database& database);
void addElapsedAndZoom(SQLite::Database& database);

}  // namespace eyrie::schema

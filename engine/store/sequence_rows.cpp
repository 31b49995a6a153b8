#include "store/sequence_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <chrono>
#include <ctime>

namespace eyrie {

std::string nowUtc() {
    const std::time_t now = std::chrono::system_clock::to_time_t(std::chrono::system_clock::now());
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return text;
}

int storeSequence(SQLite::Database& database, const SequenceRecord& sequence) {
    SQLite::Statement statement(database,
                                "INSERT INTO sequence (path, width, height, frame_count, frame_rate_hz) "
                                "VALUES (?, ?, ?, ?, ?) ON CONFLICT (path, width, height) DO UPDATE SET "
                                "frame_count = excluded.frame_count, frame_rate_hz = excluded.frame_rate_hz "
                                "RETURNING id");
    statement.bind(1, sequence.path);
    statement.bind(2, sequence.size.width);
    statement.bind(3, sequence.size.height);
    statement.bind(4, sequence.frame_count);
    statement.bind(5, sequence.frame_rate_hz);
    statement.executeStep();
    return statement.getColumn(0).getInt();
}

}  // namespace eyrie

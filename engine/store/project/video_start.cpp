#include "store/project/video_start.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>

#include "core/error.h"
#include "core/time/utc_time.h"
#include "store/database/rows.h"

namespace eyrie {

std::optional<std::int64_t> videoStartOf(ProjectFile& project, int sequence_id, std::optional<std::int64_t> given_us) {
    if (given_us) return given_us;
    return guarded(project.path(), "reading when a video began", [&]() -> std::optional<std::int64_t> {
        SQLite::Statement statement(project.database(), "SELECT start_utc FROM sequence WHERE id = ?");
        statement.bind(1, sequence_id);
        if (!statement.executeStep()) return std::nullopt;
        const std::string text = RowReader(statement).text();
        if (text.empty()) return std::nullopt;
        const auto start_utc_us = utcOf(text);
        if (!start_utc_us) throw MalformedRow{"video " + std::to_string(sequence_id) + " begins at no time"};
        return start_utc_us;
    });
}

void storeVideoStart(ProjectFile& project, int sequence_id, std::optional<std::int64_t> start_utc_us) {
    const std::string text = start_utc_us ? utcText(*start_utc_us) : std::string();
    if (start_utc_us && text.empty()) throw Error(ErrorKind::parameter, "the start of the video is in no calendar");
    project.checkInPlace();
    guarded(project.path(), "storing when a video began", [&] {
        SQLite::Statement statement(project.database(), "UPDATE sequence SET start_utc = ? WHERE id = ?");
        RowWriter(statement).text(text).integer(sequence_id).run();
    });
}

}  // namespace eyrie

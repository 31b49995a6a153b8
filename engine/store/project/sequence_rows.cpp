#include "store/project/sequence_rows.h"

#include <SQLiteCpp/SQLiteCpp.h>

#include <cmath>

#include "store/database/database_error.h"
#include "store/database/rows.h"

namespace eyrie {

int readElapsed(RowReader& row) {
    const int elapsed = row.integer();
    if (elapsed < 1 || elapsed > kLastFrame) throw MalformedRow{"an impossible time since the frame before"};
    return elapsed;
}

double readZoom(RowReader& row) {
    const double zoom = row.real();
    if (!(zoom >= kLeastZoom && zoom <= kMostZoom)) throw MalformedRow{"an impossible zoom"};
    return zoom;
}

FrameIndex readFrameNumber(RowReader& row) {
    const FrameIndex frame = row.integer();
    if (frame < 0 || frame > kLastFrame) throw MalformedRow{"a frame " + std::to_string(frame) + " that no video has"};
    return frame;
}

void checkSequence(const SequenceRecord& sequence) {
    const auto refuse = [&](const char* what) {
        throw MalformedRow{"video " + std::to_string(sequence.id) + " has " + what};
    };
    constexpr int kLargestSide = 1 << 16;
    const cv::Size size = sequence.size;
    if (size.width < 1 || size.height < 1 || size.width > kLargestSide || size.height > kLargestSide)
        refuse("an impossible size");
    if (sequence.frame_count < 0 || sequence.frame_count > kLastFrame + 1) refuse("an impossible number of frames");
    if (!(sequence.frame_rate_hz > 0 && std::isfinite(sequence.frame_rate_hz))) refuse("an impossible frame rate");
}

int storeSequence(SQLite::Database& database, const SequenceRecord& sequence) {
    SQLite::Statement statement(database,
                                "INSERT INTO sequence (path, width, height, frame_count, frame_rate_hz, rate_assumed) "
                                "VALUES (?, ?, ?, ?, ?, ?) ON CONFLICT (path, width, height) DO UPDATE SET "
                                "frame_count = excluded.frame_count, frame_rate_hz = excluded.frame_rate_hz, "
                                "rate_assumed = excluded.rate_assumed "
                                "RETURNING id");
    statement.bind(1, sequence.path);
    statement.bind(2, sequence.size.width);
    statement.bind(3, sequence.size.height);
    statement.bind(4, sequence.frame_count);
    statement.bind(5, sequence.frame_rate_hz);
    statement.bind(6, sequence.rate_assumed ? 1 : 0);
    statement.executeStep();
    return statement.getColumn(0).getInt();
}

}  // namespace eyrie

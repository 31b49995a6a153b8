#include "store/database/rows.h"

#include <limits>

namespace eyrie {

double RowReader::real() {
    const SQLite::Column column = statement_.getColumn(next_++);
    const double value = column.getDouble();  // 0 of nothing; only then it is asked for once more
    return value == 0 && column.isNull() ? std::numeric_limits<double>::quiet_NaN() : value;
}

std::string RowReader::text() {
    constexpr int kLongest = 1 << 16;
    const SQLite::Column column = statement_.getColumn(next_++);
    if (column.getBytes() > kLongest) {
        throw MalformedRow{"a text of " + std::to_string(column.getBytes()) + " characters"};
    }
    return column.getString();
}

OrientedBox RowReader::box() {
    OrientedBox box;
    box.centre = point();
    box.length = real();
    box.width = real();
    box.heading = real();
    return box;
}

TrackState readTrackState(RowReader& row) {
    TrackState state;
    state.id = row.integer();
    state.box = row.box();
    state.velocity = row.point();
    state.status = row.word(stored::kTrackStatuses);
    state.origin = row.word(stored::kStateOrigins);
    state.age = row.integer();
    state.hits = row.integer();
    state.score = row.real();
    return state;
}

}  // namespace eyrie

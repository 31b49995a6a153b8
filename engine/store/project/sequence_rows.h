#pragma once

#include <string>

#include "core/values/last_frame.h"
#include "store/runs/run_store.h"

namespace SQLite {
class Database;
}

namespace eyrie {

/// Zooms of stored frames; beyond them no camera goes.
inline constexpr double kLeastZoom = 1e-2;
inline constexpr double kMostZoom = 1e2;
/// Metres per pixel of a stored run; beyond them a vehicle has no size in whole pixels.
inline constexpr double kFinestGsd = 1e-4;
inline constexpr double kCoarsestGsd = 1e4;
/// The largest factor that an estimate of the scale may be off by.
inline constexpr double kMostUncertain = 1e9;

class RowReader;
/// The next column as the number of a frame. Throws MalformedRow for one that no video has.
FrameIndex readFrameNumber(RowReader& row);
/// Registration::elapsed of a frame. Throws MalformedRow for none.
int readElapsed(RowReader& row);
/// Registration::zoom of a frame. Throws MalformedRow for one that no camera has.
double readZoom(RowReader& row);

/// Throws MalformedRow for a video that cannot be.
void checkSequence(const SequenceRecord& sequence);

/// The row of a video, new or reused; a reused row takes over what is known of the video now. Answers its id. Throws
/// SQLite::Exception.
int storeSequence(SQLite::Database& database, const SequenceRecord& sequence);

}  // namespace eyrie

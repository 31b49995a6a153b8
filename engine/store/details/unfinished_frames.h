#pragma once

#include <SQLiteCpp/Statement.h>

#include <optional>
#include <vector>

#include "core/evidence/classified_box.h"
#include "core/values/frame_result.h"

namespace SQLite {
class Database;
}

namespace eyrie {

/// What finishing a run needs of the frames of which it keeps no details: motion vectors, and what the classifier says.
/// There until the run is finished. The caller owns the transaction; `database` must outlive it.
class UnfinishedFrames {
 public:
    explicit UnfinishedFrames(SQLite::Database& database);
    void insert(int run_id, const FrameResult& result);

    /// Nothing where the run has no such frame here.
    static std::optional<std::vector<MotionVector>> vectors(SQLite::Database& database, int run_id, FrameIndex frame);
    static std::optional<std::vector<ClassifiedBox>> classified(SQLite::Database& database, int run_id,
                                                                FrameIndex frame);

 private:
    SQLite::Statement insert_;
};

}  // namespace eyrie

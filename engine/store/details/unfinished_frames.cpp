#include "store/details/unfinished_frames.h"

#include "core/evidence/classified_box.h"
#include "store/database/rows.h"
#include "store/details/squeezed_bytes.h"

namespace eyrie {
namespace {

template <class Unsqueeze>
auto readSqueezed(SQLite::Database& database, const std::string& column, int run_id, FrameIndex frame,
                  Unsqueeze&& unsqueeze) -> decltype(unsqueeze(ByteView())) {
    SQLite::Statement statement(database, "SELECT " + column + " FROM unfinished_frame WHERE run_id = ? AND frame = ?");
    statement.bind(1, run_id);
    statement.bind(2, frame);
    if (!statement.executeStep()) return std::nullopt;
    return RowReader::unpacked(unsqueeze(RowReader(statement).bytes()), "rows of an unfinished frame");
}

}  // namespace

UnfinishedFrames::UnfinishedFrames(SQLite::Database& database)
    : insert_(database, "INSERT INTO unfinished_frame (run_id, frame, vectors, vehicles) VALUES (?, ?, ?, ?)") {}

void UnfinishedFrames::insert(int run_id, const FrameResult& result) {
    const Bytes vectors = squeezeMotionVectors(result.motion.motion_vectors);
    const Bytes vehicles = squeezeBoxes(classifiedOf(result.detections));
    RowWriter(insert_).integer(run_id).integer(result.motion.frame).bytes(vectors).bytes(vehicles).run();
}

std::optional<std::vector<MotionVector>> UnfinishedFrames::vectors(SQLite::Database& database, int run_id,
                                                                   FrameIndex frame) {
    return readSqueezed(database, "vectors", run_id, frame, unsqueezeMotionVectors);
}

std::optional<std::vector<ClassifiedBox>> UnfinishedFrames::classified(SQLite::Database& database, int run_id,
                                                                       FrameIndex frame) {
    return readSqueezed(database, "vehicles", run_id, frame, unsqueezeBoxes);
}

}  // namespace eyrie

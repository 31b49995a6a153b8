#include <SQLiteCpp/SQLiteCpp.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "fuzz/input_file.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "store/runs/sweep_store.h"

/// project_fuzz --project=FILE: bytes as changes of that project, each of six: place (3 bytes, little-endian), how many
/// bytes from there (1), and what they become (2); then all of it is read. Of the project only the first frames are
/// kept, in small pages: an input is tried the quicker, and more of what it changes says something.
namespace {

constexpr int kFramesKept = 2;

std::string bytesOf(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::vector<std::string> tablesByFrame(SQLite::Database& database) {
    SQLite::Statement tables(database,
                             "SELECT t.name FROM sqlite_schema AS t JOIN pragma_table_info(t.name) AS c "
                             "WHERE t.type = 'table' AND c.name = 'frame'");
    std::vector<std::string> names;
    while (tables.executeStep()) names.push_back(tables.getColumn(0).getString());
    return names;
}

/// The project without most of its frames, in as few bytes as it takes, and without a log.
void shrink(const std::filesystem::path& path) {
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE);
    for (const std::string& table : tablesByFrame(database))
        database.exec("DELETE FROM \"" + table + "\" WHERE frame >= " + std::to_string(kFramesKept));
    database.exec("PRAGMA journal_mode = DELETE");
    database.exec("PRAGMA page_size = 512");
    database.exec("VACUUM");
}

struct Reader {
    eyrie::fuzz::MemoryFolder folder;
    std::filesystem::path file = folder / "fuzzed.eyrie";
    std::string whole;

    static Reader& only() {
        static Reader reader;
        return reader;
    }
};

void readEverything(const std::filesystem::path& path) {
    eyrie::ProjectFile project = eyrie::ProjectFile::open(path, eyrie::ProjectFile::Mode::read_only);
    const eyrie::RunStore store(project);
    for (const eyrie::RunRecord& run : store.runs()) {
        store.parameters(run.id);
        for (const eyrie::FrameSummary& summary : store.frameSummaries(run.id))
            store.frameResult(run.id, summary.frame);
        for (const eyrie::TrackSummary& track : store.tracks(run.id)) store.trackStates(run.id, track.id);
        store.trackBoxes(run.id);
        store.detectionBoxes(run.id);
    }
    eyrie::SweepStore(project).sweeps();
    eyrie::AnnotationStore(project, 1).annotations();
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    Reader& reader = Reader::only();
    const std::string given = bytesOf(eyrie::fuzz::option(*argc, *argv, "project", ""));
    if (given.empty()) {
        std::fputs("project_fuzz: --project=FILE names no project\n", stderr);
        std::exit(2);
    }
    eyrie::fuzz::writeBytes(reader.file, given.data(), given.size());
    shrink(reader.file);
    readEverything(reader.file);
    reader.whole = bytesOf(reader.file);
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const Reader& reader = Reader::only();
    std::string bytes = reader.whole;
    for (; size >= 6; data += 6, size -= 6) {
        const std::size_t at = (data[0] | data[1] << 8 | data[2] << 16) % bytes.size();
        const std::size_t count = std::min<std::size_t>(1 + data[3], bytes.size() - at);
        for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(data[4] + i * data[5]);
    }
    for (const char* ending : {"-wal", "-shm", "-journal"}) std::filesystem::remove(reader.file.string() + ending);
    eyrie::fuzz::writeBytes(reader.file, bytes.data(), bytes.size());
    eyrie::fuzz::expectAnswer([&] { readEverything(reader.file); });
    return 0;
}

#include <SQLiteCpp/SQLiteCpp.h>

#include <algorithm>
#include <fstream>
#include <functional>
#include <iterator>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "fuzz/input_file.h"
#include "fuzz/memory_database.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "store/sweeps/sweep_store.h"

/// project_fuzz --project=FILE: bytes as changes of that project, each of six: place (3 bytes, little-endian), how many
/// bytes from there (1), and what they become (2); then all of it is read. Of the project only the first frames are
/// kept, in small pages: an input is tried the quicker, and more of what it changes says something. The project is
/// opened again only where the changes touch what is read for that.
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

using Read = std::function<void(eyrie::ProjectFile&)>;

/// What is read of a project. `list`: whatever tells what else there is.
void readRun(int run, const std::function<void(const Read&)>& list, const std::function<void(const Read&)>& leaf) {
    std::vector<eyrie::FrameSummary> frames;
    std::vector<eyrie::TrackSummary> tracks;
    list([&](eyrie::ProjectFile& file) { frames = eyrie::RunStore(file).frameSummaries(run); });
    list([&](eyrie::ProjectFile& file) { tracks = eyrie::RunStore(file).tracks(run); });
    leaf([run](eyrie::ProjectFile& file) { eyrie::RunStore(file).parameters(run); });
    for (const eyrie::FrameSummary& summary : frames)
        leaf([run, frame = summary.frame](eyrie::ProjectFile& file) { eyrie::RunStore(file).frameResult(run, frame); });
    for (const eyrie::TrackSummary& track : tracks)
        leaf([run, id = track.id](eyrie::ProjectFile& file) { eyrie::RunStore(file).trackStates(run, id); });
    leaf([run](eyrie::ProjectFile& file) { eyrie::RunStore(file).trackBoxes(run); });
    leaf([run](eyrie::ProjectFile& file) { eyrie::RunStore(file).detectionBoxes(run); });
}

void readProject(const std::function<void(const Read&)>& list, const std::function<void(const Read&)>& leaf) {
    std::vector<int> runs;
    list([&](eyrie::ProjectFile& file) {
        for (const eyrie::RunRecord& run : eyrie::RunStore(file).runs()) runs.push_back(run.id);
    });
    for (const int run : runs) readRun(run, list, leaf);
    leaf([](eyrie::ProjectFile& file) { eyrie::SweepStore(file).sweeps(); });
    leaf([](eyrie::ProjectFile& file) { eyrie::AnnotationStore(file, 1).annotations(); });
}

void readEverything(eyrie::ProjectFile& project) {
    const auto atOnce = [&](const Read& read) { read(project); };
    readProject(atOnce, atOnce);
}

using Pages = std::vector<bool>;

/// A reading with the pages of the whole project that it looks at: while those are as they were, so is its answer.
struct Reading {
    Read read;
    Pages pages;
};

struct Reader {
    eyrie::fuzz::MemoryFolder folder;
    std::filesystem::path file = folder / "fuzzed.eyrie";
    std::string whole;
    std::unique_ptr<eyrie::fuzz::MemoryDatabase> memory;
    std::optional<eyrie::ProjectFile> open;  ///< the whole one
    Pages opening;                           ///< that are looked at while it is opened
    Pages lists;                             ///< and by what tells what else there is
    std::vector<Reading> leaves;

    static Reader& only() {
        static Reader reader;
        return reader;
    }
    eyrie::ProjectFile opened() const { return eyrie::ProjectFile::open(file, eyrie::ProjectFile::Mode::read_only); }
    /// The pages that `work` looks at.
    template <class Work>
    Pages pagesOf(const Work& work) {
        memory->tellOfChange();
        memory->pages_read.clear();
        memory->notes_pages = true;
        work();
        memory->notes_pages = false;
        Pages pages(memory->pageOf(whole.size() - 1) + 1);
        for (const std::size_t page : memory->pages_read) pages.at(page) = true;
        return pages;
    }
    /// Of a good project.
    void learn() {
        opening = pagesOf([&] { open = opened(); });
        lists.resize(opening.size());
        readProject(
            [&](const Read& read) {
                const Pages pages = pagesOf([&] { read(*open); });
                for (std::size_t page = 1; page < pages.size(); ++page) lists[page] = lists[page] || pages[page];
            },
            [&](const Read& read) {
                Pages pages = pagesOf([&] { read(*open); });
                leaves.push_back({read, std::move(pages)});
            });
    }
};

/// The places that an input changes.
struct Change {
    std::size_t at = 0;
    std::size_t count = 0;
};

std::vector<Change> changeBytes(std::string& bytes, const std::uint8_t* data, std::size_t size) {
    std::vector<Change> changes;
    for (; size >= 6; data += 6, size -= 6) {
        const std::size_t at = (data[0] | data[1] << 8 | data[2] << 16) % bytes.size();
        const std::size_t count = std::min<std::size_t>(1 + data[3], bytes.size() - at);
        for (std::size_t i = 0; i < count; ++i) bytes[at + i] = static_cast<char>(data[4] + i * data[5]);
        changes.push_back({at, count});
    }
    return changes;
}

/// What SQLite keeps in files beside a database with a log, memory has not.
bool asksForLog(const std::string& bytes) {
    return bytes[18] == 2 || bytes[19] == 2;
}

void readFromDisk(const Reader& reader) {
    for (const char* ending : {"-wal", "-shm", "-journal"}) std::filesystem::remove(reader.file.string() + ending);
    eyrie::fuzz::writeBytes(reader.file, reader.memory->bytes.data(), reader.memory->bytes.size());
    reader.memory->stands_in = false;
    eyrie::fuzz::expectAnswer([&] {
        eyrie::ProjectFile project = reader.opened();
        readEverything(project);
    });
    reader.memory->stands_in = true;
    eyrie::fuzz::writeBytes(reader.file, reader.whole.data(), reader.whole.size());
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    sqlite3_config(SQLITE_CONFIG_SINGLETHREAD);
    sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
    Reader& reader = Reader::only();
    const std::string given = bytesOf(eyrie::fuzz::option(*argc, *argv, "project", ""));
    if (given.empty()) {
        std::fputs("project_fuzz: --project=FILE names no project\n", stderr);
        std::exit(2);
    }
    eyrie::fuzz::writeBytes(reader.file, given.data(), given.size());
    shrink(reader.file);
    reader.whole = bytesOf(reader.file);
    reader.memory = std::make_unique<eyrie::fuzz::MemoryDatabase>(reader.file, reader.whole);
    reader.learn();
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Reader& reader = Reader::only();
    eyrie::fuzz::MemoryDatabase& memory = *reader.memory;
    const std::vector<Change> changes = changeBytes(memory.bytes, data, size);
    const auto touch = [&](const Pages& pages) {
        return std::any_of(changes.begin(), changes.end(), [&](const Change& change) {
            const std::size_t last = memory.pageOf(change.at + change.count - 1);
            for (std::size_t page = memory.pageOf(change.at); page <= last; ++page)
                if (pages[page]) return true;
            return false;
        });
    };
    if (asksForLog(memory.bytes)) {
        readFromDisk(reader);
    } else if (touch(reader.opening)) {
        eyrie::fuzz::expectAnswer([&] {
            eyrie::ProjectFile project = reader.opened();
            readEverything(project);
        });
    } else {
        memory.tellOfChange();
        if (touch(reader.lists)) {
            eyrie::fuzz::expectAnswer([&] { readEverything(*reader.open); });
        } else {
            for (const Reading& leaf : reader.leaves) {
                if (touch(leaf.pages)) eyrie::fuzz::expectAnswer([&] { leaf.read(*reader.open); });
            }
        }
    }
    for (const Change& change : changes)
        memory.bytes.replace(change.at, change.count, reader.whole, change.at, change.count);
    return 0;
}

#include "store/health/damaged_copy.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <sqlite3.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "store/health/raw_file.h"
#include "store/project/project_file.h"
#include "store/project/schema.h"

namespace eyrie {
namespace {

using Path = std::filesystem::path;

constexpr std::size_t kBlock = 1 << 20;
constexpr std::uint32_t kOurPageSize = 8192;

using Header = std::array<unsigned char, 100>;

std::uint32_t get(const Header& header, std::size_t at, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value = value << 8 | header[at + static_cast<std::size_t>(i)];
    return value;
}

void put(Header& header, std::size_t at, int bytes, std::uint32_t value) {
    for (int i = bytes - 1; i >= 0; --i, value >>= 8) {
        header[at + static_cast<std::size_t>(i)] = static_cast<unsigned char>(value & 255);
    }
}

bool isPageSize(std::uint32_t size) {
    return size >= 512 && size <= 32768 && (size & (size - 1)) == 0;
}

[[noreturn]] void refuseToWrite(const Path& copy) {
    throw Error(ErrorKind::output, copy.string() + " cannot be written; check the folder and its free space");
}

/// Copies the bytes; false when stopped.
bool copyBytes(const Path& project, const Path& copy, const CopyWatch& watch) {
    const auto source = RawFile::open(project);
    if (!source) {
        throw Error(ErrorKind::project, "the project " + project.string() + " cannot be read; check its permissions");
    }
    std::ofstream target(copy, std::ios::binary);
    std::vector<unsigned char> block(kBlock);
    for (std::uint64_t at = 0; at < source->size(); at += kBlock) {
        if (watch.stop.stop_requested()) return false;
        block.resize(static_cast<std::size_t>(std::min<std::uint64_t>(kBlock, source->size() - at)));
        // What the disk refuses to give stays zero: the rest may be whole.
        if (!source->read(at, block)) std::fill(block.begin(), block.end(), 0);
        target.write(reinterpret_cast<const char*>(block.data()), static_cast<std::streamsize>(block.size()));
    }
    target.close();
    if (!target) refuseToWrite(copy);
    return true;
}

/// How many of the first pages begin as pages of a tree do, were they of this size.
int plausiblePages(std::ifstream& file, std::uint64_t file_size, std::uint32_t page_size) {
    constexpr std::uint64_t kPages = 200;
    int plausible = 0;
    for (std::uint64_t page = 1; page < kPages && (page + 1) * page_size <= file_size; ++page) {
        file.seekg(static_cast<std::streamoff>(page * page_size));
        const int type = file.get();
        plausible += type == 2 || type == 5 || type == 10 || type == 13 ? 1 : 0;
    }
    return plausible;
}

std::uint32_t likelyPageSize(const Path& copy) {
    std::ifstream file(copy, std::ios::binary);
    const std::uint64_t size = std::filesystem::file_size(copy);
    std::uint32_t best = kOurPageSize;
    int most = plausiblePages(file, size, best);
    for (std::uint32_t page_size = kOurPageSize / 2; page_size >= 1024; page_size /= 2) {
        const int plausible = plausiblePages(file, size, page_size);
        // Smaller pages find those of larger ones, too, and much besides; each size is held against twice its own.
        if (plausible > 2 * most) {
            best = page_size;
            most = plausible;
        }
    }
    return best;
}

/// Makes the header one with which SQLite opens the file; answers whether it had to.
bool mendHeader(const Path& copy, bool with_log) {
    std::fstream file(copy, std::ios::binary | std::ios::in | std::ios::out);
    Header header{};
    file.read(reinterpret_cast<char*>(header.data()), header.size());
    file.clear();
    const std::uint64_t size = std::filesystem::file_size(copy);
    const bool sound = std::memcmp(header.data(), kSqliteMagic, sizeof kSqliteMagic) == 0 &&
                       isPageSize(get(header, 16, 2)) && header[18] <= 2 && header[19] <= 2 && header[18] > 0 &&
                       header[19] > 0 && header[20] == 0 && get(header, 21, 3) == 0x402020 && get(header, 44, 4) == 4 &&
                       get(header, 56, 4) == 1;
    if (!sound) {
        const std::uint32_t page_size = isPageSize(get(header, 16, 2)) ? get(header, 16, 2) : likelyPageSize(copy);
        header.fill(0);
        std::memcpy(header.data(), kSqliteMagic, sizeof kSqliteMagic);
        put(header, 16, 2, page_size);
        header[18] = header[19] = with_log ? 2 : 1;
        put(header, 21, 3, 0x402020);  // fractions of a page, which are fixed
        put(header, 44, 4, 4);         // format of the list of tables
        put(header, 56, 4, 1);         // UTF-8
        put(header, 60, 4, static_cast<std::uint32_t>(schema::currentNumber()));
        put(header, 68, 4, static_cast<std::uint32_t>(schema::kApplicationId));
    }
    // The number of pages, and no free ones.
    put(header, 28, 4, static_cast<std::uint32_t>(size / get(header, 16, 2)));
    put(header, 32, 4, 0);
    put(header, 36, 4, 0);
    // Nor maps of who points to a page: reading does without them, and they may be damaged, too.
    put(header, 52, 4, 0);
    put(header, 64, 4, 0);
    put(header, 92, 4, get(header, 24, 4));
    file.seekp(0);
    file.write(reinterpret_cast<const char*>(header.data()), header.size());
    file.close();
    if (!file) refuseToWrite(copy);
    return !sound;
}

/// Whether the list of tables can be read and names those without which nothing can be found.
bool hasTables(const Path& copy) {
    try {
        SQLite::Database database(copy.string(), SQLite::OPEN_READWRITE);
        database.exec("PRAGMA writable_schema = ON");
        database.exec("PRAGMA trusted_schema = OFF");
        return database
                   .execAndGet(
                       "SELECT count(*) FROM sqlite_schema WHERE type = 'table' AND name IN ('run', 'frame', "
                       "'sequence', 'track_state', 'detection')")
                   .getInt() == 5;
    } catch (const SQLite::Exception&) {
        return false;
    }
}

/// Puts the list of tables of a project that this version makes in place of what is there.
void replaceTables(const Path& copy, const Path& folder) {
    const Path sample = folder / "sample.eyrie";
    std::vector<std::uint32_t> pages;
    {
        ProjectFile project = ProjectFile::create(sample);
        project.database().exec("PRAGMA journal_mode = DELETE");
        SQLite::Statement statement(project.database(), "SELECT pageno FROM dbstat WHERE name = 'sqlite_schema'");
        while (statement.executeStep()) pages.push_back(statement.getColumn(0).getUInt());
    }
    std::ifstream from(sample, std::ios::binary);
    std::fstream to(copy, std::ios::binary | std::ios::in | std::ios::out);
    std::vector<char> bytes(kOurPageSize);
    for (const std::uint32_t page : pages) {
        const auto at = static_cast<std::streamoff>((page - 1) * kOurPageSize);
        from.seekg(at);
        from.read(bytes.data(), kOurPageSize);
        to.seekp(at);
        to.write(bytes.data(), kOurPageSize);
    }
    to.close();
    if (!to || !from) refuseToWrite(copy);
    mendHeader(copy, false);
}

bool isSound(const Path& copy) {
    try {
        SQLite::Database database(copy.string(), SQLite::OPEN_READWRITE);
        return database.tableExists("run") && database.execAndGet("PRAGMA quick_check(1)").getString() == "ok";
    } catch (const SQLite::Exception&) {
        return false;
    }
}

/// Takes over the file that belongs to the project's log or broken-off change; false when there is none.
bool copyCompanion(const Path& project, const Path& copy, const std::string& ending) {
    std::error_code failed;
    const auto overwrite = std::filesystem::copy_options::overwrite_existing;
    return std::filesystem::copy_file(project.string() + ending, copy.string() + ending, overwrite, failed);
}

}  // namespace

DamagedCopy copyDamaged(const Path& project, const Path& folder, const CopyWatch& watch) {
    DamagedCopy result{folder / "copy.eyrie", {}, false};
    const Path& copy = result.path;
    const auto stopped = [&] {
        result.stopped = true;
        return result;
    };
    if (!copyBytes(project, copy, watch)) return stopped();
    const bool has_log = copyCompanion(project, copy, "-wal") && std::filesystem::file_size(copy.string() + "-wal") > 0;
    copyCompanion(project, copy, "-journal");
    if (isSound(copy)) return result;

    if (has_log) {
        // Looking at the copy may have moved the log into it.
        removeDatabase(copy);
        if (!copyBytes(project, copy, watch)) return stopped();
        if (isSound(copy)) {
            result.notes.emplace_back(
                "the log beside the project contradicts it and was left out, with the newest changes if they were of "
                "this project");
            return result;
        }
        removeDatabase(copy);
        if (!copyBytes(project, copy, watch)) return stopped();
        copyCompanion(project, copy, "-wal");
    }
    if (mendHeader(copy, has_log))
        result.notes.emplace_back("the beginning of the file (header) was damaged and was rebuilt");
    if (!hasTables(copy)) {
        removeDatabase(copy.string() + "-wal");
        replaceTables(copy, folder);
        result.notes.emplace_back(
            "the list of tables was lost; the file was taken for one that this version of Eyrie made");
    }
    return result;
}

}  // namespace eyrie

#include "io/video/parts/part_list.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "core/time/utc_time.h"
#include "io/atomic_file.h"
#include "io/file_digest.h"
#include "io/folder.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kLongestStem = 100;  ///< bytes of each of two names in one
constexpr std::size_t kDigestDigits = 64;
constexpr int kMostLists = 1000;  ///< of one name in one folder

std::uintmax_t bytesIn(const CsvReader& rows) {
    const std::string text = rows.text("bytes");
    std::uintmax_t bytes = 0;
    const char* end = text.data() + text.size();
    const auto [stop, failed] = std::from_chars(text.data(), end, bytes);
    if (!text.empty() && (failed != std::errc() || stop != end)) rows.refuse("bytes", "the size of the file in bytes");
    return bytes;
}

ListedPart partIn(const CsvReader& rows, const fs::path& folder) {
    ListedPart part;
    const std::string file = rows.text("file");
    if (file.empty()) rows.refuse("file", "the name of a video file");
    part.file = (folder / file).lexically_normal();
    if (const std::string start = rows.text("start_utc"); !start.empty()) {
        part.start_utc_us = utcOf(start);
        if (!part.start_utc_us) rows.refuse("start_utc", "a time in UTC, e.g. 2026-11-21T08:00:00Z");
    }
    part.frames = rows.whole("frames", 0);
    if (part.frames < 0) rows.refuse("frames", "a number of frames");
    part.bytes = bytesIn(rows);
    part.digest = rows.text("digest");
    const bool digits =
        std::all_of(part.digest.begin(), part.digest.end(), [](unsigned char c) { return std::isxdigit(c) != 0; });
    if (!part.digest.empty() && (!digits || part.digest.size() != kDigestDigits))
        rows.refuse("digest", std::to_string(kDigestDigits) + " hexadecimal digits");
    return part;
}

/// As a list in `folder` names it.
std::string nameIn(const fs::path& folder, const fs::path& file) {
    const fs::path relative = file.lexically_relative(folder);
    const bool below = !relative.empty() && *relative.begin() != "..";
    std::string name = (below ? relative : file).string();
    if (name.find_first_of("\r\n") != std::string::npos || trimmed(name) != name)
        throw Error(ErrorKind::input, file.string() +
                                          ": its name begins or ends with a blank or holds a line break, so that no "
                                          "list can name it; rename it");
    return name;
}

bool isSame(const ListedPart& a, const ListedPart& b) {
    return a.file == b.file && a.frames == b.frames && a.bytes == b.bytes && a.digest == b.digest;
}

bool holds(const fs::path& list, const std::vector<ListedPart>& parts) {
    if (!isFile(list)) return false;
    try {
        const std::vector<ListedPart> there = readPartList(list);
        return std::equal(there.begin(), there.end(), parts.begin(), parts.end(), isSame);
    } catch (const Error&) {
        return false;  // something else, or a list that a person is writing
    }
}

std::string shortStem(const fs::path& file) {
    std::string stem = file.stem().string();
    if (stem.size() <= kLongestStem) return stem;
    std::size_t end = kLongestStem;
    while (end > 0 && (static_cast<unsigned char>(stem[end]) & 0xC0U) == 0x80U) --end;  // amid a letter of UTF-8
    return stem.substr(0, end);
}

}  // namespace

bool hasPartListName(const fs::path& path) {
    return hasEnding(path, kPartListEnding);
}

std::vector<ListedPart> readPartList(const fs::path& list) {
    const fs::path folder = fs::absolute(list).lexically_normal().parent_path();
    CsvReader rows(list, {"file"});
    std::vector<ListedPart> parts;
    while (rows.next()) {
        ListedPart part = partIn(rows, folder);
        const bool known =
            std::any_of(parts.begin(), parts.end(), [&](const ListedPart& before) { return before.file == part.file; });
        if (known) rows.refuse("file", "each part once");
        parts.push_back(std::move(part));
    }
    if (parts.empty()) throw Error(ErrorKind::input, list.string() + ": names no part; add a line for each video file");
    for (ListedPart& part : parts) {
        std::error_code unknown;
        const fs::path beside = folder / part.file.filename();
        if (!fs::exists(part.file, unknown) && isFile(beside)) part.file = beside;
    }
    return parts;
}

void writePartList(const fs::path& list, const std::vector<ListedPart>& parts) {
    const fs::path folder = fs::absolute(list).lexically_normal().parent_path();
    std::string text = "file,start_utc,frames,bytes,digest\n";
    for (const ListedPart& part : parts) {
        const auto number = [](std::uintmax_t value) { return value > 0 ? std::to_string(value) : std::string(); };
        text += csvField(nameIn(folder, part.file)) + ',' + (part.start_utc_us ? utcText(*part.start_utc_us) : "") +
                ',' + number(static_cast<std::uintmax_t>(part.frames)) + ',' + number(part.bytes) + ',' + part.digest +
                '\n';
    }
    writeFileAtomically(list, text);
}

fs::path keepPartList(const fs::path& wish, const std::vector<ListedPart>& parts) {
    const fs::path wished = fs::absolute(wish).lexically_normal();
    for (int number = 1; number <= kMostLists; ++number) {
        fs::path list = wished;
        if (number > 1) list.replace_filename(wished.stem().string() + "-" + std::to_string(number) + kPartListEnding);
        if (holds(list, parts)) return list;
        std::error_code unknown;
        if (fs::exists(fs::symlink_status(list, unknown))) continue;
        writePartList(list, parts);
        return list;
    }
    throw Error(ErrorKind::output, wished.string() + ": there are too many lists of this name; remove some");
}

std::string partListName(const std::vector<fs::path>& files) {
    const std::string first = shortStem(files.front());
    const std::string last = shortStem(files.back());
    return (first == last ? first : first + "-" + last) + kPartListEnding;
}

std::vector<ListedPart> relocatedParts(std::vector<ListedPart> parts, const std::vector<fs::path>& chosen) {
    for (ListedPart& part : parts) {
        if (isFile(part.file)) continue;
        const fs::path name = part.file.filename();
        const auto named =
            std::find_if(chosen.begin(), chosen.end(), [&](const fs::path& file) { return file.filename() == name; });
        if (named != chosen.end()) {
            part.file = fs::absolute(*named).lexically_normal();
            continue;
        }
        for (const fs::path& file : chosen) {
            const fs::path beside = fs::absolute(file).lexically_normal().parent_path() / name;
            if (isFile(beside)) part.file = beside;
        }
    }
    return parts;
}

void checkPart(const fs::path& list, const std::vector<ListedPart>& parts, std::size_t number) {
    const ListedPart& part = parts[number];
    const std::string which = list.string() + ": part " + std::to_string(number + 1) + " of " +
                              std::to_string(parts.size()) + ", " + part.file.string() + ", ";
    std::error_code unknown;
    if (!fs::exists(part.file, unknown))
        throw Error(
            ErrorKind::input,
            which + "is not there" +
                (unknown && unknown != std::errc::no_such_file_or_directory ? " (" + unknown.message() + ")" : "") +
                "; put it back or beside the list, write its place into the list, or locate "
                "it in the window");
    checkReadableFile(part.file);
    const std::uintmax_t bytes = fs::file_size(part.file);
    if (part.bytes > 0 && bytes != part.bytes)
        throw Error(ErrorKind::input, which + "has changed since the list was made: it has " + std::to_string(bytes) +
                                          " bytes, then " + std::to_string(part.bytes) +
                                          "; put the old file back, or open the files anew as another video");
    if (!part.digest.empty() && edgeDigestOf(part.file) != part.digest)
        throw Error(ErrorKind::input, which +
                                          "is another file than when the list was made, as long as that; put the old "
                                          "file back, or open the files anew as another video");
}

}  // namespace eyrie

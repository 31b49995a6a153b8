#include "io/file_kind.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "core/project_name.h"

namespace eyrie {
namespace {

constexpr std::size_t kLookedAt = 1024;
constexpr std::size_t kTransportPacket = 188;  ///< bytes between the sync marks of an MPEG transport stream

constexpr std::array kVideoExtensions = {".mp4", ".m4v",  ".mov", ".avi",  ".mkv",  ".webm",  ".ts",  ".mts", ".m2ts",
                                         ".mpg", ".mpeg", ".vob", ".wmv",  ".flv",  ".3gp",   ".ogv", ".mxf", ".h264",
                                         ".264", ".h265", ".265", ".hevc", ".mjpg", ".mjpeg", ".nut", ".y4m"};

std::string lowered(std::string text) {
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

bool has(std::string_view bytes, std::size_t at, std::string_view mark) {
    return bytes.size() >= at + mark.size() && bytes.substr(at, mark.size()) == mark;
}

bool isVideo(std::string_view bytes) {
    using namespace std::string_view_literals;
    const bool transport =
        has(bytes, 0, "G") && has(bytes, kTransportPacket, "G") && has(bytes, 2 * kTransportPacket, "G");
    return transport || has(bytes, 4, "ftyp") || has(bytes, 4, "moov") || has(bytes, 4, "mdat") ||
           has(bytes, 0, "\x1A\x45\xDF\xA3") || (has(bytes, 0, "RIFF") && has(bytes, 8, "AVI ")) ||
           has(bytes, 0, "\0\0\x01\xBA"sv) || has(bytes, 0, "\0\0\x01\xB3"sv) || has(bytes, 0, "\0\0\0\x01"sv) ||
           has(bytes, 0, "OggS") || has(bytes, 0, "FLV\x01") || has(bytes, 0, "\x30\x26\xB2\x75") ||
           has(bytes, 0, "YUV4MPEG2 ") || has(bytes, 0, "#EXTM3U") || has(bytes, 0, "ffconcat version");
}

bool isImage(std::string_view bytes) {
    using namespace std::string_view_literals;
    const bool netpbm = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '7' &&
                        std::isspace(static_cast<unsigned char>(bytes[2])) != 0;
    return netpbm || has(bytes, 0, "\x89PNG") || has(bytes, 0, "\xFF\xD8\xFF") || has(bytes, 0, "II*\0"sv) ||
           has(bytes, 0, "MM\0*"sv) || has(bytes, 0, "GIF8") || (has(bytes, 0, "RIFF") && has(bytes, 8, "WEBP")) ||
           (has(bytes, 0, "BM") && has(bytes, 6, "\0\0\0\0"sv));
}

bool isText(std::string_view bytes) {
    return std::none_of(bytes.begin(), bytes.end(), [](char c) {
        const auto code = static_cast<unsigned char>(c);
        return code < 0x20 && c != '\n' && c != '\r' && c != '\t' && c != '\f';
    });
}

FileKind kindOfText(std::string_view bytes) {
    if (has(bytes, 0, "\xEF\xBB\xBF")) bytes.remove_prefix(3);
    if (has(bytes, 0, "#!")) return FileKind::other;
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos) return FileKind::text;
    bytes.remove_prefix(first);
    if (bytes[0] == '{') return FileKind::json;
    if (bytes[0] == '[') {
        // "[Sequence]" begins a table of settings, "[1" or "[{" JSON.
        const bool word = bytes.size() > 1 && std::isalpha(static_cast<unsigned char>(bytes[1])) != 0;
        return word ? FileKind::text : FileKind::json;
    }
    if (bytes[0] != '<') return FileKind::text;
    const std::string beginning = lowered(std::string(bytes.substr(0, 14)));
    return beginning == "<!doctype html" || beginning.starts_with("<html") ? FileKind::html : FileKind::xml;
}

}  // namespace

const char* nameOf(FileKind kind) {
    switch (kind) {
        case FileKind::empty:
            return "an empty file";
        case FileKind::project:
            return "a project or database";
        case FileKind::video:
            return "a video";
        case FileKind::image:
            return "a picture";
        case FileKind::model:
            return "a trained classifier";
        case FileKind::pdf:
            return "a PDF document";
        case FileKind::html:
            return "a web page";
        case FileKind::xml:
            return "an XML file";
        case FileKind::json:
            return "a JSON file";
        case FileKind::text:
            return "a table or text";
        case FileKind::other:
            break;
    }
    return "a file of another program";
}

FileKind kindOfFile(const std::filesystem::path& path) {
    if (hasProjectName(path)) return FileKind::project;
    std::ifstream file(path, std::ios::binary);
    if (!file) return FileKind::other;
    std::string bytes(kLookedAt, '\0');
    file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    bytes.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
    if (bytes.empty()) return FileKind::empty;
    if (has(bytes, 0, "SQLite format 3")) return FileKind::project;
    if (has(bytes, 0, "EYRIEMDL")) return FileKind::model;
    if (has(bytes, 0, "%PDF-")) return FileKind::pdf;
    if (isImage(bytes)) return FileKind::image;
    if (isVideo(bytes)) return FileKind::video;
    if (isText(bytes)) return kindOfText(bytes);
    return hasVideoName(path) ? FileKind::video : FileKind::other;
}

bool hasVideoName(const std::filesystem::path& path) {
    const std::string extension = lowered(path.extension().string());
    return std::find(kVideoExtensions.begin(), kVideoExtensions.end(), extension) != kVideoExtensions.end();
}

std::string videoFilePatterns() {
    std::string text;
    for (const char* extension : kVideoExtensions) text += std::string(text.empty() ? "*" : " *") + extension;
    return text;
}

}  // namespace eyrie

#include "formats/json_xml/json_place.h"

#include <algorithm>

#include "io/atomic_file.h"

namespace eyrie {
namespace {

constexpr int kDeepest = 32;  ///< nesting; labels need about six

/// How deep brackets nest outside of texts.
int depthOf(const std::string& bytes) {
    int depth = 0, deepest = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const char c = bytes[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

/// NaN, Infinity and -Infinity outside of texts become null.
std::string withoutNonNumbers(std::string bytes) {
    if (bytes.find("NaN") == std::string::npos && bytes.find("Infinity") == std::string::npos) return bytes;
    std::string clean;
    clean.reserve(bytes.size());
    bool in_text = false;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        if (in_text) {
            clean += bytes[i];
            if (bytes[i] == '\\' && i + 1 < bytes.size())
                clean += bytes[++i];
            else if (bytes[i] == '"')
                in_text = false;
            continue;
        }
        bool replaced = false;
        for (const std::string_view word : {"NaN", "-Infinity", "Infinity"}) {
            if (bytes.compare(i, word.size(), word) != 0) continue;
            clean += "null";
            i += word.size() - 1;
            replaced = true;
            break;
        }
        if (replaced) continue;
        in_text = bytes[i] == '"';
        clean += bytes[i];
    }
    return clean;
}

}  // namespace

nlohmann::json readLabelJson(const std::filesystem::path& path) {
    const std::string bytes = withoutNonNumbers(readWholeFile(path));
    if (depthOf(bytes) > kDeepest) {
        throw Error(ErrorKind::input, path.string() + ": is nested deeper than labels ever are");
    }
    try {
        return nlohmann::json::parse(bytes);
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorKind::input, path.string() + ": is not valid JSON: " + error.what());
    }
}

}  // namespace eyrie

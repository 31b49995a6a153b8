#include "formats/text_fields.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"

namespace eyrie {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

}  // namespace

TextLine::TextLine(const std::filesystem::path& file, int line, const std::string& text) : file_(file), line_(line) {
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        std::size_t first = begin;
        std::size_t last = end;
        while (first < last && isBlank(text[first])) ++first;
        while (last > first && isBlank(text[last - 1])) --last;
        fields_.push_back({text.substr(first, last - first), first + 1});
        if (end == text.size()) return;
        begin = end + 1;
    }
}

double TextLine::number(std::size_t field, const char* name) const {
    if (field >= fields_.size()) fail(fields_.size() - 1, std::string("the line ends before the ") + name);
    const std::string& text = fields_[field].text;
    const char* first = text.data();
    const char* last = first + text.size();
    if (first != last && *first == '+') ++first;
    double value = 0;
    const auto [end, error] = std::from_chars(first, last, value);
    if (error != std::errc() || end != last || !std::isfinite(value)) {
        fail(field, "\"" + text.substr(0, 40) + "\" is no number; expected the " + name);
    }
    return value;
}

int TextLine::integer(std::size_t field, const char* name) const {
    const double value = number(field, name);
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
        fail(field, "\"" + fields_[field].text + "\" is no whole number in range; expected the " + name);
    }
    return static_cast<int>(value);
}

void TextLine::fail(std::size_t field, const std::string& message) const {
    const std::size_t column = field < fields_.size() ? fields_[field].column : 1;
    throw Error(ErrorKind::input,
                file_.string() + ":" + std::to_string(line_) + ":" + std::to_string(column) + ": " + message);
}

std::vector<std::string> readTextLines(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        throw Error(ErrorKind::input, file.string() + ": there is no such file");
    }
    if (std::filesystem::is_directory(file, ignored)) {
        throw Error(ErrorKind::input, file.string() + ": is a folder; name the text file in it");
    }
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(ErrorKind::input, file.string() + ": cannot be read; check its permissions");
    std::vector<std::string> lines;
    std::string line;
    while (std::getline(stream, line)) {
        if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
        if (line.find('\0') != std::string::npos) {
            throw Error(ErrorKind::input, file.string() + ":" + std::to_string(lines.size() + 1) +
                                              ": holds zero bytes; this is no text file");
        }
        lines.push_back(std::move(line));
    }
    if (stream.bad()) throw Error(ErrorKind::input, file.string() + ": reading broke off");
    return lines;
}

}  // namespace eyrie

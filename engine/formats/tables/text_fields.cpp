#include "formats/tables/text_fields.h"

#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "io/atomic_file.h"

namespace eyrie {
namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

}  // namespace

TextLine::TextLine(const std::filesystem::path& file, int line, const std::string& text, char separator)
    : file_(file), line_(line) {
    separator == ' ' ? splitAtBlanks(text) : split(text, separator);
}

void TextLine::splitAtBlanks(const std::string& text) {
    std::size_t begin = 0;
    for (;;) {
        while (begin < text.size() && isBlank(text[begin])) ++begin;
        if (begin == text.size()) break;
        std::size_t end = begin;
        while (end < text.size() && !isBlank(text[end])) ++end;
        fields_.push_back({text.substr(begin, end - begin), begin + 1});
        begin = end;
    }
    if (fields_.empty()) fields_.push_back({});
}

void TextLine::split(const std::string& text, char separator) {
    std::size_t begin = 0;
    for (;;) {
        std::size_t first = begin;
        while (first < text.size() && isBlank(text[first]) && text[first] != separator) ++first;
        if (first < text.size() && text[first] == '"') {
            Field field{{}, first + 1};
            std::size_t at = first + 1;
            for (;; ++at) {
                if (at >= text.size()) {
                    fields_.push_back(field);
                    fail(fields_.size() - 1, "a quote is opened and never closed");
                }
                if (text[at] != '"') {
                    field.text += text[at];
                } else if (at + 1 < text.size() && text[at + 1] == '"') {
                    field.text += text[at++];
                } else {
                    break;
                }
            }
            fields_.push_back(field);
            for (++at; at < text.size() && text[at] != separator; ++at) {
                if (!isBlank(text[at])) fail(fields_.size() - 1, "text follows a closing quote");
            }
            if (at >= text.size()) return;
            begin = at + 1;
            continue;
        }
        const std::size_t end = std::min(text.find(separator, begin), text.size());
        std::size_t last = end;
        first = std::min(first, end);
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
        fail(field, "\"" + text.substr(0, 40) + "\" is not a number; expected the " + name);
    }
    return value;
}

int TextLine::integer(std::size_t field, const char* name) const {
    const double value = number(field, name);
    if (value != std::floor(value) || std::abs(value) > std::numeric_limits<int>::max()) {
        fail(field, "\"" + fields_[field].text + "\" is not a whole number in range; expected the " + name);
    }
    return static_cast<int>(value);
}

double TextLine::pixels(std::size_t field, const char* name) const {
    const double value = number(field, name);
    if (std::abs(value) > kLargestCoordinate) {
        fail(field, "\"" + fields_[field].text.substr(0, 40) + "\" lies outside any image; expected the " + name);
    }
    return value;
}

double TextLine::size(std::size_t field, const char* name) const {
    const double value = pixels(field, name);
    if (value < 0) fail(field, std::string("the ") + name + " is negative");
    return value;
}

int TextLine::frame(std::size_t field, int first_frame_number) const {
    const int number = integer(field, "frame");
    if (number < first_frame_number) {
        fail(field,
             "frame " + std::to_string(number) + "; frames count from " + std::to_string(first_frame_number) + " here");
    }
    if (number >= kFrameLimit) fail(field, "frame " + std::to_string(number) + " is beyond any video");
    return number - first_frame_number;
}

int TextLine::identity(std::size_t field) const {
    const int id = integer(field, "id");
    if (id < 0) fail(field, "id " + std::to_string(id) + " is negative");
    return id;
}

std::string TextLine::word(std::size_t field, const char* name) const {
    if (field >= fields_.size()) fail(fields_.size() - 1, std::string("the line ends before the ") + name);
    for (const char c : fields_[field].text) {
        if (static_cast<unsigned char>(c) < 0x20) fail(field, std::string("the ") + name + " holds control characters");
    }
    return fields_[field].text;
}

void TextLine::fail(std::size_t field, const std::string& message) const {
    const std::size_t column = field < fields_.size() ? fields_[field].column : 1;
    throw Error(ErrorKind::input,
                file_.string() + ":" + std::to_string(line_) + ":" + std::to_string(column) + ": " + message);
}

std::vector<std::string> readTextLines(const std::filesystem::path& file) {
    checkReadableFile(file);
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw Error(ErrorKind::input, file.string() + ": cannot be read; check its permissions");
    std::vector<std::string> lines;
    std::string line;
    while (std::getline(stream, line)) {
        if (lines.empty() && line.starts_with("\xEF\xBB\xBF")) line.erase(0, 3);
        if (line.find('\0') != std::string::npos) {
            throw Error(ErrorKind::input, file.string() + ":" + std::to_string(lines.size() + 1) +
                                              ": holds zero bytes; this is not a text file");
        }
        if (!isUtf8(line)) {
            throw Error(ErrorKind::input, file.string() + ":" + std::to_string(lines.size() + 1) +
                                              ": is not UTF-8 text; save the file as UTF-8");
        }
        lines.push_back(std::move(line));
    }
    if (stream.bad()) throw Error(ErrorKind::input, file.string() + ": reading broke off");
    return lines;
}

bool isUtf8(std::string_view bytes) {
    std::size_t at = 0;
    while (at < bytes.size()) {
        const unsigned char first = static_cast<unsigned char>(bytes[at]);
        if (first < 0x80) {
            ++at;
            continue;
        }
        const int following = first >= 0xF0 ? 3 : first >= 0xE0 ? 2 : 1;
        if (first < 0xC2 || first > 0xF4 || at + static_cast<std::size_t>(following) >= bytes.size()) return false;
        const unsigned char second = static_cast<unsigned char>(bytes[at + 1]);
        if ((first == 0xE0 && second < 0xA0) || (first == 0xED && second > 0x9F) || (first == 0xF0 && second < 0x90) ||
            (first == 0xF4 && second > 0x8F)) {
            return false;
        }
        for (int i = 1; i <= following; ++i) {
            if ((static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]) & 0xC0) != 0x80) return false;
        }
        at += static_cast<std::size_t>(following) + 1;
    }
    return true;
}

}  // namespace eyrie

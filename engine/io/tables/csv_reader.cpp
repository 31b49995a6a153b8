#include "io/tables/csv_reader.h"

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

/// What spreadsheets would run, or what has become like it by a guard.
bool isFormula(const std::string& text) {
    const std::size_t first = text.find_first_not_of('\'');
    if (first == std::string::npos || std::string_view("=+-@\t\r").find(text[first]) == std::string_view::npos)
        return false;
    return first > 0 || !parseReal(text);
}

}  // namespace

CsvReader::CsvReader(const std::filesystem::path& path, const std::vector<std::string>& required)
    : path_(path), bytes_(readWholeFile(path)) {
    if (bytes_.starts_with("\xEF\xBB\xBF")) position_ = 3;
    if (!readFields())
        throw Error(ErrorKind::input, path_.string() + ": the file is empty, expected a line of column names");
    column_count_ = fields_.size();
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const std::string name(trimmed(fields_[i]));
        if (!name.empty() && !columns_.emplace(name, i).second) refuseLine("column " + name + " is there twice");
    }
    std::string needed;
    for (const std::string& name : required) needed += (needed.empty() ? "" : ",") + name;
    for (const std::string& name : required)
        if (!has(name)) refuseLine("column " + name + " is missing; the first line must name at least " + needed);
}

bool CsvReader::readFields() {
    while (position_ < bytes_.size()) {
        ++line_;
        const std::size_t line_end = std::min(bytes_.find('\n', position_), bytes_.size());
        std::string_view rest = std::string_view(bytes_).substr(position_, line_end - position_);
        position_ = line_end + 1;
        if (!rest.empty() && rest.back() == '\r') rest.remove_suffix(1);
        if (trimmed(rest).empty()) continue;
        if (rest.find('\0') != std::string_view::npos)
            refuseLine("the line holds bytes that are not text; is this a CSV file?");

        fields_.clear();
        for (bool more = true; more;) {
            std::string field;
            if (rest.starts_with('"')) {
                std::size_t i = 1;
                for (; i < rest.size(); ++i) {
                    if (rest[i] != '"') {
                        field += rest[i];
                    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
                        field += rest[i++];
                    } else {
                        break;
                    }
                }
                if (i >= rest.size()) refuseLine("a quote is not closed on this line");
                rest.remove_prefix(i + 1);
                if (!rest.empty() && rest.front() != ',') refuseLine("text follows a closing quote, expected a comma");
            } else {
                const std::size_t comma = std::min(rest.find(','), rest.size());
                field = rest.substr(0, comma);
                rest.remove_prefix(comma);
            }
            fields_.push_back(std::move(field));
            more = !rest.empty();
            if (more) rest.remove_prefix(1);
        }
        return true;
    }
    return false;
}

bool CsvReader::next() {
    if (!readFields()) return false;
    if (fields_.size() != column_count_)
        refuseLine("the line has " + std::to_string(fields_.size()) + " fields, the header " +
                   std::to_string(column_count_));
    return true;
}

std::string CsvReader::text(const std::string& column) const {
    const auto found = columns_.find(column);
    return found == columns_.end() ? std::string() : withoutFormulaGuard(std::string(trimmed(fields_[found->second])));
}

double CsvReader::real(const std::string& column, std::optional<double> fallback) const {
    const std::string field = text(column);
    if (field.empty() && fallback) return *fallback;
    const std::optional<double> value = parseReal(field);
    if (!value) refuse(column, "a number");
    return *value;
}

int CsvReader::whole(const std::string& column, std::optional<int> fallback) const {
    const std::string field = text(column);
    if (field.empty() && fallback) return *fallback;
    const std::optional<int> value = parseWhole(field);
    if (!value) refuse(column, "a whole number");
    return *value;
}

void CsvReader::refuse(const std::string& column, const std::string& expected) const {
    const std::string field = text(column);
    refuseLine("column " + column + (field.empty() ? " is empty" : " = " + field) + ", expected " + expected);
}

void CsvReader::refuseLine(const std::string& reason) const {
    throw Error(ErrorKind::input, path_.string() + ":" + std::to_string(line_) + ": " + reason);
}

std::string formulaGuarded(const std::string& text) {
    return isFormula(text) ? "'" + text : text;
}

std::string withoutFormulaGuard(const std::string& text) {
    return text.starts_with('\'') && isFormula(text.substr(1)) ? text.substr(1) : text;
}

std::string csvField(const std::string& raw) {
    const std::string text = formulaGuarded(raw);
    if (text.find_first_of(",\"\n\r") == std::string::npos && trimmed(text) == text) return text;
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += c == '\n' || c == '\r' ? ' ' : c;
    }
    return quoted + "\"";
}

}  // namespace eyrie

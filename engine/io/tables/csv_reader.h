#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace eyrie {

/// Reads a table of comma-separated values row by row; columns are found by the names in the first line. Understands
/// quoted fields with doubled quotes, CRLF, a byte order mark and blank lines. Every error is an Error(input) that
/// begins with "file:line: ".
class CsvReader {
 public:
    /// Throws Error(input) when the file cannot be read, has no header or lacks one of `required`.
    CsvReader(const std::filesystem::path& path, const std::vector<std::string>& required);

    /// Goes to the next row; false at the end.
    bool next();
    bool has(const std::string& column) const { return columns_.contains(column); }

    /// The field of this row without the guard against formulas; empty when there is no such column.
    std::string text(const std::string& column) const;
    /// The field as a number, or `fallback` when there is no such column or the field is empty. Without `fallback` an
    /// empty field is an error, as is anything but a finite number.
    double real(const std::string& column, std::optional<double> fallback = std::nullopt) const;
    /// The same for whole numbers.
    int whole(const std::string& column, std::optional<int> fallback = std::nullopt) const;

    /// Throws the Error about this row: "file:line: column heading = abc, expected a number".
    [[noreturn]] void refuse(const std::string& column, const std::string& expected) const;

 private:
    bool readFields();
    [[noreturn]] void refuseLine(const std::string& reason) const;

    std::filesystem::path path_;
    std::string bytes_;
    std::size_t position_ = 0;
    int line_ = 0;
    std::vector<std::string> fields_;
    std::map<std::string, std::size_t> columns_;
    std::size_t column_count_ = 0;
};

/// The text as one field: quoted where commas, quotes or line ends ask for it, and guarded.
std::string csvField(const std::string& text);

/// Spreadsheets run text that begins with =, +, -, @, a tab or a carriage return. Such gets an apostrophe before it,
/// which they take for the mark of a text; numbers stay as they are. A text that begins with apostrophes and then such
/// a character gets one more, so that every text comes back from `withoutFormulaGuard`.
std::string formulaGuarded(const std::string& text);
std::string withoutFormulaGuard(const std::string& text);

}  // namespace eyrie

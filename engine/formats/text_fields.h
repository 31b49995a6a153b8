#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace eyrie {

/// A line of a text table, split into fields; knows where it stands, so that errors can say so.
class TextLine {
 public:
    /// `line` counts from 1. Fields are separated by commas; blanks around them and a carriage return at the end do not
    /// count.
    TextLine(const std::filesystem::path& file, int line, const std::string& text);

    std::size_t size() const { return fields_.size(); }
    bool blank() const { return fields_.size() == 1 && fields_[0].text.empty(); }
    std::string_view text(std::size_t field) const { return fields_[field].text; }
    /// A finite number. Throws Error(input) "file:line:column: …" otherwise; `name` tells what was expected.
    double number(std::size_t field, const char* name) const;
    /// A whole number; "3.0" is one.
    int integer(std::size_t field, const char* name) const;
    /// Throws Error(input) at a field: "file:line:column: message".
    [[noreturn]] void fail(std::size_t field, const std::string& message) const;

 private:
    struct Field {
        std::string text;
        std::size_t column = 1;  ///< of its first character, from 1
    };
    std::filesystem::path file_;
    int line_;
    std::vector<Field> fields_;
};

/// All lines of a text file, without a byte order mark at the start. Throws Error(input) when the file is missing, is a
/// folder, cannot be read, or holds a zero byte (then it is no text).
std::vector<std::string> readTextLines(const std::filesystem::path& file);

}  // namespace eyrie

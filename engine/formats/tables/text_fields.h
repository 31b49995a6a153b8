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
    /// `line` counts from 1. Fields are separated by `separator`, ' ' meaning any run of blanks; blanks around fields
    /// and a carriage return at the end do not count. Between commas and the like, fields may be quoted, quotes
    /// doubled.
    TextLine(const std::filesystem::path& file, int line, const std::string& text, char separator = ',');

    std::size_t size() const { return fields_.size(); }
    bool blank() const { return fields_.size() == 1 && fields_[0].text.empty(); }
    std::string_view text(std::size_t field) const { return fields_[field].text; }
    /// A finite number. Throws Error(input) "file:line:column: …" otherwise; `name` tells what was expected.
    double number(std::size_t field, const char* name) const;
    /// A whole number; "3.0" is one.
    int integer(std::size_t field, const char* name) const;
    /// A coordinate or a length that can stand in an image: a number within ±10 million.
    double pixels(std::size_t field, const char* name) const;
    /// The same, not negative.
    double size(std::size_t field, const char* name) const;
    /// A frame below 10 million, given from `first_frame_number` on; returned from 0.
    int frame(std::size_t field, int first_frame_number) const;
    /// A whole number, 0 or more.
    int identity(std::size_t field) const;
    /// The field as text for a class or name; throws for control characters.
    std::string word(std::size_t field, const char* name) const;
    /// Throws Error(input) at a field: "file:line:column: message".
    [[noreturn]] void fail(std::size_t field, const std::string& message) const;

 private:
    void split(const std::string& text, char separator);
    void splitAtBlanks(const std::string& text);
    struct Field {
        std::string text;
        std::size_t column = 1;  ///< of its first character, from 1
    };
    std::filesystem::path file_;
    int line_;
    std::vector<Field> fields_;
};

/// All lines of a text file, without a byte order mark at the start. Throws Error(input) when the file is missing, is a
/// folder, cannot be read, or holds a zero byte or no UTF-8 (then it is no text).
std::vector<std::string> readTextLines(const std::filesystem::path& file);

/// Whether the bytes are well-formed UTF-8, without surrogates or overlong forms.
bool isUtf8(std::string_view bytes);

/// The largest coordinate and frame that are taken for meant.
inline constexpr double kLargestCoordinate = 1e7;
inline constexpr int kFrameLimit = 10'000'000;

}  // namespace eyrie

#pragma once

#include <optional>
#include <string>
#include <string_view>

/// Numbers as text, the same in every locale.
namespace eyrie {

/// The finite number that is the whole text, blanks around it aside; nothing otherwise.
std::optional<double> parseReal(std::string_view text);
/// The whole number that is the whole text; "12.0" is one too.
std::optional<int> parseWhole(std::string_view text);
/// At most this many decimals, without trailing zeros and without "-0".
std::string fixedText(double value, int decimals);
/// The shortest text that reads back identically.
std::string shortestText(double value);
/// The text without blanks at its ends.
std::string_view trimmed(std::string_view text);

}  // namespace eyrie

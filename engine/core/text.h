#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Small works on text that several rooms need.
namespace eyrie {

/// Text with every byte that is not UTF-8 replaced by U+FFFD, as JSON, XML and Qt need it.
std::string validUtf8(std::string_view text);

/// A file's name for people and for files: names may hold any bytes, what is shown or exchanged must be UTF-8.
std::string displayText(const std::filesystem::path& path);

/// Whether a file's name ends so (".ts"), in small letters or capitals.
bool hasEnding(const std::filesystem::path& path, std::string_view ending);

/// Text made safe between tags and in attributes of XML, HTML and SVG; characters that XML forbids become "_",
/// bytes that are not UTF-8 U+FFFD.
std::string markupEscaped(std::string_view text);

/// How many letters must be added, removed, replaced or swapped with their neighbour to make one text of the other.
std::size_t editDistance(std::string_view a, std::string_view b);

/// What somebody probably meant by a word that is none of `known`: the nearest of them, unless it differs in more than
/// a third of the word (at least two letters).
std::optional<std::string> nearestWord(std::string_view word, const std::vector<std::string>& known);

/// A number with a decimal comma ("0,08") as we read it ("0.08"); nothing for any other text.
std::optional<std::string> withDecimalPoint(std::string_view text);

}  // namespace eyrie

// How much a folder, a class and the wiring of the window may grow, and how texts are written.
#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

namespace eyrie::house_rules_test {
namespace {

namespace fs = std::filesystem;

template <class Visit>
void forEachSourceLine(const std::set<std::string>& folders, Visit&& visit) {
    for (const std::string& folder : folders) {
        for (const auto& entry : fs::recursive_directory_iterator(test::sourceFolder() / folder)) {
            const auto extension = entry.path().extension();
            if (extension != ".h" && extension != ".cpp") continue;
            std::ifstream file(entry.path());
            std::string line;
            while (std::getline(file, line)) visit(entry.path(), line);
        }
    }
}

bool isPartOfName(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// The class whose function a line begins to define, such as "Tracker" of "void Tracker::reset() {"; empty for others.
std::string classOfDefinition(const std::string& line) {
    if (line.empty() || !isPartOfName(line.front()) || line.back() == ';') return {};
    const std::size_t arguments = line.find('(');
    if (arguments == std::string::npos) return {};
    const std::size_t colons = line.rfind("::", arguments);
    if (colons == std::string::npos) return {};
    for (std::size_t i = colons + 2; i < arguments; ++i)
        if (!isPartOfName(line[i]) && line[i] != '~') return {};
    std::size_t begin = colons;
    while (begin > 0 && isPartOfName(line[begin - 1])) --begin;
    const bool is_class = begin < colons && std::isupper(static_cast<unsigned char>(line[begin])) != 0;
    return is_class ? line.substr(begin, colons - begin) : std::string();
}

/// The texts between quotes on a line of C++, as they stand there; none of a comment.
std::vector<std::string> textsOf(const std::string& line) {
    std::vector<std::string> texts;
    bool inside = false;
    for (std::size_t i = 0; i < line.size(); ++i) {
        if (!inside && line.compare(i, 2, "//") == 0) break;
        if (!inside && line.compare(i, 3, "'\"'") == 0) {
            i += 2;
            continue;
        }
        if (line[i] == '"') {
            inside = !inside;
            if (inside) texts.emplace_back();
        } else if (inside) {
            texts.back() += line[i];
            if (line[i] == '\\' && i + 1 < line.size()) texts.back() += line[++i];
        }
    }
    return texts;
}

}  // namespace

// With its header it is in three files at most, beside the one that says what all classes of a room remember.
TEST(HouseRules, noClassIsWrittenInMoreThanTwoFilesBesideItsHeader) {
    std::map<std::string, std::set<std::string>> files;
    forEachSourceLine({"engine", "app", "ui"}, [&](const fs::path& file, const std::string& line) {
        if (file.extension() != ".cpp" || file.stem().string().ends_with("_state")) return;
        const std::string name = classOfDefinition(line);
        if (!name.empty()) files[name].insert(file.filename().string());
    });
    EXPECT_GT(files.size(), 200U) << "definitions are not recognised any more";
    for (const auto& [name, written_in] : files)
        EXPECT_LE(written_in.size(), 2U) << name << " is written in " << ::testing::PrintToString(written_in);
}

// What is bound one by one cannot be seen at a glance: lists of ui/widgets/wiring.h can.
TEST(HouseRules, atMost200SignalsAreConnectedOneByOneOutsideTheSession) {
    int calls = 0;
    forEachSourceLine({"app", "ui"}, [&](const fs::path& file, const std::string& line) {
        if (file.string().find("/ui/session/") != std::string::npos) return;
        for (std::size_t at = line.find("connect("); at != std::string::npos; at = line.find("connect(", at + 1))
            calls += at == 0 || !isPartOfName(line[at - 1]);
    });
    EXPECT_GT(calls, 50) << "calls are not recognised any more";
    EXPECT_LE(calls, 200);
}

// "Reading …" is a word short: what goes on, and what a command asks for, has its dots at its last word.
TEST(HouseRules, dotsStandAtAWordOrBetweenTwo) {
    const std::string dots = "…";
    int found = 0;
    forEachSourceLine({"engine", "app", "ui"}, [&](const fs::path& file, const std::string& line) {
        for (const std::string& text : textsOf(line)) {
            for (std::size_t at = text.find(dots); at != std::string::npos; at = text.find(dots, at + 1)) {
                ++found;
                const std::size_t after = at + dots.size();
                const bool alone = text == dots;
                const bool between = after < text.size() && text[after] == ' ';
                EXPECT_TRUE(alone || (at > 0 && (text[at - 1] != ' ' || between))) << file << ": " << text;
            }
        }
    });
    EXPECT_GT(found, 50) << "texts are not recognised any more";
}

}  // namespace eyrie::house_rules_test

#include <gtest/gtest.h>

#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "support/places.h"

namespace eyrie::tested_parameters_test {
namespace {

namespace tree = std::filesystem;

/// Where a parameter is declared.
struct DeclaredParameter {
    std::string room;   ///< of the engine
    std::string field;  ///< of its options
};

bool isWordPart(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::string wordFrom(const std::string& text, std::size_t at) {
    std::size_t end = at;
    while (end < text.size() && isWordPart(text[end])) ++end;
    return text.substr(at, end - at);
}

std::size_t withoutSpace(const std::string& text, std::size_t at) {
    while (at < text.size() && std::isspace(static_cast<unsigned char>(text[at])) != 0) ++at;
    return at;
}

std::string textOf(const tree::path& path) {
    std::ifstream file(path);
    std::stringstream text;
    text << file.rdbuf();
    return text.str();
}

tree::path sources() {
    return test::sourceFolder();
}

/// Reads `declare.real("room.name", field, …` and the like.
void readDeclarations(const tree::path& path, std::map<std::string, DeclaredParameter>& declared) {
    const std::string text = textOf(path);
    if (text.find("ParameterDeclarer") == std::string::npos) return;
    for (const std::string kind : {".real(", ".integer(", ".flag(", ".choice(", ".words("}) {
        for (std::size_t at = text.find(kind); at != std::string::npos; at = text.find(kind, at + 1)) {
            std::size_t next = withoutSpace(text, at + kind.size());
            if (text[next] == ')') continue;  // part of a complex number
            ASSERT_EQ(text[next], '"') << path << ": a parameter is declared by its name as a whole";
            const std::size_t end = text.find('"', next + 1);
            const std::string name = text.substr(next + 1, end - next - 1);
            next = withoutSpace(text, end + 2);
            std::string field = wordFrom(text, next);
            for (next += field.size(); text[next] == '.'; next += field.size() + 1) field = wordFrom(text, next + 1);
            const std::string room = *tree::relative(path, sources() / "engine").begin();
            EXPECT_TRUE(declared.emplace(name, DeclaredParameter{room, field}).second) << name << " is declared twice";
        }
    }
}

std::map<std::string, DeclaredParameter> declaredParameters() {
    std::map<std::string, DeclaredParameter> declared;
    for (const auto& entry : tree::recursive_directory_iterator(sources() / "engine")) {
        const std::string name = entry.path().filename();
        if (entry.path().extension() == ".cpp" && name != "parameter.cpp") readDeclarations(entry.path(), declared);
    }
    return declared;
}

/// What the files below tests/ say.
struct Named {
    std::set<std::string> names;                          ///< "room.name", or room.name=…
    std::map<std::string, std::set<std::string>> fields;  ///< that tests of a room set: .field = …
};

Named namedInTests() {
    Named named;
    for (const auto& entry : tree::recursive_directory_iterator(sources() / "tests")) {
        // The values of a preset do not say what a parameter does.
        const std::string file = entry.path().filename();
        if (!entry.is_regular_file() || file == "tested_parameters_test.cpp" || file == "chain_options_test.cpp")
            continue;
        const std::string text = textOf(entry.path());
        const std::string room = *tree::relative(entry.path(), sources() / "tests").begin();
        for (std::size_t dot = text.find('.'); dot != std::string::npos; dot = text.find('.', dot + 1)) {
            std::size_t begin = dot;
            while (begin > 0 && isWordPart(text[begin - 1])) --begin;
            const std::string after = wordFrom(text, dot + 1);
            const std::size_t end = dot + 1 + after.size();
            if (after.empty() || end >= text.size()) continue;
            const std::size_t next = withoutSpace(text, end);
            if (next + 1 < text.size() && text[next] == '=' && text[next + 1] != '=') named.fields[room].insert(after);
            const bool quoted = begin > 0 && text[begin - 1] == '"';
            if (begin < dot && (quoted || text[end] == '=')) named.names.insert(text.substr(begin, end - begin));
        }
    }
    return named;
}

}  // namespace

TEST(TestedParameters, eachIsNamedOrSetInATest) {
    const Named named = namedInTests();
    const auto declared = declaredParameters();
    EXPECT_GT(declared.size(), 300U);
    for (const auto& [name, parameter] : declared) {
        const auto fields = named.fields.find(parameter.room);
        const bool is_set = fields != named.fields.end() && fields->second.count(parameter.field) > 0;
        EXPECT_TRUE(is_set || named.names.count(name) > 0)
            << "no test says what " << name << " does: set it there by its name, or set " << parameter.field
            << " in a test of the room " << parameter.room;
    }
}

// Who reads a preset finds the field, and the other way round. px and frames are no part of a name.
TEST(TestedParameters, eachIsCalledLikeItsFieldButForTheUnit) {
    const std::set<std::string> units{"", "_m", "_m2", "_m_s", "_m_s2", "_kmh", "_s", "_hz", "_deg", "_sigmas"};
    for (const auto& [name, parameter] : declaredParameters()) {
        const std::string own = name.substr(name.find('.') + 1);
        const bool alike = parameter.field.compare(0, own.size(), own) == 0;
        EXPECT_TRUE(alike && units.count(parameter.field.substr(own.size())) > 0)
            << "the field of " << name << " is called " << parameter.field;
    }
}

}  // namespace eyrie::tested_parameters_test

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <string>

#include "support/places.h"

namespace eyrie {
namespace {

namespace tree = std::filesystem;

/// Those that no test names yet. Whoever tests one takes it out; none may be added.
const std::set<std::string> not_yet_tested = {
    "canny_harris.closing",
    "canny_harris.corner_share",
    "canny_harris.high",
    "canny_harris.link",
    "canny_harris.low_share",
    "canny_harris.min_corners",
    "difference.ghost_deviation",
    "difference.ghost_gradient",
    "difference.gradient_suppression",
    "difference.max_length",
    "difference.noise_factor",
    "gradient.canny_variance",
    "gradient.lbp_radius_min",
    "gradient.quantile_margin",
    "motion.area_contrast",
    "motion.area_few_corners",
    "motion.area_gap",
    "motion.area_max_corners",
    "motion.area_max_length",
    "motion.area_min_correlation",
    "motion.area_min_shift",
    "motion.area_min_size",
    "motion.area_min_size_px",
    "motion.area_noise_factor",
    "motion.area_sure_correlation",
    "motion.local_background_cell",
    "motion.local_background_min_corners",
    "motion.parallax_agreement",
    "motion.shadow_bright_near",
    "motion.shadow_darkest",
    "motion.shadow_ground",
    "motion.shadow_lit",
    "motion.shadow_min_brightness",
    "motion.shadow_owner_length",
    "motion.shadow_owner_width",
    "motion.shadow_radius",
    "motion.shadow_reach",
    "motion.silhouette_contrast",
    "motion.silhouette_max_width",
    "motion.silhouette_min_speed",
    "motion.silhouette_noise_factor",
    "motion.slow_baseline",
    "motion.slow_min_age",
    "mser.delta",
    "mser.max_area",
    "mser.max_eccentricity",
    "mser.max_variation",
    "mser.min_area",
    "relative_connectivity.high_factor",
    "relative_connectivity.min_points",
    "tophat_otsu.element",
    "tophat_otsu.smoothing",
    "training.contrast_change",
    "training.folds",
    "training.hard_others_per_vehicle",
    "training.others_per_vehicle",
    "training.weight_trimming",
};

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
        if (!entry.is_regular_file() || entry.path().filename() == "tested_parameters_test.cpp") continue;
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

std::set<std::string> untestedParameters() {
    const Named named = namedInTests();
    std::set<std::string> untested;
    for (const auto& [name, parameter] : declaredParameters()) {
        const auto fields = named.fields.find(parameter.room);
        const bool is_set = fields != named.fields.end() && fields->second.count(parameter.field) > 0;
        if (!is_set && named.names.count(name) == 0) untested.insert(name);
    }
    return untested;
}

}  // namespace

TEST(TestedParameters, eachIsNamedOrSetInATest) {
    EXPECT_GT(declaredParameters().size(), 300U);
    for (const std::string& name : untestedParameters()) {
        EXPECT_EQ(not_yet_tested.count(name), 1U)
            << "no test says what " << name
            << " does: set it there by its name, or set its field in a test of its room";
    }
}

TEST(TestedParameters, whatIsTestedIsNoExceptionAnyLonger) {
    const std::set<std::string> untested = untestedParameters();
    for (const std::string& name : not_yet_tested) {
        EXPECT_EQ(untested.count(name), 1U) << name << " is tested, or gone: take it out of this list";
    }
}

}  // namespace eyrie

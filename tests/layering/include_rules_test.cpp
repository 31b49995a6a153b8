#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

struct Include {
    fs::path file;
    std::string room;
    std::string included;  // as written between quotes or brackets
};

std::vector<Include> includesBelow(const fs::path& top) {
    static const std::regex pattern(R"(^\s*#\s*include\s*[<"]([^>"]+)[>"])");
    std::vector<Include> found;
    for (const auto& entry : fs::recursive_directory_iterator(top)) {
        const auto extension = entry.path().extension();
        if (extension != ".h" && extension != ".cpp") continue;
        std::ifstream file(entry.path());
        std::string line;
        while (std::getline(file, line)) {
            std::smatch match;
            if (!std::regex_search(line, match, pattern)) continue;
            found.push_back({entry.path(), fs::relative(entry.path(), top).begin()->string(), match[1]});
        }
    }
    return found;
}

const fs::path source_dir = eyrie::test::sourceFolder();

/// Which engine rooms each engine room may include besides itself (the plan of the house).
const std::map<std::string, std::set<std::string>> allowed = {
    {"core", {}},
    {"annotation", {"core", "stacking"}},
    {"io", {"core"}},
    {"formats", {"core", "io"}},
    {"imaging", {"core"}},
    {"registration", {"core"}},
    {"motion", {"core"}},
    {"stacking", {"core", "imaging"}},
    {"detection", {"core", "imaging", "learning"}},
    {"learning", {"core", "imaging", "io"}},
    {"removal", {"core"}},
    {"tracking", {"core", "imaging"}},
    {"evaluation", {"core"}},
    {"exchange", {"core", "annotation", "formats", "store"}},
    {"scene", {"core", "io"}},
    {"store", {"core"}},
    {"rerun", {"core", "io", "registration", "motion", "stacking", "detection", "removal", "tracking", "chain"}},
    {"explain", {"core", "registration", "motion", "detection", "removal", "tracking", "chain", "rerun"}},
    {"sweep",
     {"core", "io", "registration", "motion", "stacking", "detection", "removal", "tracking", "evaluation", "chain",
      "rerun", "store"}},
    {"chain",
     {"core", "io", "registration", "motion", "stacking", "detection", "learning", "removal", "tracking", "store"}},
    {"report", {"core", "chain", "diagnosis", "evaluation", "io", "store"}},
    {"diagnosis",
     {"core", "annotation", "chain", "rerun", "evaluation", "exchange", "formats", "io", "motion", "store"}},
};

}  // namespace

TEST(IncludeRules, engineRoomsIncludeOnlyTheRoomsTheyMay) {
    for (const auto& include : includesBelow(source_dir / "engine")) {
        const std::string target = include.included.substr(0, include.included.find('/'));
        if (!allowed.count(target) || include.included.find('/') == std::string::npos || target == include.room)
            continue;
        ASSERT_TRUE(allowed.count(include.room)) << include.room << " is not in the plan";
        EXPECT_TRUE(allowed.at(include.room).count(target)) << include.file.string() << " includes " << include.included
                                                            << ", which " << include.room << " may not see";
    }
}

TEST(IncludeRules, engineAndCommandLineAreFreeOfQt) {
    static const std::regex qt(R"(^(Q[A-Z]\w*|Qt\w+/.*|q[a-z]+\.h|qcustomplot\.h)$)");
    for (const char* folder : {"engine", "app/cli"}) {
        for (const auto& include : includesBelow(source_dir / folder)) {
            EXPECT_FALSE(std::regex_match(include.included, qt))
                << include.file.string() << " includes " << include.included;
        }
    }
}

TEST(IncludeRules, viewsAndModelsSeeOnlyValues) {
    for (const auto& include : includesBelow(source_dir / "ui")) {
        if (include.room != "view" && include.room != "models") continue;
        const std::string target = include.included.substr(0, include.included.find('/'));
        const bool engine_room = allowed.count(target) && include.included.find('/') != std::string::npos;
        const bool value_header = target == "core" || include.included == "store/runs/run_store.h" ||
                                  include.included == "chain/recording/run_facts.h";
        EXPECT_TRUE(!engine_room || value_header) << include.file.string() << " includes " << include.included;
    }
}

TEST(IncludeRules, everyHeaderIsGuarded) {
    for (const char* folder : {"engine", "app", "ui", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source_dir / folder)) {
            if (entry.path().extension() != ".h") continue;
            std::ifstream file(entry.path());
            std::string text((std::istreambuf_iterator<char>(file)), {});
            EXPECT_NE(text.find("#pragma once"), std::string::npos) << entry.path();
        }
    }
}

}  // namespace eyrie

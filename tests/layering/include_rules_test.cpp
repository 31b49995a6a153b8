#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "support/places.h"

namespace eyrie::include_rules_test {
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
    {"annotation", {"core", "imaging", "stacking"}},
    {"io", {"core"}},
    {"metadata", {"core", "io"}},
    {"georeference", {"core", "annotation", "io", "metadata"}},
    {"formats", {"core", "io"}},
    {"imaging", {"core"}},
    {"registration", {"core"}},
    {"motion", {"core"}},
    {"stacking", {"core", "imaging"}},
    {"detection", {"core", "imaging", "learning"}},
    {"learning", {"core", "imaging", "io"}},
    {"removal", {"core"}},
    {"tracking", {"core", "imaging"}},
    {"peer", {"core", "motion", "tracking"}},
    {"evaluation", {"core"}},
    {"exchange", {"core", "annotation", "correction", "events", "formats", "georeference", "io", "metadata", "store"}},
    {"scene", {"core", "io"}},
    {"store", {"core"}},
    {"rerun",
     {"core", "io", "registration", "motion", "stacking", "detection", "removal", "tracking", "peer", "chain"}},
    {"explain", {"core", "registration", "motion", "detection", "removal", "tracking", "chain", "rerun"}},
    {"sweep",
     {"core", "io", "registration", "motion", "stacking", "detection", "removal", "tracking", "evaluation", "chain",
      "rerun", "scoring", "store"}},
    {"chain",
     {"core", "imaging", "io", "metadata", "registration", "motion", "stacking", "detection", "learning", "removal",
      "tracking", "store"}},
    {"report",
     {"core", "chain", "correction", "diagnosis", "evaluation", "events", "georeference", "ground", "io", "metadata",
      "store"}},
    {"scoring", {"core", "annotation", "evaluation", "formats", "io", "store"}},
    {"correction", {"core", "annotation", "store"}},
    {"events", {"core", "annotation", "correction", "formats", "io", "store"}},
    {"ground", {"core", "annotation", "events", "learning"}},
    {"diagnosis", {"core", "chain", "rerun", "evaluation", "io", "motion", "removal", "scoring", "store"}},
};

/// What a room of the window may include besides itself; no engine rooms named: any.
struct WindowRoom {
    std::set<std::string> window;
    std::set<std::string> engine;
};

const std::map<std::string, WindowRoom> allowed_in_window = {
    {"canvas", {{"widgets"}, {"core"}}},
    {"widgets", {{}, {"core", "store"}}},
    {"session", {{"canvas"}, {"core", "chain", "correction", "imaging", "io", "metadata", "rerun", "scene", "store"}}},
    {"workspace", {{"canvas", "widgets", "session"}, {"core", "io"}}},
    {"review",
     {{"canvas", "widgets", "session", "workspace"},
      {"core", "annotation", "chain", "correction", "events", "georeference", "ground", "io", "metadata", "store"}}},
    {"label",
     {{"canvas", "widgets", "session", "workspace"}, {"core", "annotation", "exchange", "formats", "io", "store"}}},
    {"tune", {{"canvas", "widgets", "session", "workspace"}, {}}},
    {"window", {{"canvas", "widgets", "session", "workspace", "review", "label", "tune"}, {}}},
};

/// Which folders of the command line each may include besides itself; "." is what lies in none of them. Nobody includes
/// a command.
const std::map<std::string, std::set<std::string>> allowed_in_command_line = {
    {".", {"arguments"}},
    {"reports", {"."}},
    {"arguments", {".", "reports"}},
    {"batch", {".", "arguments", "reports"}},
    {"live", {".", "arguments", "reports"}},
    {"commands", {".", "arguments", "batch", "live", "reports"}},
};

/// The folder of a file of the command line by its path from app/: "cli/arguments/input.h" lies in "arguments".
std::string folderInCommandLine(const fs::path& from_app) {
    const std::string folder = from_app.lexically_relative("cli").begin()->string();
    return allowed_in_command_line.count(folder) ? folder : ".";
}

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

TEST(IncludeRules, roomsOfTheWindowIncludeOnlyTheRoomsTheyMay) {
    for (const auto& include : includesBelow(source_dir / "ui")) {
        const std::size_t slash = include.included.find('/');
        if (slash == std::string::npos) continue;
        const std::string target = include.included.substr(0, slash);
        ASSERT_TRUE(allowed_in_window.count(include.room)) << include.room << " is not in the plan";
        const auto& rooms = allowed_in_window.at(include.room);
        if (allowed_in_window.count(target) && target != include.room) {
            EXPECT_TRUE(rooms.window.count(target)) << include.file.string() << " includes " << include.included;
        }
        if (allowed.count(target)) {
            EXPECT_TRUE(rooms.engine.empty() || rooms.engine.count(target))
                << include.file.string() << " includes " << include.included;
        }
    }
}

TEST(IncludeRules, commandLineKnowsNothingOfTheWindow) {
    for (const auto& include : includesBelow(source_dir / "app" / "cli")) {
        const std::string target = include.included.substr(0, include.included.find('/'));
        EXPECT_FALSE(allowed_in_window.count(target) || target == "gui")
            << include.file.string() << " includes " << include.included;
    }
}

TEST(IncludeRules, foldersOfTheCommandLineIncludeOnlyThoseTheyMay) {
    for (const auto& entry : fs::directory_iterator(source_dir / "app" / "cli"))
        EXPECT_TRUE(!entry.is_directory() || allowed_in_command_line.count(entry.path().filename().string()))
            << entry.path() << " is not in the plan";
    int between_folders = 0;
    for (const auto& include : includesBelow(source_dir / "app")) {
        if (include.room != "cli" || include.included.rfind("cli/", 0) != 0) continue;
        const std::string from = folderInCommandLine(fs::relative(include.file, source_dir / "app"));
        const std::string target = folderInCommandLine(include.included);
        if (target == from) continue;
        ++between_folders;
        EXPECT_TRUE(allowed_in_command_line.at(from).count(target))
            << include.file.string() << " includes " << include.included << ", which " << from << " may not see";
    }
    EXPECT_GT(between_folders, 50) << "includes are not recognised any more";
}

TEST(IncludeRules, theProgramOfTheWindowIncludesOnlyTheWindow) {
    int of_window = 0;
    for (const auto& include : includesBelow(source_dir / "app")) {
        const std::size_t slash = include.included.find('/');
        if (include.room != "gui" || slash == std::string::npos) continue;
        const std::string target = include.included.substr(0, slash);
        // Of the engine the words that everybody speaks: values and errors.
        EXPECT_TRUE(target == "window" || target == "gui" || target == "core" || target.rfind("Qt", 0) == 0 ||
                    target == "sys")
            << include.file.string() << " includes " << include.included;
        of_window += target == "window" ? 1 : 0;
    }
    EXPECT_GT(of_window, 0) << "includes are not recognised any more";
}

TEST(IncludeRules, noTwoFilesHaveOneName) {
    const std::set<std::string> of_every_folder = {"CMakeLists.txt", "main.cpp", "run"};
    std::map<std::string, fs::path> places;
    for (const char* folder : {"engine", "app", "ui", "tests"}) {
        for (const auto& entry : fs::recursive_directory_iterator(source_dir / folder)) {
            const std::string name = entry.path().filename();
            if (!entry.is_regular_file() || of_every_folder.count(name)) continue;
            EXPECT_TRUE(places.emplace(name, entry.path()).second) << entry.path() << " and " << places.at(name);
        }
    }
}

TEST(IncludeRules, noFolderHoldsMoreThan25Files) {
    for (const char* folder : {"engine", "app", "ui", "tests"}) {
        std::map<fs::path, int> files;
        for (const auto& entry : fs::recursive_directory_iterator(source_dir / folder)) {
            if (entry.is_regular_file()) ++files[entry.path().parent_path()];
        }
        for (const auto& [place, count] : files) EXPECT_LE(count, 25) << place;
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

}  // namespace eyrie::include_rules_test

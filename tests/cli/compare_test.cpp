#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cli/loaded_program.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "store/sweeps/comparison_store.h"
#include "support/moving_scene.h"

namespace eyrie::compare_test {
namespace {

using testing::HasSubstr;

class Compare : public testing::Test {
 protected:
    static constexpr int kFrames = 26;

    void SetUp() override {
        const test::MovingScene scene;
        std::filesystem::create_directories(folder / "clip");
        std::ofstream truth(at("truth.csv"));
        truth << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int i = 0; i < kFrames; ++i) {
            cv::imwrite(at("clip/" + std::to_string(1000 + i) + ".png"), scene.draw(i));
            for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
                const cv::Point2d centre = scene.vehicleAt(scene.vehicles[v], i);
                truth << i << "," << v + 1 << "," << centre.x << "," << centre.y << "," << scene.vehicles[v].size.width
                      << "," << scene.vehicles[v].size.height << "," << (v == 0 ? 0 : 90) << ",car,0\n";
            }
        }
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }
    test::ProcessResult compare(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"compare", "--sequence", at("clip"), "--ground-truth", at("truth.csv"),
                                           "--gsd",   "0.2",        "--quiet",  "--set",          "view.oblique=false"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return test::runLoaded(arguments);
    }
    const test::TemporaryFolder folder;
};

}  // namespace

TEST_F(Compare, PrintsALineForEveryMethodAndOverlap) {
    const auto result =
        compare({"--methods", "clusters", "gradient", "--overlap", "0.1", "0.3", "--csv", at("figures.csv")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("T_ov 0.1"));
    EXPECT_THAT(result.output, HasSubstr("T_ov 0.3"));
    EXPECT_THAT(result.output, HasSubstr("clusters + tracking"));
    EXPECT_THAT(result.output, HasSubstr("difference"));
    std::ifstream csv(at("figures.csv"));
    std::string line;
    std::getline(csv, line);
    EXPECT_THAT(line, HasSubstr("method,stacking,tracking,overlap,tp,fp,fn"));
    const auto fields = std::count(line.begin(), line.end(), ',');
    int lines = 0;
    while (std::getline(csv, line)) {
        ++lines;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), fields) << line;
    }
    EXPECT_EQ(lines, 8);
}

TEST_F(Compare, JsonHasIntervalsAndTheProjectTheRuns) {
    const auto result =
        compare({"--methods", "gradient", "mser", "three_frame_difference", "--stacking", "off,on", "--tracking", "on",
                 "--overlap", "0.1", "--json", "--project", at("p.eyrie"), "--set", "stacking.min_height=5"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    ASSERT_EQ(json["results"].size(), 6U);
    EXPECT_EQ(json["results"][1]["name"], "gradient + stacking + tracking");
    EXPECT_GT(json["results"][0]["f_score"], 0.5);
    EXPECT_FALSE(json["results"][0].contains("difference"));
    const auto difference = json["results"][1]["difference"];
    EXPECT_EQ(difference["to"], "gradient + tracking");
    EXPECT_LE(difference["f_score"]["low"], difference["f_score"]["high"]);
    EXPECT_TRUE(difference.contains("mota"));
    ProjectFile project = ProjectFile::open(at("p.eyrie"), ProjectFile::Mode::read_only);
    const auto runs = RunStore(project).runs();
    ASSERT_EQ(runs.size(), 6U);
    EXPECT_EQ(runs[1].name, "compare: gradient + stacking");
    EXPECT_EQ(runs[1].frames_done, kFrames);
    EXPECT_EQ(runs[1].state, RunState::finished);
    const auto kept = comparisons(project);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(nlohmann::json::parse(kept[0].report), json);
    const auto told = nlohmann::json::parse(test::runLoaded({"info", at("p.eyrie"), "--json"}).output);
    ASSERT_EQ(told["comparisons"].size(), 1U);
    EXPECT_EQ(told["comparisons"][0]["figures"], json);
}

TEST_F(Compare, InfoShowsTheFiguresThatAProjectKeeps) {
    {
        ProjectFile project = ProjectFile::openOrCreate(at("kept.eyrie"));
        addComparison(project, "/clips/town.mp4", R"({"results":[
            {"name":"gradient + tracking","overlap":0.3,"precision":0.9,"recall":0.8,"f_score":0.847,"n_modp":0.61,
             "mota":0.5,"id_switches":7,"ms_per_frame":12.34},
            {"name":"mser","overlap":0.1,"precision":1,"recall":0.25,"f_score":0.4,"n_modp":0.5,"mota":null}, 5]})");
        addComparison(project, "/clips/other.mp4", "not JSON");
        addComparison(project, "/clips/third.mp4", R"({"results":{}})");
    }
    const auto info = test::runLoaded({"info", at("kept.eyrie")});
    ASSERT_EQ(info.exit_code, 0) << info.errors;
    EXPECT_THAT(info.output, HasSubstr("  comparison 1: /clips/town.mp4, 20"));
    // A column of figures is 11 wide, the methods' as wide as the longest name.
    const std::string titles =
        "       T_ov  precision     recall    f-score     N-MODP       MOTA        IDS         ms\n";
    EXPECT_THAT(info.output, HasSubstr("\n    " + std::string(19, ' ') + titles));
    EXPECT_THAT(info.output,
                HasSubstr("    gradient + tracking        0.3      0.900      0.800      0.847      0.610      "
                          "0.500          7       12.3\n"));
    EXPECT_THAT(info.output,
                HasSubstr("    mser                       0.1      1.000      0.250      0.400      0.500          "
                          "-          -          -\n"));
    EXPECT_THAT(info.output, HasSubstr("  comparison 2: /clips/other.mp4, 20"));
    EXPECT_THAT(info.output, testing::ContainsRegex("third.mp4, [^\n]*\n    no figures that can be read\n"));
    const auto told = nlohmann::json::parse(test::runLoaded({"info", at("kept.eyrie"), "--json"}).output);
    ASSERT_EQ(told["comparisons"].size(), 3U);
    EXPECT_EQ(told["comparisons"][0]["figures"]["results"][0]["id_switches"], 7);
    EXPECT_TRUE(told["comparisons"][1]["figures"].is_null());
}

TEST_F(Compare, ThePeerStandsBesideAndHasParametersOfItsOwn) {
    const std::vector<std::string> arguments{"--methods", "clusters",  "peer",          "--stacking",
                                             "off,on",    "--overlap", "0.3",           "--upright",
                                             "--json",    "--project", at("peer.eyrie")};
    const auto result = compare(arguments);
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    ASSERT_EQ(json["results"].size(), 6U) << "stacks mean nothing to the peer";
    EXPECT_EQ(json["results"][5]["name"], "three_frame_difference_sort + tracking");
    EXPECT_GT(json["results"][5]["f_score"], 0.6);
    EXPECT_THAT(json["remarks"].dump(), HasSubstr("three-frame difference with SORT"));
    ProjectFile project = ProjectFile::open(at("peer.eyrie"), ProjectFile::Mode::read_only);
    const auto runs = RunStore(project).runs();
    ASSERT_EQ(runs.size(), 3U);
    EXPECT_EQ(runs[2].frames_done, kFrames);
    const auto stored = RunStore(project).trackBoxes(runs[2].id);
    EXPECT_FALSE(stored.empty());

    const auto blind = compare({"--methods", "peer", "--overlap", "0.3", "--json", "--set", "peer.threshold=255"});
    ASSERT_EQ(blind.exit_code, 0) << blind.errors;
    EXPECT_EQ(nlohmann::json::parse(blind.output)["results"][1]["tp"], 0);
    for (const char* setting : {"peer.gap=0", "peer.magic=1", "peer.gap", "peer.min_hits=some"}) {
        const auto wrong = compare({"--methods", "peer", "--set", setting});
        EXPECT_EQ(wrong.exit_code, 2) << setting;
        EXPECT_THAT(wrong.errors, HasSubstr("peer.")) << setting;
    }
}

TEST_F(Compare, PrintsWhatIsPublishedBeside) {
    const std::vector<std::string> arguments{"--methods", "clusters", "--overlap", "0.1", "--published", "egtest01"};
    const auto table = compare(arguments);
    ASSERT_EQ(table.exit_code, 0) << table.errors;
    EXPECT_THAT(table.output, HasSubstr("T_ov 0.1"));
    EXPECT_THAT(table.output, HasSubstr("their paper, in table 7.10"));
    auto as_json = arguments;
    as_json.push_back("--json");
    const auto json = nlohmann::json::parse(compare(as_json).output);
    EXPECT_EQ(json["results"].size(), 2U);
    std::map<std::string, nlohmann::json> by_table;
    for (const auto& row : json["published"])
        by_table[row["source"].get<std::string>() + ", " + row["name"].get<std::string>()] = row;
    EXPECT_EQ(by_table.size(), json["published"].size());
    EXPECT_EQ(by_table["table 7.6, clusters"]["tp"], 6844);
    EXPECT_EQ(by_table["table 7.3, gradient_canny"]["n_modp"], .483);
    EXPECT_EQ(by_table["table 7.8, sliding_window + stacking"]["fn"], 189);
    const auto& siam = by_table["their paper, in table 7.7, Siam et al. 2012a"];
    EXPECT_EQ(siam["precision"], .996);
    EXPECT_TRUE(siam["tp"].is_null()) << "Siam et al. give no counts";
    EXPECT_EQ(compare({"--methods", "clusters", "--published", "m1303"}).exit_code, 2);
}

TEST_F(Compare, SaysWhatIsWrong) {
    const auto method = compare({"--methods", "magic"});
    EXPECT_EQ(method.exit_code, 2);
    EXPECT_THAT(method.errors, HasSubstr("there is no method \"magic\""));
    const auto model = compare({"--methods", "sliding_window", "--set", "sliding_window.model=nowhere.eyriemodel"});
    EXPECT_EQ(model.exit_code, 3);
    EXPECT_THAT(model.errors, HasSubstr("nowhere.eyriemodel"));
    const auto range = compare({"--methods", "gradient", "--frames", "0:500"});
    EXPECT_EQ(range.exit_code, 2);
    EXPECT_EQ(compare({"--stacking", "maybe"}).exit_code, 2);
}

TEST_F(Compare, BenchHasARowForEveryStageAndMethod) {
    const auto result = test::runLoaded({"bench", "--input", at("clip"), "--gsd", "0.2", "--frames", "10", "--corners",
                                         "600", "--set", "stacking.enabled=true", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    ASSERT_EQ(json["columns"].size(), 1U);
    EXPECT_GT(json["columns"][0]["stages"]["corners"]["median_ms"], 0);
    EXPECT_GT(json["columns"][0]["baseline_ms"], 0);
    std::vector<std::string> names;
    for (const auto& method : json["methods"]) {
        names.push_back(method["name"]);
        EXPECT_GT(method["detection_ms"], 0) << method["name"];
        EXPECT_GT(method["removal_ms"], 0) << method["name"];
        // Stacks are a matter of the method's name, not of the parameters.
        const bool stacked = names.back().find("+ stacking") != std::string::npos;
        EXPECT_EQ(method["stacking_ms"] > 0, stacked) << method["name"];
    }
    EXPECT_THAT(names, testing::IsSupersetOf(
                           {"clusters", "sliding_window", "mser", "three_frame_difference", "gradient + stacking"}));
}

TEST_F(Compare, BenchNeedsMoreFramesThanItIsToLeaveOut) {
    const auto result = test::runLoaded(
        {"bench", "--input", at("clip"), "--gsd", "0.2", "--frames", "10", "--warm-up", "5000", "--corners", "600"});
    EXPECT_EQ(result.exit_code, 3);
    EXPECT_THAT(result.errors, HasSubstr("more than 5000 frames are needed"));
}

}  // namespace eyrie::compare_test

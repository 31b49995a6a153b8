#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "cli/loaded_program.h"
#include "learning/drawn_windows.h"
#include "support/temporary_folder.h"

namespace eyrie::train_test {
namespace {

using testing::HasSubstr;

test::ProcessResult cli(const std::vector<std::string>& arguments) {
    return test::runLoaded(arguments);
}

class TrainCommand : public testing::Test {
 protected:
    TrainCommand() {
        sheets("one", 1);
        sheets("two", 2);
    }
    std::string at(const std::string& name) const { return (folder / name).string(); }

    /// A folder of patch sheets with drawn vehicles, their axis horizontal; with their sizes, if wanted, of which the
    /// first is said to be longer than its cell.
    void sheets(const std::string& name, std::uint64_t seed, bool sized = false) const {
        constexpr int rows = 3;
        std::filesystem::create_directories(folder / name);
        std::ofstream table(folder / name / "patches.csv");
        table << "kind,row,column,group,duplicate" << (sized ? ",length_px,width_px\n" : "\n");
        SeededRandom random(seed);
        for (const bool vehicle : {true, false}) {
            cv::Mat sheet(rows * 16, 32 * 32, CV_8UC1);
            for (int i = 0; i < rows * 32; ++i) {
                cv::Mat lying;
                cv::rotate(test::drawnWindow(vehicle, random), lying, cv::ROTATE_90_CLOCKWISE);
                lying.copyTo(sheet(cv::Rect(i % 32 * 32, i / 32 * 16, 32, 16)));
                table << (vehicle ? "pos," : "neg,") << i / 32 << "," << i % 32 << ",group" << i % 5 << ",0";
                if (sized) table << (!vehicle ? ",," : i == 0 ? ",40,9" : ",21,9");
                table << "\n";
            }
            cv::imwrite(at(name + (vehicle ? "/pos.png" : "/neg.png")), sheet);
        }
    }
    test::ProcessResult train(std::vector<std::string> more) const {
        std::vector<std::string> arguments{"train",   "--samples", at("one"), "--out", at("m.eyriemodel"),
                                           "--trees", "20"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return cli(arguments);
    }
    const test::TemporaryFolder folder;
};

}  // namespace

TEST_F(TrainCommand, makesAModelThatClassifyMeasures) {
    const auto trained = train({"--note", "drawn", "--quiet"});
    ASSERT_EQ(trained.exit_code, 0) << trained.errors;
    EXPECT_THAT(trained.output, HasSubstr("one: 96 vehicles, 96 others"));
    const auto measured = cli({"classify", "--model", at("m.eyriemodel"), "--patches", at("two"), "--json"});
    ASSERT_EQ(measured.exit_code, 0) << measured.errors;
    const auto json = nlohmann::json::parse(measured.output);
    EXPECT_GT(json["auc"], 0.95);
    EXPECT_EQ(json["vehicles"], 96);
    EXPECT_GE(json["detection_rate_at_1_percent"], json["detection_rate_at_0.1_percent"]);
    EXPECT_THAT(json["training_data"].get<std::string>(), HasSubstr("drawn"));
    EXPECT_THAT(json["trained"].get<std::string>(), testing::MatchesRegex("....-..-..T..:..:..Z"));
    const auto text = cli({"classify", "--model", at("m.eyriemodel"), "--patches", at("two"), "--roc", at("r.csv")});
    EXPECT_THAT(text.output, HasSubstr("AUC"));
    EXPECT_GT(std::filesystem::file_size(folder / "r.csv"), 50U);
}

TEST_F(TrainCommand, cutsSheetsAsTheModelWantsThem) {
    sheets("sized", 1, true);
    sheets("other", 2, true);
    const std::string filled = "training.fill_window=true", model = at("filled.eyriemodel");
    const auto trained = cli({"train", "--samples", at("sized"), "--out", model, "--trees", "20", "--set", filled});
    ASSERT_EQ(trained.exit_code, 0) << trained.errors;
    EXPECT_THAT(trained.output, HasSubstr("sized: 95 vehicles, 96 others")) << "all that their cells hold";
    const auto measured = cli({"classify", "--model", model, "--patches", at("other"), "--json"});
    ASSERT_EQ(measured.exit_code, 0) << measured.errors;
    EXPECT_EQ(nlohmann::json::parse(measured.output)["vehicles"], 95);
    EXPECT_GT(nlohmann::json::parse(measured.output)["auc"], 0.8);
    const auto compared = cli({"classify-test", "--samples", at("sized") + "," + at("other"), "--descriptors", "hog",
                               "--classifiers", "adaboost", "--set", "training.trees=10", "--set", filled, "--json"});
    ASSERT_EQ(compared.exit_code, 0) << compared.errors;
    const auto table = nlohmann::json::parse(compared.output);
    for (const auto& source : table["sources"]) EXPECT_EQ(source["vehicles"], 95);
    ASSERT_EQ(train({"--quiet"}).exit_code, 0);
    const auto whole = cli({"classify", "--model", at("m.eyriemodel"), "--patches", at("other"), "--json"});
    EXPECT_EQ(nlohmann::json::parse(whole.output)["vehicles"], 96) << "with the ground around them";
}

TEST_F(TrainCommand, cutsLabelledFrames) {
    std::filesystem::create_directories(folder / "clip");
    cv::Mat frame(120, 160, CV_8UC1, cv::Scalar(110));
    cv::rectangle(frame, cv::Rect(40, 50, 21, 9), cv::Scalar(230), cv::FILLED);
    for (const char* name : {"clip/0.png", "clip/1.png", "clip/2.png"}) cv::imwrite(at(name), frame);
    std::ofstream(folder / "gt.csv") << "frame,id,x,y,length,width,heading,class,ignore\n0,1,50,54,21,9,0,car,0\n"
                                     << "2,1,50,54,21,9,0,car,0\n";
    const auto trained = train({"--images", at("clip"), "--ground-truth", at("gt.csv"), "--every", "2", "--quiet"});
    ASSERT_EQ(trained.exit_code, 0) << trained.errors;
    EXPECT_THAT(trained.output, HasSubstr("clip: 2 vehicles, 8 others"));
}

TEST_F(TrainCommand, refusesWhatCannotBeNamingTheRemedy) {
    EXPECT_EQ(train({"--descriptor", "hogg"}).exit_code, 2);
    EXPECT_THAT(train({"--classifier", "boost"}).errors, HasSubstr("adaboost"));
    EXPECT_EQ(train({"--seed", "-1"}).exit_code, 2);
    EXPECT_EQ(train({"--set", "training.tree=5"}).exit_code, 2);
    EXPECT_EQ(train({"--set", "nonsense"}).exit_code, 2);
    EXPECT_EQ(train({"--images", at("one")}).exit_code, 2);
    EXPECT_EQ(cli({"train", "--out", at("m")}).exit_code, 2);
    EXPECT_EQ(cli({"train", "--samples", at("none"), "--out", at("m")}).exit_code, 3);
    EXPECT_EQ(cli({"train", "--samples", at("one"), "--out", at("no/such/m")}).exit_code, 4);
    EXPECT_FALSE(std::filesystem::exists(folder / "m.eyriemodel"));
    std::ofstream(folder / "foreign") << "no model";
    const auto foreign = cli({"classify", "--model", at("foreign"), "--patches", at("one")});
    EXPECT_EQ(foreign.exit_code, 3);
    EXPECT_THAT(foreign.errors, HasSubstr("foreign"));
}

TEST_F(TrainCommand, classifyTestComparesOverSources) {
    const std::vector<std::string> arguments{"classify-test",
                                             "--samples",
                                             at("one") + "," + at("two"),
                                             "--descriptors",
                                             "hog,dct",
                                             "--classifiers",
                                             "adaboost,rnb",
                                             "--set",
                                             "training.trees=10",
                                             "--set",
                                             "training.weak_classifiers=10",
                                             "--out",
                                             at("roc"),
                                             "--quiet"};
    const auto table = cli(arguments);
    ASSERT_EQ(table.exit_code, 0) << table.errors;
    EXPECT_THAT(table.output, HasSubstr("AUC mean ± deviation"));
    EXPECT_THAT(table.output, HasSubstr("adaboost"));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder / "roc"), {}), 2 * 2 * 2);
    auto with_json = arguments;
    with_json.push_back("--json");
    with_json.push_back("--force");  // the curves are there already
    const auto json = nlohmann::json::parse(cli(with_json).output);
    ASSERT_EQ(json["combinations"].size(), 4U);
    for (const auto& combination : json["combinations"]) {
        EXPECT_EQ(combination["cases"].size(), 2U) << "trained on each, tested on the other";
        EXPECT_GT(combination["auc_mean"], 0.8);
    }
    EXPECT_EQ(cli({"classify-test", "--samples", at("one")}).exit_code, 2) << "one source is no test";
    EXPECT_EQ(cli({"classify-test", "--samples", at("one") + "," + at("two"), "--train-on", "three"}).exit_code, 2);
}

}  // namespace eyrie::train_test

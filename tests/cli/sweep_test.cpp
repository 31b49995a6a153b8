#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cli/loaded_program.h"
#include "store/project/project_file.h"
#include "store/sweeps/sweep_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/wait_until.h"

namespace eyrie::sweep_test {
namespace {

using testing::HasSubstr;

constexpr int kFrames = 26;

/// A clip and its truth, drawn once for all tests.
const test::TemporaryFolder& clip() {
    static const test::TemporaryFolder folder;
    static const bool drawn = [] {
        const test::MovingScene scene;
        std::filesystem::create_directories(folder / "clip");
        std::ofstream truth(folder / "truth.csv");
        std::ofstream late(folder / "late.csv");
        truth << "frame,id,x,y,length,width,heading,class,ignore\n";
        late << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int i = 0; i < kFrames; ++i) {
            cv::imwrite(folder / ("clip/" + std::to_string(1000 + i) + ".png"), scene.draw(i));
            for (std::size_t v = 0; v < scene.vehicles.size(); ++v) {
                const cv::Point2d centre = scene.vehicleAt(scene.vehicles[v], i);
                std::ostringstream line;
                line << "," << v + 1 << "," << centre.x << "," << centre.y << "," << scene.vehicles[v].size.width << ","
                     << scene.vehicles[v].size.height << "," << (v == 0 ? 0 : 90) << ",car,0\n";
                truth << i << line.str();
                late << i + 500 << line.str();
            }
        }
        return true;
    }();
    EXPECT_TRUE(drawn);
    return folder;
}

class Sweep : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }
    static std::string in(const std::string& name) { return (clip() / name).string(); }
    static test::ProcessResult cli(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    static std::vector<std::string> command(const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"sweep",         "--sequence",
                                           in("clip"),      "--ground-truth",
                                           in("truth.csv"), "--gsd",
                                           "0.2",           "--quiet",
                                           "--set",         "detection.method=gradient",
                                           "--set",         "view.oblique=false"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        return arguments;
    }
    static test::ProcessResult sweep(const std::vector<std::string>& more) { return cli(command(more)); }
    const test::TemporaryFolder folder;
};

std::string contentsOf(const std::string& file) {
    std::ifstream stream(file);
    return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace

TEST_F(Sweep, GivesTheFiguresOfRunAndEvaluate) {
    const auto result = sweep({"--parameter", "gradient.quantile=0.1,0.4", "--out", at("s.eyrie"), "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    ASSERT_EQ(json["points"].size(), 2U);
    for (const auto& point : json["points"]) {
        const std::string quantile = point["values"]["gradient.quantile"];
        const std::string project = at("run" + quantile + ".eyrie");
        ASSERT_EQ(
            cli({"run", in("clip"), "--project", project, "--gsd", "0.2", "--quiet", "--set",
                 "detection.method=gradient", "--set", "view.oblique=false", "--set", "gradient.quantile=" + quantile})
                .exit_code,
            0);
        for (const auto& figures : point["figures"]) {
            std::vector<std::string> arguments{"evaluate",
                                               "--project",
                                               project,
                                               "--ground-truth",
                                               in("truth.csv"),
                                               "--overlap",
                                               figures["overlap"].dump(),
                                               "--json"};
            if (figures["of"] == "detections") arguments.push_back("--detections");
            const auto evaluated = cli(arguments);
            ASSERT_EQ(evaluated.exit_code, 0) << evaluated.errors;
            const auto measures = nlohmann::json::parse(evaluated.output);
            const auto& expected = measures["measures"][0];
            for (const auto& [key, value] : figures["measures"].items()) {
                EXPECT_EQ(expected.at(key).get<double>(), value.get<double>()) << quantile << " " << key;
            }
            EXPECT_GE(figures["measures"].size(), 17U);
        }
    }
}

TEST_F(Sweep, PrintsACurveAndATableAndWritesCsvAndPreset) {
    auto result = sweep({"--parameter", "gradient.quantile=0.1:0.2:0.5", "--out", at("s.eyrie"), "--csv", at("s.csv"),
                         "--save-preset", at("best.json")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("gradient.quantile"));
    EXPECT_THAT(result.output, HasSubstr("best f-score of detections, mean over T_ov 0.1, 0.2, 0.3"));
    EXPECT_THAT(contentsOf(at("s.csv")), HasSubstr("0.3,"));
    EXPECT_THAT(contentsOf(at("best.json")), HasSubstr("gradient.quantile"));
    EXPECT_EQ(cli({"params", "--preset", at("best.json")}).exit_code, 0);

    result = sweep({"--parameter", "gradient.quantile=0.1,0.3", "--parameter", "outliers.min_vectors=2,4", "--overlap",
                    "0.1", "--out", at("s.eyrie"), "--best", "n_moda"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("gradient.quantile down, outliers.min_vectors across"));
    EXPECT_THAT(result.output, HasSubstr("best N-MODA"));
}

TEST_F(Sweep, UsesTheMotionVectorsOfAProject) {
    ASSERT_EQ(
        cli({"run", in("clip"), "--project", at("p.eyrie"), "--gsd", "0.2", "--quiet", "--set", "view.oblique=false"})
            .exit_code,
        0);
    const auto result = cli({"sweep", "--project", at("p.eyrie"), "--ground-truth", in("truth.csv"), "--parameter",
                             "detection.method=gradient,clusters", "--quiet", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_EQ(nlohmann::json::parse(result.output)["points"].size(), 2U);
    ProjectFile project = ProjectFile::open(at("p.eyrie"));
    EXPECT_EQ(SweepStore(project).sweeps().size(), 1U);
    const auto unlabelled =
        cli({"sweep", "--project", at("p.eyrie"), "--parameter", "gradient.quantile=0.1", "--quiet"});
    EXPECT_EQ(unlabelled.exit_code, 5);
    EXPECT_THAT(unlabelled.errors, HasSubstr("nobody has labelled"));
    EXPECT_EQ(
        cli({"sweep", "--project", at("p.eyrie"), "--run", "7", "--parameter", "gradient.quantile=0.1"}).exit_code, 2);
}

TEST_F(Sweep, ShardsJoinToTheWhole) {
    const std::vector<std::string> axis{"--parameter", "gradient.quantile=0.1:0.1:0.5"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), axis.begin(), axis.end());
        return sweep(more);
    };
    ASSERT_EQ(with({"--out", at("whole.eyrie"), "--csv", at("whole.csv")}).exit_code, 0);
    ASSERT_EQ(with({"--out", at("1.eyrie"), "--shard", "1/2"}).exit_code, 0);
    const auto part = cli({"merge", at("1.eyrie"), "--out", at("m.eyrie")});
    EXPECT_EQ(part.exit_code, 3) << "not all of it is there";
    EXPECT_THAT(part.errors, HasSubstr("missing: gradient.quantile = 0.3"));
    ASSERT_EQ(with({"--out", at("2.eyrie"), "--shard", "2/2"}).exit_code, 0);
    const auto there = cli({"merge", at("1.eyrie"), at("2.eyrie"), "--out", at("m.eyrie")});
    EXPECT_EQ(there.exit_code, 2);
    EXPECT_THAT(there.errors, HasSubstr("--add"));
    for (const auto& onto_a_part : {std::vector<std::string>{}, std::vector<std::string>{"--add"}}) {
        std::vector<std::string> words{"merge", at("1.eyrie"), at("2.eyrie"), "--out", at("2.eyrie")};
        words.insert(words.end(), onto_a_part.begin(), onto_a_part.end());
        const auto refused = cli(words);
        EXPECT_EQ(refused.exit_code, 2);
        EXPECT_THAT(refused.errors, HasSubstr("is one of the parts"));
    }
    const auto added = cli({"merge", at("1.eyrie"), at("2.eyrie"), "--out", at("m.eyrie"), "--add"});
    EXPECT_EQ(added.exit_code, 0) << added.errors;
    EXPECT_THAT(added.errors, HasSubstr("was added to"));
    const auto merged = cli({"merge", at("1.eyrie"), at("2.eyrie"), "--out", at("w.eyrie"), "--csv", at("m.csv")});
    ASSERT_EQ(merged.exit_code, 0) << merged.errors;
    EXPECT_EQ(contentsOf(at("m.csv")), contentsOf(at("whole.csv")));
    EXPECT_EQ(merged.errors, "");

    ASSERT_EQ(
        sweep({"--parameter", "gradient.quantile=0.1:0.1:0.4", "--out", at("3.eyrie"), "--shard", "2/2"}).exit_code, 0);
    const auto foreign = cli({"merge", at("1.eyrie"), at("3.eyrie"), "--out", at("n.eyrie")});
    EXPECT_EQ(foreign.exit_code, 2);
    EXPECT_THAT(foreign.errors, HasSubstr("not parts of one sweep: the values of gradient.quantile differ"));
    EXPECT_EQ(cli({"merge", at("nothing.eyrie"), "--out", at("n.eyrie")}).exit_code, 5);
    EXPECT_EQ(with({"--out", at("4.eyrie"), "--shard", "3/2"}).exit_code, 2);
    EXPECT_EQ(with({"--out", at("4.eyrie"), "--shard", "x"}).exit_code, 2);
}

TEST_F(Sweep, RefusesBadInputBeforeItBegins) {
    const auto refused = [&](const std::vector<std::string>& more, int code, const std::string& why) {
        const auto result = sweep(more);
        EXPECT_EQ(result.exit_code, code) << result.errors;
        EXPECT_THAT(result.errors, HasSubstr(why));
        EXPECT_FALSE(std::filesystem::exists(at("x.eyrie"))) << why;
    };
    const std::string out = at("x.eyrie");
    refused({"--parameter", "gradient.quantile=0.5:0.1:0.1", "--out", out}, 2, "is empty");
    refused({"--parameter", "gradient.quantle=0.5", "--out", out}, 2, "the nearest is");
    refused({"--parameter", "gradient.quantile=0.0010001:0.0000009:0.9", "--out", out}, 2, "add --yes");
    refused({"--parameter", "gradient.quantile=0.1"}, 2, "--out");
    refused({"--parameter", "gradient.quantile=0.1", "--overlap", "7", "--out", out}, 2, "overlap");
    refused({"--parameter", "gradient.quantile=0.1", "--best", "magic", "--out", out}, 2, "there is no measure");
    refused({"--parameter", "gradient.quantile=0.1", "--sequence", "more", "--out", out}, 2,
            "needs its --ground-truth");
    refused({"--parameter", "gradient.quantile=0.1", "--frames", "400:500", "--out", out}, 2, "are not in");
    refused({"--parameter", "detection.method=sliding_window", "--set", "sliding_window.model=" + in("truth.csv"),
             "--out", out},
            3, "truth.csv");
    refused({"--parameter", "gradient.quantile=0.1", "--set", "detection.method=sliding_window", "--set",
             "sliding_window.descriptor=dct", "--out", out},
            2, "was trained for the descriptor chnftrs, but sliding_window.descriptor asks for dct");
    refused({"--parameter", "sliding_window.descriptor=chnftrs,nothing", "--set", "detection.method=sliding_window",
             "--out", out},
            2, "nothing");
    const auto late = cli({"sweep", "--sequence", in("clip"), "--ground-truth", in("late.csv"), "--gsd", "0.2",
                           "--parameter", "gradient.quantile=0.1", "--out", out, "--quiet"});
    EXPECT_EQ(late.exit_code, 3);
    EXPECT_THAT(late.errors,
                HasSubstr("holds no box in the frames to be measured, 0 to 25, only in frames 500 to 525"));
    const auto nowhere = sweep({"--parameter", "gradient.quantile=0.1", "--out", at("no/such/folder/x.eyrie")});
    EXPECT_EQ(nowhere.exit_code, 4) << nowhere.errors;
}

TEST_F(Sweep, KeepsWhatIsDoneWhenKilledAndDoesOnlyTheRest) {
    const std::vector<std::string> axis{"--parameter", "gradient.quantile=0.02:0.016:0.9", "--out", at("k.eyrie")};
    std::vector<std::string> arguments = command(axis);
    arguments.insert(arguments.begin(), test::programPath("eyrie-cli"));
    const auto pointsDone = [&]() -> int {
        try {
            ProjectFile project = ProjectFile::open(at("k.eyrie"), ProjectFile::Mode::read_only);
            const auto sweeps = SweepStore(project).sweeps();
            return sweeps.empty() ? 0 : sweeps.front().points_done;
        } catch (const std::exception&) {
            return 0;
        }
    };
    const auto interrupted = [&](int signal, int at_least) {
        test::Process process(arguments);
        test::waitUntil("points are done", [&] { return pointsDone() >= at_least; });
        kill(process.pid(), signal);
        return process.wait().exit_code;
    };
    EXPECT_EQ(interrupted(SIGKILL, 3), 128 + SIGKILL);
    const int killed = pointsDone();
    EXPECT_GE(killed, 3);
    EXPECT_LT(killed, 56);
    // Not begun again by mistake.
    EXPECT_EQ(sweep(axis).exit_code, 2);
    arguments.push_back("--resume");
    EXPECT_EQ(interrupted(SIGINT, killed + 2), 130);
    const int stopped = pointsDone();
    EXPECT_GE(stopped, killed + 2);
    const auto rest = sweep({"--parameter", "gradient.quantile=0.02:0.016:0.9", "--out", at("k.eyrie"), "--resume"});
    EXPECT_EQ(rest.exit_code, 0) << rest.errors;
    EXPECT_EQ(pointsDone(), 56);
}

TEST_F(Sweep, OnlyOneProgramWorksOnASweep) {
    const std::vector<std::string> axis{"--parameter", "gradient.quantile=0.02:0.016:0.9", "--out", at("l.eyrie"),
                                        "--resume"};
    std::vector<std::string> arguments = command(axis);
    arguments.insert(arguments.begin(), test::programPath("eyrie-cli"));
    test::Process working(arguments);
    const auto locked = [&] { return std::filesystem::exists(at("l.eyrie.sweep-1")); };
    test::waitUntil("the sweep is locked", locked);
    const auto second = sweep(axis);
    EXPECT_EQ(second.exit_code, 5);
    EXPECT_THAT(second.errors, HasSubstr("is being worked on by process " + std::to_string(working.pid())));
    kill(working.pid(), SIGKILL);  // which releases the lock, though its file stays
    working.wait();
    const auto third = sweep(axis);
    EXPECT_EQ(third.exit_code, 0) << third.errors;
    EXPECT_FALSE(locked());
}

TEST_F(Sweep, SeveralRunsOfAProjectAreSweptTogether) {
    for (const char* overlap : {"0.2", "0.4"})
        ASSERT_EQ(cli({"run", in("clip"), "--project", at("p.eyrie"), "--gsd", "0.2", "--quiet", "--set",
                       "view.oblique=false", "--set", std::string("tracking.min_overlap=") + overlap})
                      .exit_code,
                  0);
    const auto result =
        cli({"sweep", "--project", at("p.eyrie"), "--run", "2,1", "--ground-truth", in("truth.csv"), "--ground-truth",
             in("truth.csv"), "--parameter", "detection.method=gradient,clusters", "--quiet", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    ProjectFile project = ProjectFile::open(at("p.eyrie"));
    EXPECT_EQ(SweepStore(project).sweeps().at(0).points_done, 2);
    const auto one = cli({"sweep", "--project", at("p.eyrie"), "--run", "2,1", "--ground-truth", in("truth.csv"),
                          "--parameter", "detection.method=gradient", "--quiet"});
    EXPECT_EQ(one.exit_code, 2);
    EXPECT_THAT(one.errors, HasSubstr("one for each of the 2 runs"));
}

TEST_F(Sweep, AFullDiskLeavesWhatIsDone) {
    std::string line = "trap '' XFSZ; ulimit -f 500; exec '" + test::programPath("eyrie-cli") + "'";
    for (const std::string& argument :
         command({"--parameter", "gradient.quantile=0.02:0.01:0.9", "--out", at("f.eyrie")}))
        line += " '" + argument + "'";
    const auto result = test::runProcess({"/bin/bash", "-c", line});
    EXPECT_EQ(result.exit_code, 4) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("f.eyrie"));
    int kept = 0;
    {
        ProjectFile project = ProjectFile::open(at("f.eyrie"));
        kept = SweepStore(project).sweeps().at(0).points_done;
    }
    EXPECT_GE(kept, 1);
    EXPECT_LT(kept, 89);
    const auto rest = sweep(
        {"--parameter", "gradient.quantile=0.02:0.01:0.9", "--out", at("f.eyrie"), "--resume", "--csv", at("f.csv")});
    EXPECT_EQ(rest.exit_code, 0) << rest.errors;
}

}  // namespace eyrie::sweep_test

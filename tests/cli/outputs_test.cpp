#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <thread>

#include "cli/loaded_program.h"
#include "io/atomic_file.h"
#include "io/video/video_writer.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::outputs_test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// Which files commands may write, and how they end when they cannot.
class Outputs : public testing::Test {
 protected:
    Outputs() {
        write("clip.mp4", std::string("\0\0\0\x18", 4) + "ftypisom and more");
        write("boxes.csv", "frame,id,x,y,length,width,heading\n0,1,50,40,20,10,0\n");
        write("table.csv", "a,b\n1,2\n");
        write("page.html", "<html></html>");
        write("settings.json", "{\"eyrie_preset\": 1, \"name\": \"n\", \"parameters\": {}}");
        for (const char* name : {"p.eyrie", "other.eyrie"}) {
            RunRecord run;
            run.sequence = {.path = "/nowhere/clip.mp4", .size = {160, 120}, .frame_count = 2, .frame_rate_hz = 25};
            run.last_frame = 1;
            ResultWriter writer(ProjectFile::create(folder_ / name).path(), run, {});
            FrameResult frame;
            frame.motion.image_size = {160, 120};
            writer.write(frame);
            writer.finish(RunState::finished, "");
        }
    }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(folder_ / name, std::ios::binary) << bytes;
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::string frames(int count) const {
        const test::MovingScene scene;
        fs::create_directories(folder_ / "frames");
        for (int i = 0; i < count; ++i) cv::imwrite(at("frames/" + std::to_string(100 + i) + ".png"), scene.draw(i));
        return at("frames");
    }
    /// A command that gets Ctrl-C as soon as it takes any: held back until then, so that no moment has to be met.
    static test::ProcessResult stoppedAtOnce(std::vector<std::string> words) {
        words.insert(words.begin(), test::programPath("eyrie-cli"));
        sigset_t ctrl_c;
        sigemptyset(&ctrl_c);
        sigaddset(&ctrl_c, SIGINT);
        sigset_t before;
        pthread_sigmask(SIG_BLOCK, &ctrl_c, &before);
        test::Process process(words);
        kill(process.pid(), SIGINT);
        pthread_sigmask(SIG_SETMASK, &before, nullptr);
        return process.wait();
    }
    /// Words that begin with "@" are paths in the folder.
    test::ProcessResult call(std::vector<std::string> arguments) const {
        for (std::string& word : arguments) {
            if (word.starts_with('@')) word = at(word.substr(1));
        }
        return test::runLoaded(arguments);
    }
    /// The same through a shell, where `redirection` says what becomes of the streams.
    test::ProcessResult shell(const std::string& arguments, const std::string& redirection) const {
        return test::runProcess({"/bin/sh", "-c", test::programPath("eyrie-cli") + " " + arguments + redirection});
    }
    std::map<std::string, std::string> contents() const {
        std::map<std::string, std::string> files;
        for (const auto& entry : fs::recursive_directory_iterator(folder_.path()))
            if (entry.is_regular_file()) files[entry.path().string()] = readWholeFile(entry.path());
        return files;
    }
    /// All calls end with `exit_code`, say `words` and change nothing on the disk.
    void expectRefused(const std::vector<std::vector<std::string>>& calls, int exit_code,
                       const std::string& words) const {
        for (const auto& arguments : calls) {
            const auto before = contents();
            const auto result = call(arguments);
            std::string line;
            for (const std::string& word : arguments) line += word + ' ';
            EXPECT_EQ(result.exit_code, exit_code) << line << result.errors;
            EXPECT_THAT(result.errors, HasSubstr(words)) << line;
            EXPECT_TRUE(contents() == before) << line << "changed a file";
        }
    }
    test::TemporaryFolder folder_;
};

TEST_F(Outputs, NoCommandOverwritesWhatItReads) {
    expectRefused({{"run", "@clip.mp4", "--annotated", "@clip.mp4", "--project", "@n.eyrie"},
                   {"run", "@clip.mp4", "--project", "@clip.mp4"},
                   {"run", "@clip.mp4", "--preset", "@settings.json", "--timing", "@settings.json"},
                   {"evaluate", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--errors", "@./boxes.csv"},
                   {"evaluate", "--result", "@boxes.csv", "--ground-truth", "@table.csv", "--errors", "@boxes.csv"},
                   {"report", "--project", "@p.eyrie", "--ground-truth", "@page.html", "--out", "@page.html"},
                   {"export", "--from", "@boxes.csv", "--format", "native", "--out", "@boxes.csv"},
                   {"import", "@boxes.csv", "--out", "@boxes.csv"},
                   {"import", "@boxes.csv", "--project", "@boxes.csv", "--video", "scene:demo"},
                   {"compare", "--sequence", "@clip.mp4", "--ground-truth", "@boxes.csv", "--csv", "@boxes.csv"},
                   {"sweep", "--sequence", "@clip.mp4", "--ground-truth", "@boxes.csv", "--out", "@s.eyrie", "--csv",
                    "@boxes.csv", "--parameter", "gradient.quantile=0.3"},
                   {"train", "--images", "@clip.mp4", "--ground-truth", "@boxes.csv", "--out", "@boxes.csv"}},
                  4, "is read by this command");
}

TEST_F(Outputs, NoCommandOverwritesAProject) {
    expectRefused({{"run", "@clip.mp4", "--project", "@n.eyrie", "--tracks", "@other.eyrie", "--force"},
                   {"evaluate", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--errors", "@other.eyrie"},
                   {"report", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--out", "@other.eyrie"},
                   {"export", "--project", "@p.eyrie", "--format", "mot", "--out", "@other.eyrie", "--force"},
                   {"import", "@boxes.csv", "--out", "@other.eyrie"},
                   {"merge", "@p.eyrie", "--out", "@n.eyrie", "--csv", "@other.eyrie"},
                   {"train", "--rendered", "1", "--out", "@other.eyrie", "--force"}},
                  4, "never overwritten");
    expectRefused({{"run", "@clip.mp4", "--project", "@p.eyrie", "--tracks", "@p.eyrie"}}, 4, "two outputs");
    expectRefused({{"export", "--project", "@p.eyrie", "--format", "mot", "--out", "@p.eyrie"},
                   {"evaluate", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--errors", "@p.eyrie"},
                   {"report", "--project", "@p.eyrie", "--events", "--out", "@p.eyrie"},
                   {"report", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--out", "@p.eyrie"}},
                  4, "is read by this command");
}

TEST_F(Outputs, FilesOfAnotherKindStayEvenWithForce) {
    expectRefused(
        {{"run", "@clip.mp4", "--project", "@n.eyrie", "--annotated", "@table.csv", "--force"},
         {"run", "scene:demo", "--project", "@n.eyrie", "--tracks", "@clip.mp4", "--force"},
         {"report", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--out", "@table.csv", "--force"},
         {"report", "--project", "@p.eyrie", "--events", "--out", "@table.csv", "--force"},
         {"export", "--from", "@boxes.csv", "--format", "coco", "--out", "@table.csv", "--force"},
         {"classify", "--model", "@m", "--patches", "@d", "--roc", "@settings.json", "--force"}},
        4, "does not replace");
    expectRefused({{"run", "scene:demo", "--project", "@table.csv"},
                   {"sweep", "--sequence", "@clip.mp4", "--ground-truth", "@boxes.csv", "--out", "@table.csv",
                    "--parameter", "gradient.quantile=0.3"}},
                  5, "left untouched");
}

TEST_F(Outputs, FilesOfTheSameKindNeedForce) {
    expectRefused({{"run", "scene:demo", "--project", "@n.eyrie", "--tracks", "@table.csv"},
                   {"import", "@boxes.csv", "--out", "@table.csv"},
                   {"export", "--from", "@boxes.csv", "--format", "mot", "--out", "@table.csv"}},
                  4, "--force");
    EXPECT_EQ(call({"import", "@boxes.csv", "--out", "@table.csv", "--force"}).exit_code, 0);
    EXPECT_THAT(readWholeFile(at("table.csv")), HasSubstr("frame,id,x,y"));

    ASSERT_EQ(
        call({"export", "--from", "@boxes.csv", "--format", "trackeval", "--out", "@tree", "--name", "s"}).exit_code,
        0);
    expectRefused({{"export", "--from", "@boxes.csv", "--format", "trackeval", "--out", "@tree", "--name", "s"}}, 4,
                  "gt.txt and 1 more exist already");
    EXPECT_EQ(
        call({"export", "--from", "@boxes.csv", "--format", "trackeval", "--out", "@tree", "--name", "t"}).exit_code, 0)
        << "another sequence of the same tree";
    ASSERT_EQ(call({"render", "stops", "--frames", "2", "--quiet", "--out", "@scene"}).exit_code, 0);
    expectRefused({{"render", "stops", "--frames", "1", "--quiet", "--out", "@scene"}}, 4, "--force");
    EXPECT_EQ(call({"render", "stops", "--frames", "1", "--quiet", "--out", "@scene", "--force"}).exit_code, 0);
    EXPECT_FALSE(fs::exists(at("scene/frames/000001.png")));
}

TEST_F(Outputs, FramesOfTheInputAreNotWritten) {
    frames(2);
    expectRefused({{"run", "@frames", "--project", "@n.eyrie", "--timing", "@frames/100.png"}}, 4, "in the folder");
}

TEST_F(Outputs, StreamsCanBeWritten) {
    const auto result = call({"import", "@boxes.csv", "--out", "/dev/stdout"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, AllOf(HasSubstr("boxes"), HasSubstr("frame,id,x,y"))) << "in turn with what is printed";
    EXPECT_TRUE(fs::is_symlink("/dev/stdout") || !fs::exists("/dev/stdout"));
    EXPECT_EQ(call({"import", "@boxes.csv", "--out", "/dev/null"}).exit_code, 0);
}

TEST_F(Outputs, PrintingThatIsLostIsAnError) {
    const auto full = shell("params", " >/dev/full");
    EXPECT_EQ(full.exit_code, 4);
    EXPECT_THAT(full.errors, HasSubstr("standard output cannot be written (No space left"));
    EXPECT_EQ(shell("--help", " >/dev/full").exit_code, 4);
    EXPECT_EQ(shell("params", " >&-").exit_code, 4);
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    const auto unread = test::runProcess({"/bin/sh", "-c",
                                          "pipe='" + at("pipe") + "'; ( : <$pipe ) & exec 3>$pipe; wait; '" +
                                              test::programPath("eyrie-cli") + "' params >&3"});
    EXPECT_EQ(unread.exit_code, 4) << "a reader that has gone does not kill";
    EXPECT_THAT(unread.errors, HasSubstr("Broken pipe"));
}

TEST_F(Outputs, ARunOnAFullDiskIsFour) {
    const std::string clip = frames(30);
    // The file system's limit stands in for its end.
    const auto result =
        test::runProcess({"/bin/sh", "-c",
                          "trap '' XFSZ; ulimit -f 400; exec " + test::programPath("eyrie-cli") + " run " + clip +
                              " --gsd 0.2 --set view.oblique=false --quiet --project " + at("n.eyrie")});
    EXPECT_EQ(result.exit_code, 4) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("n.eyrie"));
}

TEST_F(Outputs, ARunWhoseInputBreaksIsThree) {
    const std::string clip = frames(6);
    std::ofstream(clip + "/104.png", std::ios::trunc) << "broken";
    EXPECT_EQ(call({"run", clip, "--gsd", "0.2", "--set", "view.oblique=false", "--quiet", "--project", "@n.eyrie"})
                  .exit_code,
              3);
}

TEST_F(Outputs, PipesAreNoInputs) {
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    ASSERT_EQ(mkfifo(at("pipe.png").c_str(), 0600), 0);
    for (const std::vector<std::string>& arguments :
         std::vector<std::vector<std::string>>{{"run", "@pipe", "--project", "@n.eyrie"},
                                               {"run", "@pipe.png", "--project", "@n.eyrie"},
                                               {"run", "scene:demo", "--preset", "@pipe", "--project", "@n.eyrie"},
                                               {"info", "@pipe"},
                                               {"import", "@pipe", "--show"},
                                               {"import", "@pipe", "--format", "mot", "--show"},
                                               {"evaluate", "--ground-truth", "@pipe", "--result", "@boxes.csv"},
                                               {"evaluate", "--ground-truth", "@boxes.csv", "--result", "@pipe"},
                                               {"export", "--from", "@pipe", "--format", "mot", "--out", "@x.txt"},
                                               {"classify", "--model", "@pipe", "--patches", "@d"}}) {
        const auto result = call(arguments);
        EXPECT_EQ(result.exit_code, 3) << arguments[0] << result.errors;
        EXPECT_THAT(result.errors, HasSubstr("pipe")) << arguments[0];
    }
    EXPECT_EQ(call({"evaluate", "--project", "@pipe"}).exit_code, 5);
    EXPECT_EQ(call({"run", "scene:demo", "--project", "@pipe"}).exit_code, 5);
}

TEST_F(Outputs, NamesNeedNotBeUtf8) {
    frames(8);
    const fs::path odd = folder_ / "clip\xFF";
    fs::rename(at("frames"), odd);
    std::string truth = "frame,id,x,y,length,width,heading,class,ignore\n";
    for (int frame = 0; frame < 8; ++frame) truth += std::to_string(frame) + ",1,100,120,24,11,0,car,0\n";
    write("truth.csv", truth);
    const auto sweep = call({"sweep", "--sequence", odd.string(), "--ground-truth", "@truth.csv", "--gsd", "0.2",
                             "--set", "view.oblique=false", "--out", "@s.eyrie", "--quiet", "--parameter",
                             "tracking.min_overlap=0.3,0.5", "--json"});
    EXPECT_EQ(sweep.exit_code, 0) << sweep.errors;
    EXPECT_NO_THROW(nlohmann::json::parse(sweep.output));
    ASSERT_EQ(
        call({"run", odd.string(), "--gsd", "0.2", "--set", "view.oblique=false", "--quiet", "--project", "@odd.eyrie"})
            .exit_code,
        0);
    EXPECT_NO_THROW(nlohmann::json::parse(call({"info", "@odd.eyrie", "--json"}).output));
    ASSERT_EQ(call({"export", "--project", "@odd.eyrie", "--format", "cvat", "--out", "@odd.xml"}).exit_code, 0);
    EXPECT_EQ(call({"import", "@odd.xml", "--show"}).exit_code, 0) << "read as UTF-8";
}

TEST_F(Outputs, InfoTellsHowShadowsFallInARunInWordsAndDegrees) {
    const fs::path project = folder_ / "lit.eyrie";
    RunRecord planned;
    planned.sequence = {.path = "/nowhere/a.mp4", .size = {320, 240}, .frame_count = 4, .frame_rate_hz = 25};
    planned.scale = {0.345, 25, true};
    planned.last_frame = 3;
    ProjectFile::create(project);
    ResultWriter writer(project, planned, {});
    writer.finish(RunState::finished, "");
    const int run = writer.runId();
    ASSERT_EQ(nlohmann::json::parse(call({"info", "@lit.eyrie", "--json"}).output)["runs"][0]["light"].size(), 0U);
    EXPECT_THAT(call({"info", "@lit.eyrie"}).output, testing::Not(HasSubstr("light:")));
    {
        ProjectFile file = ProjectFile::open(project);
        TracksOfRun tracks;
        LightFinding finding;
        finding.last_frame = 3;
        finding.heading = -1.5707963267948966;
        finding.reach_m = 3.45;
        finding.vehicles = 9;
        finding.agreement = 1;
        tracks.light.findings = {finding};
        RunStore(file).replaceTracks(run, tracks);
    }
    EXPECT_THAT(call({"info", "@lit.eyrie"}).output,
                HasSubstr("    light: shadows fall to 270° (up) in frame 0, 3.5 m beyond most vehicles: 9 vehicles say "
                          "so, 100 % of what they say agrees\n"));
    const auto told = nlohmann::json::parse(call({"info", "@lit.eyrie", "--json"}).output)["runs"][0];
    ASSERT_EQ(told["light"].size(), 1U);
    const auto& light = told["light"][0];
    EXPECT_EQ(light["outcome"], "shadows");
    EXPECT_NEAR(light["heading_deg"].get<double>(), 270, 1e-9);
    EXPECT_NEAR(light["reach_m"].get<double>(), 3.45, 1e-9);
    EXPECT_NEAR(light["reach_px"].get<double>(), 10, 1e-9);
    EXPECT_EQ(light["vehicles"], 9);
    EXPECT_TRUE(light["darkening"].is_null());
    EXPECT_EQ(light["last_frame"], 3);
    EXPECT_THAT(told["light_in_words"].get<std::string>(), HasSubstr("270°"));
}

TEST_F(Outputs, FoldersAndNamesThatCannotBeLookedAtAreNoDefect) {
    fs::create_symlink(at("loop"), at("loop"));
    const std::string longest = at(std::string(300, 'n'));
    for (const std::string& name : {at("loop"), longest, at("boxes.csv/inside")}) {
        for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
                 {"run", name, "--project", "@n.eyrie"},
                 {"info", name},
                 {"import", name, "--show"},
                 {"import", "@boxes.csv", "--project", name},
                 {"import", "@boxes.csv", "--out", name},
                 {"evaluate", "--ground-truth", name, "--result", "@boxes.csv"},
                 {"export", "--from", name, "--format", "mot", "--out", "@x.txt"},
                 {"export", "--from", "@boxes.csv", "--format", "dota", "--out", name},
                 {"run", "scene:demo", "--preset", name, "--project", "@n.eyrie"},
                 {"sweep", "--project", name, "--parameter", "gradient.quantile=0.3"},
                 {"merge", name, "--out", "@m.eyrie"},
                 {"render", "demo", "--frames", "1", "--quiet", "--out", name},
                 {"train", "--samples", name, "--out", "@m"},
                 {"classify", "--model", name, "--patches", name}}) {
            const auto result = call(arguments);
            EXPECT_GT(result.exit_code, 1) << arguments[0] << " " << name << result.errors;
            EXPECT_LT(result.exit_code, 6) << arguments[0] << " " << name;
            EXPECT_THAT(result.errors, HasSubstr(name.substr(0, 40))) << arguments[0];
        }
    }
}

TEST_F(Outputs, AClosedTerminalStopsARunCleanly) {
    const std::string clip = frames(120);
    test::Process process({test::programPath("eyrie-cli"), "run", clip, "--gsd", "0.2", "--set", "view.oblique=false",
                           "--project", at("n.eyrie")});
    test::waitUntil("the run has made its project", [&] { return fs::exists(at("n.eyrie")); });
    kill(process.pid(), SIGHUP);
    const auto result = process.wait();
    EXPECT_EQ(result.exit_code, 130) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("stopped"));
}

TEST_F(Outputs, CtrlCWhileAVideoIsIndexedIsAStopAndNoFaultOfTheVideo) {
    {
        VideoWriter video(at("short.mp4"), {64, 48});
        for (int i = 0; i < 5; ++i) video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 + 20 * i)));
        video.finish();
    }
    const auto result = stoppedAtOnce({"run", at("short.mp4"), "--gsd", "0.2", "--project", at("n.eyrie")});
    EXPECT_EQ(result.exit_code, 130) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("short.mp4: stopped while indexing"));
    EXPECT_FALSE(fs::exists(at("n.eyrie")));
}

TEST_F(Outputs, CtrlCWhileSomethingIsListedIsAStopToo) {
    {
        VideoWriter video(at("short.mp4"), {64, 48});
        for (int i = 0; i < 5; ++i) video.write(cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(40 + 20 * i)));
        video.finish();
    }
    for (const std::vector<std::string>& words :
         std::vector<std::vector<std::string>>{{"info", at("short.mp4")},
                                               {"info", at("p.eyrie")},
                                               {"events", "--project", at("p.eyrie"), "--csv", at("events.csv")}}) {
        const auto result = stoppedAtOnce(words);
        EXPECT_EQ(result.exit_code, 130) << words[0] << " " << words[1] << ": " << result.errors;
        EXPECT_EQ(result.output, "") << "half a list is none";
    }
    EXPECT_FALSE(fs::exists(at("events.csv")));
}

TEST_F(Outputs, CtrlCEndsAnExportAndLeavesNothing) {
    const auto result =
        stoppedAtOnce({"export", "--project", at("p.eyrie"), "--format", "native", "--out", at("tracks.csv")});
    EXPECT_EQ(result.exit_code, 130) << result.errors;
    EXPECT_THAT(result.errors, HasSubstr("tracks.csv: stopped before it was written"));
    EXPECT_FALSE(fs::exists(at("tracks.csv")));
}

}  // namespace
}  // namespace eyrie::outputs_test

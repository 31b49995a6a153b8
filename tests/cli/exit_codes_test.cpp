#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "cli/loaded_program.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"

namespace eyrie::exit_codes_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A call, the code it ends with, and what its message names.
struct Call {
    std::vector<std::string> arguments;
    int exit_code = 0;
    std::string names;
};

class ExitCodes : public testing::Test {
 protected:
    ExitCodes() {
        write("words.eyrie", "not a database at all, but long enough to be mistaken for one");
        write("boxes.csv", "frame,id,x,y,length,width,heading\n0,1,50,40,20,10,0\n");
        write("file", "x");
        ProjectFile::create(folder_ / "empty.eyrie");
        ProjectFile::create(folder_ / "p.eyrie");
        RunRecord run;
        run.sequence = {.path = "/nowhere/clip.mp4", .size = {160, 120}, .frame_count = 2, .frame_rate_hz = 25};
        run.last_frame = 1;
        ResultWriter writer(folder_ / "p.eyrie", run, {});
        FrameResult frame;
        frame.motion.image_size = {160, 120};
        writer.write(frame);
        writer.finish(RunState::finished, "");
    }
    void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }
    /// Words that begin with "@" are paths in the folder.
    test::ProcessResult call(std::vector<std::string> arguments) const {
        for (std::string& word : arguments) {
            if (word.starts_with('@')) word = (folder_ / word.substr(1)).string();
        }
        return test::runLoaded(arguments);
    }
    void expect(const std::vector<Call>& calls) const {
        for (const Call& one : calls) {
            const auto result = call(one.arguments);
            std::string line;
            for (const std::string& word : one.arguments) line += word + ' ';
            EXPECT_EQ(result.exit_code, one.exit_code) << line << "\n" << result.errors;
            EXPECT_THAT(result.errors, HasSubstr(one.names)) << line;
        }
    }
    test::TemporaryFolder folder_;
};

TEST_F(ExitCodes, AProjectThatCannotBeUsedIsFiveEverywhere) {
    for (const std::string name : {"absent.eyrie", "words.eyrie"}) {
        const std::string project = "@" + name;
        expect({{{"info", project}, 5, name},
                {{"evaluate", "--project", project}, 5, name},
                {{"evaluate", "--project", project, "--ground-truth", "@boxes.csv"}, 5, name},
                {{"events", "--project", project}, 5, name},
                {{"report", "--project", project, "--out", "@r.html"}, 5, name},
                {{"report", "--project", project, "--events", "--out", "@r.html"}, 5, name},
                {{"export", "--project", project, "--format", "mot", "--out", "@x.txt"}, 5, name},
                {{"export", "--project", project, "--labels", "--format", "mot", "--out", "@x.txt"}, 5, name},
                {{"import", "@boxes.csv", "--project", project}, 5, name},
                {{"import", "@boxes.csv", "--project", project, "--show"}, 5, name},
                {{"sweep", "--project", project, "--parameter", "gradient.quantile=0.3"}, 5, name},
                {{"merge", project, "--out", "@m.eyrie"}, 5, name}});
    }
    EXPECT_THAT(call({"import", "@boxes.csv", "--project", "@absent.eyrie"}).errors, HasSubstr("--video"));
}

TEST_F(ExitCodes, AProjectWithoutRunsOrLabelsIsFiveEverywhere) {
    expect({{{"evaluate", "--project", "@empty.eyrie", "--ground-truth", "@boxes.csv"}, 5, "holds no run"},
            {{"evaluate", "--project", "@empty.eyrie", "--run", "1"}, 5, "holds no run"},
            {{"events", "--project", "@empty.eyrie"}, 5, "holds no run"},
            {{"report", "--project", "@empty.eyrie", "--out", "@r.html"}, 5, "holds no run"},
            {{"report", "--project", "@empty.eyrie", "--events", "--out", "@r.html"}, 5, "holds no run"},
            {{"export", "--project", "@empty.eyrie", "--format", "mot", "--out", "@x.txt"}, 5, "holds no run"},
            {{"sweep", "--project", "@empty.eyrie", "--parameter", "gradient.quantile=0.3"}, 5, "holds no run"},
            {{"import", "@boxes.csv", "--project", "@empty.eyrie"}, 5, "--video"},
            {{"evaluate", "--project", "@p.eyrie"}, 5, "file of ground truth"},
            {{"report", "--project", "@p.eyrie", "--out", "@r.html"}, 5, "file of ground truth"},
            {{"export", "--project", "@p.eyrie", "--labels", "--format", "mot", "--out", "@x.txt"}, 5, "labelled"},
            {{"sweep", "--project", "@p.eyrie", "--parameter", "gradient.quantile=0.3"}, 5, "nobody has labelled"},
            {{"info", "@empty.eyrie"}, 0, ""}});
}

TEST_F(ExitCodes, ARunThatIsNotThereIsTwoEverywhere) {
    expect(
        {{{"evaluate", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--run", "7"}, 2, "run 1 alone"},
         {{"events", "--project", "@p.eyrie", "--run", "7"}, 2, "run 1 alone"},
         {{"report", "--project", "@p.eyrie", "--out", "@r.html", "--run", "7"}, 2, "run 1 alone"},
         {{"report", "--project", "@p.eyrie", "--events", "--out", "@r.html", "--run", "7"}, 2, "run 1 alone"},
         {{"report", "--project", "@p.eyrie", "--events", "--out", "@r.html", "--overlap", "0.3"}, 2, "--events"},
         {{"report", "--project", "@p.eyrie", "--out", "@r.html", "--verdict", "relevant"}, 2, "add --events"},
         {{"report", "--project", "@p.eyrie", "--out", "@r.html", "--tag", "lorry"}, 2, "add --events"},
         {{"report", "--project", "@p.eyrie", "--events", "--out", "@r.html", "--start", "noon"}, 2, "UTC"},
         {{"report", "--project", "@p.eyrie", "--out", "@r.html", "--against", "7"}, 2, "--against 7"},
         {{"export", "--project", "@p.eyrie", "--run", "7", "--format", "mot", "--out", "@x.txt"}, 2, "run 1 alone"},
         {{"sweep", "--project", "@p.eyrie", "--run", "7", "--parameter", "gradient.quantile=0.3"}, 2, "run 1 alone"}});
}

TEST_F(ExitCodes, AnInputThatCannotBeReadIsThreeEverywhere) {
    expect({{{"run", "@absent.mp4", "--project", "@n.eyrie"}, 3, "absent.mp4"},
            {{"info", "@absent.mp4"}, 3, "absent.mp4"},
            {{"metadata", "@absent.mp4"}, 3, "absent.mp4"},
            {{"compare", "--sequence", "@absent.mp4", "--ground-truth", "@boxes.csv"}, 3, "absent.mp4"},
            {{"sweep", "--sequence", "@absent.mp4", "--ground-truth", "@boxes.csv", "--parameter",
              "gradient.quantile=0.3", "--out", "@s.eyrie"},
             3,
             "absent.mp4"},
            {{"evaluate", "--project", "@p.eyrie", "--ground-truth", "@absent.csv"}, 3, "absent.csv"},
            {{"evaluate", "--ground-truth", "@boxes.csv", "--result", "@absent.csv"}, 3, "absent.csv"},
            {{"report", "--project", "@p.eyrie", "--ground-truth", "@absent.csv", "--out", "@r.html"}, 3, "absent.csv"},
            {{"events", "--project", "@p.eyrie", "--zone", "@absent.json"}, 3, "absent.json"},
            {{"import", "@absent.csv", "--show"}, 3, "absent.csv"},
            {{"export", "--from", "@absent.csv", "--format", "mot", "--out", "@x.txt"}, 3, "absent.csv"}});
}

TEST_F(ExitCodes, WhatIsNoVideoNamesTheCommandThatTakesIt) {
    expect({{{"run", "@p.eyrie"}, 3, "eyrie-cli info"},
            {{"run", "@boxes.csv"}, 3, "eyrie-cli import"},
            {{"info", "@boxes.csv"}, 3, "eyrie-cli import"},
            {{"compare", "--sequence", "@boxes.csv", "--ground-truth", "@boxes.csv"}, 3, "--ground-truth"}});
}

TEST_F(ExitCodes, AnOutputThatCannotBeWrittenIsFourEverywhere) {
    expect(
        {{{"evaluate", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--errors", "@file/e.csv"}, 4, "file"},
         {{"report", "--project", "@p.eyrie", "--ground-truth", "@boxes.csv", "--chips", "0", "--out", "@file/r"},
          4,
          "file"},
         {{"export", "--from", "@boxes.csv", "--format", "mot", "--out", "@file/x.txt"}, 4, "file"},
         {{"import", "@boxes.csv", "--out", "@file/x.csv"}, 4, "file"},
         {{"import", "@boxes.csv", "--project", "@no/where/n.eyrie", "--video", "scene:demo"}, 4, "where"},
         {{"render", "demo", "--frames", "1", "--quiet", "--out", "@file/r"}, 4, "file"}});
}

TEST_F(ExitCodes, MisspeltWordsNameTheNearest) {
    expect({{{"rnu", "x"}, 2, "did you mean run?"},
            {{"evalaute"}, 2, "did you mean evaluate?"},
            {{"dance"}, 2, "there are run, batch"},
            {{"run", "x", "--gds", "0.1"}, 2, "did you mean --gsd?"},
            {{"run", "x", "-gsd", "0.1"}, 2, "did you mean --gsd?"},
            {{"evaluate", "--ground-thruth=x", "--project", "@p.eyrie"}, 2, "did you mean --ground-truth?"},
            {{"run", "x", "--absolutely"}, 2, "run --help"},
            {{"run", "x", "--set", "motion.min_sped=1", "--project", "@n.eyrie"}, 2, "motion.min_speed"}});
    EXPECT_EQ(call({"run", "--help"}).exit_code, 0);
    EXPECT_EQ(call({"--version"}).exit_code, 0);
}

TEST_F(ExitCodes, WhatIsMissingOrNoNumberIsSaidInOneLine) {
    expect({{{}, 2, "eyrie-cli: a command is missing"},
            {{"run", "x", "--gsd"}, 2, "eyrie-cli: --gsd needs a value"},
            {{"run", "x", "--gsd", "--quiet"}, 2, "eyrie-cli: --gsd needs a value"},
            {{"run", "x", "--gsd", "much"}, 2, "eyrie-cli: --gsd much: expected a number"},
            {{"evaluate", "--project", "@p.eyrie", "--classes", "cars"}, 2, "eyrie-cli: --classes: cars not in"},
            {{"compare", "--sequence", "x"}, 2, "eyrie-cli: --ground-truth is required; eyrie-cli compare --help"}});
    EXPECT_THAT(call({"dance"}).errors, Not(HasSubstr("manual")));  // what people need not know is not listed
}

TEST_F(ExitCodes, DecimalCommasSayWhatToWrite) {
    expect({{{"run", "x", "--gsd", "0,08"}, 2, "write 0.08"},
            {{"run", "x", "--gsd=0,08"}, 2, "write 0.08"},
            {{"run", "x", "--fps", "29,97"}, 2, "write 29.97"},
            {{"evaluate", "--project", "@p.eyrie", "--border", "3,5"}, 2, "write 3.5"},
            {{"run", "x", "--set", "motion.min_speed=1,5", "--project", "@n.eyrie"}, 2, "write 1.5"}});
}

}  // namespace
}  // namespace eyrie::exit_codes_test

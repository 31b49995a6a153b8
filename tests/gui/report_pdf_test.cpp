#include <gmock/gmock.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>

#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/temporary_folder.h"
#include "support/wait_until.h"

namespace eyrie::report_pdf_test {
namespace {

namespace fs = std::filesystem;

using testing::HasSubstr;
using testing::StartsWith;

/// A clip and the project of a run over it, made once for all tests.
struct MadeRun {
    MadeRun() {
        test::MovingScene scene;
        scene.frames = 30;
        fs::create_directories(folder / "clip");
        for (int i = 0; i < scene.frames; ++i)
            cv::imwrite((folder / "clip" / (std::to_string(1000 + i) + ".png")).string(), scene.draw(i));
        EXPECT_EQ(
            test::runProcess({test::programPath("eyrie-cli"), "run", (folder / "clip").string(), "--gsd", "0.2",
                              "--set", "view.oblique=false", "--project", (folder / "p.eyrie").string(), "--quiet"})
                .exit_code,
            0);
    }
    const test::TemporaryFolder folder;
};

/// The command line has the window's program print, without a screen.
class ReportPdf : public testing::Test {
 protected:
    ReportPdf() {
        for (const char* place : {"HOME", "XDG_DATA_HOME", "XDG_CONFIG_HOME", "XDG_CACHE_HOME", "XDG_RUNTIME_DIR"})
            setenv(place, folder_.path().c_str(), 1);
        static const MadeRun made;
        fs::copy_file(made.folder / "p.eyrie", folder_ / "p.eyrie");
    }
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    test::ProcessResult report(const std::string& out, const std::vector<std::string>& further = {},
                               const std::string& program = test::programPath("eyrie-cli")) const {
        std::vector<std::string> words{program,     "report", "--project", at("p.eyrie"), "--events",
                                       "--verdict", "all",    "--out",     at(out)};
        words.insert(words.end(), further.begin(), further.end());
        return test::runProcess(words);
    }
    std::string contents(const std::string& name) const {
        std::ifstream file(folder_ / name, std::ios::binary);
        return {std::istreambuf_iterator<char>(file), {}};
    }
    test::TemporaryFolder folder_;
};

TEST_F(ReportPdf, AReportWhoseNameEndsSoIsAPdfAndReplacesNothing) {
    unsetenv("QT_QPA_PLATFORM");
    unsetenv("DISPLAY");
    unsetenv("WAYLAND_DISPLAY");
    const auto written = report("r.pdf");
    EXPECT_EQ(written.exit_code, 0) << written.errors;
    EXPECT_THAT(written.output, HasSubstr("Report: " + at("r.pdf")));
    const std::string first = contents("r.pdf");
    EXPECT_THAT(first, StartsWith("%PDF-"));
    EXPECT_EQ(report("r.pdf").exit_code, 4) << "nobody agreed";
    EXPECT_EQ(contents("r.pdf"), first);
    EXPECT_EQ(report("r.pdf", {"--force"}).exit_code, 0);
    EXPECT_THAT(contents("r.pdf"), StartsWith("%PDF-"));
    std::ofstream(folder_ / "notes.pdf") << "no PDF";
    EXPECT_EQ(report("notes.pdf", {"--force"}).exit_code, 4) << "a file of another kind";
    EXPECT_EQ(contents("notes.pdf"), "no PDF");
    EXPECT_EQ(report("absent/r.pdf").exit_code, 4);
}

TEST_F(ReportPdf, WithoutTheProgramOfTheWindowItIsToldBeforeTheWork) {
    fs::create_directories(folder_ / "bin");
    fs::copy_file(test::programPath("eyrie-cli"), folder_ / "bin" / "eyrie-cli");
    const auto refused = report("r.pdf", {}, at("bin/eyrie-cli"));
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_THAT(refused.errors, HasSubstr("which is not at " + at("bin/eyrie")));
    EXPECT_THAT(refused.errors, HasSubstr(".html"));
    EXPECT_FALSE(fs::exists(folder_ / "r.pdf"));
    EXPECT_EQ(report("r.html", {}, at("bin/eyrie-cli")).exit_code, 0);
}

TEST_F(ReportPdf, APrinterThatDiesOrIsStoppedLeavesNothingAndReplacesNothing) {
    fs::create_directories(folder_ / "bin");
    fs::copy_file(test::programPath("eyrie-cli"), folder_ / "bin" / "eyrie-cli");
    fs::create_directories(folder_ / "out");
    std::ofstream(folder_ / "out" / "r.pdf") << "%PDF-1.4 of yesterday";
    const auto printsHalfAnd = [&](const std::string& then) {
        std::ofstream(folder_ / "bin" / "eyrie") << "#!/bin/sh\necho half > \"$3.$$-1.part\"\n" + then + "\n";
        fs::permissions(folder_ / "bin" / "eyrie", fs::perms::owner_all);
    };
    const auto files = [&] {
        std::vector<std::string> names;
        for (const auto& entry : fs::directory_iterator(folder_ / "out"))
            names.push_back(entry.path().filename().string());
        return names;
    };
    printsHalfAnd("kill -KILL $$");
    const auto died = report("out/r.pdf", {"--force"}, at("bin/eyrie-cli"));
    EXPECT_EQ(died.exit_code, 4);
    EXPECT_THAT(died.errors, HasSubstr("did not write the PDF"));
    EXPECT_THAT(files(), testing::ElementsAre("r.pdf"));

    printsHalfAnd("touch '" + at("at-work") + "'\nexec sleep 1000");
    test::Process process({at("bin/eyrie-cli"), "report", "--project", at("p.eyrie"), "--events", "--verdict", "all",
                           "--out", at("out/r.pdf"), "--force"});
    test::waitUntil("it prints", [&] { return fs::exists(folder_ / "at-work"); });
    kill(process.pid(), SIGINT);
    EXPECT_EQ(process.wait().exit_code, 130);
    EXPECT_THAT(files(), testing::ElementsAre("r.pdf"));
    EXPECT_EQ(contents("out/r.pdf"), "%PDF-1.4 of yesterday");
}

TEST_F(ReportPdf, TheProgramOfTheWindowPrintsNothingElseAndOverNothingElse) {
    std::ofstream(folder_ / "noise") << "no report";
    const auto print = [&](const std::string& out) {
        return test::runProcess(
            {test::programPath("eyrie"), "--print-report", at("noise"), at(out), "-platform", "offscreen"});
    };
    const auto noise = print("new.pdf");
    EXPECT_EQ(noise.exit_code, 4);
    EXPECT_THAT(noise.errors, HasSubstr("no report"));
    EXPECT_FALSE(fs::exists(folder_ / "new.pdf"));
    EXPECT_EQ(print("p.eyrie").exit_code, 4);
    EXPECT_THAT(contents("p.eyrie"), StartsWith("SQLite"));
}

}  // namespace
}  // namespace eyrie::report_pdf_test

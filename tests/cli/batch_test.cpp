#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cli/batch/batch_inputs.h"
#include "core/time/utc_time.h"
#include "io/video/video_writer.h"
#include "store/database/file_lock.h"
#include "store/project/project_file.h"
#include "store/runs/run_store.h"
#include "support/moving_scene.h"
#include "support/places.h"
#include "support/process.h"
#include "support/wait_until.h"

namespace eyrie::batch_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::UnorderedElementsAre;

namespace fs = std::filesystem;

constexpr int kFrames = 12;
constexpr int kFramesOfLong = 60;  ///< for those in whose midst something happens

fs::path drawn(const fs::path& path, int frames) {
    test::MovingScene scene;
    scene.frames = frames;
    VideoWriter writer(path, scene.size, {});
    cv::Mat colours;
    for (int i = 0; i < frames; ++i) {
        cv::cvtColor(scene.draw(i), colours, cv::COLOR_GRAY2BGR);
        writer.write(colours);
    }
    writer.finish();
    return path;
}

/// Clips drawn once for all tests.
const fs::path& drawnClip() {
    static const test::TemporaryFolder folder;
    static const fs::path path = drawn(folder / "clip.mp4", kFrames);
    return path;
}

const fs::path& longClip() {
    static const test::TemporaryFolder folder;
    static const fs::path path = drawn(folder / "clip.mp4", kFramesOfLong);
    return path;
}

class Batches : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }
    void put(const std::string& name, const fs::path& clip = drawnClip()) const {
        fs::create_directories((folder / name).parent_path());
        fs::copy_file(clip, folder / name);
    }
    void write(const std::string& name, const std::string& text) const {
        fs::create_directories((folder / name).parent_path());
        std::ofstream(folder / name) << text;
    }
    std::string textOf(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(folder / name).rdbuf();
        return text.str();
    }
    std::vector<std::string> command(const std::string& name, const std::vector<std::string>& more = {}) const {
        std::vector<std::string> words{test::programPath("eyrie-cli"),
                                       name,
                                       at("in"),
                                       "--out",
                                       at("out"),
                                       "--gsd",
                                       "0.2",
                                       "--set",
                                       "view.oblique=false"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }
    test::ProcessResult batch(const std::vector<std::string>& more = {}) const {
        return test::runProcess(command("batch", more));
    }
    std::vector<RunRecord> runsOf(const std::string& project) const {
        try {
            ProjectFile file = ProjectFile::open(at(project), ProjectFile::Mode::read_only);
            return RunStore(file).runs();
        } catch (const Error&) {
            return {};
        }
    }
    bool isFinished(const std::string& project, int frames = kFrames) const {
        const auto runs = runsOf(project);
        return runs.size() == 1 && runs[0].state == RunState::finished && runs[0].frames_done == frames;
    }
    /// All runs of a project began that far into this second, as those of before: only times tell what has changed.
    void beganAt(const std::string& project, const std::string& fraction_us) const {
        SQLite::Database(at(project), SQLite::OPEN_READWRITE)
            .exec("UPDATE run SET started_utc = '" + utcTextOfSeconds(kSecond.count()) +
                  "', source_digest = '', started_fraction_us = " + fraction_us);
    }
    void changedAt(const std::string& name, int past_second_us) const {
        fs::last_write_time(folder / name,
                            fs::file_time_type::clock::from_sys(std::chrono::sys_time<std::chrono::nanoseconds>(
                                kSecond + std::chrono::microseconds(past_second_us))));
    }
    /// Old pictures whose names begin with letters of either case: A01, b02, A03 ….
    void putPictures(int count) const {
        const test::MovingScene scene;
        fs::create_directories(folder / "in/day");
        for (int i = 0; i < count; ++i) {
            const std::string number = std::to_string(101 + i).substr(1);
            const std::string name = (i % 2 == 0 ? "in/day/A" : "in/day/b") + number + ".png";
            cv::imwrite(at(name), scene.draw(i));
            makeOld(name);
        }
    }
    void makeOld(const std::string& name) const {
        fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::hours(1000));
    }
    void copyAsItIs(const std::string& from, const std::string& to) const {
        fs::copy_file(folder / from, folder / to, fs::copy_options::overwrite_existing);
        fs::last_write_time(folder / to, fs::last_write_time(folder / from));
    }
    /// The names of files that the summary has in a state.
    std::vector<std::string> inState(const std::string& state, const std::string& summary = "out/batch.csv") const {
        std::vector<std::string> names;
        std::istringstream lines(textOf(summary));
        for (std::string line; std::getline(lines, line);) {
            if (line.find("," + state + ",") == std::string::npos) continue;
            names.push_back(fs::path(line.substr(0, line.find(','))).lexically_relative(folder / "in").string());
        }
        return names;
    }
    const test::TemporaryFolder folder;
    static constexpr std::chrono::seconds kSecond{1'795'000'000};  ///< in which beganAt() and changedAt() are
};

TEST_F(Batches, everyFileGetsAProjectAndBadOnesAreListed) {
    put("in/a.mp4", longClip());
    put("in/deep/er/b.mp4");
    write("in/broken.mp4", std::string(5000, '\1'));
    write("in/empty.mp4", "");
    write("in/notes.txt", "not for us");
    write("in/panel.ts", "<TS language=\"de\"></TS>");
    put("in/.hidden.mp4");
    test::MovingScene scene;
    fs::create_directories(folder / "in/images");
    for (int i = 0; i < 12; ++i) cv::imwrite(at("in/images/" + std::to_string(10 + i) + ".png"), scene.draw(i));
    fs::create_directory_symlink(folder / "in", folder / "in/deep/again");

    const auto result = batch({"--jobs", "2"});
    EXPECT_EQ(result.exit_code, 3) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("5 files: 3 done, 2 failed"));
    EXPECT_THAT(result.output, HasSubstr("failed       broken.mp4: "));
    EXPECT_TRUE(isFinished("out/a.eyrie", kFramesOfLong));
    EXPECT_TRUE(isFinished("out/deep/er/b.eyrie"));
    EXPECT_EQ(runsOf("out/images.eyrie").at(0).frames_done, 12);
    EXPECT_THAT(inState("done"), ElementsAre("a.mp4", "deep/er/b.mp4", "images"));
    EXPECT_THAT(inState("failed"), ElementsAre("broken.mp4", "empty.mp4"));
    std::istringstream log(textOf("out/batch.jsonl"));
    int ended = 0;
    for (std::string line; std::getline(log, line);) {
        const auto entry = nlohmann::json::parse(line);
        if (entry["event"] != "working") ++ended;
        if (entry["event"] == "done" && entry["file"] == at("in/a.mp4")) {
            EXPECT_EQ(entry["frames"], kFramesOfLong);
            EXPECT_GE(entry["tracks"], 1);
        }
    }
    EXPECT_EQ(ended, 5);
}

TEST_F(Batches, aListOfPartsIsOneVideoAndItsPartsAreNone) {
    put("in/one.mp4");
    put("in/rec/a.mp4");
    put("in/rec/b.mp4");
    write("in/rec/whole.parts", "file\na.mp4\nb.mp4\n");
    write("in/rec/broken.parts", "nothing,of,the,kind\n");
    const auto result = batch();
    EXPECT_EQ(result.exit_code, 3) << result.errors;
    EXPECT_THAT(inState("done"), ElementsAre("one.mp4", "rec/whole.parts"));
    EXPECT_THAT(inState("failed"), ElementsAre("rec/broken.parts"));
    EXPECT_EQ(runsOf("out/rec/whole.eyrie").at(0).frames_done, 2 * kFrames);
    EXPECT_FALSE(fs::exists(at("out/rec/a.eyrie")));

    write("in/rec/whole.parts", "file\nb.mp4\n");
    const auto again = batch();
    EXPECT_THAT(inState("done"), ElementsAre("rec/a.mp4", "rec/whole.parts")) << again.output;
    EXPECT_EQ(runsOf("out/rec/whole.eyrie").back().frames_done, kFrames);
}

TEST_F(Batches, startedAgainSkipsWhatIsDoneAndDoesWhatCame) {
    put("in/a.mp4");
    ASSERT_EQ(batch().exit_code, 0);
    put("in/b.mp4");
    const auto result = batch();
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("2 files: 1 done, 1 done before"));
    EXPECT_TRUE(isFinished("out/a.eyrie"));
    EXPECT_TRUE(isFinished("out/b.eyrie"));
    // Other options are another piece of work.
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("2 files: 2 done"));
}

TEST_F(Batches, goesOnAfterAKill) {
    put("in/a.mp4", longClip());
    put("in/b.mp4", longClip());
    put("in/c.mp4");
    test::Process process(command("batch", {"--jobs", "2"}));
    test::waitUntil("some frames are done",
                    [&] { return !runsOf("out/a.eyrie").empty() && runsOf("out/a.eyrie")[0].frames_done > 5; });
    kill(process.pid(), SIGKILL);
    process.wait();
    // Those at work end by themselves, so that nobody holds their projects.
    test::waitUntil("nobody writes a run any more", [&] {
        const auto a = runsOf("out/a.eyrie");
        const auto b = runsOf("out/b.eyrie");
        return (a.empty() || !a[0].live) && (b.empty() || !b[0].live);
    });
    const auto result = batch();
    EXPECT_EQ(result.exit_code, 0) << result.errors << result.output;
    for (const char* project : {"out/a.eyrie", "out/b.eyrie"})
        EXPECT_TRUE(isFinished(project, kFramesOfLong)) << project;
    EXPECT_TRUE(isFinished("out/c.eyrie"));
}

TEST_F(Batches, aSecondOneOnTheSameResultsIsRefused) {
    for (const char* name : {"in/a.mp4", "in/b.mp4"}) put(name, longClip());
    test::Process process(command("batch", {"--jobs", "1"}));
    test::waitUntil("a run has begun", [&] { return !runsOf("out/a.eyrie").empty(); });
    const auto second = batch({"--jobs", "1"});
    EXPECT_EQ(second.exit_code, 4);
    EXPECT_THAT(second.errors, HasSubstr("another batch or watch, process " + std::to_string(process.pid())));
    const auto shard = batch({"--shard", "1/2"});
    EXPECT_EQ(shard.exit_code, 4) << "it does a part of the same";
    EXPECT_THAT(shard.errors, HasSubstr("process " + std::to_string(process.pid())));
    EXPECT_EQ(process.wait().exit_code, 0);
    EXPECT_EQ(runsOf("out/a.eyrie").size(), 1U);
    EXPECT_EQ(batch().exit_code, 0);  // the first one's lock is gone
}

TEST_F(Batches, aBatchAndAWatchAreRefusedBesideEachOther) {
    put("in/a.mp4");
    test::Process watching(command("watch", {"--settle", "0"}));
    test::waitUntil("it is listed", [&] { return !inState("done", "out/watch.csv").empty(); });
    const auto refused = batch();
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_THAT(refused.errors, HasSubstr("another batch or watch, process " + std::to_string(watching.pid())));
    EXPECT_EQ(batch({"--shard", "2/2"}).exit_code, 4);
    EXPECT_EQ(test::runProcess(command("watch")).exit_code, 4);
    kill(watching.pid(), SIGTERM);
    EXPECT_EQ(watching.wait().exit_code, 130);
    EXPECT_EQ(batch().exit_code, 0) << "the lock is gone with it";
}

TEST_F(Batches, partsOfOneDivisionWorkBesideEachOtherAndOthersDoNot) {
    put("in/a.mp4");
    fs::create_directories(folder / "out");
    const auto lock = FileLock::tryTake(folder / "out/batch-2-of-3.lock");
    ASSERT_EQ(lock.outcome, FileLock::Outcome::taken);
    EXPECT_EQ(batch({"--shard", "1/3", "--frames", "0:3"}).exit_code, 0);
    EXPECT_EQ(batch({"--shard", "2/3", "--frames", "0:3"}).exit_code, 4);
    EXPECT_EQ(batch({"--shard", "1/2", "--frames", "0:3"}).exit_code, 4) << "its files are those of others there";
    EXPECT_EQ(batch({"--frames", "0:3"}).exit_code, 4);
    EXPECT_EQ(test::runProcess(command("watch")).exit_code, 4);
}

TEST_F(Batches, stopsWhenAskedAndSaysSo) {
    put("in/a.mp4", longClip());
    put("in/b.mp4");
    test::Process process(command("batch", {"--jobs", "1"}));
    test::waitUntil("some frames are done",
                    [&] { return !runsOf("out/a.eyrie").empty() && runsOf("out/a.eyrie")[0].frames_done > 5; });
    kill(process.pid(), SIGTERM);
    const auto result = process.wait();
    EXPECT_EQ(result.exit_code, 130);
    EXPECT_THAT(result.errors, HasSubstr("the same command continues"));
    EXPECT_THAT(inState("stopped"), ElementsAre("a.mp4"));
    EXPECT_TRUE(runsOf("out/b.eyrie").empty());
    EXPECT_EQ(batch().exit_code, 0);
    EXPECT_TRUE(isFinished("out/a.eyrie", kFramesOfLong));
}

TEST_F(Batches, shardsDoEveryFileOnce) {
    std::vector<std::string> all;
    for (const char* name : {"a", "b", "c", "d", "e"}) put("in/" + std::string(name) + ".mp4");
    for (const char* shard : {"1/3", "2/3", "3/3"}) {
        ASSERT_EQ(batch({"--shard", shard, "--frames", "0:3"}).exit_code, 0);
        const std::string part(1, shard[0]);
        for (const std::string& name : inState("done", "out/batch-" + part + "-of-3.csv")) all.push_back(name);
    }
    EXPECT_THAT(all, UnorderedElementsAre("a.mp4", "b.mp4", "c.mp4", "d.mp4", "e.mp4"));
}

TEST_F(Batches, aFileStaysInItsPartWhateverComesBesideIt) {
    const std::vector<std::string> old{"b.mp4", "c.mp4", "d.mp4", "e.mp4", "f.mp4", "g.mp4"};
    for (const std::string& name : old) put("in/" + name);
    ASSERT_EQ(batch({"--shard", "1/2", "--frames", "0:3"}).exit_code, 0);
    std::vector<std::string> done = inState("done", "out/batch-1-of-2.csv");
    put("in/a.mp4");
    put("in/bb.mp4");
    ASSERT_EQ(batch({"--shard", "2/2", "--frames", "0:3"}).exit_code, 0);
    EXPECT_THAT(inState("done before", "out/batch-2-of-2.csv"), testing::IsEmpty());
    for (const std::string& name : inState("done", "out/batch-2-of-2.csv")) done.push_back(name);
    EXPECT_THAT(done, testing::IsSupersetOf(old));
}

TEST_F(Batches, filesThatDifferInTheirEndingGetProjectsOfTheirOwn) {
    put("in/a.mp4");
    put("in/a.mov");
    ASSERT_EQ(batch().exit_code, 0);
    ASSERT_EQ(batch().exit_code, 0) << "the second time, too";
    EXPECT_TRUE(isFinished("out/a.eyrie"));
    EXPECT_TRUE(isFinished("out/a.mp4.eyrie"));
    EXPECT_FALSE(fs::exists(at("out/a.mov.eyrie")));
}

TEST_F(Batches, aVideoKeepsItsProjectWhenTheOneBesideItGoes) {
    write("in/a.mov", "not found: ask the archive");
    put("in/a.mp4");
    EXPECT_EQ(batch({"--frames", "0:3"}).exit_code, 3);
    ASSERT_EQ(runsOf("out/a.mp4.eyrie").size(), 1U);
    fs::remove(folder / "in/a.mov");
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("1 file: 1 done before"));
    EXPECT_TRUE(runsOf("out/a.eyrie").empty());
    EXPECT_EQ(runsOf("out/a.mp4.eyrie").size(), 1U);
}

TEST_F(Batches, aVideoKeepsItsProjectWhenOthersComeBesideIt) {
    put("in/a.mp4");
    ASSERT_EQ(batch({"--frames", "0:3"}).exit_code, 0);
    put("in/a.mov");
    put("in/a.mov.mp4");  // would like the name that is left to a.mov
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("3 files: 2 done, 1 done before"));
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("3 files: 3 done before"));
    for (const char* project : {"out/a.eyrie", "out/a.mov.eyrie", "out/a.mov.mp4.eyrie"}) {
        EXPECT_EQ(runsOf(project).size(), 1U) << project;
    }
}

TEST_F(Batches, aFolderThatIsCalledLikeAProjectIsNotInTheWay) {
    put("in/a.mp4");
    fs::create_directories(folder / "out/a.eyrie");
    EXPECT_EQ(batch({"--frames", "0:3"}).exit_code, 0);
    EXPECT_EQ(runsOf("out/a.mp4.eyrie").size(), 1U);
}

TEST(WorkOfABatch, isOneForAllThatMayWantTheSameProject) {
    const auto work = [](const char* name) {
        cli::BatchInput input;
        input.path = input.name = name;
        return cli::nameOfWork(input).string();
    };
    for (const char* name : {"day/a.mov", "day/a.mp4", "day/a.mp4.mov", "day/a.mp4.parts", "day/a.MOV.mp4"})
        EXPECT_EQ(work(name), "day/a") << name;
    EXPECT_EQ(work("day/a.2024.mp4"), "day/a.2024");
    EXPECT_EQ(work("night/a.mp4"), "night/a");
}

TEST_F(Batches, sameNamesInSeveralPlacesStayApart) {
    for (const char* card : {"1", "2", "3"}) put("cards/" + std::string(card) + "/DCIM/film.mp4");
    std::vector<std::string> words{test::programPath("eyrie-cli"),
                                   "batch",
                                   "--out",
                                   at("out"),
                                   "--set",
                                   "view.oblique=false",
                                   "--frames",
                                   "0:3",
                                   "--gsd",
                                   "0.2",
                                   at("cards/1/DCIM"),
                                   at("cards/2/DCIM"),
                                   at("cards/3/DCIM"),
                                   at("cards/1/DCIM/film.mp4")};
    const auto result = test::runProcess(words);
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("3 files: 3 done")) << "named twice it is done once";
    int projects = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "out"))
        projects += entry.path().extension() == ".eyrie";
    EXPECT_EQ(projects, 3);
}

TEST_F(Batches, shardsDoNotMeanTheSameProject) {
    put("in/a.mov");
    put("in/a.mp4");
    ASSERT_EQ(batch({"--shard", "2/2"}).exit_code, 0);
    ASSERT_EQ(batch({"--shard", "1/2"}).exit_code, 0);
    EXPECT_TRUE(isFinished("out/a.eyrie"));
    EXPECT_TRUE(isFinished("out/a.mp4.eyrie"));
}

TEST_F(Batches, aFileWithOtherContentsIsDoneAgain) {
    put("in/a.mp4");
    ASSERT_EQ(batch({"--frames", "0:3"}).exit_code, 0);
    fs::last_write_time(folder / "in/a.mp4", fs::file_time_type::clock::now() + std::chrono::seconds(5));
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("1 file: 1 done"));
    EXPECT_EQ(runsOf("out/a.eyrie").size(), 2U);
}

TEST_F(Batches, aFileThatChangedInTheSecondOfItsRunIsDoneAgain) {
    put("in/a.mp4");
    ASSERT_EQ(batch({"--frames", "0:1"}).exit_code, 0);
    beganAt("out/a.eyrie", "500000");
    changedAt("in/a.mp4", 400'000);
    EXPECT_THAT(batch({"--frames", "0:1"}).output, HasSubstr("1 file: 1 done before\n"));
    changedAt("in/a.mp4", 600'000);
    EXPECT_THAT(batch({"--frames", "0:1"}).output, HasSubstr("1 file: 1 done\n"));
    EXPECT_EQ(runsOf("out/a.eyrie").size(), 2U);
}

TEST_F(Batches, aFileThatMayHaveChangedSinceItsRunBeganIsDoneAgain) {
    put("in/a.mp4");
    ASSERT_EQ(batch({"--frames", "0:1"}).exit_code, 0);
    const auto doesAgain = [&](const char* began, int changed_us) {
        beganAt("out/a.eyrie", began);
        changedAt("in/a.mp4", changed_us);
        return batch({"--frames", "0:1"}).output.find("1 file: 1 done\n") != std::string::npos;
    };
    EXPECT_FALSE(doesAgain("NULL", -100'000));
    EXPECT_TRUE(doesAgain("NULL", 100'000)) << "an older version did not keep when in the second its run began";
    EXPECT_TRUE(doesAgain("500000", 495'000)) << "times of files tick";
    EXPECT_TRUE(doesAgain("500000", 0)) << "some disks keep whole seconds";
    EXPECT_FALSE(doesAgain("500000", -3'000'000));
}

TEST_F(Batches, aFolderWithOtherPicturesIsDoneAgainHoweverOldTheyAre) {
    putPictures(8);
    const auto said = [&] { return batch().output; };
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done\n"));
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done before\n"));
    fs::remove(folder / "in/day/b02.png");
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done\n")) << "one was taken away";
    EXPECT_EQ(runsOf("out/day.eyrie").back().frames_done, 7);
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done before\n"));
    copyAsItIs("in/day/A01.png", "in/day/z.png");
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done\n")) << "an old one was put in";
    copyAsItIs("in/day/A03.png", "in/day/z.png");
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done\n")) << "an old one was put in another's place";
    fs::rename(folder / "in/day/z.png", folder / "in/day/0.png");
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done\n")) << "they are in another order";
    EXPECT_THAT(said(), HasSubstr("1 file: 1 done before\n"));
}

TEST_F(Batches, aVideoInWhosePlaceAnOlderOneWasPutIsDoneAgain) {
    put("in/a.mp4");
    ASSERT_EQ(batch({"--frames", "0:3"}).exit_code, 0);
    fs::copy_file(longClip(), folder / "in/a.mp4", fs::copy_options::overwrite_existing);
    makeOld("in/a.mp4");
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("1 file: 1 done\n"));
    EXPECT_THAT(batch({"--frames", "0:3"}).output, HasSubstr("1 file: 1 done before\n"));
}

TEST_F(Batches, ofAFolderOfBeforeItIsKnownHowManyPicturesThereWere) {
    putPictures(5);
    ASSERT_EQ(batch().exit_code, 0);
    SQLite::Database(at("out/day.eyrie"), SQLite::OPEN_READWRITE).exec("UPDATE run SET source_digest = ''");
    EXPECT_THAT(batch().output, HasSubstr("1 file: 1 done before\n"));
    fs::remove(folder / "in/day/b04.png");
    EXPECT_THAT(batch().output, HasSubstr("1 file: 1 done\n"));
}

TEST_F(Batches, whatWasStoppedGoesOnInItsPicturesAndBeginsAnewInOthers) {
    putPictures(kFramesOfLong);
    const auto stop = [&](std::size_t run) {
        test::Process process(command("batch", {"--jobs", "1"}));
        test::waitUntil("some frames are done", [&] {
            const auto runs = runsOf("out/day.eyrie");
            return runs.size() == run && runs.back().frames_done > 5;
        });
        kill(process.pid(), SIGTERM);
        EXPECT_EQ(process.wait().exit_code, 130);
    };
    stop(1);
    fs::remove(folder / "in/day/A09.png");  // one that was done
    stop(2);
    const auto result = batch();
    EXPECT_EQ(result.exit_code, 0) << result.output;
    const auto runs = runsOf("out/day.eyrie");
    ASSERT_EQ(runs.size(), 2U);
    EXPECT_EQ(runs[1].state, RunState::finished);
    EXPECT_EQ(runs[1].frames_done, kFramesOfLong - 1);
}

TEST_F(Batches, textThatIsCalledAVideoIsListedWithTheReason) {
    put("in/a.mp4");
    write("in/bad.mp4", "not found: ask the archive");
    const auto result = batch({"--frames", "0:3"});
    EXPECT_NE(result.exit_code, 0);
    EXPECT_THAT(inState("failed", "out/batch.csv"), ElementsAre("bad.mp4"));
    EXPECT_THAT(inState("done", "out/batch.csv"), ElementsAre("a.mp4"));
    // What to do with labels is no help with a video that is none.
    EXPECT_THAT(result.output, HasSubstr("copy or record the video again"));
}

TEST_F(Batches, aFileIsTakenOnceItHasArrived) {
    fs::create_directories(folder / "in");
    test::Process process(command("watch", {"--settle", "2"}));
    std::ifstream clip(drawnClip(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(clip), {}};
    std::ofstream arriving(folder / "in/a.mp4", std::ios::binary);
    const std::size_t part = bytes.size() / 12 + 1;
    // It comes slowly, as from a camera's card, for longer than --settle says, yet each part much sooner: there is
    // nothing to wait for.
    constexpr auto kBetweenParts = std::chrono::milliseconds(250);
    for (std::size_t from = 0; from < bytes.size(); from += part) {
        arriving.write(bytes.data() + from, static_cast<std::streamsize>(std::min(part, bytes.size() - from)));
        arriving.flush();
        std::this_thread::sleep_for(kBetweenParts);
    }
    // The list is written after the project.
    test::waitUntil("the clip is listed as done", [&] { return !inState("done", "out/watch.csv").empty(); });
    kill(process.pid(), SIGTERM);
    EXPECT_EQ(process.wait().exit_code, 130);
    EXPECT_THAT(inState("failed", "out/watch.csv"), ElementsAre()) << "it was not tried half";
    EXPECT_THAT(inState("done", "out/watch.csv"), ElementsAre("a.mp4"));
}

TEST_F(Batches, theLogIsCompleteThoughItCouldNotBeWrittenForAWhile) {
    fs::create_directories(folder / "in");
    test::Process process(command("watch", {"--settle", "0", "--frames", "0:3"}));
    const auto arrives = [&](const std::string& name) {
        put("in/" + name);
        test::waitUntil(name + " is done", [&] {
            const auto done = inState("done", "out/watch.csv");
            return std::find(done.begin(), done.end(), name) != done.end();
        });
    };
    arrives("a.mp4");
    fs::remove(folder / "out/watch.jsonl");
    fs::create_directories(folder / "out/watch.jsonl");
    arrives("b.mp4");
    fs::remove(folder / "out/watch.jsonl");
    arrives("c.mp4");
    kill(process.pid(), SIGTERM);
    EXPECT_EQ(process.wait().exit_code, 130);
    EXPECT_THAT(textOf("out/watch.jsonl"), HasSubstr("b.mp4"));
}

TEST_F(Batches, aPlaceWithoutAnyVideoIsAnErrorAsAnUnmountedDiskLooksSo) {
    fs::create_directories(folder / "in");
    const auto done = batch();
    EXPECT_EQ(done.exit_code, 3);
    EXPECT_THAT(done.errors, testing::AllOf(HasSubstr("there is no video in"), HasSubstr("mounted")));
    EXPECT_FALSE(fs::exists(folder / "out")) << "nothing was begun";
}

TEST_F(Batches, whatCannotBeIsRefusedBeforeTheWork) {
    put("in/a.mp4");
    for (const char* shard : {"0/3", "4/3", "1/0", "x", "1/2/3"}) {
        const auto result = batch({"--shard", shard});
        EXPECT_EQ(result.exit_code, 2) << shard;
        EXPECT_THAT(result.errors, HasSubstr("2/8"));
        EXPECT_THAT(result.errors, HasSubstr("SLURM_ARRAY_TASK_COUNT"));
    }
    EXPECT_EQ(batch({"--gsd", "-1"}).exit_code, 2);
    EXPECT_EQ(test::runProcess({test::programPath("eyrie-cli"), "batch", at("absent"), "--out", at("out")}).exit_code,
              3);
    const auto no_folder =
        test::runProcess({test::programPath("eyrie-cli"), "batch", at("in"), "--out", at("in/a.mp4/out")});
    EXPECT_EQ(no_folder.exit_code, 4);
    EXPECT_THAT(no_folder.errors, HasSubstr("in/a.mp4/out: the folder cannot be made"));
    EXPECT_THAT(no_folder.errors, HasSubstr("choose another with --out"));
    EXPECT_EQ(test::runProcess({test::programPath("eyrie-cli"), "batch", at("in"), "--out", at("in/a.mp4")}).exit_code,
              4);
    write("out/batch.csv/x", "a folder where the summary should be");
    EXPECT_EQ(batch().exit_code, 4);
    EXPECT_FALSE(fs::exists(at("out/a.eyrie")));
}

}  // namespace
}  // namespace eyrie::batch_test

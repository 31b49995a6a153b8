#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "store/labels/annotation_store.h"
#include "store/review/review_samples.h"
#include "store/review/review_store.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::killed_review_test {
namespace {

/// Judges ten events, adds a zone and corrects a track a step until it is killed, and tells the pipe of each step that
/// is on screen.
[[noreturn]] void judgeUntilKilled(const std::filesystem::path& path, int pipe_end) {
    try {
        ProjectFile project = ProjectFile::open(path);
        ReviewStore store(project, 1);
        if (store.readOnly()) _exit(2);
        for (;;) {
            ReviewEdit edit{"Judge ten", {}, {}};
            for (int i = 0; i < 10; ++i) {
                edit.verdicts.push_back({std::nullopt, test::sampleVerdict(store.newVerdictId())});
            }
            edit.zones.push_back({std::nullopt, test::sampleZone(store.newZoneId())});
            edit.corrections.push_back({std::nullopt, test::sampleCorrection(store.newCorrectionId())});
            store.apply(edit);
            const char message = 1;
            if (write(pipe_end, &message, 1) != 1) break;
        }
    } catch (...) {
    }
    _exit(1);
}

TEST(KilledReview, LosesNothingThatWasJudgedAndTearsNoStepApart) {
    std::mt19937 dice(23);
    for (int round = 0; round < 6; ++round) {
        const test::TemporaryFolder folder;
        const auto path = folder / "clip.eyrie";
        {
            ProjectFile project = ProjectFile::create(path);
            ensureSequence(project, test::sampleRun().sequence);
        }
        int ends[2];
        ASSERT_EQ(pipe(ends), 0);
        const pid_t child = fork();
        if (child == 0) {
            close(ends[0]);
            judgeUntilKilled(path, ends[1]);
        }
        close(ends[1]);
        int reported = 0;
        char message = 0;
        const int wanted = static_cast<int>(1 + dice() % 30);
        while (reported < wanted && read(ends[0], &message, 1) == 1) ++reported;
        // The moment decides where inside the next step the axe falls; any is right.
        std::this_thread::sleep_for(std::chrono::microseconds(dice() % 3000));
        kill(child, SIGKILL);
        while (read(ends[0], &message, 1) == 1) ++reported;
        close(ends[0]);
        waitpid(child, nullptr, 0);

        ProjectFile project = ProjectFile::open(path);
        ReviewStore store(project, 1);
        EXPECT_FALSE(store.readOnly()) << "the dead hold no lock: " << store.readOnlyReason();
        ASSERT_GE(store.undoCount(), reported) << "a step is missing";
        ASSERT_LE(store.undoCount(), reported + 1);
        EXPECT_EQ(store.review().verdicts.size(), 10U * static_cast<unsigned>(store.undoCount()));
        EXPECT_EQ(store.review().zones.size(), static_cast<unsigned>(store.undoCount()));
        ASSERT_EQ(store.review().corrections.size(), static_cast<unsigned>(store.undoCount()));
        for (const auto& [id, correction] : store.review().corrections)
            EXPECT_EQ(correction, test::sampleCorrection(id));
        while (store.undo()) {
        }
        EXPECT_TRUE(store.review().zones.empty());
        EXPECT_TRUE(store.review().corrections.empty());
        EXPECT_TRUE(store.review().verdicts.empty());
    }
}

}  // namespace
}  // namespace eyrie::killed_review_test

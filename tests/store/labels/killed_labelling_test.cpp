#include <gmock/gmock.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>
#include <thread>

#include "store/following.h"
#include "store/labels/annotation_store.h"
#include "store/labels/label_samples.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::killed_labelling_test {
namespace {

/// What the labeller below does: step n draws object n, then objects are moved in turn, every tenth step is undone.
AnnotationEdit stepOf(const AnnotationSet& set, int step) {
    if (step % 3 == 0) return test::sampleEdit(step / 3 + 1);
    AnnotationEdit edit;
    edit.name = "step " + std::to_string(step);
    const LabelledObject& object = set.objects.at(step / 3 + 1);
    LabelledObject after = object;
    after.keyframes[1].box.centre.x += step;
    after.notes += std::to_string(step);
    edit.objects.push_back({object, after});
    return edit;
}

AnnotationSet stateAfter(int steps) {
    AnnotationSet set;
    for (int step = 0; step < steps; ++step) applyEdit(set, stepOf(set, step));
    return set;
}

/// Labels until it is killed, and tells the pipe of each step that is on screen.
[[noreturn]] void labelUntilKilled(const std::filesystem::path& path, int pipe_end) {
    try {
        ProjectFile project = ProjectFile::open(path);
        AnnotationStore store(project, 1);
        if (store.readOnly()) _exit(2);
        for (int step = 0;; ++step) {
            store.apply(stepOf(store.annotations(), step));
            const char message = 1;
            if (write(pipe_end, &message, 1) != 1) break;
        }
    } catch (...) {
    }
    _exit(1);
}

struct Child {
    pid_t pid = 0;
    int pipe_end = 0;
    int reported = 0;

    explicit Child(const std::filesystem::path& path) {
        int ends[2];
        if (pipe(ends) != 0) return;
        pid = fork();
        if (pid == 0) {
            close(ends[0]);
            labelUntilKilled(path, ends[1]);
        }
        close(ends[1]);
        pipe_end = ends[0];
    }
    void waitFor(int steps) {
        char message = 0;
        while (reported < steps && read(pipe_end, &message, 1) == 1) ++reported;
    }
    void killNow() {
        kill(pid, SIGKILL);
        char message = 0;
        while (read(pipe_end, &message, 1) == 1) ++reported;
        close(pipe_end);
        waitpid(pid, nullptr, 0);
    }
};

TEST(KilledLabelling, LosesNothingThatWasOnScreenAndCanBeUndone) {
    std::mt19937 dice(17);
    for (int round = 0; round < 8; ++round) {
        const test::TemporaryFolder folder;
        const auto path = folder / "clip.eyrie";
        {
            ProjectFile project = ProjectFile::create(path);
            ensureSequence(project, test::sampleRun().sequence);
        }
        Child child(path);
        child.waitFor(static_cast<int>(1 + dice() % 40));
        // The moment decides where inside the next step the axe falls; any is right.
        std::this_thread::sleep_for(std::chrono::microseconds(dice() % 3000));
        child.killNow();

        ProjectFile project = ProjectFile::open(path);
        AnnotationStore store(project, 1);
        EXPECT_FALSE(store.readOnly()) << "the dead hold no lock: " << store.readOnlyReason();
        const int steps = store.undoCount();
        ASSERT_GE(steps, child.reported) << "a step is missing";
        ASSERT_LE(steps, child.reported + 1);
        test::expectSame(store.annotations(), stateAfter(steps));
        for (int left = steps; left > 0; --left) ASSERT_TRUE(store.undo().has_value());
        EXPECT_TRUE(store.annotations().objects.empty());
    }
}

TEST(KilledLabelling, WhileAnotherProcessLabelsTheSecondReadsAndSaysWho) {
    const test::TemporaryFolder folder;
    const auto path = folder / "clip.eyrie";
    {
        ProjectFile project = ProjectFile::create(path);
        ensureSequence(project, test::sampleRun().sequence);
    }
    Child child(path);
    child.waitFor(3);
    ProjectFile project = ProjectFile::open(path);
    AnnotationStore store(project, 1);
    EXPECT_TRUE(store.readOnly());
    EXPECT_THAT(store.readOnlyReason(), testing::HasSubstr("process " + std::to_string(child.pid) + " on "));
    EXPECT_FALSE(store.tryToWrite());
    // Closing files of the project in this process frees nobody's lock.
    { ProjectFile another = ProjectFile::open(path); }
    EXPECT_FALSE(store.tryToWrite());
    // Until it has done more than was read.
    child.waitFor(store.undoCount() + 2);
    EXPECT_TRUE(test::follows(store, path));
    EXPECT_GE(store.annotations().objects.size(), 2U);
    child.killNow();
    EXPECT_TRUE(store.tryToWrite()) << store.readOnlyReason();
    EXPECT_GE(store.undoCount(), child.reported);
}

}  // namespace
}  // namespace eyrie::killed_labelling_test

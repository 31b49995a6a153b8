#include "store/runs/run_counts.h"

#include <gtest/gtest.h>

#include "store/database/change_watch.h"
#include "store/labels/annotation_store.h"
#include "store/runs/result_writer.h"
#include "store/samples.h"
#include "support/temporary_folder.h"

namespace eyrie::run_counts_test {
namespace {

/// A frame that could not be registered for a reason.
FrameResult failed(FrameIndex frame, const RegistrationFailure& failure) {
    FrameResult result;
    result.motion.frame = frame;
    result.motion.registration.state = RegistrationState::failed;
    result.motion.registration.failure = failure;
    return result;
}

class RunCountsTest : public testing::Test {
 protected:
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "clip.eyrie";
};

}  // namespace

TEST_F(RunCountsTest, ReasonsAreCountedWithoutTheirFigures) {
    ProjectFile project = ProjectFile::create(path_);
    ResultWriter writer(path_, test::sampleRun(), {});
    writer.write(failed(0, {.fault = RegistrationFault::cut}));
    writer.write(failed(1, {.fault = RegistrationFault::too_few_corners, .count = 12, .of = 40}));
    writer.write(failed(2, {.fault = RegistrationFault::too_few_corners, .count = 9, .of = 40}));
    const RunCounts counts = countRun(project, writer.runId());
    EXPECT_EQ(counts.frames, 3);
    EXPECT_EQ(counts.unregistered, 3);
    ASSERT_EQ(counts.reasons.size(), 2U);
    EXPECT_EQ(counts.reasons[0].fault, RegistrationFault::too_few_corners);
    EXPECT_EQ(counts.reasons[0].frames, 2);
    EXPECT_EQ(counts.reasons[1].frames, 1);
}

TEST_F(RunCountsTest, CountsAgreeWithTheFrames) {
    const int run = test::writeSampleProject(path_, 8);
    ProjectFile project = ProjectFile::open(path_);
    const RunCounts counts = countRun(project, run);
    const RunStore store(project);
    long vectors = 0;
    long detections = 0;
    for (const FrameSummary& frame : store.frameSummaries(run)) {
        vectors += frame.motion_vectors;
        detections += frame.detections;
    }
    EXPECT_EQ(counts.frames, 8);
    EXPECT_EQ(counts.unregistered, 2);  // every fourth
    EXPECT_EQ(counts.motion_vectors, vectors);
    EXPECT_EQ(counts.detections, detections);
    EXPECT_TRUE(counts.any_detection);
    int confirmed = 0;
    for (const TrackSummary& track : store.tracks(run)) confirmed += track.confirmed ? 1 : 0;
    EXPECT_EQ(counts.tracks, confirmed);
    EXPECT_EQ(countRun(project, run + 1).frames, 0);
}

TEST_F(RunCountsTest, AWatchTellsWhatOthersCommit) {
    const int run = test::writeSampleProject(path_, 2);
    ProjectFile mine = ProjectFile::open(path_);
    ProjectFile other = ProjectFile::open(path_);
    ChangeWatch watch(mine);
    watch.changed();
    EXPECT_FALSE(watch.changed());
    RunStore(other).rename(run, "by another");
    EXPECT_TRUE(watch.changed());
    EXPECT_FALSE(watch.changed());
}

TEST_F(RunCountsTest, ARelocatedVideoKeepsItsRuns) {
    const int run = test::writeSampleProject(path_, 2);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    const int sequence = store.run(run)->sequence.id;
    relocateSequence(project, sequence, "/elsewhere/street.mp4");
    EXPECT_EQ(store.run(run)->sequence.path, "/elsewhere/street.mp4");
    EXPECT_EQ(store.run(run)->sequence.id, sequence);
}

TEST_F(RunCountsTest, AVideoIsNotRelocatedToThePlaceOfAnother) {
    const int run = test::writeSampleProject(path_, 2);
    ProjectFile project = ProjectFile::open(path_);
    const RunStore store(project);
    const SequenceRecord before = store.run(run)->sequence;
    SequenceRecord other = before;
    other.path = "/elsewhere/other.mp4";
    ensureSequence(project, other);
    try {
        relocateSequence(project, before.id, other.path);
        FAIL() << "two videos of one path";
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        for (const std::string& named : {path_.string(), other.path, before.path})
            EXPECT_NE(std::string(error.what()).find(named), std::string::npos) << error.what();
    }
    EXPECT_EQ(store.run(run)->sequence.path, before.path);
    other.size.width += 2;
    other.path = "/elsewhere/larger.mp4";
    ensureSequence(project, other);
    EXPECT_NO_THROW(relocateSequence(project, before.id, other.path)) << "it is told apart by its size";
}

}  // namespace eyrie::run_counts_test

#include "sweep/clip_opening.h"

#include <SQLiteCpp/SQLiteCpp.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "chain/chain_options.h"
#include "core/error.h"
#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"
#include "sweep/sweep_scene.h"

namespace eyrie::clip_opening_test {
namespace {

using testing::HasSubstr;

class StoredRuns : public testing::Test {
 protected:
    /// A run over these frames, whose motion tells what it is.
    int add(FrameIndex first, int frames) {
        ProjectFile::openOrCreate(path_);
        RunRecord run;
        run.sequence.path = "/videos/street.mp4";
        run.sequence.size = {320, 240};
        run.sequence.frame_count = 100;
        run.sequence.frame_rate_hz = 25;
        run.scale = {0.25, 25, true};
        run.first_frame = first;
        run.last_frame = first + 9;
        ResultWriter writer(path_, run, parameterValues(sweepBase()));
        for (FrameIndex frame = first; frame < first + frames; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.image_size = run.sequence.size;
            result.motion.motion_vectors.push_back({1, {5.F + static_cast<float>(frame), 7}, {1, 0}, 9});
            result.motion.corner_count = 1;
            writer.write(result);
        }
        writer.finish(RunState::stopped, "");
        return writer.runId();
    }
    std::string refusal(std::optional<int> id = {}) {
        ProjectFile project = ProjectFile::openOrCreate(path_);
        try {
            readStoredRun(project, id);
        } catch (const Error& error) {
            return error.what();
        }
        return "read";
    }
    static ChainOptions sweepBase() { return test::sweepBase(); }

    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
};

}  // namespace

TEST_F(StoredRuns, TheNewestIsReadUnlessOneIsNamed) {
    EXPECT_THAT(refusal(), HasSubstr("p.eyrie: holds no run"));
    const int one = add(20, 1), more = add(40, 3);
    ProjectFile project = ProjectFile::open(path_);
    for (const auto& [asked, id, first, frames] : {std::tuple(std::optional<int>(), more, 40, 3),
                                                   {std::optional(more), more, 40, 3},
                                                   {std::optional(one), one, 20, 1}}) {
        const StoredRun run = readStoredRun(project, asked);
        EXPECT_EQ(run.record.id, id);
        EXPECT_EQ(run.clip.run, id);
        EXPECT_EQ(run.clip.sequence, "/videos/street.mp4");
        EXPECT_EQ(run.clip.size, cv::Size(320, 240));
        EXPECT_EQ(run.clip.scale.gsd_m_per_px, 0.25);
        EXPECT_EQ(run.options.detection.method, DetectionMethod::gradient);
        EXPECT_EQ(run.range.first, first) << "what is there of it, not what was planned";
        EXPECT_EQ(run.range.last, first + frames - 1);
        ASSERT_EQ(run.motion.size(), static_cast<std::size_t>(frames));
        for (int i = 0; i < frames; ++i) {
            EXPECT_EQ(run.motion[static_cast<std::size_t>(i)].frame, first + i);
            EXPECT_EQ(run.motion[static_cast<std::size_t>(i)].motion_vectors.at(0).position.x,
                      5.F + static_cast<float>(first + i));
        }
    }
    EXPECT_THAT(refusal(77), HasSubstr("there is no run 77; it holds the runs " + std::to_string(one) + ", " +
                                       std::to_string(more)));
}

TEST_F(StoredRuns, OneWithoutAFrameIsRefused) {
    const int none = add(20, 0);
    EXPECT_THAT(refusal(), HasSubstr("run " + std::to_string(none) + " has no frame"));
    EXPECT_THAT(refusal(77), HasSubstr("there is no run 77; it holds run " + std::to_string(none) + " alone"));
}

TEST_F(StoredRuns, WhoseDetailsWereNotKeptHaveNoMotion) {
    add(20, 3);
    ProjectFile project = ProjectFile::open(path_);
    project.database().exec("UPDATE frame SET details = 0 WHERE frame = 21");
    const StoredRun run = readStoredRun(project);
    EXPECT_TRUE(run.motion.empty());
    EXPECT_EQ(run.range.last, 22);
}

TEST(OpenedClip, KnowsItsSizeFramesAndDigest) {
    SweepClip clip;
    clip.scale = test::kSweepScale;
    GroundTruth truth;
    truth.boxes = test::sweepTruth();
    truth.has_headings = false;
    truth.remarks = {"odd"};
    FrameRange range;
    range.first = 3;
    range.last = 12;
    SweepInput input = openClip(clip, test::sweepSource, range, truth, {});
    EXPECT_EQ(clip.size, cv::Size(320, 240));
    EXPECT_EQ(clip.first_frame, 3);
    EXPECT_EQ(clip.last_frame, 12);
    EXPECT_TRUE(clip.upright) << "true boxes that cannot be turned are compared as upright ones";
    EXPECT_EQ(clip.digest, digestOf(test::sweepSource()->read(3, false), input.scoring.truth.boxes));
    OpenedClips clips;
    clips.add(clip, std::move(input));
    EXPECT_THAT(clips.remarks, testing::Contains(std::string("odd")));
    EXPECT_EQ(clips.clips.size(), 1U);
    EXPECT_EQ(clips.inputs.size(), 1U);
}

}  // namespace eyrie::clip_opening_test

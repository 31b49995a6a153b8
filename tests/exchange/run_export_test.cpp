#include "exchange/run_export.h"

#include <gmock/gmock.h>

#include "core/error.h"
#include "exchange/project_labels.h"
#include "formats/track_world.h"
#include "store/project/video_start.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::run_export_test {
namespace {

class RunExport : public testing::Test {
 protected:
    RunExport()
        : run_(test::writeRun(folder_ / "p.eyrie", 10,
                              [](int frame, FrameResult& result) {
                                  result.motion.time_us = 40'000 * frame;
                                  TrackState state;
                                  state.id = 1;
                                  state.box = {{30.0 + 2 * frame, 40}, 20, 8, 0};
                                  state.status = TrackStatus::confirmed;
                                  result.tracks = {state};
                              })),
          project_(ProjectFile::open(folder_ / "p.eyrie", ProjectFile::Mode::read_only)),
          store_(project_),
          labels_(labelStreamOf(store_, run_, false)) {}

    /// A video that cannot be opened.
    OpenVideo broken() {
        return [this]() -> std::unique_ptr<FrameSource> {
            ++asked_;
            throw Error(ErrorKind::input, "the video is gone");
        };
    }
    /// As both programs do before they write.
    std::unique_ptr<FrameSource> world(const std::string& format, const OpenVideo& open,
                                       const std::stop_token& stop = {}) {
        auto video = openVideoFor(format, run_, open, stop);
        addWorld(labels_, format, project_, run_, video.get(), {}, stop);
        return video;
    }

    /// What is thrown; empty where nothing is.
    static std::string refusal(const std::function<void()>& what) {
        try {
            what();
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    test::TemporaryFolder folder_;
    RunRecord run_;
    ProjectFile project_;
    RunStore store_;
    LabelStream labels_;
    int asked_ = 0;
};

TEST_F(RunExport, aFormatOfBoxesAloneDoesNotAskForTheVideo) {
    EXPECT_EQ(world("native", broken()), nullptr);
    EXPECT_EQ(asked_, 0);
    EXPECT_EQ(labels_.about.world, nullptr);
}

TEST_F(RunExport, aFormatWithTimesIsWrittenWithoutTheVideo) {
    EXPECT_EQ(world("tracks-csv", broken()), nullptr);
    EXPECT_EQ(asked_, 1);
    ASSERT_NE(labels_.about.world, nullptr);
    EXPECT_NEAR(labels_.about.world->seconds(5), 0.2, 1e-6);
}

TEST_F(RunExport, aCopyOfTheVideoNeedsIt) {
    EXPECT_THAT(refusal([&] { world(kVmtiFormat, broken()); }), testing::HasSubstr("the video is gone"));
    EXPECT_THAT(refusal([&] { world(kVmtiFormat, [] { return nullptr; }); }), testing::HasSubstr("is needed"));
}

TEST_F(RunExport, whatIsStoppedIsNotWrittenWithLess) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(refusal([&] { world("tracks-csv", broken(), stop.get_token()); }), testing::HasSubstr("is gone"));
    EXPECT_THAT(refusal([&] {
                    world(
                        "tracks-csv", [] { return nullptr; }, stop.get_token());
                }),
                testing::HasSubstr("stopped"));
}

/// A video that is not read.
class SilentVideo : public FrameSource {
 public:
    SilentVideo() {
        info_.size = {320, 240};
        info_.frame_count = 10;
        info_.frame_rate_hz = 25;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex, bool) override { return {}; }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000LL; }

 private:
    VideoInfo info_;
};

TEST_F(RunExport, theVideoIsHandedOnWhereTheFormatTellsTimes) {
    const OpenVideo open = [this]() -> std::unique_ptr<FrameSource> {
        ++asked_;
        return std::make_unique<SilentVideo>();
    };
    EXPECT_NE(openVideoFor("tracks-csv", run_, open), nullptr);
    EXPECT_NE(openVideoFor(kVmtiFormat, run_, open), nullptr);
    EXPECT_EQ(openVideoFor("native", run_, open), nullptr);
    EXPECT_EQ(openVideoFor("no such format", run_, open), nullptr);
    EXPECT_EQ(asked_, 2);
    EXPECT_EQ(openVideoFor("tracks-csv", run_, [] { return nullptr; }), nullptr);
}

TEST_F(RunExport, timesCountFromTheStartThatIsSaidOrThatTheProjectKeeps) {
    addWorld(labels_, "tracks-csv", project_, run_, nullptr, 5'000'000);
    ASSERT_TRUE(labels_.about.world->utc_us);
    EXPECT_EQ(labels_.about.world->utc_us(5), 5'200'000);
    addWorld(labels_, "tracks-csv", project_, run_, nullptr);
    EXPECT_FALSE(labels_.about.world->utc_us);
    {
        ProjectFile writable = ProjectFile::open(folder_ / "p.eyrie");
        storeVideoStart(writable, run_.sequence.id, 1'231'798'102'000'000);
    }
    ProjectFile again = ProjectFile::open(folder_ / "p.eyrie", ProjectFile::Mode::read_only);
    addWorld(labels_, "tracks-csv", again, run_, nullptr);
    ASSERT_TRUE(labels_.about.world->utc_us);
    EXPECT_EQ(labels_.about.world->utc_us(0), 1'231'798'102'000'000);
    addWorld(labels_, kVmtiFormat, again, run_, nullptr, 7'000'000);
    EXPECT_EQ(labels_.about.world->utc_us(0), 7'000'000) << "what is said now counts";
}

}  // namespace
}  // namespace eyrie::run_export_test

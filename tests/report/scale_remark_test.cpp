#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "metadata/transport_stream.h"
#include "report/review/review_report.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

/// What a report says of the scale that the video's metadata state beside that of the run.
namespace eyrie::scale_remark_test {
namespace {

constexpr int kFrames = 100;
constexpr int kWidth = 640;

/// 160 m across the picture as two bytes state it, in steps of 10,000 m / 65,535.
constexpr double kStated = 1049 * 10'000.0 / 65'535 / kWidth;

/// Pictures that nobody asks for, with the metadata of a file.
class StatedVideo : public FrameSource {
 public:
    StatedVideo(std::filesystem::path path, int frames) : frames_(frames) {
        known_.path = std::move(path);
        known_.size = {kWidth, 400};
        known_.frame_count = frames;
    }
    const VideoInfo& info() const override { return known_; }
    Frame read(FrameIndex, bool) override { return {}; }
    std::int64_t timeOf(FrameIndex frame) const override {
        if (frame < 0 || frame >= frames_) throw Error(ErrorKind::input, "there is no such frame");
        return frame * std::int64_t{40'000};
    }
    std::vector<PictureStamp> pictureStamps() const override {
        std::vector<PictureStamp> stamps;
        for (int i = 0; i < frames_; ++i) stamps.push_back({1'000'000 + timeOf(i), timeOf(i)});
        return stamps;
    }

 private:
    VideoInfo known_;
    int frames_;
};

class ScaleRemark : public testing::Test {
 protected:
    /// 160 m across the picture before frame 50, 192 m from there on, or nothing at all.
    void SetUp() override {
        test::TransportStreamWriter stream(test::TransportStreamWriter::Carriage::asynchronous);
        for (int frame = 0; frame < kFrames; ++frame) {
            test::LocalSetWriter set;
            set.time(1'231'798'102'000'000U + 40'000U * static_cast<unsigned>(frame));
            set.range(22, frame < 50 ? 160 : 192, 0, 10'000);
            stream.set(set.bytes(), 90'000 + 3'600 * frame);
        }
        stream.save(folder_ / "stated.ts");
    }
    std::string remark(double gsd_m_per_px, ScaleOrigin origin, FrameIndex first, FrameIndex last, int left = kFrames) {
        const std::filesystem::path path = folder_ / ("p" + std::to_string(++projects_) + ".eyrie");
        RunRecord run;
        run.sequence = {.path = "/nowhere/a.ts", .size = {kWidth, 400}, .frame_count = kFrames, .frame_rate_hz = 25};
        run.scale = {gsd_m_per_px, 25, isKnownScale(origin)};
        run.scale_basis.origin = origin;
        run = test::writeRun(path, run, [](int, FrameResult&) {});
        run.first_frame = first;
        run.last_frame = last;
        ProjectFile project = ProjectFile::open(path, ProjectFile::Mode::read_only);
        const StatedVideo video(folder_ / "stated.ts", left);
        return gatherReviewReport(project, run, {}, &video).scale_remark;
    }

    test::TemporaryFolder folder_;
    int projects_ = 0;
};

}  // namespace

TEST_F(ScaleRemark, TellsTheStatedScaleWhereItIsAnother) {
    const std::string other = "the video's metadata (the target width) say 0.2501 m/px";
    EXPECT_EQ(remark(0.2, ScaleOrigin::given, 0, 40), other);
    EXPECT_EQ(remark(0.3, ScaleOrigin::given, 0, 40), other);
    EXPECT_EQ(remark(kStated / 2, ScaleOrigin::given, 0, 40), other) << "half of it";
    EXPECT_EQ(remark(2 * kStated, ScaleOrigin::estimated, 0, 40), other) << "twice as much";
    EXPECT_EQ(remark(0.251, ScaleOrigin::assumed, 0, 40), other);
}

TEST_F(ScaleRemark, SaysSoWhereItIsTheSame) {
    EXPECT_EQ(remark(kStated, ScaleOrigin::given, 0, 40), "the video's metadata (the target width) say the same");
}

TEST_F(ScaleRemark, SaysNothingWhereTheRunHasItFromThere) {
    EXPECT_EQ(remark(kStated, ScaleOrigin::metadata, 0, 40), "");
}

TEST_F(ScaleRemark, AsksTheFramesOfTheRunThatAreLeft) {
    EXPECT_EQ(remark(0.2, ScaleOrigin::given, 60, 99), "the video's metadata (the target width) say 0.2999 m/px");
    EXPECT_EQ(remark(0.2, ScaleOrigin::given, 60, 99, 70), "the video's metadata (the target width) say 0.2999 m/px");
    EXPECT_EQ(remark(0.2, ScaleOrigin::given, 60, 99, 61), "the video's metadata (the target width) say 0.2999 m/px");
    EXPECT_EQ(remark(0.2, ScaleOrigin::given, 60, 99, 60), "") << "the video ends before";
}

}  // namespace eyrie::scale_remark_test

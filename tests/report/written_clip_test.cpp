#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "correction/made_corrections.h"
#include "report/clip/annotator.h"
#include "report/clip/run_clip.h"
#include "store/review/review_store.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

/// What the clips of a run show, by the videos that are written.
namespace eyrie::written_clip_test {
namespace {

using testing::HasSubstr;

constexpr int kFrames = 70;
constexpr int kRoad = 24;       ///< px down, where the vehicles drive
constexpr int kOtherRoad = 64;  ///< px down, where the other one stands
const cv::Size kWide(960, 96);  ///< not enlarged

/// 12 px a frame.
int xAt(FrameIndex frame) {
    return 40 + 12 * frame;
}

/// Grey pictures with a square in their lower left corner that is the brighter the later they are.
class CountedVideo : public FrameSource {
 public:
    explicit CountedVideo(int frames = kFrames, cv::Size size = kWide) {
        known.path = "/nowhere/clip.mp4";
        known.size = size;
        known.frame_count = frames;
        known.frame_rate_hz = 25;
    }
    const VideoInfo& info() const override { return known; }
    Frame read(FrameIndex index, bool) override {
        if (index == damaged) throw Error(ErrorKind::input, "frame " + std::to_string(index) + " is damaged");
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(known.size, CV_8UC1, cv::Scalar(120));
        frame.gray(cv::Rect(0, known.size.height - 16, 16, 16)).setTo(20 + 3 * index);
        return frame;
    }
    /// Of uneven ones each fifth is shown for twice as long.
    std::int64_t timeOf(FrameIndex index) const override {
        return 40'000LL * (index + (known.variable_frame_rate ? (index + 3) / 5 : 0));
    }

    VideoInfo known;
    FrameIndex damaged = -1;
};

/// Which frame a picture of a clip shows.
int numberIn(const cv::Mat& picture, int zoom = 1) {
    const cv::Rect square(4 * zoom, picture.rows - 12 * zoom, 8 * zoom, 8 * zoom);
    return cvRound((cv::mean(picture(square))[1] - 20) / 3);
}

/// Whether there is green there, or within two pixels, as tracks have it.
bool greenAt(const cv::Mat& picture, int x, int y) {
    for (int dy = -2; dy <= 2; ++dy) {
        for (int dx = -2; dx <= 2; ++dx) {
            const cv::Vec3b& pixel = picture.at<cv::Vec3b>(y + dy, x + dx);
            if (pixel[1] - (pixel[0] + pixel[2]) / 2 > 25) return true;
        }
    }
    return false;
}

TrackState vehicle(TrackId id, cv::Point2d centre) {
    TrackState state;
    state.id = id;
    state.box = {centre, 20, 10, 0};
    state.status = TrackStatus::confirmed;
    return state;
}

/// Track 3 drives up to frame 40 and track 7 from there on; track 9 stands at x = 500 on the other road.
class WrittenClip : public testing::Test {
 protected:
    void SetUp() override {
        run_ = test::writeRun(project_path_, kFrames, [](int frame, FrameResult& result) {
            result.tracks = {vehicle(frame <= 40 ? 3 : 7, cv::Point2d(xAt(frame), kRoad)),
                             vehicle(9, {500.0, kOtherRoad})};
        });
        project_.emplace(ProjectFile::open(project_path_));
    }
    std::optional<FrameRange> write(const ClipWish& wish, const std::function<void(double)>& progress = {},
                                    const std::stop_token& stop = {}) {
        return writeClip(wish, *project_, run_, video_, clip_path_, progress, stop);
    }
    /// The pictures of the clip.
    std::vector<cv::Mat> written() const {
        SourceOptions options;
        options.index_folder = folder_ / "index";
        const auto source = openSource(clip_path_, options);
        std::vector<cv::Mat> pictures;
        for (int i = 0; i < source->info().frame_count; ++i) pictures.push_back(source->read(i, true).colour.clone());
        return pictures;
    }
    void correct(TrackCorrection correction) {
        ReviewStore store(*project_, run_.sequence.id);
        correction.id = store.newCorrectionId();
        ReviewEdit edit{"Correct", {}, {}};
        edit.corrections.push_back({std::nullopt, std::move(correction)});
        store.apply(edit);
    }
    std::vector<TrackFrame> states(TrackId track) const { return RunStore(*project_).trackStates(run_.id, track); }

    test::TemporaryFolder folder_;
    std::filesystem::path project_path_ = folder_ / "p.eyrie", clip_path_ = folder_ / "clip.mp4";
    RunRecord run_;
    mutable std::optional<ProjectFile> project_;
    CountedVideo video_;
};

}  // namespace

TEST_F(WrittenClip, HasTheFramesOfItsRangeAndNothingDrawnUnlessWished) {
    std::vector<double> told;
    const auto range = write({{20, 23}}, [&](double share) { told.push_back(share); });
    ASSERT_TRUE(range);
    EXPECT_EQ(range->first, 20);
    EXPECT_EQ(range->last, 23);
    EXPECT_EQ(told, (std::vector<double>{0.25, 0.5, 0.75, 1}));
    const auto pictures = written();
    ASSERT_EQ(pictures.size(), 4U);
    for (int i = 0; i < 4; ++i) {
        EXPECT_EQ(numberIn(pictures[static_cast<std::size_t>(i)]), 20 + i);
        EXPECT_EQ(pictures[static_cast<std::size_t>(i)].size(), kWide);
        EXPECT_FALSE(greenAt(pictures[static_cast<std::size_t>(i)], xAt(20 + i) + 10, kRoad));
    }
}

TEST_F(WrittenClip, TracksThatBeganBeforeItHaveTheirTrail) {
    // Its first frame shows the 50 frames of the trail as any later one does; track 7 began with frame 41.
    write({{60, 61}, true});
    const auto pictures = written();
    ASSERT_EQ(pictures.size(), 2U);
    EXPECT_EQ(numberIn(pictures[0]), 60);
    for (int i = 0; i < 2; ++i) {
        const cv::Mat& picture = pictures[static_cast<std::size_t>(i)];
        EXPECT_TRUE(greenAt(picture, xAt(60 + i) + 10, kRoad)) << "its front";
        EXPECT_TRUE(greenAt(picture, xAt(60 + i), kRoad - 5)) << "its side";
        EXPECT_FALSE(greenAt(picture, xAt(60 + i) + 16, kRoad)) << "before it";
        EXPECT_TRUE(greenAt(picture, xAt(55), kRoad)) << "where it was";
        EXPECT_TRUE(greenAt(picture, xAt(41) + 4, kRoad)) << "where it was first";
        EXPECT_FALSE(greenAt(picture, xAt(41) - 6, kRoad)) << "before it was followed";
        EXPECT_TRUE(greenAt(picture, 510, kOtherRoad));
    }
}

TEST_F(WrittenClip, ATrailGoesFiftyFramesBackAndNotBeyondTheVideosBeginning) {
    correct(joinOf(states(3), states(7)));
    write({{65, 65}, true});
    const auto late = written();
    ASSERT_EQ(late.size(), 1U);
    EXPECT_TRUE(greenAt(late[0], xAt(30), kRoad));
    EXPECT_TRUE(greenAt(late[0], xAt(16) + 4, kRoad));
    EXPECT_FALSE(greenAt(late[0], xAt(16) - 6, kRoad)) << "longer ago";
    write({{5, 5}, true});
    const auto early = written();
    ASSERT_EQ(early.size(), 1U);
    EXPECT_TRUE(greenAt(early[0], xAt(0) + 4, kRoad));
    EXPECT_FALSE(greenAt(early[0], xAt(0) - 6, kRoad));
}

TEST_F(WrittenClip, ShowsTracksAsPeopleCorrectedThemUnlessWishedOtherwise) {
    correct(joinOf(states(3), states(7)));
    correct(rejectionOf(states(9)));
    write({{60, 60}, true});
    const auto corrected = written();
    ASSERT_EQ(corrected.size(), 1U);
    EXPECT_TRUE(greenAt(corrected[0], xAt(60) + 10, kRoad));
    EXPECT_TRUE(greenAt(corrected[0], xAt(30), kRoad)) << "one vehicle, one trail";
    EXPECT_FALSE(greenAt(corrected[0], 510, kOtherRoad)) << "rejected";
    write({{60, 60}, true, true});
    const auto as_found = written();
    ASSERT_EQ(as_found.size(), 1U);
    EXPECT_TRUE(greenAt(as_found[0], xAt(60) + 10, kRoad));
    EXPECT_FALSE(greenAt(as_found[0], xAt(30), kRoad));
    EXPECT_TRUE(greenAt(as_found[0], 510, kOtherRoad));
}

TEST_F(WrittenClip, EndsWithAVideoThatBecameShorter) {
    video_.known.frame_count = 63;
    const auto range = write({{60, 69}});
    ASSERT_TRUE(range);
    EXPECT_EQ(range->first, 60);
    EXPECT_EQ(range->last, 62);
    const auto pictures = written();
    ASSERT_EQ(pictures.size(), 3U);
    EXPECT_EQ(numberIn(pictures.back()), 62);
    const auto last = write({{62, 69}});
    ASSERT_TRUE(last);
    EXPECT_EQ(last->last, 62);
    std::filesystem::remove(clip_path_);
    EXPECT_THAT(test::messageOf(ErrorKind::input,
                                [&] {
                                    write({{63, 69}});
                                }),
                testing::AllOf(HasSubstr("/nowhere/clip.mp4"), HasSubstr("is shorter"), HasSubstr("it has 63 frames")));
    EXPECT_FALSE(std::filesystem::exists(clip_path_));
}

TEST_F(WrittenClip, AFrameBeyondTheRunHasNoTracks) {
    video_.known.frame_count = kFrames + 5;
    write({{68, 71}, true});
    const auto pictures = written();
    ASSERT_EQ(pictures.size(), 4U);
    EXPECT_TRUE(greenAt(pictures[1], 510, kOtherRoad));
    EXPECT_FALSE(greenAt(pictures[3], 510, kOtherRoad));
    EXPECT_EQ(numberIn(pictures[3]), 71);
}

TEST_F(WrittenClip, SmallPicturesAreEnlargedWhereSomethingIsDrawn) {
    video_ = CountedVideo(kFrames, {320, 96});
    write({{10, 10}, true});
    const auto drawn = written();
    ASSERT_EQ(drawn.size(), 1U);
    ASSERT_EQ(drawn[0].size(), cv::Size(960, 288));
    EXPECT_EQ(numberIn(drawn[0], 3), 10);
    EXPECT_TRUE(greenAt(drawn[0], 3 * (xAt(10) + 10) + 1, 3 * kRoad + 1));
    write({{10, 10}});
    EXPECT_EQ(written().at(0).size(), cv::Size(320, 96));
}

TEST_F(WrittenClip, FramesKeepTheirDistancesInTime) {
    const auto times = [&](FrameRange range) {
        write({range});
        SourceOptions options;
        options.index_folder = folder_ / "index";
        const auto source = openSource(clip_path_, options);
        std::vector<std::int64_t> found;
        for (int i = 0; i < source->info().frame_count; ++i) found.push_back(source->timeOf(i));
        return found;
    };
    EXPECT_EQ(times({10, 13}), (std::vector<std::int64_t>{0, 40'000, 80'000, 120'000}));
    video_.known.variable_frame_rate = true;
    EXPECT_EQ(times({10, 13}), (std::vector<std::int64_t>{0, 40'000, 120'000, 160'000}));
}

TEST_F(WrittenClip, StoppedOrFailedThereIsNoFile) {
    std::stop_source stop;
    int written_frames = 0;
    const auto range = write(
        {{10, 20}, true},
        [&](double) {
            if (++written_frames == 3) stop.request_stop();
        },
        stop.get_token());
    EXPECT_FALSE(range);
    EXPECT_EQ(written_frames, 3);
    EXPECT_FALSE(std::filesystem::exists(clip_path_));
    video_.damaged = 15;
    EXPECT_EQ(test::messageOf(ErrorKind::input, [&] { write({{10, 20}}); }), "frame 15 is damaged");
    EXPECT_FALSE(std::filesystem::exists(clip_path_));
}

}  // namespace eyrie::written_clip_test

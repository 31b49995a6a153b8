#include "report/review/review_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "store/project/video_start.h"
#include "store/review/review_store.h"
#include "store/review/seen_store.h"
#include "store/runs/result_writer.h"
#include "support/temporary_folder.h"

namespace eyrie::review_report_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr int kLength = 300;
constexpr double kTempo_hz = 25;
const cv::Size kSize(640, 400);

/// A car that comes in from the left at 27 km/h (1.5 px a frame at 0.2 m/px) and stops at x = 320.
double xAt(int frame) {
    return std::min(320.0, -20 + 1.5 * frame);
}

/// Grey pictures of which some cannot be read.
class GreyVideo : public FrameSource {
 public:
    explicit GreyVideo(int readable = kLength) : readable_(readable) {
        info_.size = kSize;
        info_.frame_count = kLength;
        info_.frame_rate_hz = kTempo_hz;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        if (index >= readable_) throw Error(ErrorKind::input, "frame " + std::to_string(index) + " is damaged");
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(kSize, CV_8UC1, cv::Scalar(120));
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index * 40'000LL; }

 private:
    VideoInfo info_;
    int readable_;
};

class ReviewReport : public testing::Test {
 protected:
    void writeRun(bool gsd_known, int failed = -1, int frames = kLength, bool with_car = true) {
        RunRecord run;
        run.sequence = {
            .path = "/nowhere/a <b>.mp4", .size = kSize, .frame_count = kLength, .frame_rate_hz = kTempo_hz};
        run.last_frame = frames - 1;
        run.scale = {0.2, kTempo_hz, gsd_known};
        if (!gsd_known) run.scale_basis = {ScaleOrigin::estimated, 1.198, 14};
        ProjectFile::create(path_);
        ResultWriter writer(path_, run, {{"motion.min_age", "9"}});
        for (int frame = 0; frame < frames; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.time_us = frame * 40'000LL;
            result.motion.image_size = kSize;
            auto& registration = result.motion.registration;
            registration.state = frame == 0        ? RegistrationState::first
                                 : frame == failed ? RegistrationState::failed
                                                   : RegistrationState::registered;
            if (frame == failed) registration.failure.fault = RegistrationFault::cut;
            registration.current_from_previous.from_frame = std::max(0, frame - 1);
            registration.current_from_previous.to_frame = frame;
            if (with_car && xAt(frame) > 11) {
                TrackState track;
                track.id = 5;
                track.box = {{xAt(frame), 200}, 22, 9, 0};
                track.status = TrackStatus::confirmed;
                track.score = 0.87;
                result.tracks.push_back(track);
            }
            writer.write(result);
        }
        writer.finish(RunState::finished, "");
    }
    ReviewReportInput gather(const EventChoice& choice = {}, std::optional<std::int64_t> start = {}) {
        ProjectFile project = ProjectFile::open(path_, ProjectFile::Mode::read_only);
        const GreyVideo pixels;
        return gatherReviewReport(project, *RunStore(project).run(1), choice, &pixels, start);
    }
    /// Says something about the event of a kind.
    void judge(EventKind kind, Judgement judgement, const std::string& note) {
        const ReviewReportInput input = gather();
        for (const Event& event : input.reviewed.events) {
            if (event.kind != kind) continue;
            ProjectFile project = ProjectFile::open(path_);
            ReviewStore store(project, 1);
            Verdict verdict;
            verdict.id = store.newVerdictId();
            verdict.subject = subjectOf(event, input.reviewed.tracks);
            verdict.judgement = judgement;
            verdict.note = note;
            verdict.tags = {"lorry"};
            verdict.person = "Ada";
            verdict.when_utc = "2026-11-21T08:00:00Z";
            store.apply({"Judge", {{std::nullopt, verdict}}, {}});
        }
    }
    static std::string htmlOf(const ReviewReportInput& input, FrameSource* pixels = nullptr) {
        return makeReviewReport(input, pixels).html;
    }
    test::TemporaryFolder folder_;
    std::filesystem::path path_ = folder_ / "p.eyrie";
};

}  // namespace

TEST_F(ReviewReport, ClockTimesCountFromTheStartThatTheProjectKeeps) {
    writeRun(true);
    {
        ProjectFile project = ProjectFile::open(path_);
        storeVideoStart(project, 1, 1'231'798'102'000'000);
    }
    EXPECT_EQ(gather().clock.at(40'000), 1'231'798'102'040'000);
    EXPECT_EQ(gather({}, 5).clock.at(0), 5) << "what is said now counts";
}

TEST_F(ReviewReport, TellsTheChosenEventsWithAllThatIsKnownOfThem) {
    writeRun(true);
    judge(EventKind::stops, Judgement::relevant, "parks <here>");
    EventChoice choice;
    choice.judgements = {Judgement::relevant, Judgement::unsure};
    ReviewReportInput input = gather(choice, 1'231'798'102'000'000);
    input.video_digest = "abc123";
    input.made_utc = "2026-11-22T09:00:00Z";
    ASSERT_EQ(countOfEvents(input), 1u);
    EXPECT_THAT(htmlOf(input), Not(HasSubstr("<b>Light</b>")));
    LightFinding light;
    light.reach_m = 3;
    light.vehicles = 7;
    input.reviewed.run.light = {light};
    EXPECT_THAT(htmlOf(input), HasSubstr("<b>Light</b></td><td>shadows fall to 0° (to the right) in frame 0, 3.0 m"));
    GreyVideo pixels;
    const ReportFile report = makeReviewReport(input, &pixels);
    EXPECT_THAT(report.html, AllOf(HasSubstr("stops"), HasSubstr("parks &lt;here&gt;"), HasSubstr("lorry"),
                                   HasSubstr("Ada, 2026-11-21T08:00:00Z"), HasSubstr("relevant")));
    EXPECT_THAT(report.html,
                AllOf(HasSubstr("abc123"), HasSubstr("2026-11-22T09:00:00Z"), HasSubstr("the machine, run 1"),
                      HasSubstr("the start time given"), HasSubstr("motion.min_age"), HasSubstr("0.2 m/px, as given")));
    EXPECT_THAT(report.html, Not(HasSubstr("<h3>1. appears")));
    EXPECT_THAT(report.html, HasSubstr("By kind</b></td><td>stops 1</td>"));
    EXPECT_THAT(report.html, HasSubstr("Speed before</b></td><td>2")) << "one does not stop at 27 km/h";
    // It stops where xAt does: frame 227 at 25 Hz, 9 s and some after 22:08:22.
    EXPECT_THAT(report.html, HasSubstr("2009-01-12T22:08:3"));
    EXPECT_THAT(report.html, HasSubstr("km/h"));
    EXPECT_EQ(report.pictures.size(), 5u);  // still, close-up, path, speed, ground
    const std::string one_file = selfContained(report);
    EXPECT_THAT(one_file, AllOf(HasSubstr("data:image/jpeg;base64,"), HasSubstr("data:image/svg+xml;base64,")));
    EXPECT_THAT(one_file,
                AllOf(Not(HasSubstr("http://")), Not(HasSubstr("src=\"still")), Not(HasSubstr("src=\"path"))));
}

TEST_F(ReviewReport, EveryEventIsTheDefaultOfTheChoice) {
    writeRun(true);
    const ReviewReportInput input = gather();
    EXPECT_EQ(countOfEvents(input), input.reviewed.events.size());
    EXPECT_GE(countOfEvents(input), 2u);  // stops, stands
    EXPECT_THAT(htmlOf(input), AllOf(HasSubstr("not judged"), HasSubstr("all events, judged or not")));
}

TEST_F(ReviewReport, TagsChooseToo) {
    writeRun(true);
    judge(EventKind::stops, Judgement::relevant, "");  // tagged "lorry"
    EventChoice choice;
    choice.tags = {"gate <3>", "lorry"};
    const ReviewReportInput input = gather(choice);
    EXPECT_EQ(countOfEvents(input), 1u);
    EXPECT_THAT(htmlOf(input), HasSubstr("; tagged gate &lt;3&gt; or lorry"));
    choice.tags = {"gate 3"};
    EXPECT_EQ(countOfEvents(gather(choice)), 0u);
}

TEST_F(ReviewReport, WithoutAKnownScaleNobodyIsToldMetres) {
    writeRun(false);
    const std::string html = htmlOf(gather());
    EXPECT_THAT(html, Not(HasSubstr(" km/h</td>")));
    EXPECT_THAT(html, HasSubstr("px/frame"));
    EXPECT_THAT(html,
                HasSubstr("not known; the search worked with 0.2 m/px, estimated from 14 vehicles, right to within "
                          "a factor of 1.2, and no speeds in km/h are given"));
    EXPECT_THAT(html, HasSubstr("Clock</b></td><td>not known"));
}

TEST_F(ReviewReport, SaysWhatCouldNotBeSearchedAndWhatWasSeen) {
    writeRun(true, 100);
    {
        ProjectFile project = ProjectFile::open(path_);
        addSeen(project, 1, "Ada", {{0, 149}});
        addSeen(project, 1, "Bob", {{75, 224}});
    }
    const std::string html = htmlOf(gather());
    EXPECT_THAT(html, AllOf(HasSubstr("in 1 stretch"), HasSubstr("Could not be searched"), HasSubstr("100–100")));
    EXPECT_THAT(html, HasSubstr("75 % (Ada 50 %, Bob 50 %)"));
}

TEST_F(ReviewReport, VerdictsWithoutAnEventAreListedWithTheReason) {
    writeRun(true);
    ProjectFile project = ProjectFile::open(path_);
    ReviewStore store(project, 1);
    Verdict verdict;
    verdict.id = store.newVerdictId();
    verdict.subject.kind = EventKind::turns_back;
    verdict.judgement = Judgement::relevant;
    verdict.note = "seen in an earlier run";
    store.apply({"Judge", {{std::nullopt, verdict}}, {}});
    const std::string html = htmlOf(gather());
    EXPECT_THAT(html, AllOf(HasSubstr("without an event in this run"), HasSubstr("seen in an earlier run"),
                            HasSubstr("no such event near")));
}

TEST_F(ReviewReport, ARunWithoutTracksOrFramesHasAReportAllTheSame) {
    writeRun(true, -1, 40, false);
    const std::string html = htmlOf(gather());
    EXPECT_THAT(html, HasSubstr("Nothing happened that the limits call an event."));
    path_ = folder_ / "empty.eyrie";
    writeRun(true, -1, 0, false);
    EXPECT_THAT(htmlOf(gather()), HasSubstr("the run has no frames"));
}

TEST_F(ReviewReport, PicturesThatCannotBeReadAreLeftOutAndSaid) {
    writeRun(true);
    const ReviewReportInput input = gather();
    GreyVideo pixels(50);
    const ReportFile report = makeReviewReport(input, &pixels);
    EXPECT_THAT(report.html, HasSubstr("Pictures are missing: frame "));
    EXPECT_THAT(htmlOf(input), HasSubstr("Pictures are missing: the video could not be read."));
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(makeReviewReport(input, &pixels, {}, stop.get_token()).html, HasSubstr("stopped"));
}

TEST_F(ReviewReport, TheGroundShowsWhereTheEventsWereAndTheWaysThere) {
    writeRun(true);
    const ReviewReportInput input = gather();
    GreyVideo pixels;
    const ReportFile report = makeReviewReport(input, &pixels);
    EXPECT_THAT(report.html, HasSubstr("ground-1"));
    ASSERT_TRUE(report.pictures.contains("ground-1"));
    const std::string& bytes = report.pictures.at("ground-1").bytes;
    const cv::Mat ground = cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
    ASSERT_EQ(ground.size(), cv::Size(1200, 750));  // a camera that stands sees no more; enlarged
    const double zoom = 1200.0 / kSize.width;
    const auto isGrey = [&](cv::Point in_video, cv::Point away = {}) {
        const cv::Point at(cvRound((in_video.x + 0.5) * zoom - 0.5), cvRound((in_video.y + 0.5) * zoom - 0.5));
        const cv::Vec3b& pixel = ground.at<cv::Vec3b>(at + away);
        return std::abs(pixel[0] - 120) + std::abs(pixel[1] - 120) + std::abs(pixel[2] - 120) < 60;
    };
    EXPECT_FALSE(isGrey({150, 200})) << "the way";
    EXPECT_TRUE(isGrey({150, 230}));
    EXPECT_TRUE(isGrey({500, 200})) << "where nobody went";
    // The car stops at x = 320: the ring around its place.
    EXPECT_FALSE(isGrey({320, 200}, {0, 9}));
    GreyVideo damaged(50);
    EXPECT_THAT(htmlOf(input, &damaged), HasSubstr("There is no picture of the ground: frame "));
}

TEST_F(ReviewReport, LimitsThatDifferAreTold) {
    writeRun(true);
    EventChoice choice;
    choice.options.stands_s = 2;
    EXPECT_THAT(htmlOf(gather(choice)), AllOf(HasSubstr("events.stands"), HasSubstr("2 (3)")));
    EXPECT_THAT(htmlOf(gather()), Not(HasSubstr("events.stands")));
}

}  // namespace eyrie::review_report_test

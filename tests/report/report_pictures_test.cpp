#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "report/evaluation_report.h"

/// The pictures of an evaluation's report, of figures that are easy to work out.
namespace eyrie::report_pictures_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A bright patch 10 px right of and 5 px below (100, 80) on grey.
class PatchSource : public FrameSource {
 public:
    PatchSource() {
        info_.size = {320, 240};
        info_.frame_count = 10;
    }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(240, 320, CV_8UC1, cv::Scalar(120));
        frame.gray(cv::Rect(110, 85, 4, 4)).setTo(250);
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index; }

 private:
    VideoInfo info_;
};

DiagnosedError errorOf(ResultErrorKind kind, int count, const OrientedBox& box) {
    DiagnosedError one;
    one.error.kind = kind;
    one.error.objects = {1};
    for (int i = 0; i < count; ++i) one.error.places.push_back({0, box, {0}, {}});
    return one;
}

/// Ten frames of one object, which is missed in frame 4; five frames a second.
RunEvaluation evaluationOf(std::vector<DiagnosedError> errors) {
    RunEvaluation e;
    e.run.sequence = {.path = "/videos/street.mp4", .size = {320, 240}, .frame_count = 10, .frame_rate_hz = 5};
    e.shown.tracks.truth.push_back({.id = 1, .frames = 10, .matched = 9});
    e.table = {e.shown};
    for (int frame = 0; frame < 10; ++frame) e.frames.push_back({frame, frame == 4 ? 0 : 1, frame == 4, 0});
    e.errors = std::move(errors);
    return e;
}

cv::Mat chipOf(const OrientedBox& box) {
    PatchSource pixels;
    const ReportFile report = makeEvaluationReport(evaluationOf({errorOf(ResultErrorKind::miss, 1, box)}), &pixels);
    const std::string& bytes = report.pictures.at("chip-1").bytes;
    return cv::imdecode(std::vector<char>(bytes.begin(), bytes.end()), cv::IMREAD_COLOR);
}

/// Whether the outline passes: it is yellow, with a dark edge.
bool outlinedAt(const cv::Mat& chip, int x, int y) {
    const cv::Vec3b& pixel = chip.at<cv::Vec3b>(y, x);
    return pixel[0] < 100;
}

}  // namespace

TEST(ErrorChipByHand, ASmallBoxIsShownWithTwentyPixelsAroundIt) {
    // 72 px for 20: 3.6 times as large, with the box in the middle, (57, 35.5), of 115 × 72.
    const cv::Mat chip = chipOf({{100, 80}, 10, 5, 0});
    ASSERT_EQ(chip.size(), cv::Size(115, 72));
    EXPECT_EQ(chip.at<cv::Vec3b>(59, 98), cv::Vec3b(250, 250, 250));
    for (const cv::Point grey : {cv::Point(86, 59), cv::Point(110, 59), cv::Point(98, 48), cv::Point(98, 70)})
        EXPECT_EQ(chip.at<cv::Vec3b>(grey.y, grey.x), cv::Vec3b(120, 120, 120)) << grey;
    // Its sides lie 18 px to the left and right, 9 px above and below.
    EXPECT_TRUE(outlinedAt(chip, 39, 35));
    EXPECT_TRUE(outlinedAt(chip, 75, 35));
    EXPECT_TRUE(outlinedAt(chip, 57, 26) || outlinedAt(chip, 57, 27));
    EXPECT_TRUE(outlinedAt(chip, 57, 44) || outlinedAt(chip, 57, 45));
    for (const cv::Point bare :
         {cv::Point(57, 35), cv::Point(44, 35), cv::Point(34, 35), cv::Point(57, 20), cv::Point(57, 50)})
        EXPECT_FALSE(outlinedAt(chip, bare.x, bare.y)) << bare;
}

TEST(ErrorChipByHand, OfALargerBoxTwoAndAHalfAreShownEitherWay) {
    // 20 px across: 52 px are shown, 1.385 times as large; the sides 13.8 px above and below the middle.
    const cv::Mat wide = chipOf({{100, 80}, 10, 20, 0});
    EXPECT_TRUE(outlinedAt(wide, 57, 22));
    EXPECT_TRUE(outlinedAt(wide, 57, 49));
    EXPECT_FALSE(outlinedAt(wide, 57, 27));
    EXPECT_FALSE(outlinedAt(wide, 57, 17));
    // 40 px along: 104 px on a chip that is 1.6 times as wide as high, 1.108 times as large.
    const cv::Mat along = chipOf({{100, 80}, 40, 10, 0});
    EXPECT_TRUE(outlinedAt(along, 35, 35));
    EXPECT_TRUE(outlinedAt(along, 79, 35));
    EXPECT_FALSE(outlinedAt(along, 40, 35));
    EXPECT_FALSE(outlinedAt(along, 30, 35));
    // Beyond the picture it is dark.
    EXPECT_EQ(chipOf({{0, 80}, 10, 5, 0}).at<cv::Vec3b>(10, 10), cv::Vec3b(60, 60, 60));
}

TEST(ErrorChipByHand, TheGravestHaveOneAndEveryFourthIsASwitch) {
    std::vector<DiagnosedError> errors;
    for (int count = 1; count <= 8; ++count)
        errors.push_back(errorOf(ResultErrorKind::miss, count, {{100, 80}, 10, 5, 0}));
    for (int i = 0; i < 2; ++i) errors.push_back(errorOf(ResultErrorKind::id_switch, 1, {{100, 80}, 10, 5, 0}));
    PatchSource pixels;
    ReportOptions options;
    options.chips = 8;
    std::vector<double> told;
    const ReportFile report =
        makeEvaluationReport(evaluationOf(errors), &pixels, options, [&](double share) { told.push_back(share); });
    ASSERT_EQ(told.size(), 8U);
    EXPECT_EQ(told.front(), 0.125);
    EXPECT_EQ(told.back(), 1);
    std::size_t last = 0;
    for (const int number : {8, 7, 6, 5, 4, 3, 9, 10}) {
        const std::size_t at = report.html.find("\"chip-" + std::to_string(number) + "\"");
        ASSERT_NE(at, std::string::npos) << number;
        EXPECT_GT(at, last) << number;
        last = at;
    }
    EXPECT_FALSE(report.pictures.contains("chip-1"));
    EXPECT_FALSE(report.pictures.contains("chip-2"));
    options.chips = 7;
    const ReportFile fewer = makeEvaluationReport(evaluationOf(errors), &pixels, options);
    EXPECT_TRUE(fewer.pictures.contains("chip-3"));
    EXPECT_TRUE(fewer.pictures.contains("chip-9"));
    EXPECT_FALSE(fewer.pictures.contains("chip-10"));
    options.chips = 0;
    EXPECT_THAT(makeEvaluationReport(evaluationOf(errors), &pixels, options).html, Not(HasSubstr("The worst errors")));
}

TEST(ErrorChipByHand, APageHoldsSixteen) {
    PatchSource pixels;
    const auto pages = [&](std::size_t count) {
        const std::vector<DiagnosedError> errors(count, errorOf(ResultErrorKind::miss, 1, {{100, 80}, 10, 5, 0}));
        const std::string html = makeEvaluationReport(evaluationOf(errors), &pixels).html;
        int found = 0;
        for (std::size_t at = 0; (at = html.find("The worst errors", at)) != std::string::npos; ++at) ++found;
        return found;
    };
    EXPECT_EQ(pages(16), 1);
    EXPECT_EQ(pages(17), 2);
    EXPECT_EQ(pages(33), 3);
}

TEST(ReportFiguresByHand, CountsAndSharesLieWhereTheFramesSay) {
    const ReportFile report = makeEvaluationReport(evaluationOf({}), nullptr);
    // 650 px for nine steps; what is found reaches 174 / 1.05 px up, but for frame 4.
    const std::string& counts = report.pictures.at("figure-counts").bytes;
    EXPECT_THAT(counts, HasSubstr("<polygon fill=\"#2e9650\" points=\"58,200 58,34.3 130.2,34.3 202.4,34.3 274.7,34.3 "
                                  "346.9,200 419.1,34.3 "));
    EXPECT_THAT(counts, HasSubstr("<polygon fill=\"#dea014\" points=\"58,200 58,34.3 130.2,34.3 202.4,34.3 274.7,34.3 "
                                  "346.9,34.3 "));
    // Recall over five frames is four fifths wherever frame 4 is among them; nothing was false.
    const std::string& ratios = report.pictures.at("figure-ratios").bytes;
    EXPECT_THAT(ratios, HasSubstr("stroke=\"#2d78c8\" points=\"58,29.4 130.2,29.4 202.4,63.5 274.7,63.5 346.9,63.5 "
                                  "419.1,63.5 491.3,63.5 563.6,29.4 635.8,29.4 708,29.4 \""));
    EXPECT_THAT(ratios, HasSubstr("stroke=\"#d64236\" points=\"58,29.4 130.2,29.4 202.4,29.4 "));
    EXPECT_THAT(report.html, HasSubstr("over 5 frames."));
    // Found in nine of ten frames: mostly tracked; 94 px are all.
    const std::string& tracked = report.pictures.at("figure-tracked").bytes;
    EXPECT_THAT(tracked, HasSubstr("<rect x=\"58\" y=\"35.4\" width=\"649\" height=\"84.6\" fill=\"#2e9650\"/>"));
    for (const char* share : {">100 %<", ">80 %<", ">20 %<", ">1 objects, best first<"})
        EXPECT_THAT(tracked, HasSubstr(share));
}

TEST(ReportFiguresByHand, ObjectsAreSortedByTheirShareAndColouredByIt) {
    RunEvaluation e = evaluationOf({});
    e.shown.tracks.truth = {{.id = 1, .frames = 10, .matched = 1},
                            {.id = 2, .frames = 10, .matched = 9},
                            {.id = 3, .frames = 10, .matched = 5},
                            {.id = 4, .frames = 0, .matched = 0}};
    const std::string tracked = makeEvaluationReport(e, nullptr).pictures.at("figure-tracked").bytes;
    EXPECT_THAT(tracked, HasSubstr("<rect x=\"58\" y=\"35.4\" width=\"161.5\" height=\"84.6\" fill=\"#2e9650\"/>"));
    EXPECT_THAT(tracked, HasSubstr("<rect x=\"220.5\" y=\"73\" width=\"161.5\" height=\"47\" fill=\"#dea014\"/>"));
    EXPECT_THAT(tracked, HasSubstr("<rect x=\"383\" y=\"110.6\" width=\"161.5\" height=\"9.4\" fill=\"#d64236\"/>"));
    EXPECT_THAT(tracked, HasSubstr("<rect x=\"545.5\" y=\"120\" width=\"161.5\" height=\"0\""));
}

}  // namespace eyrie::report_pictures_test

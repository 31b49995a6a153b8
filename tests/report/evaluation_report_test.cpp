#include "report/evaluation_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "chain/chain_options.h"
#include "core/error.h"
#include "report/svg_chart.h"
#include "support/temporary_folder.h"

namespace eyrie::evaluation_report_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// An evaluation made up by hand: ten frames, one object, a miss and a switch.
RunEvaluation sample() {
    RunEvaluation e;
    e.run.id = 3;
    e.run.name = "a <b> & c";
    e.run.sequence = {.path = "/videos/street.mp4", .size = {320, 240}, .frame_count = 10, .frame_rate_hz = 5};
    e.run.scale = {0.0335, 5, true};
    e.run.scale_basis = {ScaleOrigin::metadata};
    e.run.frames_done = 10;
    e.parameters = parameterValues(builtInPreset("default"));
    for (auto& [name, value] : e.parameters)
        if (name == "motion.min_age") value = "9";
    e.truth_name = "truth.csv";
    e.options.overlap = 0.1;
    Measures measures;
    measures.overlap = 0.1;
    measures.detection.f_score = 0.875;
    measures.tracks.truth.push_back({.id = 1, .frames = 10, .matched = 9});
    e.table = {measures};
    e.shown = measures;
    e.f_score = {0.875, 0.8, 0.9};
    for (int frame = 0; frame < 10; ++frame) e.frames.push_back({frame, frame == 4 ? 0 : 1, frame == 4, 0});
    DiagnosedError miss;
    miss.error = {ResultErrorKind::miss, {1}, {}, 4, 4, {{4, {{100, 80}, 20, 10, 0.3}, {0}, {}}}};
    miss.cause = ErrorCause::too_slow;
    miss.text = "7 corners, none counts as moving";
    DiagnosedError change;
    change.error = {ResultErrorKind::id_switch, {1}, {5, 6}, 3, 5, {{5, {{104, 80}, 20, 10, 0.3}, {0}, {0}}}};
    change.cause = ErrorCause::track_ended;
    e.errors = {miss, change};
    return e;
}

class GreySource : public FrameSource {
 public:
    explicit GreySource(int readable) : readable_(readable) { info_.size = {320, 240}; }
    const VideoInfo& info() const override { return info_; }
    Frame read(FrameIndex index, bool) override {
        if (index >= readable_) throw Error(ErrorKind::input, "frame " + std::to_string(index) + " is damaged");
        Frame frame;
        frame.index = index;
        frame.gray = cv::Mat(240, 320, CV_8UC1, cv::Scalar(120));
        return frame;
    }
    std::int64_t timeOf(FrameIndex index) const override { return index; }

 private:
    VideoInfo info_;
    int readable_;
};

int countOf(const std::string& text, const std::string& wanted) {
    int count = 0;
    for (std::size_t at = text.find(wanted); at != std::string::npos; at = text.find(wanted, at + 1)) ++count;
    return count;
}

}  // namespace

TEST(EvaluationReport, isOneFileWithEverything) {
    GreySource pixels(10);
    const auto report = makeEvaluationReport(sample(), &pixels);
    EXPECT_EQ(report.pictures.size(), 6u);  // four figures and two chips
    const std::string html = selfContained(report);
    EXPECT_EQ(countOf(html, "src=\"data:image/svg+xml;base64,"), 4);
    EXPECT_EQ(countOf(html, "src=\"data:image/png;base64,"), 2);
    EXPECT_THAT(html, Not(HasSubstr("src=\"figure")));
    EXPECT_THAT(html, Not(HasSubstr("src=\"chip")));
    EXPECT_THAT(html, Not(HasSubstr("http://")));  // nothing to be fetched
    EXPECT_THAT(html, HasSubstr("a &lt;b&gt; &amp; c"));
    EXPECT_THAT(html, HasSubstr("too slow"));
    EXPECT_THAT(html, HasSubstr("5 → 6"));
    EXPECT_THAT(html, HasSubstr("0.8750"));
    EXPECT_THAT(html, HasSubstr("0.0335 m/px, from the video's metadata"));
}

TEST(EvaluationReport, parametersThatDifferComeFirst) {
    const std::string html = makeEvaluationReport(sample(), nullptr).html;
    const std::size_t different = html.find("differ from the default");
    const std::size_t changed = html.find("motion.min_age");
    const std::size_t measures = html.find("<h2>Measures");
    EXPECT_LT(different, changed);
    EXPECT_LT(changed, measures);
    EXPECT_GT(html.find("motion.baseline"), measures);
    EXPECT_THAT(html, HasSubstr("<b>9</b>"));
    RunEvaluation usual = sample();
    usual.parameters = parameterValues(builtInPreset("default"));
    EXPECT_THAT(makeEvaluationReport(usual, nullptr).html, HasSubstr("None: the run has the default parameters"));
}

TEST(EvaluationReport, picturesThatCannotBeReadAreTold) {
    GreySource pixels(5);  // frame 4 can be read, frame 5 cannot
    const auto report = makeEvaluationReport(sample(), &pixels);
    EXPECT_EQ(std::count_if(report.pictures.begin(), report.pictures.end(),
                            [](const auto& one) { return one.second.kind == ReportPicture::Kind::png; }),
              1);
    EXPECT_THAT(report.html, HasSubstr("frame 5 is damaged"));
    EXPECT_TRUE(makeEvaluationReport(sample(), nullptr).pictures.size() == 4u);
}

TEST(EvaluationReport, longListsAreCutAndSaySo) {
    RunEvaluation e = sample();
    e.errors.resize(10, e.errors.front());
    ReportOptions options;
    options.rows = 4;
    EXPECT_THAT(makeEvaluationReport(e, nullptr, options).html, HasSubstr("And 6 more"));
    e.errors.clear();
    EXPECT_THAT(makeEvaluationReport(e, nullptr).html, HasSubstr("No errors"));
}

TEST(EvaluationReport, aFolderThatCannotBeWrittenIsNamed) {
    const test::TemporaryFolder folder;
    const auto report = makeEvaluationReport(sample(), nullptr);
    try {
        writeHtmlReport(folder / "no" / "where.html", report);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
        EXPECT_THAT(error.what(), HasSubstr("where.html"));
    }
    writeHtmlReport(folder / "r.html", report);
    std::stringstream text;
    text << std::ifstream(folder / "r.html").rdbuf();
    EXPECT_EQ(text.str(), selfContained(report));
}

TEST(SvgChart, stepsAreRound) {
    EXPECT_DOUBLE_EQ(niceStep(1.02, 5), 0.5);
    EXPECT_DOUBLE_EQ(niceStep(25, 5), 5);
    EXPECT_DOUBLE_EQ(niceStep(401, 8), 100);
}

TEST(SvgChart, gapsPartCurves) {
    CurveChart chart{"frame", "share", {0, 1, 2, 3}, {}, 1, false};
    chart.series = {{"a", "#112233", {0.5, std::nan(""), 0.5, 0.6}}};
    EXPECT_EQ(countOf(curvesSvg(chart), "<polyline"), 2);
    chart.stacked = true;
    EXPECT_EQ(countOf(curvesSvg(chart), "<polygon"), 1);
    EXPECT_THAT(curvesSvg({}), HasSubstr("</svg>"));
}

}  // namespace eyrie::evaluation_report_test

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "chain/chain_options.h"
#include "report/evaluation_report.h"
#include "report/svg_chart.h"

/// The tables of an evaluation's report, row by row.
namespace eyrie::evaluation_tables_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// Ten frames of a run of one object.
RunEvaluation evaluation() {
    RunEvaluation e;
    e.run.id = 3;
    e.run.sequence = {.path = "/videos/street.mp4", .size = {320, 240}, .frame_count = 10, .frame_rate_hz = 5};
    e.run.scale = {0.2, 5, true};
    e.parameters = parameterValues(builtInPreset("default"));
    e.shown.overlap = 0.1;
    e.shown.tracks.truth.push_back({.id = 1, .frames = 10, .matched = 9});
    e.table = {e.shown};
    e.options.overlap = 0.1;
    for (int frame = 0; frame < 10; ++frame) e.frames.push_back({frame, 1, 0, 0});
    return e;
}

DiagnosedError errorOf(ResultErrorKind kind, ErrorCause cause, FrameIndex first, FrameIndex last,
                       std::vector<int> objects, std::vector<int> tracks) {
    DiagnosedError one;
    one.error = {kind, std::move(objects), std::move(tracks), first, last, {}};
    for (FrameIndex frame = first; frame <= last; ++frame)
        one.error.places.push_back({frame, {{100, 80}, 20, 10, 0}, {0}, {}});
    one.cause = cause;
    one.text = "a < b";
    return one;
}

std::string htmlOf(const RunEvaluation& e, const ReportOptions& options = {}) {
    return makeEvaluationReport(e, nullptr, options).html;
}

std::string row(const std::vector<std::string>& fields) {
    std::string text = "<tr>";
    for (const std::string& field : fields) text += "<td>" + field + "</td>";
    return text + "</tr>";
}

std::string fact(const std::string& name, const std::string& value) {
    return row({"<b>" + name + "</b>", value});
}

std::string bold(const std::string& text) {
    return "<b>" + text + "</b>";
}

/// What follows a heading up to the end of its table.
std::string chapter(const std::string& html, const std::string& heading) {
    const std::size_t begin = html.find(">" + heading + "</h2>");
    if (begin == std::string::npos) return {};
    return html.substr(begin, html.find("</table>", begin) - begin);
}

}  // namespace

TEST(EvaluationTables, AllParametersStandInTwoColumnsAnOddOneBelowTheFirst) {
    RunEvaluation e = evaluation();
    e.parameters = {{"a", "1"}, {"b", "2"}, {"c", "3"}, {"d<", "4"}};
    const std::string four = chapter(htmlOf(e), "All parameters");
    EXPECT_THAT(four, HasSubstr(row({bold("a"), bold("1"), bold("c"), bold("3")})));
    EXPECT_THAT(four, HasSubstr(row({bold("b"), bold("2"), bold("d&lt;"), bold("4")})));
    e.parameters.emplace_back("e", "5");
    const std::string five = chapter(htmlOf(e), "All parameters");
    EXPECT_THAT(five, HasSubstr(row({bold("a"), bold("1"), bold("d&lt;"), bold("4")})));
    EXPECT_THAT(five, HasSubstr(row({bold("b"), bold("2"), bold("e"), bold("5")})));
    EXPECT_THAT(five, HasSubstr(row({bold("c"), bold("3")})));
    e.parameters = {{"a", "1"}};
    EXPECT_THAT(chapter(htmlOf(e), "All parameters"), HasSubstr(row({bold("a"), bold("1")})));
    e.parameters.clear();
    EXPECT_THAT(htmlOf(e), Not(HasSubstr("<td>a</td>")));
}

TEST(EvaluationTables, ParametersThatDifferAreToldWithTheirDefaultAndAreBoldAmongAll) {
    RunEvaluation e = evaluation();
    ASSERT_GE(e.parameters.size(), 3U);
    const auto [name, usual] = e.parameters[0];
    const auto [kept, kept_value] = e.parameters[1];
    e.parameters = {{name, "987"}, {kept, kept_value}, {"from.elsewhere", "1"}};
    const std::string html = htmlOf(e);
    const std::string different = chapter(html, "Parameters that differ from the default");
    EXPECT_THAT(different, HasSubstr(row({name, bold("987"), usual})));
    EXPECT_THAT(different, HasSubstr(row({"from.elsewhere", bold("1"), "(unknown to this version)"})));
    EXPECT_THAT(different, Not(HasSubstr(kept)));
    EXPECT_THAT(chapter(html, "All parameters"),
                HasSubstr(row({bold(name), bold("987"), bold("from.elsewhere"), bold("1")})));
    EXPECT_THAT(chapter(html, "All parameters"), HasSubstr(row({kept, kept_value})));
}

TEST(EvaluationTables, MeasuresBeginAPageWhereManyParametersDiffer) {
    RunEvaluation e = evaluation();
    e.parameters.clear();
    for (int i = 0; i < 12; ++i) e.parameters.emplace_back("p" + std::to_string(i), "1");
    EXPECT_THAT(htmlOf(e), HasSubstr("<h2>Measures"));
    e.parameters.emplace_back("p12", "1");
    EXPECT_THAT(htmlOf(e), HasSubstr("<h2 class=\"chapter\">Measures"));
}

TEST(EvaluationTables, MeasuresHaveAColumnForEachOverlap) {
    RunEvaluation e = evaluation();
    Measures strict = e.shown;
    strict.overlap = 0.25;
    e.table[0].detection.f_score = 0.875;
    strict.detection.f_score = 0.5;
    e.table.push_back(strict);
    const std::string table = chapter(htmlOf(e), "Measures");
    EXPECT_THAT(table, HasSubstr("<th align=\"left\"></th><th align=\"right\">T_ov 0.1</th><th align=\"right\">T_ov "
                                 "0.25</th>"));
    EXPECT_THAT(table, HasSubstr("<td align=\"right\">0.8750</td><td align=\"right\">0.5000</td>"));
    std::size_t rows = 0;
    for (std::size_t at = 0; (at = table.find("<tr><td>", at)) != std::string::npos; ++at) ++rows;
    EXPECT_EQ(rows, listMeasures(strict).size());
}

TEST(EvaluationTables, FactsOfTheRun) {
    RunEvaluation e = evaluation();
    e.run.name = "a <b>";
    e.run.first_frame = 20;
    e.run.frames_done = 10;
    e.run.started_utc = "2026-11-21T08:00:00Z";
    e.run.engine_version = "9.8";
    e.truth_name = "truth.csv";
    ReportOptions options;
    options.made_utc = "2026-11-22T09:00:00Z";
    const std::string html = htmlOf(e, options);
    EXPECT_THAT(html, HasSubstr(fact("Run",
                                     "3, a &lt;b&gt;, frames 20 to 29, started 2026-11-21T08:00:00Z, Eyrie "
                                     "9.8")));
    EXPECT_THAT(html, HasSubstr(fact("Image", "320 × 240 px, 5 frames/s")));
    EXPECT_THAT(html, HasSubstr(fact("Ground truth", "truth.csv, 10 frames")));
    EXPECT_THAT(html, HasSubstr(fact("Measured", "tracks")));
    EXPECT_THAT(html, HasSubstr(fact("Report made", "2026-11-22T09:00:00Z")));
    EXPECT_THAT(html, HasSubstr("<td><b>Compared</b></td><td>oriented boxes"));
    EXPECT_THAT(html, HasSubstr("<title>Evaluation of run 3, street.mp4</title>"));
    EXPECT_THAT(html, Not(HasSubstr("(assumed)")));
    EXPECT_THAT(html, Not(HasSubstr("not known; worked with")));
    EXPECT_THAT(html, Not(HasSubstr("<b>Light</b>"))) << "nothing is known of shadows";
    LightFinding light;
    light.outcome = LightOutcome::shaded_sides;
    light.vehicles = 6;
    e.run.light = {light};
    e.run.rate_assumed = true;
    e.run.scale.gsd_known = false;
    e.detections = true;
    e.options.upright = true;
    e.options.border = 12.5;
    e.remarks = {"some <remark>"};
    options.title = "My title";
    options.made_utc.clear();
    const std::string other = htmlOf(e, options);
    EXPECT_THAT(other, HasSubstr("5 frames/s (assumed)"));
    EXPECT_THAT(other, HasSubstr("<td><b>Light</b></td><td>no shadows found: what is dark at 6 vehicles"));
    EXPECT_THAT(other, HasSubstr("<td><b>Scale</b></td><td>not known; worked with 0.2 m/px"));
    EXPECT_THAT(other, HasSubstr(fact("Measured", "detections")));
    EXPECT_THAT(other, HasSubstr("enclosing upright boxes"));
    EXPECT_THAT(other, HasSubstr("without results within 12.5 px of the edge"));
    EXPECT_THAT(other, HasSubstr("<p>Note: some &lt;remark&gt;.</p>"));
    EXPECT_THAT(other, HasSubstr("<title>My title</title>"));
    EXPECT_THAT(other, Not(HasSubstr("Report made")));
}

TEST(EvaluationTables, ADifferenceIsRealWhereItsIntervalLeavesOutZero) {
    RunEvaluation e = evaluation();
    e.f_score = {0.875, 0.8, 0.9};
    e.difference.emplace();
    e.difference->other.id = 2;
    e.difference->other.name = "old <one>";
    const auto text = [&](double value, double low, double high) {
        e.difference->difference.f_score = {value, low, high};
        return htmlOf(e);
    };
    EXPECT_THAT(text(0.02, 0.01, 0.03), HasSubstr("f-score against run 2 (old &lt;one&gt;): +0.020 (0.010 – 0.030), "
                                                  "<b>significantly better</b>"));
    EXPECT_THAT(text(-0.02, -0.03, -0.01), HasSubstr(": -0.020 (-0.030 – -0.010), <b>significantly worse</b>"));
    EXPECT_THAT(text(0.02, -0.01, 0.03), HasSubstr(": +0.020 (-0.010 – 0.030), <b>no significant difference</b>"));
    EXPECT_THAT(text(0, 0, 0), HasSubstr(": +0.000 (0.000 – 0.000), <b>no significant difference</b>"));
    EXPECT_THAT(text(0, 0, 0), Not(HasSubstr("MOTA against")));
    EXPECT_THAT(text(0, 0, 0), HasSubstr("At T_ov 0.1: f-score 0.875 (0.800 – 0.900). In"));
    e.mota = BootstrapInterval{0.7, 0.6, 0.75};
    e.difference->other.name.clear();
    e.difference->difference.mota = BootstrapInterval{0.1, 0.05, 0.2};
    EXPECT_THAT(htmlOf(e), HasSubstr("0.900), MOTA 0.700 (0.600 – 0.750)."));
    EXPECT_THAT(htmlOf(e), HasSubstr("MOTA against run 2: +0.100 (0.050 – 0.200), <b>significantly better</b>"));
}

TEST(ErrorTables, CausesAreCountedInBoxesAndTheChartBeginsWithTheMostFrequent) {
    RunEvaluation e = evaluation();
    e.errors = {errorOf(ResultErrorKind::miss, ErrorCause::too_slow, 0, 1, {1}, {}),
                errorOf(ResultErrorKind::miss, ErrorCause::no_corners, 2, 6, {1}, {}),
                errorOf(ResultErrorKind::miss, ErrorCause::too_slow, 8, 8, {1}, {}),
                errorOf(ResultErrorKind::false_alarm, ErrorCause::shadow, 0, 0, {}, {5}),
                errorOf(ResultErrorKind::false_alarm, ErrorCause::too_slow, 0, 3, {}, {5})};
    const ReportFile report = makeEvaluationReport(e, nullptr);
    const std::string colour = "#4a6fa5";
    EXPECT_EQ(report.pictures.at("figure-causes").bytes, lyingBarsSvg({{nameOf(ErrorCause::too_slow), colour, 7},
                                                                       {nameOf(ErrorCause::no_corners), colour, 5},
                                                                       {nameOf(ErrorCause::shadow), colour, 1}}));
    const auto cause = [](ErrorCause one) { return std::string(nameOf(one)); };
    const std::string table = chapter(report.html, "Errors by kind and probable cause");
    EXPECT_THAT(table, HasSubstr("<td>miss</td><td>" + cause(ErrorCause::too_slow) + "</td><td>2</td><td>3</td>"));
    EXPECT_THAT(table, HasSubstr("<td>miss</td><td>" + cause(ErrorCause::no_corners) + "</td><td>1</td><td>5</td>"));
    EXPECT_THAT(table, HasSubstr("<td>false alarm</td><td>" + cause(ErrorCause::shadow) + "</td><td>1</td><td>1</td>"));
    EXPECT_THAT(table,
                HasSubstr("<td>false alarm</td><td>" + cause(ErrorCause::too_slow) + "</td><td>1</td><td>4</td>"));
}

TEST(ErrorTables, EachErrorSaysWhenAndOfWhich) {
    RunEvaluation e = evaluation();
    e.errors = {errorOf(ResultErrorKind::miss, ErrorCause::too_slow, 4, 4, {1}, {}),
                errorOf(ResultErrorKind::merge, ErrorCause::clustered_together, 2, 6, {1, 12}, {5}),
                errorOf(ResultErrorKind::id_switch, ErrorCause::track_ended, 3, 5, {1}, {5, 6})};
    const auto rowOf = [](const std::string& kind, const std::string& frames, const std::string& count,
                          const std::string& objects, const std::string& tracks, ErrorCause cause) {
        return row({kind, frames, count, objects, tracks, nameOf(cause), "a &lt; b"});
    };
    const std::string all = chapter(htmlOf(e), "All errors");
    EXPECT_THAT(all, HasSubstr(rowOf("miss", "4", "1", "1", "", ErrorCause::too_slow)));
    EXPECT_THAT(all, HasSubstr(rowOf("merge", "2–6", "5", "1, 12", "5", ErrorCause::clustered_together)));
    EXPECT_THAT(all, HasSubstr(rowOf("switch", "3–5", "3", "1", "5, 6", ErrorCause::track_ended)));
    ReportOptions options;
    options.rows = 3;
    EXPECT_THAT(htmlOf(e, options), Not(HasSubstr("more: the whole list")));
    options.rows = 2;
    const std::string shorter = htmlOf(e, options);
    EXPECT_THAT(shorter, HasSubstr("And 1 more: the whole list"));
    EXPECT_THAT(chapter(shorter, "All errors"), Not(HasSubstr("<td>switch</td>")));
    e.errors.clear();
    EXPECT_THAT(htmlOf(e), Not(HasSubstr("All errors")));
}

TEST(EvaluationFigures, SharesAreTakenOverASecondOfFramesAtLeastOne) {
    RunEvaluation e = evaluation();
    const auto words = [&](double rate_hz) {
        e.run.sequence.frame_rate_hz = rate_hz;
        return htmlOf(e);
    };
    EXPECT_THAT(words(0.4), HasSubstr("Precision and recall over 1 frames."));
    EXPECT_THAT(words(2.6), HasSubstr("Precision and recall over 3 frames."));
    EXPECT_THAT(words(24.6), HasSubstr("Precision and recall over 25 frames."));
    EXPECT_THAT(words(30), HasSubstr("Precision and recall over 31 frames."));
}

}  // namespace eyrie::evaluation_tables_test

#include "report/svg_chart.h"

#include <gmock/gmock.h>

#include <cmath>
#include <string>
#include <vector>

namespace eyrie::svg_chart_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// What is drawn in lies from 58 to 158 px across and from 26 down to 86 px.
constexpr ChartSize kSize{170, 126};

int countOf(const std::string& text, const std::string& part) {
    int count = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
    return count;
}

std::string rectangle(const std::string& x, const std::string& y, const std::string& width, const std::string& height) {
    return "<rect x=\"" + x + "\" y=\"" + y + "\" width=\"" + width + "\" height=\"" + height + "\"";
}

std::string line(const std::string& x1, const std::string& y1, const std::string& x2, const std::string& y2) {
    return "<line x1=\"" + x1 + "\" y1=\"" + y1 + "\" x2=\"" + x2 + "\" y2=\"" + y2 + "\"";
}

std::string words(const std::string& x, const std::string& y, const std::string& anchor, const std::string& text) {
    return "<text x=\"" + x + "\" y=\"" + y + "\" text-anchor=\"" + anchor + "\" fill=\"#333333\">" + text + "</text>";
}

CurveChart chartOf(std::vector<double> places, std::vector<std::vector<double>> curves, double top) {
    CurveChart chart;
    chart.place_label = "frame";
    chart.value_label = "value";
    chart.places = std::move(places);
    chart.top = top;
    for (std::vector<double>& values : curves) {
        const auto number = std::to_string(chart.series.size() + 1);
        chart.series.push_back({"s" + number, "#00000" + number, std::move(values)});
    }
    return chart;
}

}  // namespace

TEST(SvgChartByHand, CurvesLieWhereTheirValuesSay) {
    const std::string svg = curvesSvg(chartOf({0, 10}, {{0, 3}, {1.5, 0.5}}, 3), kSize);
    EXPECT_THAT(svg, HasSubstr("stroke=\"#000001\" points=\"58,86 158,26 \""));
    EXPECT_THAT(svg, HasSubstr("stroke=\"#000002\" points=\"58,56 158,76 \""));
    // Values: at most some five steps of 1, 20 px each.
    EXPECT_EQ(countOf(svg, "#dddddd"), 4);
    EXPECT_THAT(svg, HasSubstr(line("58", "66", "158", "66")));
    EXPECT_THAT(svg, HasSubstr(words("52", "90", "end", "0")));
    EXPECT_THAT(svg, HasSubstr(words("52", "70", "end", "1")));
    EXPECT_THAT(svg, HasSubstr(words("52", "30", "end", "3")));
    // Places: at most some eight steps of 2; with the axis seven lines.
    EXPECT_EQ(countOf(svg, "#666666"), 7);
    EXPECT_THAT(svg, HasSubstr(line("78", "86", "78", "90")));
    EXPECT_THAT(svg, HasSubstr(words("78", "103", "middle", "2")));
    EXPECT_THAT(svg, HasSubstr(line("158", "86", "158", "90")));
    EXPECT_THAT(svg, HasSubstr(line("58", "86", "158", "86")));
    EXPECT_THAT(svg, HasSubstr(words("108", "120", "middle", "frame")));
    // The names, each by its colour: 40 px and 8 a letter.
    EXPECT_THAT(svg, HasSubstr(rectangle("58", "8", "12", "10")));
    EXPECT_THAT(svg, HasSubstr(words("75", "17", "start", "s1")));
    EXPECT_THAT(svg, HasSubstr(rectangle("114", "8", "12", "10")));
    EXPECT_THAT(svg, HasSubstr(words("131", "17", "start", "s2")));
}

TEST(SvgChartByHand, PlacesNeedNotBeginAtATick) {
    const std::string svg = curvesSvg(chartOf({3, 13}, {{0, 1}}, 1), kSize);
    EXPECT_EQ(countOf(svg, "#666666"), 6) << "4, 6, 8, 10, 12 and the axis";
    EXPECT_THAT(svg, HasSubstr(words("68", "103", "middle", "4")));
    EXPECT_THAT(svg, HasSubstr(words("148", "103", "middle", "12")));
    EXPECT_THAT(svg, HasSubstr(words("52", "78", "end", "0.2"))) << "86 − 12 + 4";
    // Of places that are near each other each one has a tick; a single one has the next beside it.
    EXPECT_EQ(countOf(curvesSvg(chartOf({3, 5}, {{0, 1}}, 1), kSize), "#666666"), 4);
    const std::string single = curvesSvg(chartOf({5}, {{1}}, 1), kSize);
    EXPECT_EQ(countOf(single, "#666666"), 3);
    EXPECT_THAT(single, HasSubstr("points=\"58,26 \""));
    EXPECT_THAT(single, HasSubstr(words("158", "103", "middle", "6")));
}

TEST(SvgChartByHand, TheValueAxisEndsAboveTheLargestAndAtOneAtLeast) {
    EXPECT_THAT(curvesSvg(chartOf({0, 10}, {{0, 0.5}}, 0), kSize), HasSubstr("points=\"58,86 158,56 \""));
    // 86 − 10 / 10.5 · 60
    EXPECT_THAT(curvesSvg(chartOf({0, 10}, {{10, 0}}, 0), kSize), HasSubstr("points=\"58,28.9 158,86 \""));
}

TEST(SvgChartByHand, AGapPartsACurveAndItGoesOnBehindIt) {
    const double gap = std::nan("");
    const std::string svg = curvesSvg(chartOf({0, 2, 4, 6, 8, 10}, {{1, 0, gap, gap, 0, 1}}, 1), kSize);
    EXPECT_EQ(countOf(svg, "<polyline"), 2);
    EXPECT_THAT(svg, HasSubstr("points=\"58,26 78,86 \""));
    EXPECT_THAT(svg, HasSubstr("points=\"138,86 158,26 \""));
    // A curve of fewer values than places ends early.
    EXPECT_THAT(curvesSvg(chartOf({0, 5, 10}, {{1, 0}}, 1), kSize), HasSubstr("points=\"58,26 108,86 \""));
}

TEST(SvgChartByHand, StackedAreasLieOnEachOtherAndALackIsNone) {
    CurveChart chart = chartOf({0, 10}, {{1, 2}, {std::nan(""), 1}}, 4);
    chart.stacked = true;
    const std::string svg = curvesSvg(chart, kSize);
    // 15 px a unit; the upper one, of 1 and 3 in all, is drawn first.
    const std::string upper = "fill=\"#000002\" points=\"58,86 58,71 158,41 158,86\"";
    const std::string lower = "fill=\"#000001\" points=\"58,86 58,71 158,56 158,86\"";
    EXPECT_THAT(svg, HasSubstr(upper));
    EXPECT_THAT(svg, HasSubstr(lower));
    EXPECT_LT(svg.find(upper), svg.find(lower));
    chart.top = 0;  // 3 · 1.05: 86 − 3 / 3.15 · 60
    EXPECT_THAT(curvesSvg(chart, kSize), HasSubstr("158,28.9 158,86\""));
}

TEST(SvgChartByHand, SharesAreColumnsFromTheAxisUp) {
    const auto columns = [](std::size_t count) {
        return sharesSvg(std::vector<ChartBar>(count, {"", "#123456", 0.5}), {0.25, 1}, "score", kSize);
    };
    const std::string four = columns(4);  // 25 px each, a px apart
    EXPECT_EQ(countOf(four, "#123456"), 4);
    EXPECT_THAT(four, HasSubstr(rectangle("58", "56", "24", "30")));
    EXPECT_THAT(four, HasSubstr(rectangle("83", "56", "24", "30")));
    EXPECT_THAT(four, HasSubstr(rectangle("133", "56", "24", "30")));
    EXPECT_THAT(four, HasSubstr(line("58", "71", "158", "71")));
    EXPECT_THAT(four, HasSubstr(words("52", "75", "end", "25 %")));
    EXPECT_THAT(four, HasSubstr(words("52", "30", "end", "100 %")));
    EXPECT_THAT(four, HasSubstr(line("58", "86", "158", "86")));
    EXPECT_THAT(four, HasSubstr(words("108", "112", "middle", "score")));
    EXPECT_THAT(columns(20), HasSubstr(rectangle("63", "56", "4", "30")));
    EXPECT_THAT(columns(25), HasSubstr(rectangle("62", "56", "4", "30"))) << "of 4 px there is none to spare";
    EXPECT_THAT(columns(50), HasSubstr(rectangle("60", "56", "2", "30")));
    EXPECT_THAT(columns(200), HasSubstr(rectangle("58.5", "56", "0.8", "30"))) << "what is finer is not seen";
    EXPECT_THAT(columns(0), Not(HasSubstr("#123456")));
}

TEST(SvgChartByHand, LyingBarsAreAsLongAsTheirShareOfTheLargest) {
    const std::string svg = lyingBarsSvg({{"four", "#00000a", 4}, {"one", "#00000b", 1}, {"none", "#00000c", 0}}, 350);
    EXPECT_THAT(svg, HasSubstr("width=\"350\" height=\"68\""));  // three of 20 px and 8
    EXPECT_THAT(svg, HasSubstr(words("182", "18", "end", "four")));
    EXPECT_THAT(svg, HasSubstr(rectangle("190", "7", "100", "14") + " fill=\"#00000a\""));
    EXPECT_THAT(svg, HasSubstr(words("296", "18", "start", "4")));
    EXPECT_THAT(svg, HasSubstr(words("182", "38", "end", "one")));
    EXPECT_THAT(svg, HasSubstr(rectangle("190", "27", "25", "14") + " fill=\"#00000b\""));
    EXPECT_THAT(svg, HasSubstr(words("221", "38", "start", "1")));
    EXPECT_THAT(svg, HasSubstr(rectangle("190", "47", "1", "14") + " fill=\"#00000c\"")) << "seen all the same";
    EXPECT_THAT(svg, HasSubstr(words("196", "58", "start", "0")));
    // Less than one is not stretched to the whole width.
    EXPECT_THAT(lyingBarsSvg({{"half", "#00000a", 0.5}}, 350), HasSubstr(rectangle("190", "7", "50", "14")));
    EXPECT_THAT(lyingBarsSvg({}, 350), HasSubstr("height=\"28\""));
}

}  // namespace eyrie::svg_chart_test

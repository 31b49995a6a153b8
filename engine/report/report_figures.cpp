#include <algorithm>
#include <cmath>

#include "report/report_parts.h"
#include "report/svg_chart.h"

namespace eyrie {
namespace {

constexpr const char* kFound = "#2e9650";
constexpr const char* kMissed = "#dea014";
constexpr const char* kFalse = "#d64236";
constexpr const char* kRecall = "#2d78c8";

}  // namespace

void addFigures(ReportPage& page, const RunEvaluation& e, ReportFile& report) {
    page.chapter("Over time");
    CurveChart counts{"frame", "objects", {}, {}, 0, true};
    counts.series = {{"found", kFound, {}}, {"missed", kMissed, {}}, {"false", kFalse, {}}};
    for (const FrameCounts& frame : e.frames) {
        counts.places.push_back(frame.frame);
        counts.series[0].values.push_back(frame.found);
        counts.series[1].values.push_back(frame.missed);
        counts.series[2].values.push_back(frame.false_alarms);
    }
    report.add("figure-counts", ReportPicture::Kind::svg, curvesSvg(counts), kFigureWidth_mm);
    page.figure("figure-counts", "Objects found and missed, and false alarms, per frame.");

    const int half = std::max(1, static_cast<int>(std::lround(e.run.sequence.frame_rate_hz))) / 2;
    CurveChart ratios{"frame", "share", counts.places, {}, 1.02, false};
    ratios.series = {{"precision", kFalse, {}}, {"recall", kRecall, {}}};
    const int count = static_cast<int>(e.frames.size());
    for (int i = 0; i < count; ++i) {
        FrameCounts sum;
        for (int k = std::max(0, i - half); k <= std::min(count - 1, i + half); ++k) {
            const FrameCounts& one = e.frames[static_cast<std::size_t>(k)];
            sum.found += one.found;
            sum.missed += one.missed;
            sum.false_alarms += one.false_alarms;
        }
        const auto share = [&](int other) {
            return sum.found + other > 0 ? static_cast<double>(sum.found) / (sum.found + other) : std::nan("");
        };
        ratios.series[0].values.push_back(share(sum.false_alarms));
        ratios.series[1].values.push_back(share(sum.missed));
    }
    report.add("figure-ratios", ReportPicture::Kind::svg, curvesSvg(ratios), kFigureWidth_mm);
    page.figure("figure-ratios", "Precision and recall over " + std::to_string(2 * half + 1) + " frames.");

    std::vector<ChartBar> shares;
    for (const TruthTrackTally& tally : e.shown.tracks.truth) {
        const double share = tally.frames > 0 ? static_cast<double>(tally.matched) / tally.frames : 0;
        const TrackedLife life = trackedLife(tally, e.shown.convention);
        shares.push_back({"",
                          life == TrackedLife::mostly        ? kFound
                          : life == TrackedLife::mostly_lost ? kFalse
                                                             : kMissed,
                          share});
    }
    if (shares.empty()) return;
    std::stable_sort(shares.begin(), shares.end(),
                     [](const ChartBar& a, const ChartBar& b) { return a.value > b.value; });
    report.add(
        "figure-tracked", ReportPicture::Kind::svg,
        sharesSvg(shares, {1, kMostlyTracked, kMostlyLost}, std::to_string(shares.size()) + " objects, best first"),
        kFigureWidth_mm);
    page.figure(
        "figure-tracked",
        "Share of its frames in which each object was found: mostly tracked from 80 %, mostly lost below 20 %.");
}

}  // namespace eyrie

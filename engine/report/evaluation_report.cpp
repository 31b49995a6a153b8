#include "report/evaluation_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <set>

#include "chain/chain_options.h"
#include "io/number_text.h"
#include "report/svg_chart.h"

namespace eyrie {
namespace {

constexpr const char* kFound = "#2e9650";
constexpr const char* kMissed = "#dea014";
constexpr const char* kFalse = "#d64236";
constexpr const char* kRecall = "#2d78c8";
constexpr const char* kBar = "#4a6fa5";
constexpr std::size_t kFewParameters = 12;  ///< leave room for the measures on their page
constexpr std::size_t kChipsOnPage = 16;
constexpr int kChipHeight = 72;
constexpr double kChipShape = 1.6;
constexpr double kAround = 2.6;  ///< a chip is as many boxes wide

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string ids(const std::vector<int>& all, const char* between) {
    std::string text;
    for (const int id : all) {
        if (!text.empty()) text += between;
        text += std::to_string(id);
    }
    return text;
}

std::string frames(const Mistake& mistake) {
    if (mistake.first_frame == mistake.last_frame) return std::to_string(mistake.first_frame);
    return std::to_string(mistake.first_frame) + "–" + std::to_string(mistake.last_frame);
}

/// Tables and paragraphs, one after the other.
class Page {
 public:
    void heading(const std::string& text) { html_ += "<h2>" + escaped(text) + "</h2>\n"; }
    /// A heading that begins a page where the document is printed.
    void chapter(const std::string& text) { html_ += "<h2 class=\"chapter\">" + escaped(text) + "</h2>\n"; }
    void paragraph(const std::string& safe) { html_ += "<p>" + safe + "</p>\n"; }
    void figure(const std::string& name, const std::string& words) {
        html_ += "<p><img src=\"" + name + "\"><br><i>" + escaped(words) + "</i></p>\n";
    }
    /// `numbers_from`: columns from there on are aligned right.
    void beginTable(const std::vector<std::string>& headings, std::size_t numbers_from = 1000,
                    const std::string& kind = "plain") {
        html_ += "<table class=\"" + kind + "\" cellspacing=\"0\" cellpadding=\"3\">\n";
        if (headings.empty()) return;
        html_ += "<thead><tr>";
        for (std::size_t i = 0; i < headings.size(); ++i)
            html_ +=
                (i >= numbers_from ? "<th align=\"right\">" : "<th align=\"left\">") + escaped(headings[i]) + "</th>";
        html_ += "</tr></thead>\n";
    }
    /// `safe` fields; `numbers_from`: fields from there on are aligned right.
    void row(const std::vector<std::string>& safe, std::size_t numbers_from = 1000) {
        html_ += "<tr>";
        for (std::size_t i = 0; i < safe.size(); ++i) {
            html_ += i >= numbers_from ? "<td align=\"right\">" : "<td>";
            html_ += safe[i] + "</td>";
        }
        html_ += "</tr>\n";
    }
    void endTable() { html_ += "</table>\n"; }
    std::string take() { return std::move(html_); }

 private:
    std::string html_;
};

std::string interval(const BootstrapInterval& value) {
    return fixed(value.value, 3) + " (" + fixed(value.low, 3) + " – " + fixed(value.high, 3) + ")";
}

std::string differenceText(const std::string& measure, const BootstrapInterval& difference, const RunRecord& other) {
    const bool real = difference.low > 0 || difference.high < 0;
    return escaped(measure) + " against run " + std::to_string(other.id) +
           (other.name.empty() ? "" : " (" + escaped(other.name) + ")") + ": " + (difference.value >= 0 ? "+" : "") +
           interval(difference) + ", <b>" +
           (!real                  ? "not distinguishable"
            : difference.value > 0 ? "really better"
                                   : "really worse") +
           "</b>";
}

void tellWhat(Page& page, const RunEvaluation& e, const ReportOptions& options) {
    const RunRecord& run = e.run;
    page.beginTable({});
    const auto fact = [&](const char* name, const std::string& value) {
        page.row({"<b>" + escaped(name) + "</b>", escaped(value)});
    };
    fact("Video", run.sequence.path);
    fact("Image", std::to_string(run.sequence.size.width) + " × " + std::to_string(run.sequence.size.height) + " px, " +
                      fixedText(run.sequence.frame_rate_hz, 3) + " frames/s" +
                      (run.scale.gsd_known ? ", " + fixedText(run.scale.gsd_m_per_px, 4) + " m/px" : ""));
    fact("Run", std::to_string(run.id) + (run.name.empty() ? "" : ", " + run.name) + ", frames " +
                    std::to_string(run.first_frame) + " to " + std::to_string(run.first_frame + run.frames_done - 1) +
                    ", started " + run.started_utc + ", Eyrie " + run.engine_version);
    fact("Measured", e.detections ? "detections" : "tracks");
    fact("Ground truth", e.truth_name + ", " + std::to_string(e.frames.size()) + " frames");
    std::string how = e.options.upright ? "enclosing upright boxes" : "oriented boxes";
    if (e.options.vehicles_only) how += ", vehicles only";
    if (e.options.border) how += ", without results within " + fixedText(*e.options.border, 1) + " px of the edge";
    fact("Compared", how + ", definitions of the thesis (Teutsch §7.1)");
    if (!options.made_utc.empty()) fact("Report made", options.made_utc);
    page.endTable();
    for (const std::string& remark : e.remarks) page.paragraph("Note: " + escaped(remark) + ".");
    std::string certain = "f-score " + interval(e.f_score);
    if (e.mota) certain += ", MOTA " + interval(*e.mota);
    page.paragraph("At T_ov " + fixedText(e.options.overlap, 2) + ": " + certain +
                   ". In parentheses the 95 % interval had other tracks been filmed (bootstrap over whole tracks).");
    if (!e.difference) return;
    page.paragraph(differenceText("f-score", e.difference->difference.f_score, e.difference->other));
    if (e.difference->difference.mota)
        page.paragraph(differenceText("MOTA", *e.difference->difference.mota, e.difference->other));
}

/// Parameters other than the default, with the default's value.
std::set<std::string> tellDifferentParameters(Page& page, const RunEvaluation& e) {
    std::map<std::string, std::string> defaults;
    for (const auto& [name, value] : parameterValues(builtInPreset("default"))) defaults[name] = value;
    std::set<std::string> different;
    page.heading("Parameters that differ from the default");
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, value] : e.parameters) {
        const auto usual = defaults.find(name);
        if (usual != defaults.end() && usual->second == value) continue;
        different.insert(name);
        rows.push_back({escaped(name), "<b>" + escaped(value) + "</b>",
                        usual == defaults.end() ? "(unknown to this version)" : escaped(usual->second)});
    }
    if (rows.empty()) {
        page.paragraph("None: the run has the default parameters.");
        return different;
    }
    page.beginTable({"Parameter", "Value", "Default"});
    for (const auto& row : rows) page.row(row);
    page.endTable();
    return different;
}

void tellMeasures(Page& page, const RunEvaluation& e, bool on_a_new_page) {
    if (on_a_new_page)
        page.chapter("Measures");
    else
        page.heading("Measures");
    std::vector<std::string> headings{""};
    std::vector<std::vector<NamedMeasure>> columns;
    for (const Measures& measures : e.table) {
        headings.push_back("T_ov " + fixedText(measures.overlap, 2));
        columns.push_back(listMeasures(measures));
    }
    if (columns.empty()) return;
    page.beginTable(headings, 1);
    for (std::size_t i = 0; i < columns.front().size(); ++i) {
        std::vector<std::string> row{escaped(columns.front()[i].label)};
        for (const auto& column : columns)
            row.push_back(column[i].value ? fixed(*column[i].value, column[i].decimals) : "–");
        page.row(row, 1);
    }
    page.endTable();
}

void addFigures(Page& page, const RunEvaluation& e, EvaluationReportFile& report) {
    page.chapter("Over time");
    CurveChart counts{"frame", "objects", {}, {}, 0, true};
    counts.series = {{"found", kFound, {}}, {"missed", kMissed, {}}, {"false", kFalse, {}}};
    for (const FrameCounts& frame : e.frames) {
        counts.places.push_back(frame.frame);
        counts.series[0].values.push_back(frame.found);
        counts.series[1].values.push_back(frame.missed);
        counts.series[2].values.push_back(frame.false_alarms);
    }
    report.figures["figure-counts"] = curvesSvg(counts);
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
    report.figures["figure-ratios"] = curvesSvg(ratios);
    page.figure("figure-ratios", "Precision and recall over " + std::to_string(2 * half + 1) + " frames.");

    std::vector<ChartBar> shares;
    for (const TruthTrackTally& tally : e.shown.tracks.truth) {
        const double share = tally.frames > 0 ? static_cast<double>(tally.matched) / tally.frames : 0;
        shares.push_back({"", share >= 0.8 ? kFound : share < 0.2 ? kFalse : kMissed, share});
    }
    if (shares.empty()) return;
    std::stable_sort(shares.begin(), shares.end(),
                     [](const ChartBar& a, const ChartBar& b) { return a.value > b.value; });
    report.figures["figure-tracked"] =
        sharesSvg(shares, {1, 0.8, 0.2}, std::to_string(shares.size()) + " objects, best first");
    page.figure(
        "figure-tracked",
        "Share of its frames in which each object was found: mostly tracked from 80 %, mostly lost below 20 %.");
}

void tellCauses(Page& page, const RunEvaluation& e, EvaluationReportFile& report) {
    page.chapter("Errors by kind and probable cause");
    std::map<std::pair<int, int>, std::pair<int, int>> cells;  // kind, cause → entries, boxes
    std::map<int, int> by_cause;
    for (const DiagnosedMistake& one : e.mistakes) {
        auto& cell = cells[{static_cast<int>(one.mistake.kind), static_cast<int>(one.cause)}];
        ++cell.first;
        cell.second += one.mistake.count();
        by_cause[static_cast<int>(one.cause)] += one.mistake.count();
    }
    if (cells.empty()) {
        page.paragraph("Not one error.");
        return;
    }
    std::vector<ChartBar> bars;
    for (const auto& [cause, count] : by_cause)
        bars.push_back({nameOf(static_cast<MistakeCause>(cause)), kBar, static_cast<double>(count)});
    std::stable_sort(bars.begin(), bars.end(), [](const ChartBar& a, const ChartBar& b) { return a.value > b.value; });
    report.figures["figure-causes"] = lyingBarsSvg(bars);
    page.figure("figure-causes", "How often each cause occurs, in boxes.");
    page.beginTable({"Kind", "Probable cause", "Errors", "Count", ""});
    for (const auto& [key, cell] : cells) {
        const auto cause = static_cast<MistakeCause>(key.second);
        page.row({escaped(nameOf(static_cast<MistakeKind>(key.first))), escaped(nameOf(cause)),
                  std::to_string(cell.first), std::to_string(cell.second), escaped(explanationOf(cause))});
    }
    page.endTable();
}

std::string pngChip(const cv::Mat& gray, const OrientedBox& box) {
    const OrientedBox upright = box.upright();
    const double needed = std::max({20.0, upright.width * kAround, upright.length * kAround / kChipShape});
    const double scale = kChipHeight / needed;
    const cv::Size size(cvRound(kChipHeight * kChipShape), kChipHeight);
    const cv::Point2d middle((size.width - 1) / 2.0, (size.height - 1) / 2.0);
    const cv::Matx23d image_from_chip(1 / scale, 0, box.centre.x - middle.x / scale,  //
                                      0, 1 / scale, box.centre.y - middle.y / scale);
    cv::Mat chip;
    cv::warpAffine(gray, chip, image_from_chip, size, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT,
                   cv::Scalar(60));
    cv::cvtColor(chip, chip, cv::COLOR_GRAY2BGR);
    std::vector<cv::Point> outline;
    for (const cv::Point2d& corner : box.corners()) outline.emplace_back((corner - box.centre) * scale + middle);
    cv::polylines(chip, outline, true, {20, 20, 20}, 3, cv::LINE_AA);
    cv::polylines(chip, outline, true, {60, 220, 255}, 1, cv::LINE_AA);
    std::vector<unsigned char> bytes;
    cv::imencode(".png", chip, bytes);
    return {bytes.begin(), bytes.end()};
}

/// The errors with most frames, each once a kind, cause and place in the list; most first.
std::vector<std::size_t> gravest(const RunEvaluation& e, std::size_t most) {
    std::vector<std::size_t> order(e.mistakes.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return e.mistakes[a].mistake.count() > e.mistakes[b].mistake.count();
    });
    // Switches count once each however grave: every fourth place is theirs, where there are any.
    std::vector<std::size_t> rare;
    for (const std::size_t i : order)
        if (e.mistakes[i].mistake.kind == MistakeKind::id_switch) rare.push_back(i);
    rare.resize(std::min(rare.size(), most / 4));
    std::vector<std::size_t> chosen;
    for (const std::size_t i : order) {
        if (chosen.size() + rare.size() >= most) break;
        if (std::find(rare.begin(), rare.end(), i) == rare.end()) chosen.push_back(i);
    }
    chosen.insert(chosen.end(), rare.begin(), rare.end());
    return chosen;
}

void addChips(Page& page, const RunEvaluation& e, FrameSource* pixels, const ReportOptions& options,
              EvaluationReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop) {
    if (e.mistakes.empty() || pixels == nullptr || options.chips == 0) return;
    std::vector<std::size_t> chosen = gravest(e, options.chips);
    std::vector<std::size_t> by_frame = chosen;
    const auto place = [&](std::size_t i) -> const MistakePlace& {
        return e.mistakes[i].mistake.places[e.mistakes[i].place];
    };
    std::sort(by_frame.begin(), by_frame.end(),
              [&](std::size_t a, std::size_t b) { return place(a).frame < place(b).frame; });
    std::string trouble;
    for (std::size_t k = 0; k < by_frame.size() && trouble.empty() && !stop.stop_requested(); ++k) {
        try {
            const std::size_t i = by_frame[k];
            report.chips["chip-" + std::to_string(i + 1)] =
                pngChip(pixels->read(place(i).frame, false).gray, place(i).box);
        } catch (const std::exception& error) {
            trouble = error.what();
        }
        if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(by_frame.size()));
    }
    page.chapter("The gravest errors");
    if (!trouble.empty()) page.paragraph("Pictures are missing: " + escaped(trouble));
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        // A table for each printed page: rows with pictures must not be broken.
        if (k > 0 && k % kChipsOnPage == 0) {
            page.endTable();
            page.chapter("The gravest errors, continued");
        }
        if (k % kChipsOnPage == 0)
            page.beginTable({"", "Kind", "Frames", "Count", "Object", "Track", "Probable cause", "Detail"}, 1000,
                            "chips");
        const std::size_t i = chosen[k];
        const DiagnosedMistake& one = e.mistakes[i];
        const std::string name = "chip-" + std::to_string(i + 1);
        const bool is_switch = one.mistake.kind == MistakeKind::id_switch;
        page.row({report.chips.contains(name) ? "<img src=\"" + name + "\">" : "", escaped(nameOf(one.mistake.kind)),
                  frames(one.mistake), std::to_string(one.mistake.count()), ids(one.mistake.objects, ", "),
                  ids(one.mistake.tracks, is_switch ? " → " : ", "), escaped(nameOf(one.cause)), escaped(one.text)});
    }
    page.endTable();
}

void listAll(Page& page, const RunEvaluation& e, std::size_t most) {
    if (e.mistakes.empty()) return;
    page.chapter("All errors");
    page.beginTable({"Kind", "Frames", "Count", "Object", "Track", "Probable cause", "Detail"});
    for (std::size_t i = 0; i < e.mistakes.size() && i < most; ++i) {
        const DiagnosedMistake& one = e.mistakes[i];
        page.row({escaped(nameOf(one.mistake.kind)), frames(one.mistake), std::to_string(one.mistake.count()),
                  ids(one.mistake.objects, ", "), ids(one.mistake.tracks, ", "), escaped(nameOf(one.cause)),
                  escaped(one.text)});
    }
    page.endTable();
    if (e.mistakes.size() > most)
        page.paragraph("And " + std::to_string(e.mistakes.size() - most) +
                       " more: the whole list is written by eyrie-cli evaluate --errors.");
}

void listParameters(Page& page, const RunEvaluation& e, const std::set<std::string>& different) {
    page.chapter("All parameters");
    page.beginTable({"Parameter", "Value", "Parameter", "Value"});
    const std::size_t half = (e.parameters.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) {
        std::vector<std::string> row;
        for (const std::size_t at : {i, i + half}) {
            if (at >= e.parameters.size()) continue;
            const auto& [name, value] = e.parameters[at];
            const bool strong = different.contains(name);
            for (const std::string& text : {name, value})
                row.push_back(strong ? "<b>" + escaped(text) + "</b>" : escaped(text));
        }
        page.row(row);
    }
    page.endTable();
}

}  // namespace

EvaluationReportFile makeEvaluationReport(const RunEvaluation& evaluation, FrameSource* pixels,
                                          const ReportOptions& options, const std::function<void(double)>& progress,
                                          const std::stop_token& stop) {
    EvaluationReportFile report;
    const std::string name = std::filesystem::path(evaluation.run.sequence.path).filename().string();
    const std::string title =
        options.title.empty() ? "Evaluation of run " + std::to_string(evaluation.run.id) + ", " + name : options.title;
    Page page;
    tellWhat(page, evaluation, options);
    const std::set<std::string> different = tellDifferentParameters(page, evaluation);
    tellMeasures(page, evaluation, different.size() > kFewParameters);
    addFigures(page, evaluation, report);
    tellCauses(page, evaluation, report);
    addChips(page, evaluation, pixels, options, report, progress, stop);
    listAll(page, evaluation, options.rows);
    listParameters(page, evaluation, different);
    report.html =
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" + escaped(title) +
        "</title>\n<style>body{font-family:sans-serif;font-size:14px;max-width:900px;margin:24px auto;padding:0 12px;"
        "color:#222;background:#fff}h1{font-size:22px}h2{font-size:17px;margin-top:28px}"
        "table{border-collapse:collapse;margin:6px 0}th{border-bottom:2px solid #888;font-size:13px}"
        "td{border-bottom:1px solid #ddd;font-size:13px;vertical-align:middle}img{max-width:100%}"
        "@media print{h2.chapter{break-before:page}thead{display:table-header-group}}</style></head>\n"
        "<body><h1>" +
        escaped(title) + "</h1>\n" + page.take() + "</body></html>\n";
    return report;
}

}  // namespace eyrie

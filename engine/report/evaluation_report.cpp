#include "report/evaluation_report.h"

#include <set>

#include "chain/chain_options.h"
#include "io/tables/number_text.h"
#include "report/report_parts.h"

namespace eyrie {
namespace {

constexpr std::size_t kFewParameters = 12;  ///< leave room for the measures on their page

std::string interval(const BootstrapInterval& value) {
    return fixedDigits(value.value, 3) + " (" + fixedDigits(value.low, 3) + " – " + fixedDigits(value.high, 3) + ")";
}

std::string differenceText(const std::string& measure, const BootstrapInterval& difference, const RunRecord& other) {
    const bool real = difference.low > 0 || difference.high < 0;
    return markupEscaped(measure) + " against run " + std::to_string(other.id) +
           (other.name.empty() ? "" : " (" + markupEscaped(other.name) + ")") + ": " +
           (difference.value >= 0 ? "+" : "") + interval(difference) + ", <b>" +
           (!real                  ? "no significant difference"
            : difference.value > 0 ? "significantly better"
                                   : "significantly worse") +
           "</b>";
}

void tellWhat(ReportPage& page, const RunEvaluation& e, const ReportOptions& options) {
    const RunRecord& run = e.run;
    page.beginTable({});
    const auto fact = [&](const char* name, const std::string& value) {
        page.row({"<b>" + markupEscaped(name) + "</b>", markupEscaped(value)});
    };
    fact("Video", run.sequence.path);
    fact("Image", std::to_string(run.sequence.size.width) + " × " + std::to_string(run.sequence.size.height) + " px, " +
                      fixedText(run.scale.frame_rate_hz, 3) + " frames/s" + (run.rate_assumed ? " (assumed)" : ""));
    fact("Scale", (run.scale.gsd_known ? "" : "not known; worked with ") +
                      describe(run.scale, run.scale_basis, run.sequence.size));
    if (const std::string light = describe(run.light, run.scale); !light.empty()) fact("Light", light);
    fact("Run", std::to_string(run.id) + (run.name.empty() ? "" : ", " + run.name) + ", frames " +
                    std::to_string(run.first_frame) + " to " + std::to_string(run.first_frame + run.frames_done - 1) +
                    ", started " + run.started_utc + ", Eyrie " + run.engine_version);
    fact("Measured", e.detections ? "detections" : "tracks");
    fact("Ground truth", e.truth_name + ", " + std::to_string(e.frames.size()) + " frames");
    std::string how = e.options.upright ? "enclosing upright boxes" : "oriented boxes";
    how += countedText(e.options);
    if (e.options.border) how += ", without results within " + fixedText(*e.options.border, 1) + " px of the edge";
    fact("Compared", how + ", definitions of the thesis (Teutsch §7.1)");
    if (!options.made_utc.empty()) fact("Report made", options.made_utc);
    page.endTable();
    for (const std::string& remark : e.remarks) page.paragraph("Note: " + markupEscaped(remark) + ".");
    std::string certain = "f-score " + interval(e.f_score);
    if (e.mota) certain += ", MOTA " + interval(*e.mota);
    page.paragraph("At T_ov " + fixedText(e.options.overlap, 2) + ": " + certain +
                   ". In parentheses: 95 % intervals (bootstrap over whole tracks).");
    if (!e.difference) return;
    page.paragraph(differenceText("f-score", e.difference->difference.f_score, e.difference->other));
    if (e.difference->difference.mota)
        page.paragraph(differenceText("MOTA", *e.difference->difference.mota, e.difference->other));
}

void tellMeasures(ReportPage& page, const RunEvaluation& e, bool on_a_new_page) {
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
        std::vector<std::string> row{markupEscaped(columns.front()[i].label)};
        for (const auto& column : columns)
            row.push_back(column[i].value ? fixedDigits(*column[i].value, column[i].decimals) : "–");
        page.row(row, 1);
    }
    page.endTable();
}

void listParameters(ReportPage& page, const RunEvaluation& e, const std::set<std::string>& different) {
    page.chapter("All parameters");
    page.beginTable({"Parameter", "Value", "Parameter", "Value"});
    const std::size_t half = (e.parameters.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) {
        std::vector<std::string> row;
        for (const std::size_t at : {i, i + half}) {
            if (at >= e.parameters.size()) break;
            const auto& [name, value] = e.parameters[at];
            const bool strong = different.contains(name);
            for (const std::string& text : {name, value})
                row.push_back(strong ? "<b>" + markupEscaped(text) + "</b>" : markupEscaped(text));
        }
        page.row(row);
    }
    page.endTable();
}

}  // namespace

std::string fixedDigits(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::set<std::string> tellDifferentParameters(ReportPage& page,
                                              const std::vector<std::pair<std::string, std::string>>& parameters) {
    std::map<std::string, std::string> defaults;
    for (const auto& [name, value] : parameterValues(builtInPreset("default"))) defaults[name] = value;
    std::set<std::string> different;
    page.heading("Parameters that differ from the default");
    std::vector<std::vector<std::string>> rows;
    for (const auto& [name, value] : parameters) {
        const auto usual = defaults.find(name);
        if (usual != defaults.end() && usual->second == value) continue;
        different.insert(name);
        rows.push_back({markupEscaped(name), "<b>" + markupEscaped(value) + "</b>",
                        usual == defaults.end() ? "(unknown to this version)" : markupEscaped(usual->second)});
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

ReportFile makeEvaluationReport(const RunEvaluation& evaluation, FrameSource* pixels, const ReportOptions& options,
                                const std::function<void(double)>& progress, const std::stop_token& stop) {
    ReportFile report;
    const std::string name = std::filesystem::path(evaluation.run.sequence.path).filename().string();
    const std::string title =
        options.title.empty() ? "Evaluation of run " + std::to_string(evaluation.run.id) + ", " + name : options.title;
    ReportPage page;
    tellWhat(page, evaluation, options);
    const std::set<std::string> different = tellDifferentParameters(page, evaluation.parameters);
    tellMeasures(page, evaluation, different.size() > kFewParameters);
    addFigures(page, evaluation, report);
    tellCauses(page, evaluation, report);
    addChips(page, evaluation, pixels, options, report, progress, stop);
    listErrors(page, evaluation, options.rows);
    listParameters(page, evaluation, different);
    report.html = reportPage(title, page.take());
    return report;
}

}  // namespace eyrie

#include <algorithm>
#include <array>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "report/report_parts.h"
#include "report/svg_chart.h"

namespace eyrie {
namespace {

constexpr const char* kBar = "#4a6fa5";
constexpr std::size_t kChipsOnPage = 16;
constexpr int kChipHeight = 72;
constexpr double kChipWidth_mm = 21;
constexpr double kChipShape = 1.6;
constexpr double kAround = 2.6;  ///< a chip is as many boxes wide

std::string ids(const std::vector<int>& all, const char* between) {
    std::string text;
    for (const int id : all) {
        if (!text.empty()) text += between;
        text += std::to_string(id);
    }
    return text;
}

std::string frames(const ResultError& error) {
    if (error.first_frame == error.last_frame) return std::to_string(error.first_frame);
    return std::to_string(error.first_frame) + "–" + std::to_string(error.last_frame);
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
    std::vector<std::size_t> order(e.errors.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return e.errors[a].error.count() > e.errors[b].error.count();
    });
    // Switches count once each however grave: every fourth place is theirs, where there are any.
    std::vector<std::size_t> rare;
    for (const std::size_t i : order)
        if (e.errors[i].error.kind == ResultErrorKind::id_switch) rare.push_back(i);
    rare.resize(std::min(rare.size(), most / 4));
    std::vector<std::size_t> chosen;
    for (const std::size_t i : order) {
        if (chosen.size() + rare.size() >= most) break;
        if (std::find(rare.begin(), rare.end(), i) == rare.end()) chosen.push_back(i);
    }
    chosen.insert(chosen.end(), rare.begin(), rare.end());
    return chosen;
}

}  // namespace

void tellCauses(ReportPage& page, const RunEvaluation& e, ReportFile& report) {
    page.chapter("Errors by kind and probable cause");
    std::map<std::pair<int, int>, std::pair<int, int>> cells;  // kind, cause → entries, boxes
    std::map<int, int> by_cause;
    for (const DiagnosedError& one : e.errors) {
        auto& cell = cells[{static_cast<int>(one.error.kind), static_cast<int>(one.cause)}];
        ++cell.first;
        cell.second += one.error.count();
        by_cause[static_cast<int>(one.cause)] += one.error.count();
    }
    if (cells.empty()) {
        page.paragraph("No errors.");
        return;
    }
    std::vector<ChartBar> bars;
    bars.reserve(by_cause.size());
    for (const auto& [cause, count] : by_cause)
        bars.push_back({nameOf(static_cast<ErrorCause>(cause)), kBar, static_cast<double>(count)});
    std::stable_sort(bars.begin(), bars.end(), [](const ChartBar& a, const ChartBar& b) { return a.value > b.value; });
    report.add("figure-causes", ReportPicture::Kind::svg, lyingBarsSvg(bars), kFigureWidth_mm);
    page.figure("figure-causes", "How often each cause occurs, in boxes.");
    page.beginTable({"Kind", "Probable cause", "Errors", "Count", ""});
    for (const auto& [key, cell] : cells) {
        const auto cause = static_cast<ErrorCause>(key.second);
        page.row({markupEscaped(nameOf(static_cast<ResultErrorKind>(key.first))), markupEscaped(nameOf(cause)),
                  std::to_string(cell.first), std::to_string(cell.second), markupEscaped(explanationOf(cause))});
    }
    page.endTable();
}

void addChips(ReportPage& page, const RunEvaluation& e, FrameSource* pixels, const ReportOptions& options,
              ReportFile& report, const std::function<void(double)>& progress, const std::stop_token& stop) {
    if (e.errors.empty() || pixels == nullptr || options.chips == 0) return;
    std::vector<std::size_t> chosen = gravest(e, options.chips);
    std::vector<std::size_t> by_frame = chosen;
    const auto place = [&](std::size_t i) -> const ErrorPlace& { return e.errors[i].error.places[e.errors[i].place]; };
    std::sort(by_frame.begin(), by_frame.end(),
              [&](std::size_t a, std::size_t b) { return place(a).frame < place(b).frame; });
    std::string trouble;
    for (std::size_t k = 0; k < by_frame.size() && trouble.empty() && !stop.stop_requested(); ++k) {
        try {
            const std::size_t i = by_frame[k];
            report.add("chip-" + std::to_string(i + 1), ReportPicture::Kind::png,
                       pngChip(pixels->read(place(i).frame, false).gray, place(i).box), kChipWidth_mm);
        } catch (const std::exception& error) {
            trouble = error.what();
        }
        if (progress) progress(static_cast<double>(k + 1) / static_cast<double>(by_frame.size()));
    }
    page.chapter("The worst errors");
    if (!trouble.empty()) page.paragraph("Pictures are missing: " + markupEscaped(trouble));
    for (std::size_t k = 0; k < chosen.size(); ++k) {
        // A table for each printed page: rows with pictures must not be broken.
        if (k > 0 && k % kChipsOnPage == 0) {
            page.endTable();
            page.chapter("The worst errors, continued");
        }
        if (k % kChipsOnPage == 0)
            page.beginTable({"", "Kind", "Frames", "Count", "Object", "Track", "Probable cause", "Detail"}, 1000,
                            "chips");
        const std::size_t i = chosen[k];
        const DiagnosedError& one = e.errors[i];
        const std::string name = "chip-" + std::to_string(i + 1);
        const bool is_switch = one.error.kind == ResultErrorKind::id_switch;
        page.row({report.pictures.contains(name) ? "<img src=\"" + name + "\">" : "",
                  markupEscaped(nameOf(one.error.kind)), frames(one.error), std::to_string(one.error.count()),
                  ids(one.error.objects, ", "), ids(one.error.tracks, is_switch ? " → " : ", "),
                  markupEscaped(nameOf(one.cause)), markupEscaped(one.text)});
    }
    page.endTable();
}

void listErrors(ReportPage& page, const RunEvaluation& e, std::size_t most) {
    if (e.errors.empty()) return;
    page.chapter("All errors");
    page.beginTable({"Kind", "Frames", "Count", "Object", "Track", "Probable cause", "Detail"});
    for (std::size_t i = 0; i < e.errors.size() && i < most; ++i) {
        const DiagnosedError& one = e.errors[i];
        page.row({markupEscaped(nameOf(one.error.kind)), frames(one.error), std::to_string(one.error.count()),
                  ids(one.error.objects, ", "), ids(one.error.tracks, ", "), markupEscaped(nameOf(one.cause)),
                  markupEscaped(one.text)});
    }
    page.endTable();
    if (e.errors.size() > most)
        page.paragraph("And " + std::to_string(e.errors.size() - most) +
                       " more: the whole list is written by eyrie-cli evaluate --errors.");
}

}  // namespace eyrie

#include "cli/reports/evaluation_text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace eyrie::cli {
namespace {

constexpr std::size_t kLabelWidth = 20;
constexpr std::size_t kValueWidth = 11;

std::string fixed(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

/// "0.1", "0.25".
std::string shortest(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%g", value);
    return text;
}

/// Characters on screen, of UTF-8 text.
std::size_t widthOf(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string leftAligned(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, widthOf(text)), ' ');
}

std::string rightAligned(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, widthOf(text)), ' ') + text;
}

std::string conventionText(Convention convention) {
    return convention == Convention::thesis
               ? "thesis (Teutsch §7.1)"
               : "trackeval (TrackEval: ignored objects are removed, and results on them are false alarms)";
}

std::string comparedText(const EvaluationOptions& options) {
    std::string text = options.upright ? "enclosing upright boxes" : "oriented boxes";
    text += countedText(options);
    if (options.border) {
        text += ", without results within " + shortest(*options.border) + " px of the edge of " +
                std::to_string(options.image_size.width) + "x" + std::to_string(options.image_size.height);
    }
    return text;
}

std::string registrationText(const RegistrationError& error) {
    char text[200];
    std::snprintf(text, sizeof text, "mean %.3f px, rms %.3f px, largest %.3f px over %zu frames; %d not registered",
                  error.mean_px, error.rms_px, error.max_px, error.frames.size(), error.unregistered);
    return text;
}

}  // namespace

std::string tableText(const EvaluationReport& report) {
    std::string text;
    const auto head = [&](const char* label, const std::string& value) {
        text.append(leftAligned(label, kLabelWidth)).append(value).append("\n");
    };
    head("Convention", conventionText(report.options.convention));
    head("Ground truth", report.ground_truth);
    head("Result", report.result);
    head("Compared", comparedText(report.options));
    if (report.registration) head("Registration error", registrationText(*report.registration));

    std::vector<std::vector<NamedMeasure>> columns;
    text.append("\n").append(leftAligned("T_ov", kLabelWidth));
    for (const Measures& measures : report.measures) {
        text += rightAligned(shortest(measures.overlap), kValueWidth);
        columns.push_back(listMeasures(measures));
    }
    text += "\n";
    std::string group;
    for (std::size_t row = 0; !columns.empty() && row < columns.front().size(); ++row) {
        const NamedMeasure& first = columns.front()[row];
        if (first.group != group) text += "\n";
        group = first.group;
        text += leftAligned(first.label, kLabelWidth);
        for (const auto& column : columns) {
            const NamedMeasure& measure = column[row];
            text += rightAligned(measure.value ? fixed(*measure.value, measure.decimals) : "–", kValueWidth);
        }
        text += "\n";
    }
    if (!report.remarks.empty()) text += "\n";
    for (const std::string& remark : report.remarks) text.append("Note: ").append(remark).append("\n");
    return text;
}

void addMeasures(nlohmann::ordered_json& entry, const Measures& measures) {
    for (const NamedMeasure& measure : listMeasures(measures)) {
        if (!measure.value) {
            entry[measure.key] = nullptr;
        } else if (measure.decimals == 0) {
            entry[measure.key] = std::llround(*measure.value);
        } else {
            entry[measure.key] = *measure.value;
        }
    }
}

std::string jsonText(const EvaluationReport& report) {
    using Json = nlohmann::ordered_json;
    Json json{{"convention", nameOf(report.options.convention)},
              {"ground_truth", report.ground_truth},
              {"result", report.result},
              {"upright", report.options.upright},
              {"vehicles_only", report.options.vehicles_only},
              {"classes", wordOfScored(report.options.one_class)}};
    json["border_px"] = report.options.border ? Json(*report.options.border) : Json();
    if (report.options.border) {
        json["image_size"] = {report.options.image_size.width, report.options.image_size.height};
    }
    json["measures"] = Json::array();
    for (const Measures& measures : report.measures) {
        Json entry{{"overlap", measures.overlap}};
        addMeasures(entry, measures);
        json["measures"].push_back(std::move(entry));
    }
    if (report.registration) {
        json["registration"] = {{"mean_px", report.registration->mean_px},
                                {"rms_px", report.registration->rms_px},
                                {"max_px", report.registration->max_px},
                                {"frames", report.registration->frames.size()},
                                {"unregistered", report.registration->unregistered}};
    }
    json["remarks"] = report.remarks;
    return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace eyrie::cli

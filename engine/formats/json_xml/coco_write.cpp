#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "formats/format_functions.h"
#include "formats/json_xml/coco.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr int kCocoDecimals = 4;

std::string jsonString(const std::string& text) {
    return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

std::string px(double value) {
    return fixedText(value, kCocoDecimals);
}

std::string imagesText(const LabelFile& labels, int frames, bool video) {
    std::string text;
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        const auto named = labels.image_names.find(frame);
        text += frame == 0 ? "\n" : ",\n";
        text += "  {\"id\": " + std::to_string(frame + 1) + ", \"file_name\": " +
                jsonString(named == labels.image_names.end() ? numberedName(frame) + ".png" : named->second);
        if (labels.image_size) {
            text += ", \"width\": " + std::to_string(labels.image_size->width) +
                    ", \"height\": " + std::to_string(labels.image_size->height);
        }
        if (video) text += ", \"video_id\": 1, \"frame_index\": " + std::to_string(frame);
        text += "}";
    }
    return text;
}

/// What DIVE shows of a box besides its place.
std::string diveAttributes(const LabelBox& record) {
    std::string text;
    const auto add = [&](const char* key, const std::string& value) {
        text += (text.empty() ? "\"" : ", \"") + std::string(key) + "\": " + value;
    };
    const double turn = wrapPi(record.box.heading);
    if (std::abs(turn) > 5e-7) add("rotation", fixedText(turn, 6));
    if (record.occlusion == Occlusion::partly) add("occluded", "\"partly\"");
    if (record.occlusion == Occlusion::fully) add("occluded", "\"fully\"");
    if (record.ignore) add("ignore", "true");
    return text.empty() ? "" : ", \"dive_detection_attributes\": {" + text + "}";
}

std::string annotationText(const LabelBox& record, int number, int category, const ExportOptions& options, bool video) {
    const OrientedBox& box = record.box;
    const OrientedBox unrotated{box.centre, box.length, box.width, 0};
    const BoxEdges e = edgesOf(options.unrotated_bounds ? unrotated : box.upright(), 0);
    std::string text = "  {\"id\": " + std::to_string(number) + ", \"image_id\": " + std::to_string(record.frame + 1) +
                       ", \"category_id\": " + std::to_string(category) + ", \"bbox\": [" + px(e.left) + ", " +
                       px(e.top) + ", " + px(e.width) + ", " + px(e.height) + "], \"area\": " + px(box.area()) +
                       ", \"segmentation\": [[";
    std::string separator;
    for (const cv::Point2d& corner : frontFirstCorners(box)) {
        text += separator + px(corner.x + 0.5) + ", " + px(corner.y + 0.5);
        separator = ", ";
    }
    text += "]], \"iscrowd\": " + std::string(record.ignore ? "1" : "0");
    if (video && record.id) text += ", \"track_id\": " + std::to_string(*record.id);
    if (record.score != 1) text += ", \"score\": " + fixedText(record.score, 6);
    text += diveAttributes(record);
    if (record.occlusion != Occlusion::none) {
        text += std::string(", \"attributes\": {\"occluded\": true, \"occlusion\": \"") +
                (record.occlusion == Occlusion::fully ? "fully" : "partly") + "\"}";
    }
    return text + "}";
}

void write(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
           ExportReport& report, bool video) {
    std::map<std::string, int> categories;
    std::vector<std::string> names;
    const auto categoryOf = [&](const std::string& name) {
        const std::string shown = name.empty() ? "object" : name;
        const auto [found, is_new] = categories.emplace(shown, static_cast<int>(names.size()) + 1);
        if (is_new) names.push_back(shown);
        return found->second;
    };
    for (const std::string& name : labels.classes) categoryOf(name);
    std::set<std::string> sorted;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records) sorted.insert(record.object_class);
    }
    for (const std::string& name : sorted) categoryOf(name);

    std::string text = "{\"info\": {\"description\": " + jsonString(options.sequence) +
                       ", \"dive_extensions\": [\"dive_detection_attributes\"]},\n";
    if (video) {
        text += "\"videos\": [{\"id\": 1, \"name\": " + jsonString(options.sequence);
        if (labels.frame_rate_hz) {
            const std::string rate = shortestText(*labels.frame_rate_hz);
            text += ", \"fps\": " + rate + ", \"annotation_fps\": " + rate;
        }
        text += "}],\n";
    }
    text += "\"categories\": [";
    for (std::size_t i = 0; i < names.size(); ++i) {
        const bool vehicle = isVehicleClass(names[i]);
        text += std::string(i == 0 ? "\n" : ",\n") + "  {\"id\": " + std::to_string(i + 1) +
                ", \"name\": " + jsonString(names[i]) +
                ", \"supercategory\": " + (vehicle ? "\"vehicle\"}" : "\"object\"}");
    }
    text += "],\n\"images\": [" + imagesText(labels, imagesToWrite(labels, path), video) + "],\n\"annotations\": [";
    int number = 0;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records) {
            text += number == 0 ? "\n" : ",\n";
            ++number;
            text += annotationText(record, number, categoryOf(record.object_class), options, video);
        }
    }
    writeFileAtomically(path, text + "]}\n");
    report.files.push_back(path);
    report.notes.push_back(
        options.unrotated_bounds
            ? "bbox is the unrotated box, as DIVE reads it; corners are in segmentation"
            : "bbox encloses the turned box; corners are in segmentation (DIVE needs --unrotated-bounds)");
}

bool isJson(const FileHead& head) {
    const std::size_t first = head.text.find_first_not_of(" \t\r\n");
    return first != std::string::npos && (head.text[first] == '{' || head.text[first] == '[');
}

bool tellsOfVideo(const FileHead& head) {
    return head.text.find("\"videos\"") != std::string::npos ||
           head.text.find("\"frame_index\"") != std::string::npos ||
           head.text.find("\"track_id\"") != std::string::npos;
}

}  // namespace

void writeCoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report) {
    write(labels, path, options, report, false);
}

void writeKwcoco(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
                 ExportReport& report) {
    write(labels, path, options, report, true);
}

LabelFormat cocoFormat() {
    LabelFormat format;
    format.info = {"coco", "COCO", {"json"}, false, true, true, {}};
    format.info.carries = {.rotation = true, .object_class = true, .occlusion = true, .ignore = true, .score = true};
    format.read = readCoco;
    format.write = writeCoco;
    format.fits = isJson;
    return format;
}

LabelFormat kwcocoFormat() {
    LabelFormat format = cocoFormat();
    format.info.name = "kwcoco";
    format.info.title = "KWCOCO";
    format.info.carries.id = true;
    format.write = writeKwcoco;
    format.fits = [](const FileHead& head) { return isJson(head) && tellsOfVideo(head); };
    return format;
}

}  // namespace eyrie

#include "cli/arguments/evaluation_files.h"

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "formats/label_formats.h"
#include "io/folder.h"

namespace eyrie::cli {
namespace {

/// Whether the file begins like MOTChallenge text, so that its errors are told by line and column.
bool beginsWithNumbers(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) return false;
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    while (std::getline(stream, line) && line.find_first_not_of(" \t\r") == std::string::npos) {
    }
    const std::size_t first = line.find_first_not_of(" \t\r");
    const bool digit = first != std::string::npos && line[first] >= '0' && line[first] <= '9';
    return digit && line.find(',') != std::string::npos;
}

bool isMot(const std::string& format) {
    return format == "mot" || format == "mot-result";
}

BoxFile readAs(const std::string& format, const std::filesystem::path& file, std::optional<double> mot_origin,
               std::optional<cv::Size> image_size) {
    ImportOptions import;
    import.first_pixel_edge = mot_origin;
    import.image_size = image_size;
    const LabelFile labels = readLabels(file, format, import);
    BoxFile read;
    read.boxes = plainBoxes(labels.boxes);
    for (const LabelFormatInfo& info : labelFormats()) {
        if (info.name != format) continue;
        read.format = info.title;
        read.has_headings = info.carries.rotation;
    }
    if (!labels.further_files.empty() || !labels.notes.empty()) {
        std::string text = file.string() + " was read as " + read.format;
        std::string separator = " together with ";
        for (const auto& further : labels.further_files) {
            text += separator + further.filename().string();
            separator = ", ";
        }
        read.remarks.push_back(text);
    }
    for (const std::string& note : labels.notes) read.remarks.push_back(note);
    return read;
}

MotSequence readJsonDescription(const std::filesystem::path& file) {
    MotSequence sequence;
    try {
        const auto json = nlohmann::json::parse(std::ifstream(file));
        if (!json.is_object()) return sequence;
        const auto number = [&](const char* key) { return json.contains(key) && json[key].is_number_integer(); };
        if (number("width") && number("height")) {
            sequence.image_size = cv::Size(json["width"].get<int>(), json["height"].get<int>());
        }
        if (number("frames")) sequence.frame_count = json["frames"].get<int>();
    } catch (const nlohmann::json::exception& error) {
        throw Error(ErrorKind::input, file.string() + ": is not valid JSON: " + error.what());
    }
    return sequence;
}

}  // namespace

BoxFile readTruthBoxes(const std::filesystem::path& file, std::optional<double> mot_origin,
                       std::optional<cv::Size> image_size) {
    std::string format;
    try {
        format = sniffLabelFormat(file);
    } catch (const Error&) {
        if (!beginsWithNumbers(file)) throw;
        format = "mot";
    }
    return readAs(isMot(format) ? "mot" : format, file, mot_origin, image_size);
}

BoxFile readResultBoxes(const std::filesystem::path& file, std::optional<double> mot_origin,
                        std::optional<cv::Size> image_size) {
    const std::string format = beginsWithNumbers(file) ? "mot-result" : sniffLabelFormat(file);
    return readAs(format == "mot" ? "mot-result" : format, file, mot_origin, image_size);
}

MotSequence describedBeside(const std::filesystem::path& file) {
    std::error_code failed;
    const std::filesystem::path folder = std::filesystem::absolute(file, failed).parent_path();
    MotSequence found;
    for (const auto& place : {folder, folder.parent_path()}) {
        for (const char* name : {"seqinfo.ini", "meta.json", "scene.json"}) {
            if (!isFile(place / name)) continue;
            const bool ini = std::filesystem::path(name).extension() == ".ini";
            const MotSequence described = ini ? readMotSequence(place / name) : readJsonDescription(place / name);
            if (!found.image_size) found.image_size = described.image_size;
            if (!found.frame_count) found.frame_count = described.frame_count;
        }
    }
    return found;
}

std::string motOriginHelp() {
    return "Where the first pixel begins in MOTChallenge text (else 1, as by its rules; 0 with labels.txt beside it, "
           "as "
           "CVAT and datumaro write it)";
}

cv::Size parseSize(const std::string& text) {
    cv::Size size;
    const char* end = text.data() + text.size();
    const auto width = std::from_chars(text.data(), end, size.width);
    const bool times = width.ec == std::errc() && width.ptr != end && *width.ptr == 'x';
    const auto height = times ? std::from_chars(width.ptr + 1, end, size.height) : width;
    if (!times || height.ec != std::errc() || height.ptr != end || size.width < 1 || size.height < 1) {
        throw Error(ErrorKind::parameter, "--size = " + text + ", expected WIDTHxHEIGHT in px, such as 1024x540");
    }
    return size;
}

}  // namespace eyrie::cli

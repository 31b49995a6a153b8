#include "cli/arguments/described_sequence.h"

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "io/folder.h"

namespace eyrie::cli {
namespace {

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
        throw Error(ErrorKind::input, file.string() + ": is no valid JSON: " + error.what());
    }
    return sequence;
}

}  // namespace

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

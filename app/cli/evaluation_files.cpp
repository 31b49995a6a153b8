#include "cli/evaluation_files.h"

#include <charconv>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "core/error.h"
#include "io/box_csv.h"

namespace eyrie::cli {
namespace {

BoxFormat formatOf(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::exists(file, ignored)) {
        throw Error(ErrorKind::input, file.string() + ": there is no such file");
    }
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    while (std::getline(stream, line) && line.find_first_not_of(" \t\r") == std::string::npos) {
    }
    if (line.find("frame") != std::string::npos) return BoxFormat::ours;
    const std::size_t first = line.find_first_not_of(" \t\r");
    const bool numbers = first == std::string::npos || (line[first] >= '0' && line[first] <= '9');
    if (numbers && !stream.bad() && !std::filesystem::is_directory(file, ignored)) return BoxFormat::mot;
    throw Error(ErrorKind::input, file.string() +
                                      ":1: neither our CSV, whose first line names the columns (frame,id,x,y,…), nor "
                                      "MOTChallenge text (frame,id,left,top,width,height,…)");
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
        throw Error(ErrorKind::input, file.string() + ": is no valid JSON: " + error.what());
    }
    return sequence;
}

}  // namespace

BoxFile readTruthBoxes(const std::filesystem::path& file, const MotOptions& options) {
    const BoxFormat format = formatOf(file);
    return {format == BoxFormat::ours ? readBoxCsv(file) : readMotTruth(file, options), format};
}

BoxFile readResultBoxes(const std::filesystem::path& file, const MotOptions& options) {
    const BoxFormat format = formatOf(file);
    return {format == BoxFormat::ours ? readBoxCsv(file) : readMotResult(file, options), format};
}

MotSequence describedBeside(const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    MotSequence found;
    for (const auto& place : {folder, folder.parent_path()}) {
        for (const char* name : {"seqinfo.ini", "meta.json", "scene.json"}) {
            if (!std::filesystem::is_regular_file(place / name)) continue;
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

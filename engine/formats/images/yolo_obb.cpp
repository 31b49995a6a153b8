#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "formats/images/image_texts.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/tables/number_text.h"
#include "io/video/frame_source.h"

/// YOLO-OBB: labels/<image>.txt, one per image, "class x1 y1 x2 y2 x3 y3 x4 y4" with corners divided by the image's
/// width and height, clockwise from the front left; predictions append a confidence. Plain YOLO, "class cx cy w h", is
/// read too. data.yaml names the classes. We
/// add "image_size: [width, height]" to it, which others pass over.
namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr const char* kYoloFolder = "labels";

/// What we need of data.yaml: one level of keys, lists in brackets, by dashes or by numbers.
struct DataYaml {
    std::map<int, std::string> names;
    std::optional<cv::Size> image_size;
};

std::string unquoted(std::string_view text) {
    text = trimmed(text);
    if (!text.empty() && text.back() == '\r') text.remove_suffix(1);
    text = trimmed(text);
    if (text.size() >= 2 && (text.front() == '"' || text.front() == '\'') && text.back() == text.front()) {
        text = text.substr(1, text.size() - 2);
    }
    return std::string(text);
}

std::vector<std::string> listIn(std::string_view text) {
    std::vector<std::string> items;
    const std::size_t open = text.find('['), close = text.rfind(']');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return items;
    text = text.substr(open + 1, close - open - 1);
    while (!trimmed(text).empty()) {
        const std::size_t comma = std::min(text.find(','), text.size());
        items.push_back(unquoted(text.substr(0, comma)));
        text.remove_prefix(std::min(comma + 1, text.size()));
    }
    return items;
}

DataYaml readYaml(const fs::path& file) {
    DataYaml yaml;
    bool in_names = false;
    for (const std::string& line : readTextLines(file)) {
        const std::size_t first = line.find_first_not_of(" \t\r");
        if (first == std::string::npos || line[first] == '#') continue;
        const std::size_t colon = line.find(':');
        if (first == 0 && line[0] != '-') {
            const std::string key = line.substr(0, colon);
            in_names = key == "names";
            const std::vector<std::string> list = listIn(line);
            if (in_names) {
                for (std::size_t i = 0; i < list.size(); ++i) yaml.names[static_cast<int>(i)] = list[i];
            }
            if (key == "image_size" && list.size() == 2) {
                const auto width = parseWhole(list[0]), height = parseWhole(list[1]);
                if (width && height && *width > 0 && *height > 0) yaml.image_size = cv::Size(*width, *height);
            }
        } else if (in_names && line[first] == '-') {
            const std::string name = unquoted(std::string_view(line).substr(first + 1));
            yaml.names[static_cast<int>(yaml.names.size())] = name;
        } else if (in_names && colon != std::string::npos) {
            const auto number = parseWhole(line.substr(first, colon - first));
            if (number) yaml.names[*number] = unquoted(std::string_view(line).substr(colon + 1));
        }
    }
    return yaml;
}

/// data.yaml in the folder or up to three above the texts.
std::optional<fs::path> yamlFor(const fs::path& path) {
    fs::path folder = fs::absolute(path).lexically_normal();
    for (int up = 0; up < 4 && !folder.empty(); ++up, folder = folder.parent_path()) {
        if (isFile(folder / "data.yaml")) return folder / "data.yaml";
    }
    return std::nullopt;
}

/// A line of plain YOLO: class, centre and size by the image's.
OrientedBox uprightBox(const TextLine& line, cv::Size image) {
    const double width = line.size(3, "width") * image.width, height = line.size(4, "height") * image.height;
    const double x = line.pixels(1, "centre's x") * image.width, y = line.pixels(2, "centre's y") * image.height;
    return boxFromEdges({x - width / 2, y - height / 2, width, height}, 0);
}

LabelFile readYolo(const fs::path& path, const ImportOptions& options) {
    LabelFile labels;
    const std::vector<ImageText> texts = findImageTexts(path, kYoloFolder, labels);
    DataYaml yaml;
    if (const auto file = yamlFor(path)) {
        yaml = readYaml(*file);
        labels.further_files.push_back(*file);
    }
    labels.image_size = options.image_size ? options.image_size : yaml.image_size;
    if (!labels.image_size) {
        const auto images = imageFolderFor(texts.front().file.parent_path());
        if (images) labels.image_size = openSource(*images)->info().size;
    }
    const cv::Size size = neededSize(labels.image_size, path, "YOLO-OBB");
    for (const auto& [number, name] : yaml.names) labels.classes.push_back(name);
    int departures = 0, across = 0;
    std::set<int> unnamed;
    for (const ImageText& text : texts) {
        forEachLine(text.file, ' ', '#', [&](const TextLine& line) {
            const bool upright = line.size() == 5 || line.size() == 6;
            if (!upright && line.size() != 9 && line.size() != 10) {
                line.fail(0,
                          std::to_string(line.size()) + " columns, expected class and 8 corners, or a confidence more");
            }
            LabelBox record;
            record.frame = text.frame;
            const int number = line.integer(0, "class");
            if (number < 0) line.fail(0, "the class is negative");
            const auto name = yaml.names.find(number);
            record.object_class = name == yaml.names.end() ? "class " + std::to_string(number) : name->second;
            if (name == yaml.names.end()) unnamed.insert(number);
            record.box = upright ? uprightBox(line, size)
                                 : boxByFourCorners(line, 1, cv::Point2d(size.width, size.height), departures);
            if (line.size() % 2 == 0) record.score = line.number(line.size() - 1, "confidence");
            across += !upright && record.box.length < record.box.width;
            labels.boxes[text.frame].push_back(std::move(record));
        });
    }
    if (!unnamed.empty()) {
        labels.notes.push_back(counted(static_cast<int>(unnamed.size()), "class has", "classes have") +
                               " no name in a data.yaml; map \"class N\" to yours");
    }
    tellFourCorners(departures, across, labels.notes);
    return labels;
}

std::string yamlString(const std::string& name) {
    std::string text = "\"";
    for (const char c : name)
        text +=
            c == '"' || c == '\\' || c == '[' || c == ']' || c == ',' || static_cast<unsigned char>(c) < 0x20 ? '_' : c;
    return text + '"';
}

void writeYolo(const LabelFile& labels, const fs::path& path, const ExportOptions& options, ExportReport& report) {
    const cv::Size size = neededSize(labels.image_size, path, "YOLO-OBB");
    // A corner beyond the image makes trainers leave out the whole image.
    const std::optional<cv::Size> clip = options.clip.value_or(true) ? std::optional(size) : std::nullopt;
    std::map<std::string, int> numbers;
    std::vector<std::string> names;
    const auto numberOf = [&](const std::string& name) {
        const std::string shown = name.empty() ? "object" : name;
        const auto [found, is_new] = numbers.emplace(shown, static_cast<int>(names.size()));
        if (is_new) names.push_back(shown);
        return found->second;
    };
    for (const std::string& name : labels.classes) numberOf(name);
    std::set<std::string> sorted;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records) sorted.insert(record.object_class);
    }
    for (const std::string& name : sorted) numberOf(name);

    makeTextFolder(path / kYoloFolder);
    int cut = 0;
    const int frames = imagesToWrite(labels, path);
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        std::string text;
        const auto records = labels.boxes.find(frame);
        if (records != labels.boxes.end()) {
            for (const LabelBox& record : records->second) {
                text += std::to_string(numberOf(record.object_class));
                for (const cv::Point2d& corner : cornersToWrite(record.box, clip, cut)) {
                    text += ' ' + fixedText(corner.x / size.width, 8) + ' ' + fixedText(corner.y / size.height, 8);
                }
                text += '\n';
            }
        }
        writePlainFile(path / kYoloFolder / (imageStem(labels, frame) + ".txt"), text);
    }
    // Without a key "path" trainers start from this file's own folder; "." would be the one they were called in.
    std::string yaml = "train: images\nval: images\nimage_size: [" + std::to_string(size.width) + ", " +
                       std::to_string(size.height) + "]\nnames:\n";
    for (std::size_t i = 0; i < names.size(); ++i)
        yaml += "  " + std::to_string(i) + ": " + yamlString(names[i]) + '\n';
    writeFileAtomically(path / "data.yaml", yaml);
    report.files = {path / kYoloFolder, path / "data.yaml"};
    report.notes.push_back("for training, put the images into " + (path / "images").string() + ", named as the texts");
    report.add(LossKind::clipped, cut, "were cut at the image's border and are no longer rectangles");
}

bool looksLikeYolo(const FileHead& head) {
    std::vector<std::string> lines = head.lines;
    if (head.folder) {
        const auto text = firstImageText(head.path, kYoloFolder);
        if (!text) return false;
        lines = readTextLines(*text);
    }
    for (const std::string& line : lines) {
        if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
        const std::vector<double> n = leadingNumbers(line, ' ');
        const bool fits = n.size() == 5 || n.size() == 6 || n.size() == 9 || n.size() == 10;
        if (!fits || n[0] < 0 || n[0] != std::floor(n[0])) return false;
        const auto end = n.begin() + (n.size() < 9 ? 5 : 9);
        return std::all_of(n.begin() + 1, end, [](double value) { return std::abs(value) <= 3; });
    }
    return false;
}

}  // namespace

LabelFormat yoloObbFormat() {
    LabelFormat format;
    format.info = {"yolo-obb", "YOLO-OBB (text per image)", {"txt"}, true, true, true, {}};
    format.info.carries = {.rotation = true, .object_class = true};
    format.read = readYolo;
    format.write = writeYolo;
    format.files = [](const fs::path& path, const ExportOptions&) {
        return std::vector<ExportFile>{{path / "data.yaml"}};
    };
    format.fits = looksLikeYolo;
    return format;
}

}  // namespace eyrie

#include "formats/images/image_texts.h"
#include "io/tables/number_text.h"

/// DOTA: labelTxt/<image>.txt, one per image; two optional lines "imagesource:…" and "gsd:…", then
///   x1 y1 x2 y2 x3 y3 x4 y4 category difficult
/// between blanks (or commas, as in the paper), pixels from 0, clockwise from the front left corner.
namespace eyrie {
namespace {

constexpr const char* kDotaFolder = "labelTxt";

void readMeta(const TextLine& line, LabelFile& labels) {
    const std::string text(line.text(0));
    if (!text.starts_with("gsd:")) return;
    const auto gsd = parseReal(text.substr(4));
    if (gsd && *gsd > 0 && *gsd < 1000) labels.gsd_m = *gsd;
}

bool isMeta(const TextLine& line) {
    return line.text(0).starts_with("imagesource:") || line.text(0).starts_with("gsd:");
}

LabelFile readDota(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    int departures = 0, across = 0;
    for (const ImageText& text : findImageTexts(path, kDotaFolder, labels)) {
        int number = 0;
        for (const std::string& content : readTextLines(text.file)) {
            ++number;
            if (content.find_first_not_of(" \t\r") == std::string::npos) continue;
            const TextLine line(text.file, number, content, content.find(',') == std::string::npos ? ' ' : ',');
            if (isMeta(line)) {
                readMeta(line, labels);
                continue;
            }
            if (line.size() < 9 || line.size() > 10) {
                line.fail(0, std::to_string(line.size()) + " columns, expected 8 corners, category and difficult");
            }
            LabelBox record;
            record.frame = text.frame;
            record.box = boxByFourCorners(line, 0, {1, 1}, departures);
            record.object_class = line.word(8, "category");
            if (line.size() == 10) record.ignore = line.integer(9, "difficult") == 1;
            across += record.box.length < record.box.width;
            labels.boxes[text.frame].push_back(std::move(record));
        }
    }
    tellFourCorners(departures, across, labels.notes);
    return labels;
}

/// A text as one word of a line of words.
std::string joinedWord(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) <= 0x20 || c == ',' || c == '"') c = '-';
    return text;
}

void writeDota(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report) {
    std::optional<cv::Size> clip;
    if (options.clip.value_or(false)) clip = neededSize(labels.image_size, path, "cutting at the border");
    const std::filesystem::path folder = path / kDotaFolder;
    makeTextFolder(folder);
    int cut = 0, blanks = 0;
    // Readers know these lines by having fewer words than a box.
    const std::string source = joinedWord(options.sequence);
    const int frames = imagesToWrite(labels, path);
    for (FrameIndex frame = 0; frame < frames; ++frame) {
        std::string text =
            "imagesource:" + source + "\ngsd:" + (labels.gsd_m ? shortestText(*labels.gsd_m) : "null") + '\n';
        const auto records = labels.boxes.find(frame);
        if (records != labels.boxes.end()) {
            for (const LabelBox& record : records->second) {
                for (const cv::Point2d& corner : cornersToWrite(record.box, clip, cut)) {
                    text += fixedText(corner.x, 3) + ' ' + fixedText(corner.y, 3) + ' ';
                }
                const std::string name = record.object_class.empty() ? "object" : joinedWord(record.object_class);
                blanks += !record.object_class.empty() && name != record.object_class;
                text += name + (record.ignore ? " 1\n" : " 0\n");
            }
        }
        writePlainFile(folder / (imageStem(labels, frame) + ".txt"), text);
    }
    report.files.push_back(folder);
    report.add(LossKind::clipped, cut, "were cut at the image's border and are no longer rectangles");
    report.add(LossKind::class_name, blanks, "have a class with blanks or commas, which became \"-\"");
}

bool looksLikeDota(const FileHead& head) {
    std::string line;
    if (head.folder) {
        const auto text = firstImageText(head.path, kDotaFolder);
        if (!text) return false;
        for (const std::string& content : readTextLines(*text)) {
            if (content.find_first_not_of(" \t\r") != std::string::npos && !content.starts_with("imagesource:") &&
                !content.starts_with("gsd:")) {
                line = content;
                break;
            }
            if (content.starts_with("imagesource:")) return true;
        }
    } else {
        for (const std::string& content : head.lines) {
            if (content.starts_with("imagesource:")) return true;
            if (content.starts_with("gsd:")) continue;
            line = content;
            break;
        }
    }
    const char separator = line.find(',') == std::string::npos ? ' ' : ',';
    if (leadingNumbers(line, separator).size() != 8) return false;
    const std::size_t fields = TextLine(head.path, 1, line, separator).size();
    return fields == 9 || fields == 10;
}

}  // namespace

LabelFormat dotaFormat() {
    LabelFormat format;
    format.info = {"dota", "DOTA (text per image)", {"txt"}, true, true, true, {}};
    format.info.carries = {.rotation = true, .object_class = true, .ignore = true};
    format.read = readDota;
    format.write = writeDota;
    format.fits = looksLikeDota;
    return format;
}

}  // namespace eyrie

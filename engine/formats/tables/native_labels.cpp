#include "formats/format_functions.h"
#include "io/tables/box_csv.h"

namespace eyrie {
namespace {

bool hasHeader(const FileHead& head, const char* column) {
    if (head.folder || head.lines.empty()) return false;
    const std::string line = "," + head.lines.front() + ",";
    const auto has = [&](const std::string& name) { return line.find(',' + name + ',') != std::string::npos; };
    return has("frame") && has("x") && has("length") && has("width") && (column == nullptr || has(column));
}

LabelFile readNative(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    readTextLines(path);  // refuses what is no text
    labels.boxes = labelBoxes(readBoxCsv(path));
    return labels;
}

void writeNative(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions&,
                 ExportReport& report) {
    writeGroundTruthCsv(path, plainBoxes(labels.frames));
    report.files.push_back(path);
}

void writeNativeResult(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions&,
                       ExportReport& report) {
    writeResultCsv(path, plainBoxes(labels.frames));
    report.files.push_back(path);
    std::erase_if(report.losses, [](const ExportLoss& loss) { return loss.kind == LossKind::velocity; });
}

}  // namespace

LabelFormat nativeFormat() {
    LabelFormat format;
    format.info = {"native", "Eyrie ground truth (CSV)", {"csv"}, false, true, true, {}};
    format.info.carries = {.rotation = true, .id = true, .object_class = true, .ignore = true};
    format.read = readNative;
    format.write_frames = writeNative;
    format.fits = [](const FileHead& head) { return hasHeader(head, nullptr) && !hasHeader(head, "score"); };
    return format;
}

LabelFormat nativeResultFormat() {
    LabelFormat format;
    format.info = {"native-result", "Eyrie result (CSV)", {"csv"}, false, true, true, {}};
    format.info.carries = {.rotation = true, .id = true, .object_class = true, .score = true};
    format.read = readNative;
    format.write_frames = writeNativeResult;
    format.fits = [](const FileHead& head) { return hasHeader(head, "score"); };
    return format;
}

}  // namespace eyrie

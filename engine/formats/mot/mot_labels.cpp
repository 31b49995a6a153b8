#include <algorithm>

#include "core/error.h"
#include "formats/format_functions.h"
#include "formats/mot/mot_tree.h"
#include "io/folder.h"
#include "io/tables/box_csv.h"

namespace eyrie {
namespace {

MotOptions pixelsOf(const std::optional<double>& first_pixel_edge) {
    MotOptions options;
    if (first_pixel_edge) options.first_pixel_edge = *first_pixel_edge;
    return options;
}

/// The text of a sequence's folder, or the file itself.
std::filesystem::path textIn(const std::filesystem::path& path) {
    return isFolder(path) ? path / "gt" / "gt.txt" : path;
}

LabelFile withSequence(LabelFile labels, const std::filesystem::path& file) {
    const std::filesystem::path folder = std::filesystem::absolute(file).parent_path();
    for (const auto& place : {folder, folder.parent_path()}) {
        if (!isFile(place / "seqinfo.ini")) continue;
        const MotSequence sequence = readMotSequence(place / "seqinfo.ini");
        labels.image_size = sequence.image_size;
        labels.frame_count = sequence.frame_count;
        labels.frame_rate_hz = sequence.frame_rate_hz;
        labels.further_files.push_back(place / "seqinfo.ini");
        break;
    }
    return labels;
}

/// How the text is to be read, by what stands beside it.
MotOptions optionsFor(const std::filesystem::path& file, const ImportOptions& options, LabelFile& labels) {
    MotOptions mot = pixelsOf(options.first_pixel_edge);
    if (const auto list = motClassListBeside(file)) {
        mot = listedMotOptions(file, *list, options.first_pixel_edge, labels);
    }
    labels.first_frame_number = mot.first_frame_number;
    return mot;
}

LabelFile readTruth(const std::filesystem::path& path, const ImportOptions& options) {
    LabelFile labels;
    const std::filesystem::path file = textIn(path);
    const MotOptions mot = optionsFor(file, options, labels);
    labels.boxes = readMotTruth(file, mot);
    return withSequence(std::move(labels), file);
}

LabelFile readResult(const std::filesystem::path& path, const ImportOptions& options) {
    LabelFile labels;
    const MotOptions mot = optionsFor(path, options, labels);
    labels.boxes = labelBoxes(readMotResult(path, mot));
    return withSequence(std::move(labels), path);
}

void reportClasses(const MotLosses& losses, ExportReport& report) {
    report.add(LossKind::class_name, losses.classes, "have a class that MOTChallenge has no number for");
}

void writeTruth(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions& options,
                ExportReport& report) {
    MotWriteOptions write;
    write.pixels = pixelsOf(options.first_pixel_edge);
    reportClasses(writeMotTruth(path, labels.frames, write), report);
    report.files.push_back(path);
    writeOrientedSidecar(labels.frames, path, report);
    if (!options.first_pixel_edge) {
        report.notes.push_back(
            "pixels count from 1, as the benchmark has it; CVAT and datumaro count from 0 and take format mot-cvat");
    }
}

void writeResult(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions& options,
                 ExportReport& report) {
    MotWriteOptions write;
    write.pixels = pixelsOf(options.first_pixel_edge);
    writeMotResult(path, labels.frames, write);
    report.files.push_back(path);
}

/// Columns of the first line, if it holds numbers and nothing else, that of the frame from 1 on; else 0.
std::size_t columnsOf(const FileHead& head) {
    if (head.lines.empty()) return 0;
    const std::string& line = head.lines.front();
    const std::vector<double> numbers = leadingNumbers(line, ',');
    const auto commas = static_cast<std::size_t>(std::count(line.begin(), line.end(), ','));
    return numbers.size() == commas + 1 && numbers[0] >= 1 ? numbers.size() : 0;
}

}  // namespace

std::filesystem::path orientedSidecar(const std::filesystem::path& path) {
    std::filesystem::path sidecar = path;
    return sidecar.replace_extension(".oriented.csv");
}

void writeOrientedSidecar(const VisitFrames& frames, const std::filesystem::path& path, ExportReport& report) {
    if (report.lost(LossKind::rotation) == 0) return;
    const std::filesystem::path sidecar = orientedSidecar(path);
    writeGroundTruthCsv(sidecar, plainBoxes(frames));
    report.files.push_back(sidecar);
    report.notes.push_back("the exact boxes are in " + sidecar.string());
}

LabelFormat motFormat() {
    LabelFormat format;
    format.info = {"mot", "MOTChallenge ground truth", {"txt"}, false, true, true, {}};
    format.info.carries = {.id = true, .object_class = true, .occlusion = true, .ignore = true};
    format.needs_id = true;
    format.read = readTruth;
    format.write_frames = writeTruth;
    format.files = [](const std::filesystem::path& path, const ExportOptions&) {
        return std::vector<ExportFile>{{path}, {orientedSidecar(path)}};
    };
    format.fits = [](const FileHead& head) {
        if (head.folder) return isFile(head.path / "gt" / "gt.txt");
        return columnsOf(head) == 8 || columnsOf(head) == 9;
    };
    return format;
}

LabelFormat motResultFormat() {
    LabelFormat format;
    format.info = {"mot-result", "MOTChallenge result", {"txt"}, false, true, true, {}};
    format.info.carries = {.id = true, .score = true};
    format.read = readResult;
    format.write_frames = writeResult;
    format.fits = [](const FileHead& head) {
        return columnsOf(head) == 6 || columnsOf(head) == 7 || columnsOf(head) == 10;
    };
    return format;
}

}  // namespace eyrie

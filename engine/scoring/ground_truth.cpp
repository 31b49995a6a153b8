#include "scoring/ground_truth.h"

#include <algorithm>
#include <fstream>

#include "annotation/edits/ignore_regions.h"
#include "core/error.h"
#include "formats/label_formats.h"
#include "io/folder.h"
#include "store/labels/annotation_store.h"

namespace eyrie {
namespace {

/// Whether the file begins like MOTChallenge text, so that its errors are told by line and column.
bool beginsWithNumbers(const std::filesystem::path& file) {
    if (!isFile(file)) return false;
    std::ifstream stream(file, std::ios::binary);
    std::string line;
    while (std::getline(stream, line) && line.find_first_not_of(" \t\r") == std::string::npos) {
    }
    const std::size_t first = line.find_first_not_of(" \t\r");
    const bool digit = first != std::string::npos && line[first] >= '0' && line[first] <= '9';
    return digit && line.find(',') != std::string::npos;
}

/// A table of numbers may be truth or a result, which cannot be seen from its columns.
std::string formatOfTruth(const std::filesystem::path& file) {
    try {
        const std::string format = sniffLabelFormat(file);
        return format == "mot-result" ? "mot" : format;
    } catch (const Error&) {
        if (!beginsWithNumbers(file)) throw;
        return "mot";
    }
}

LabelFile readAs(const std::string& format, const GroundTruthSource& source, std::optional<cv::Size> image_size) {
    ImportOptions options;
    options.first_pixel_edge = source.mot_origin;
    options.image_size = image_size;
    return readLabels(source.file, format, options);
}

GroundTruth labelsOfProject(ProjectFile& project, const RunRecord& run) {
    const AnnotationSet labels = readAnnotations(project, run.sequence.id);
    if (labels.objects.empty()) throw NothingLabelled(project.path(), run.sequence.path);
    GroundTruthOptions options;
    options.last_frame = std::max(0, run.sequence.frame_count - 1);
    options.image = run.sequence.size;
    const auto camera = CameraMotion::fromRegistrations(RunStore(project).registrations(run.id));
    return {groundTruthBoxes(labels, camera, options), "labels of the project " + project.path().string()};
}

}  // namespace

NothingLabelled::NothingLabelled(const std::filesystem::path& project, const std::string& video)
    : Error(ErrorKind::project, project.string() + ": nobody has labelled " + video +
                                    " yet. Draw or import labels, or choose a file of ground truth.") {}

GroundTruth readGroundTruth(const GroundTruthSource& source, std::optional<cv::Size> image_size) {
    const LabelFile labels = readAs(formatOfTruth(source.file), source, image_size);
    GroundTruth truth{plainBoxes(labels.boxes), source.file.string()};
    if (truth.boxes.empty()) throw Error(ErrorKind::input, truth.name + ": holds no box; choose another file");
    const auto& formats = labelFormats();
    const auto format =
        std::find_if(formats.begin(), formats.end(), [&](const auto& info) { return info.name == labels.format; });
    truth.has_headings = format->carries.rotation || !allUpright(truth.boxes);
    if (!labels.further_files.empty() || !labels.notes.empty()) {
        std::string text = truth.name + " was read as " + format->title;
        std::string separator = " together with ";
        for (const auto& further : labels.further_files) {
            text += separator + further.filename().string();
            separator = ", ";
        }
        truth.remarks.push_back(text);
    }
    truth.remarks.insert(truth.remarks.end(), labels.notes.begin(), labels.notes.end());
    return truth;
}

GroundTruth readGroundTruth(const GroundTruthSource& source, ProjectFile& project, const RunRecord& run) {
    return source.file.empty() ? labelsOfProject(project, run) : readGroundTruth(source, run.sequence.size);
}

BoxesByFrame readResultBoxes(const GroundTruthSource& source) {
    const bool numbers = beginsWithNumbers(source.file);
    const std::string format = numbers ? "mot-result" : sniffLabelFormat(source.file);
    return plainBoxes(readAs(format == "mot" ? "mot-result" : format, source, {}).boxes);
}

}  // namespace eyrie

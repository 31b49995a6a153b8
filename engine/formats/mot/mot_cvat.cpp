#include <algorithm>
#include <map>

#include "formats/format_functions.h"
#include "formats/images/image_texts.h"
#include "formats/mot/mot_tree.h"
#include "io/atomic_file.h"
#include "io/folder.h"
#include "io/tables/number_text.h"

/// MOTChallenge as CVAT and datumaro exchange it: gt/gt.txt with pixels from 0, beside it labels.txt with a class a
/// line, whose number, from 1, is the class in the text. Visibility 0 means occluded, and ids count from 1.
namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr const char* kList = "labels.txt";
constexpr const char* kUnnamed = "object";  ///< CVAT fails on a box without class

bool hasFrameZero(const fs::path& file) {
    for (const std::string& line : readTextLines(file)) {
        const std::vector<double> numbers = leadingNumbers(line, ',');
        if (!numbers.empty() && numbers.front() == 0) return true;
    }
    return false;
}

/// Classes by name, numbered from 1.
std::map<std::string, int> classNumbers(const VisitFrames& frames) {
    std::map<std::string, int> numbers;
    frames([&](FrameIndex, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records)
            numbers[record.object_class.empty() ? kUnnamed : record.object_class] = 0;
    });
    int next = 1;
    for (auto& [name, number] : numbers) number = next++;
    return numbers;
}

void writeForCvat(const LabelStream& labels, const fs::path& path, const ExportOptions& options, ExportReport& report) {
    const fs::path folder = path / "gt";
    makeTextFolder(folder);
    const double first_pixel_edge = options.first_pixel_edge.value_or(0);
    const std::map<std::string, int> numbers = classNumbers(labels.frames);
    int lowest = 1, unnamed = 0, fully = 0;
    labels.frames([&](FrameIndex, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records) lowest = std::min(lowest, record.id.value_or(1));
    });
    AtomicFileWriter file(folder / "gt.txt");
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records) {
            const BoxEdges e = edgesOf(record.box, first_pixel_edge);
            std::string text = std::to_string(frame + 1) + ',' + std::to_string(record.id.value_or(1) + (1 - lowest));
            for (const double value : {e.left, e.top, e.width, e.height}) text += ',' + fixedText(value, 3);
            text += std::string(record.ignore ? ",0," : ",1,") +
                    std::to_string(numbers.at(record.object_class.empty() ? kUnnamed : record.object_class)) +
                    (record.occlusion == Occlusion::none ? ",1\n" : ",0\n");
            file.write(text);
            unnamed += record.object_class.empty();
            fully += record.occlusion == Occlusion::fully;
        }
    });
    file.finish();
    std::string list;
    for (const auto& [name, number] : numbers) list += name + '\n';
    if (!list.empty()) list.pop_back();
    writeFileAtomically(folder / kList, list);
    report.files.push_back(folder / "gt.txt");
    report.files.push_back(folder / kList);
    writeOrientedSidecar(labels.frames, path / "gt.txt", report);
    report.add(LossKind::class_name, unnamed, "have no class and became \"object\"");
    report.add(LossKind::occlusion, fully, "fully occluded became occluded, as CVAT has one degree only");
    if (lowest < 1) report.notes.push_back("ids were raised by " + std::to_string(1 - lowest) + ": they count from 1");
    report.notes.push_back("pixels count from " + shortestText(first_pixel_edge) +
                           "; CVAT takes the folder gt in a zip file as \"MOT 1.1\"");
}

}  // namespace

std::optional<fs::path> motClassListBeside(const fs::path& file) {
    const std::string name = file.filename().string();
    const fs::path list = file.parent_path() / kList;
    if ((name != "gt.txt" && name != "det.txt") || !isFile(list)) return std::nullopt;
    return list;
}

MotOptions listedMotOptions(const fs::path& file, const fs::path& list, std::optional<double> first_pixel_edge,
                            LabelFile& labels) {
    MotOptions options;
    options.first_pixel_edge = first_pixel_edge.value_or(0);
    options.first_frame_number = hasFrameZero(file) ? 0 : 1;
    options.class_list.emplace();
    int number = 0;
    for (const std::string& line : readTextLines(list)) {
        options.class_list->push_back(TextLine(list, ++number, line, '\t').word(0, "class"));
    }
    while (!options.class_list->empty() && options.class_list->back().empty()) options.class_list->pop_back();
    labels.classes = *options.class_list;
    labels.further_files.push_back(list);
    std::string note = "labels.txt beside it names the classes, as CVAT and datumaro write it";
    note += first_pixel_edge ? ""
                             : ", so pixels were taken to count from 0 (--pixel-origin or --mot-origin 1 where they "
                               "count from 1, as in the benchmark)";
    labels.notes.push_back(note);
    if (options.first_frame_number == 0) labels.notes.push_back("a frame has the number 0, so frames count from 0");
    return options;
}

LabelFormat motCvatFormat() {
    LabelFormat format = motFormat();
    format.info.name = "mot-cvat";
    format.info.title = "MOTChallenge of CVAT and datumaro";
    format.info.folder = true;
    format.info.extensions.clear();
    format.write_frames = writeForCvat;
    format.files = [](const fs::path& path, const ExportOptions&) {
        return std::vector<ExportFile>{{orientedSidecar(path / "gt.txt")}};
    };
    format.fits = [](const FileHead& head) {
        const fs::path text = head.folder ? head.path / "gt" / "gt.txt" : head.path;
        return text.filename() == "gt.txt" && isFile(text) && motClassListBeside(text).has_value();
    };
    return format;
}

}  // namespace eyrie

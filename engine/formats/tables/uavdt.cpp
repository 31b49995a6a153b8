#include <array>
#include <cmath>

#include "core/error.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/folder.h"

/// UAVDT: three texts per sequence, whole pixels from 0, frames from 1.
///   <name>_gt.txt         frame,id,left,top,width,height,score,in view (1),-1; without what is partly out of view
///   <name>_gt_whole.txt   frame,id,left,top,width,height,out of view,occlusion,category
///   <name>_gt_ignore.txt  frame,id,left,top,width,height,1,-1,-1: areas that count neither way
/// Category 1 car, 2 truck, 3 bus; occlusion 1 none, 2 large, 3 medium, 4 small; out of view 1 not, 2 medium, 3 small.
/// Of the first two, the second says all that the first does and is read where it is there.
namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 4> kUavdtCategories{"", "car", "truck", "bus"};
const char* const kWhole = "_gt_whole.txt";
const char* const kIgnore = "_gt_ignore.txt";
const char* const kPlain = "_gt.txt";

/// The name without its ending, when it has one of the three.
std::optional<std::string> stemOf(const fs::path& path) {
    const std::string name = path.filename().string();
    for (const char* ending : {kWhole, kIgnore, kPlain}) {
        if (name.ends_with(ending)) return name.substr(0, name.size() - std::string(ending).size());
    }
    return std::nullopt;
}

LabelBox uavdtBoxOf(const TextLine& line) {
    if (line.size() != 9) line.fail(0, std::to_string(line.size()) + " columns, expected the 9 of UAVDT");
    LabelBox record;
    record.frame = line.frame(0, 1);
    record.id = line.identity(1);
    record.box = boxByEdges(line, 2, 0);
    return record;
}

void readPlain(const fs::path& path, LabelFile& labels) {
    forEachLine(path, ',', '\0', [&](const TextLine& line) {
        LabelBox record = uavdtBoxOf(line);
        record.ignore = line.number(6, "score (1 or 0)") == 0;
        labels.boxes[record.frame].push_back(std::move(record));
    });
}

void readWhole(const fs::path& path, LabelFile& labels) {
    int out_of_view = 0, occluded = 0;
    forEachLine(path, ',', '\0', [&](const TextLine& line) {
        LabelBox record = uavdtBoxOf(line);
        const int occlusion = line.integer(7, "occlusion");
        if (occlusion < 1 || occlusion > 4)
            line.fail(7, "occlusion " + std::to_string(occlusion) + ", expected 1 to 4");
        const int category = line.integer(8, "category");
        if (category < 1 || category > 3) line.fail(8, "category " + std::to_string(category) + ", expected 1 to 3");
        if (occlusion != 1) record.occlusion = Occlusion::partly;
        occluded += occlusion != 1;
        out_of_view += line.integer(6, "out of view") > 1;
        record.object_class = kUavdtCategories[static_cast<std::size_t>(category)];
        labels.boxes[record.frame].push_back(std::move(record));
    });
    if (out_of_view > 0) {
        labels.notes.push_back(counted(out_of_view, "box lies", "boxes lie") +
                               " partly out of view; the benchmark leaves them out, here they are kept");
    }
    if (occluded > 0) labels.notes.push_back("the degree of occlusion is not kept, only that a box is partly occluded");
}

/// The ids of ignored areas are of another count than those of the objects.
void readAreas(const fs::path& path, LabelFile& labels) {
    forEachLine(path, ',', '\0', [&](const TextLine& line) {
        LabelBox record = uavdtBoxOf(line);
        record.id.reset();
        record.ignore = true;
        labels.boxes[record.frame].push_back(std::move(record));
    });
}

LabelFile readUavdt(const fs::path& path, const ImportOptions&) {
    LabelFile labels;
    labels.first_frame_number = 1;
    const std::optional<std::string> stem = stemOf(path);
    if (!stem) {
        readPlain(path, labels);
        return labels;
    }
    const fs::path folder = path.parent_path();
    const auto beside = [&](const char* ending) {
        const fs::path file = folder / (*stem + ending);
        const bool there = file != path && isFile(file);
        if (there) labels.further_files.push_back(file);
        return there ? file : fs::path();
    };
    const std::string name = path.filename().string();
    if (name.ends_with(kIgnore)) {
        readAreas(path, labels);
        return labels;
    }
    const fs::path whole = name.ends_with(kWhole) ? path : beside(kWhole);
    whole.empty() ? readPlain(path, labels) : readWhole(whole, labels);
    if (const fs::path areas = beside(kIgnore); !areas.empty()) readAreas(areas, labels);
    return labels;
}

std::string beginning(FrameIndex frame, int id, const OrientedBox& box, int& rounded) {
    const BoxEdges e = edgesOf(box, 0);
    const long left = std::lround(e.left), top = std::lround(e.top);
    const long right = std::lround(e.left + e.width), bottom = std::lround(e.top + e.height);
    rounded += std::abs(left - e.left) + std::abs(top - e.top) + std::abs(right - e.left - e.width) +
                   std::abs(bottom - e.top - e.height) >
               1e-6;
    return std::to_string(frame + 1) + ',' + std::to_string(id) + ',' + std::to_string(left) + ',' +
           std::to_string(top) + ',' + std::to_string(right - left) + ',' + std::to_string(bottom - top) + ',';
}

fs::path textOf(const fs::path& path, const char* ending) {
    return path.parent_path() / (stemOf(path).value_or(path.stem().string()) + ending);
}

std::vector<ExportFile> uavdtFiles(const fs::path& path, const ExportOptions&) {
    return {{textOf(path, kPlain)}, {textOf(path, kWhole)}, {textOf(path, kIgnore)}};
}

bool reachesBeyond(const OrientedBox& box, cv::Size image) {
    const BoxEdges e = edgesOf(box, 0);
    return e.left < 0 || e.top < 0 || e.left + e.width > image.width || e.top + e.height > image.height;
}

void writeUavdt(const LabelStream& labels, const fs::path& path, const ExportOptions&, ExportReport& report) {
    AtomicFileWriter plain(textOf(path, kPlain)), whole(textOf(path, kWhole)), areas(textOf(path, kIgnore));
    const std::optional<cv::Size>& image = labels.about.image_size;
    int rounded = 0, strange = 0, fully = 0, partly = 0, beyond = 0, objects = 0, classes_of_areas = 0;
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records) {
            const std::string begin = beginning(frame, *record.id, record.box, rounded);
            if (record.ignore) {
                areas.write(begin + "1,-1,-1\n");
                classes_of_areas += !record.object_class.empty();
                continue;
            }
            std::size_t category = 3;
            while (category > 0 && record.object_class != kUavdtCategories[category]) --category;
            strange += category == 0;
            ++objects;
            fully += record.occlusion == Occlusion::fully;
            partly += record.occlusion == Occlusion::partly;
            beyond += image && reachesBeyond(record.box, *image);
            const char* occlusion = record.occlusion == Occlusion::none     ? "1"
                                    : record.occlusion == Occlusion::partly ? "3"
                                                                            : "2";
            plain.write(begin + "1,1,-1\n");
            whole.write(begin + "1," + occlusion + ',' + std::to_string(category == 0 ? 1 : category) + '\n');
        }
    });
    for (AtomicFileWriter* file : {&plain, &whole, &areas}) file->finish();
    for (const char* ending : {kPlain, kWhole, kIgnore}) report.files.push_back(textOf(path, ending));
    report.add(LossKind::rounded, rounded, "were rounded to whole pixels");
    report.add(LossKind::class_name, strange, "have a class that UAVDT does not know and became cars");
    report.add(LossKind::class_name, classes_of_areas, "are ignored and lost their class and id");
    report.add(LossKind::occlusion, fully, "fully occluded became large occlusion, the highest degree of UAVDT");
    report.add(LossKind::occlusion, partly, "partly occluded became medium occlusion, as the degree is unknown");
    report.add(LossKind::other, beyond, "reaching beyond the image: how far out of view was not kept");
    if (objects > 0)
        report.notes.push_back("every box is written as in view (1): how far one is out of view is not kept");
}

}  // namespace

LabelFormat uavdtFormat() {
    LabelFormat format;
    format.info = {"uavdt", "UAVDT", {"txt"}, false, true, true, {}};
    format.info.carries = {.id = true, .object_class = true, .occlusion = true, .ignore = true};
    format.needs_id = true;
    format.read = readUavdt;
    format.write_frames = writeUavdt;
    format.files = uavdtFiles;
    format.fits = [](const FileHead& head) {
        return !head.folder && stemOf(head.path) && !head.lines.empty() &&
               leadingNumbers(head.lines.front(), ',').size() == 9;
    };
    return format;
}

}  // namespace eyrie

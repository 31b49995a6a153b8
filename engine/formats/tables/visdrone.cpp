#include <array>
#include <cmath>

#include "core/labels/track_class.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"

/// VisDrone, video and multi-object tracking: one text per sequence, whole pixels from 0, frames from 1:
///   frame,id,left,top,width,height,score,category,truncation,occlusion
/// score 0 and category 0 are areas that count neither way (its toolkit goes by the category alone); occlusion 0 none,
/// 1 up to half, 2 more.
namespace eyrie {
namespace {

constexpr int kIgnoredRegion = 0;
constexpr int kCarCategory = 4;
constexpr int kMotorCategory = 10;
constexpr int kOthers = 11;
constexpr std::array<const char*, 12> kVisDroneCategories{"",           "person", "person",   "bicycle",         "car",
                                                          "van",        "truck",  "tricycle", "awning-tricycle", "bus",
                                                          "motorcycle", "other"};

/// `exact` tells whether the number stands for that class; otherwise it is the nearest, or "others".
int categoryOf(const std::string& object_class, bool& exact) {
    exact = true;
    for (std::size_t i = 1; i < kVisDroneCategories.size(); ++i) {
        if (object_class == kVisDroneCategories[i]) return static_cast<int>(i);
    }
    exact = false;
    switch (trackClassOf(object_class)) {
        case TrackClass::vehicle:
            return kCarCategory;
        case TrackClass::two_wheeler:
            return kMotorCategory;
        case TrackClass::unknown:
        case TrackClass::person:
            break;
    }
    return kOthers;
}

LabelFile readVisDrone(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    labels.first_frame_number = 1;
    int people = 0, truncated = 0;
    forEachLine(path, ',', '\0', [&](const TextLine& line) {
        std::size_t columns = line.size();
        if (columns == 11 && line.text(10).empty()) columns = 10;  // some lines end with a comma
        if (columns != 10) {
            line.fail(0,
                      std::to_string(columns) +
                          " columns, expected 10: frame,id,left,top,width,height,score,category,truncation,occlusion");
        }
        LabelBox record;
        record.frame = line.frame(0, 1);
        const int id = line.integer(1, "id");
        record.box = boxByEdges(line, 2, 0);
        const double score = line.number(6, "score");
        const int category = line.integer(7, "category");
        if (category < -1 || category > kOthers)
            line.fail(7, "category " + std::to_string(category) + ", expected 0 to 11");
        const int truncation = line.integer(8, "truncation");
        const int occlusion = line.integer(9, "occlusion");
        if (occlusion < -1 || occlusion > 2)
            line.fail(9, "occlusion " + std::to_string(occlusion) + ", expected 0 to 2");
        record.ignore = category == kIgnoredRegion || score == 0;
        if (id >= 0 && category != kIgnoredRegion) record.id = id;
        if (category > 0) record.object_class = kVisDroneCategories[static_cast<std::size_t>(category)];
        if (occlusion == 1) record.occlusion = Occlusion::partly;
        if (occlusion == 2) record.occlusion = Occlusion::fully;
        if (score != 0 && score != 1) record.score = score;
        people += category == 2;
        truncated += truncation > 0;
        labels.boxes[record.frame].push_back(std::move(record));
    });
    if (people > 0) labels.notes.push_back(counted(people, "box", "boxes") + " of category \"people\" became persons");
    if (truncated > 0) {
        labels.notes.push_back(counted(truncated, "box is", "boxes are") + " cut by the border, which is not kept");
    }
    return labels;
}

void writeVisDrone(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions&,
                   ExportReport& report) {
    AtomicFileWriter file(path);
    int rounded = 0, strange = 0, near = 0, areas = 0;
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records) {
            const BoxEdges e = edgesOf(record.box, 0);
            const long left = std::lround(e.left), top = std::lround(e.top);
            const long right = std::lround(e.left + e.width), bottom = std::lround(e.top + e.height);
            rounded += std::abs(left - e.left) + std::abs(top - e.top) + std::abs(right - e.left - e.width) +
                           std::abs(bottom - e.top - e.height) >
                       1e-6;
            bool exact = true;
            const int category = record.ignore ? kIgnoredRegion : categoryOf(record.object_class, exact);
            areas += record.ignore && !record.object_class.empty();
            strange += !exact && category == kOthers;
            near += !exact && category != kOthers;
            file.write(std::to_string(frame + 1) + ',' + std::to_string(*record.id) + ',' + std::to_string(left) + ',' +
                       std::to_string(top) + ',' + std::to_string(right - left) + ',' + std::to_string(bottom - top) +
                       (record.ignore ? ",0," : ",1,") + std::to_string(category) + ",0," +
                       std::to_string(static_cast<int>(record.occlusion)) + '\n');
        }
    });
    file.finish();
    report.files.push_back(path);
    report.add(LossKind::rounded, rounded, "were rounded to whole pixels");
    report.add(LossKind::class_name, areas, "are ignored and became ignored areas, without class and id");
    report.add(LossKind::class_name, near, "have a class that VisDrone does not know and became cars or motors");
    report.add(LossKind::class_name, strange,
               "have a class that VisDrone does not know and became \"others\", which its toolkit leaves out like "
               "ignored areas");
}

bool looksLikeVisDrone(const FileHead& head) {
    if (head.lines.empty()) return false;
    for (const std::string& line : head.lines) {
        const std::vector<double> n = leadingNumbers(line, ',');
        if (n.size() != 10 || n[0] < 1 || n[7] < 0 || n[7] > kOthers || n[8] < 0 || n[8] > 1 || n[9] < 0 || n[9] > 2) {
            return false;
        }
    }
    return true;
}

}  // namespace

LabelFormat visDroneFormat() {
    LabelFormat format;
    format.info = {"visdrone", "VisDrone (video)", {"txt"}, false, true, true, {}};
    format.info.carries = {.id = true, .object_class = true, .occlusion = true, .ignore = true};
    format.needs_id = true;
    format.read = readVisDrone;
    format.write_frames = writeVisDrone;
    format.fits = looksLikeVisDrone;
    return format;
}

}  // namespace eyrie

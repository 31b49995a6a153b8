#include <array>

#include "core/labels/track_class.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

/// VIRAT objects ("vpd"): exactly 8 columns between blanks, sorted by object and frame, pixels and frames from 0.
///   object id, duration, frame, left, top, width, height, type (1 person, 2 car, 3 vehicle, 4 object, 5 bike)
namespace eyrie {
namespace {

constexpr std::array<const char*, 6> kTypes{"", "person", "car", "vehicle", "other", "bicycle"};

LabelFile readVirat(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    forEachLine(path, ' ', '#', [&](const TextLine& line) {
        if (line.size() == 10) line.fail(0, "10 columns: these are VIRAT events; the objects are in *.objects.txt");
        if (line.size() != 8) line.fail(0, std::to_string(line.size()) + " columns, expected the 8 of VIRAT objects");
        LabelBox record;
        record.id = line.identity(0);
        line.integer(1, "duration");
        record.frame = line.frame(2, 0);
        record.box = boxByEdges(line, 3, 0);
        const int type = line.integer(7, "type");
        if (type < 0 || type > 5) line.fail(7, "type " + std::to_string(type) + ", expected 0 to 5");
        record.object_class = kTypes[static_cast<std::size_t>(type)];
        labels.boxes[record.frame].push_back(std::move(record));
    });
    return labels;
}

/// Number of the class; `exact` tells whether it reads back the same.
int typeOf(const std::string& object_class, bool& exact) {
    exact = true;
    for (std::size_t i = 0; i < kTypes.size(); ++i) {
        if (object_class == kTypes[i]) return static_cast<int>(i);
    }
    exact = false;
    if (isVehicleClass(object_class)) return 3;
    return trackClassOf(object_class) == TrackClass::two_wheeler ? 5 : 4;
}

void writeVirat(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions&,
                ExportReport& report) {
    AtomicFileWriter file(path);
    int strange = 0;
    for (const auto& [id, track] : boxesById(labels.boxes)) {
        for (const LabelBox* record : track) {
            const BoxEdges e = edgesOf(record->box, 0);
            bool exact = true;
            const int type = typeOf(record->object_class, exact);
            strange += !exact;
            std::string text =
                std::to_string(id) + ' ' + std::to_string(track.size()) + ' ' + std::to_string(record->frame);
            for (const double value : {e.left, e.top, e.width, e.height}) text += ' ' + fixedText(value, 3);
            file.write(text + ' ' + std::to_string(type) + '\n');
        }
    }
    file.finish();
    report.files.push_back(path);
    report.add(LossKind::class_name, strange, "have a class that VIRAT does not know and took the nearest type");
}

}  // namespace

LabelFormat viratFormat() {
    LabelFormat format;
    format.info = {"virat", "VIRAT objects", {"txt"}, false, true, true, {}};
    format.info.carries = {.id = true, .object_class = true};
    format.needs_id = true;
    format.read = readVirat;
    format.write = writeVirat;
    format.fits = [](const FileHead& head) {
        if (head.lines.empty()) return false;
        const std::vector<double> n = leadingNumbers(head.lines.front(), ' ');
        return n.size() == 8 && n[7] >= 0 && n[7] <= 5 && TextLine(head.path, 1, head.lines.front(), ' ').size() == 8;
    };
    return format;
}

}  // namespace eyrie

#include <cmath>

#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

/// The multi-object truth of the VIVID sequences (egtestNN_truth.csv): one header line, then
///   text, frame from 0, track id, left, top, width, height
/// A negative width marks a person to be ignored. Pixels from 0.
namespace eyrie {
namespace {

LabelFile readVivid(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    bool header = true;
    forEachLine(path, ',', '\0', [&](const TextLine& line) {
        if (header) {
            header = false;
            return;
        }
        if (line.size() != 7)
            line.fail(0, std::to_string(line.size()) + " columns, expected the 7 of VIVID ground truth");
        LabelBox record;
        const std::string text = withoutFormulaGuard(line.word(0, "text"));
        record.frame = line.frame(1, 0);
        record.id = line.identity(2);
        const double width = line.pixels(5, "width");
        record.box = boxFromEdges(
            {line.pixels(3, "left edge"), line.pixels(4, "top edge"), std::abs(width), line.size(6, "height")}, 0);
        record.ignore = width < 0;
        record.object_class = width < 0 ? "person" : "";
        if (!text.empty()) labels.image_names[record.frame] = text;
        labels.boxes[record.frame].push_back(std::move(record));
    });
    labels.notes.push_back("classes are not given; map \"\" to one (such as =car)");
    return labels;
}

void writeVivid(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions&,
                ExportReport& report) {
    AtomicFileWriter file(path);
    file.write("image,frame,id,x,y,w,h\n");
    const auto& names = labels.about.image_names;
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        const auto named = names.find(frame);
        const std::string name =
            named == names.end() ? "frame" + numberedName(frame) + ".jpg" : csvField(named->second);
        for (const LabelBox& record : records) {
            const BoxEdges e = edgesOf(record.box, 0);
            file.write(name + ',' + std::to_string(frame) + ',' + std::to_string(*record.id) + ',' +
                       fixedText(e.left, 3) + ',' + fixedText(e.top, 3) + ',' + (record.ignore ? "-" : "") +
                       fixedText(e.width, 3) + ',' + fixedText(e.height, 3) + '\n');
        }
    });
    file.finish();
    report.files.push_back(path);
}

}  // namespace

LabelFormat vividFormat() {
    LabelFormat format;
    format.info = {"vivid", "VIVID ground truth (CSV)", {"csv"}, false, true, true, {}};
    format.info.carries = {.id = true, .ignore = true};
    format.needs_id = true;
    format.read = readVivid;
    format.write_frames = writeVivid;
    format.fits = [](const FileHead& head) {
        if (head.lines.size() < 2 || !leadingNumbers(head.lines[0], ',').empty()) return false;
        const std::string& line = head.lines[1];
        const std::size_t comma = line.find(',');
        if (comma == std::string::npos || head.lines[0].find('#') != std::string::npos) return false;
        return leadingNumbers(line.substr(comma + 1), ',').size() == 6 && TextLine(head.path, 2, line).size() == 7;
    };
    return format;
}

}  // namespace eyrie

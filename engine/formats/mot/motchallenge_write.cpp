#include "core/error.h"
#include "formats/mot/mot_classes.h"
#include "formats/mot/motchallenge.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

std::string boxColumns(const BoxRecord& record, const MotWriteOptions& options, MotLosses& losses) {
    const BoxEdges e = edgesOf(record.box, options.pixels.first_pixel_edge);
    ++losses.boxes;
    if (isTurned(record.box)) ++losses.turned;
    if (record.velocity != cv::Point2d(0, 0)) ++losses.velocities;
    const auto pixels = [&](double value) { return fixedText(value, options.decimals); };
    return pixels(e.left) + "," + pixels(e.top) + "," + pixels(e.width) + "," + pixels(e.height);
}

/// Writes the lines that `columns` makes of the boxes; the file appears whole or not at all.
template <class Boxes, class Columns>
void writeLines(const std::filesystem::path& file, const Boxes& boxes, const Columns& columns) {
    std::string text;
    for (const auto& [frame, records] : boxes) {
        for (const auto& record : records) text += std::to_string(frame + 1) + ',' + columns(record) + '\n';
    }
    writeFileAtomically(file, text);
}

}  // namespace

MotLosses writeMotTruth(const std::filesystem::path& file, const BoxesByFrame& boxes, const MotWriteOptions& options) {
    return writeMotTruth(file, labelBoxes(boxes), options);
}

MotLosses writeMotTruth(const std::filesystem::path& file, const LabelBoxes& boxes, const MotWriteOptions& options) {
    for (const auto& [frame, records] : boxes) {
        for (const BoxRecord& record : records) {
            if (record.id) continue;
            throw Error(ErrorKind::input, file.string() + ": a box of frame " + std::to_string(frame) +
                                              " has no id, which MOTChallenge ground truth needs");
        }
    }
    MotLosses losses;
    writeLines(file, boxes, [&](const LabelBox& record) {
        MotClass known = motFromClass(record.object_class);
        if (options.every_class_one && !record.ignore) known = {1, record.object_class == "person"};
        if (options.ignored_distract && record.ignore) known = {8, record.object_class == "other"};
        if (!known.exact) ++losses.classes;
        const char* visibility[] = {"1", "0.5", "0"};
        return std::to_string(*record.id) + "," + boxColumns(record, options, losses) + "," +
               (record.ignore ? "0" : "1") + "," + std::to_string(known.number) + "," +
               visibility[static_cast<int>(record.occlusion)];
    });
    return losses;
}

MotLosses writeMotResult(const std::filesystem::path& file, const BoxesByFrame& boxes, const MotWriteOptions& options) {
    MotLosses losses;
    writeLines(file, boxes, [&](const BoxRecord& record) {
        if (!record.object_class.empty()) ++losses.classes;
        return std::to_string(record.id.value_or(-1)) + "," + boxColumns(record, options, losses) + "," +
               fixedText(record.score, 6) + ",-1,-1,-1";
    });
    return losses;
}

}  // namespace eyrie

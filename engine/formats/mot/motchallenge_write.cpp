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
template <class Columns>
void writeLines(const std::filesystem::path& path, const VisitFrames& frames, const Columns& columns) {
    AtomicFileWriter file(path);
    frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records)
            file.write(std::to_string(frame + 1) + ',' + columns(frame, record) + '\n');
    });
    file.finish();
}

}  // namespace

MotLosses writeMotTruth(const std::filesystem::path& file, const BoxesByFrame& boxes, const MotWriteOptions& options) {
    return writeMotTruth(file, labelBoxes(boxes), options);
}

MotLosses writeMotTruth(const std::filesystem::path& file, const LabelBoxes& boxes, const MotWriteOptions& options) {
    return writeMotTruth(file, framesOf(boxes), options);
}

MotLosses writeMotTruth(const std::filesystem::path& file, const VisitFrames& frames, const MotWriteOptions& options) {
    MotLosses losses;
    writeLines(file, frames, [&](FrameIndex frame, const LabelBox& record) {
        if (!record.id) {
            throw Error(ErrorKind::input, file.string() + ": a box of frame " + std::to_string(frame) +
                                              " has no id, which MOTChallenge ground truth needs");
        }
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
    const LabelBoxes labels = labelBoxes(boxes);
    return writeMotResult(file, framesOf(labels), options);
}

MotLosses writeMotResult(const std::filesystem::path& file, const VisitFrames& frames, const MotWriteOptions& options) {
    MotLosses losses;
    writeLines(file, frames, [&](FrameIndex, const LabelBox& record) {
        if (!record.object_class.empty()) ++losses.classes;
        return std::to_string(record.id.value_or(-1)) + "," + boxColumns(record, options, losses) + "," +
               fixedText(record.score, 6) + ",-1,-1,-1";
    });
    return losses;
}

}  // namespace eyrie

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/text.h"
#include "formats/format_functions.h"
#include "formats/free_numbers.h"

namespace eyrie {
namespace {

/// Gives ids of their own to boxes that have none, or one that another box of the frame has.
int numberBoxes(LabelBoxes& boxes) {
    FreeNumbers free_numbers(boxes);
    int numbered = 0;
    for (auto& [frame, records] : boxes) {
        std::set<int> taken;
        for (LabelBox& record : records) {
            if (record.id && taken.insert(*record.id).second) continue;
            record.id = free_numbers.next();
            ++numbered;
        }
    }
    return numbered;
}

/// Cuts upright boxes at the image's border.
int clipBoxes(LabelBoxes& boxes, cv::Size size) {
    int cut = 0;
    for (auto& [frame, records] : boxes) {
        for (LabelBox& record : records) {
            const BoxEdges e = edgesOf(record.box, 0);
            const double left = std::clamp(e.left, 0.0, double(size.width));
            const double top = std::clamp(e.top, 0.0, double(size.height));
            const double right = std::clamp(e.left + e.width, 0.0, double(size.width));
            const double bottom = std::clamp(e.top + e.height, 0.0, double(size.height));
            const double moved = std::abs(left - e.left) + std::abs(top - e.top) + std::abs(right - e.left - e.width) +
                                 std::abs(bottom - e.top - e.height);
            if (moved < 1e-6) continue;
            record.box = boxFromEdges({left, top, right - left, bottom - top}, 0);
            ++cut;
        }
    }
    return cut;
}

/// What the format has no place for, before anything format-specific.
void reportLosses(const LabelFile& labels, const Carries& carries, ExportReport& report) {
    constexpr double kHeading = 0.005;  // half a degree is no heading that anybody set
    int turned = 0, headings = 0, ids = 0, classes = 0, occluded = 0, ignored = 0, scores = 0, velocities = 0;
    for (const auto& [frame, records] : labels.boxes) {
        for (const LabelBox& record : records) {
            ++report.boxes;
            const bool is_turned = isTurned(record.box);
            turned += is_turned;
            headings += !is_turned && std::abs(std::sin(record.box.heading / 2)) > kHeading;
            ids += record.id.has_value();
            classes += !record.object_class.empty();
            occluded += record.occlusion != Occlusion::none;
            ignored += record.ignore;
            scores += record.score != 1;
            velocities += record.velocity != cv::Point2d(0, 0);
        }
    }
    if (!carries.rotation) {
        report.add(LossKind::rotation, turned, "lost their rotation: the enclosing upright boxes were written");
        report.add(LossKind::heading, headings, "lost their heading");
    }
    if (!carries.id) report.add(LossKind::id, ids, "lost their id");
    if (!carries.object_class) report.add(LossKind::class_name, classes, "lost their class");
    if (!carries.occlusion) report.add(LossKind::occlusion, occluded, "are occluded, which was not kept");
    if (!carries.ignore) report.add(LossKind::ignore, ignored, "are ignored, which was not kept: they count there");
    if (!carries.score) report.add(LossKind::score, scores, "lost their score");
    report.add(LossKind::velocity, velocities, "lost their velocity");
}

const LabelFormat& formatToWrite(const std::string& format) {
    const auto& table = formatTable();
    const auto known =
        std::find_if(table.begin(), table.end(), [&](const LabelFormat& entry) { return entry.info.name == format; });
    if (known != table.end() && known->write) return *known;
    std::string names;
    for (const LabelFormat& entry : table) {
        if (entry.write) names += (names.empty() ? "" : ", ") + entry.info.name;
    }
    throw Error(ErrorKind::parameter, "format \"" + format + "\" cannot be written; there are " + names);
}

}  // namespace

void ExportReport::add(LossKind kind, int count, const std::string& remark_after_number) {
    if (count == 0) return;
    losses.push_back({kind, count, counted(count, "box", "boxes") + ' ' + remark_after_number});
}

int ExportReport::lost(LossKind kind) const {
    int count = 0;
    for (const ExportLoss& loss : losses) count += loss.kind == kind ? loss.boxes : 0;
    return count;
}

std::vector<ExportFile> filesToWrite(const std::filesystem::path& path, const std::string& format,
                                     const ExportOptions& options) {
    const LabelFormat& known = formatToWrite(format);
    if (known.files) return known.files(path, options);
    if (known.info.folder) return {};
    const std::string extension = known.info.extensions.empty() ? "" : known.info.extensions.front();
    const FileKind kind = extension == "json" ? FileKind::json : extension == "xml" ? FileKind::xml : FileKind::text;
    return {{path, kind}};
}

ExportReport writeLabels(LabelFile labels, const std::filesystem::path& path, const std::string& format,
                         const ExportOptions& options) {
    const LabelFormat& known = formatToWrite(format);
    ExportReport report;
    report.format = format;
    if (options.image_size) labels.image_size = options.image_size;
    if (options.frame_count) labels.frame_count = options.frame_count;
    if (options.frame_rate_hz) labels.frame_rate_hz = options.frame_rate_hz;
    std::erase_if(labels.boxes, [](const auto& entry) { return entry.second.empty(); });
    const Carries& carries = known.info.carries;
    reportLosses(labels, carries, report);
    if (known.needs_id) {
        report.add(LossKind::id, numberBoxes(labels.boxes), "had no id of their own in a frame and got one");
    }
    if (options.clip.value_or(false) && !carries.rotation) {
        const cv::Size size = neededSize(labels.image_size, path, "cutting boxes at the border");
        report.add(LossKind::clipped, clipBoxes(labels.boxes, size), "were cut at the image's border");
    }
    ExportOptions valid = options;
    valid.sequence = validUtf8(options.sequence);  // names of files may be anything
    known.write(labels, path, valid, report);
    return report;
}

}  // namespace eyrie

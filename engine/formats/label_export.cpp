#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "core/error.h"
#include "core/text.h"
#include "formats/format_functions.h"
#include "formats/free_numbers.h"

namespace eyrie {
namespace {

/// The box cut at the image's border; nothing where it lies within.
std::optional<OrientedBox> cutAtBorder(const OrientedBox& box, cv::Size size) {
    const BoxEdges e = edgesOf(box, 0);
    const double left = std::clamp(e.left, 0.0, double(size.width));
    const double top = std::clamp(e.top, 0.0, double(size.height));
    const double right = std::clamp(e.left + e.width, 0.0, double(size.width));
    const double bottom = std::clamp(e.top + e.height, 0.0, double(size.height));
    const double moved = std::abs(left - e.left) + std::abs(top - e.top) + std::abs(right - e.left - e.width) +
                         std::abs(bottom - e.top - e.height);
    if (moved < 1e-6) return std::nullopt;
    return boxFromEdges({left, top, right - left, bottom - top}, 0);
}

/// What is to happen to boxes on their way into a format, and what is known of them before.
class Preparation {
 public:
    Preparation(bool needs_id, std::optional<cv::Size> clip_at) : needs_id_(needs_id), clip_at_(clip_at) {}

    /// All frames must be surveyed before the first is prepared.
    void survey(const std::vector<LabelBox>& in_frame) {
        constexpr double kHeading = 0.005;  // half a degree is no heading that anybody set
        std::set<int> taken;
        for (const LabelBox& record : in_frame) {
            ++boxes_;
            const bool is_turned = isTurned(record.box);
            turned_ += is_turned;
            headings_ += !is_turned && std::abs(std::sin(record.box.heading / 2)) > kHeading;
            with_id_ += record.id.has_value();
            classes_ += !record.object_class.empty();
            occluded_ += record.occlusion != Occlusion::none;
            ignored_ += record.ignore;
            scores_ += record.score != 1;
            velocities_ += record.velocity != cv::Point2d(0, 0);
            if (clip_at_) clipped_ += cutAtBorder(record.box, *clip_at_).has_value();
            if (!needs_id_) continue;
            if (record.id) free_numbers_.use(*record.id);
            numbered_ += !record.id || !taken.insert(*record.id).second;
        }
    }

    /// What the format has no place for, before anything format-specific, and what is changed.
    void report(const Carries& carries, ExportReport& report) const {
        report.boxes = boxes_;
        if (!carries.rotation) {
            report.add(LossKind::rotation, turned_, "lost their rotation: the enclosing upright boxes were written");
            report.add(LossKind::heading, headings_, "lost their heading");
        }
        if (!carries.id) report.add(LossKind::id, with_id_, "lost their id");
        if (!carries.object_class) report.add(LossKind::class_name, classes_, "lost their class");
        if (!carries.occlusion) report.add(LossKind::occlusion, occluded_, "are occluded, which was not kept");
        if (!carries.ignore)
            report.add(LossKind::ignore, ignored_, "are ignored, which was not kept: they count there");
        if (!carries.score) report.add(LossKind::score, scores_, "lost their score");
        report.add(LossKind::velocity, velocities_, "lost their velocity");
        report.add(LossKind::id, numbered_, "had no id of their own in a frame and got one");
        report.add(LossKind::clipped, clipped_, "were cut at the image's border");
    }

    bool changesNothing() const { return numbered_ == 0 && clipped_ == 0; }

    /// Goes through frames in their order, with ids of its own for boxes that have none, or one that another box of the
    /// frame has.
    class Pass {
     public:
        explicit Pass(const Preparation& preparation)
            : preparation_(preparation), free_numbers_(preparation.free_numbers_) {}
        void apply(std::vector<LabelBox>& in_frame) {
            std::set<int> taken;
            for (LabelBox& record : in_frame) {
                const bool named = record.id && taken.insert(*record.id).second;
                if (preparation_.needs_id_ && !named) record.id = free_numbers_.next();
                if (!preparation_.clip_at_) continue;
                if (const auto cut = cutAtBorder(record.box, *preparation_.clip_at_)) record.box = *cut;
            }
        }

     private:
        const Preparation& preparation_;
        FreeNumbers free_numbers_;
    };

    /// `preparation` must outlive the result.
    static VisitFrames prepared(const VisitFrames& frames, const Preparation& preparation) {
        if (preparation.changesNothing()) return frames;
        return [frames, &preparation](const FrameVisitor& visitor) {
            Pass pass(preparation);
            std::vector<LabelBox> in_frame;
            frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
                in_frame = records;
                pass.apply(in_frame);
                visitor(frame, in_frame);
            });
        };
    }

 private:
    bool needs_id_;
    std::optional<cv::Size> clip_at_;
    FreeNumbers free_numbers_;
    int boxes_ = 0;
    int turned_ = 0;
    int headings_ = 0;
    int with_id_ = 0;
    int classes_ = 0;
    int occluded_ = 0;
    int ignored_ = 0;
    int scores_ = 0;
    int velocities_ = 0;
    int numbered_ = 0;
    int clipped_ = 0;
};

const LabelFormat& formatToWrite(const std::string& format) {
    const auto& table = formatTable();
    const auto known =
        std::find_if(table.begin(), table.end(), [&](const LabelFormat& entry) { return entry.info.name == format; });
    if (known != table.end() && known->isWritten()) return *known;
    std::string names;
    for (const LabelFormat& entry : table) {
        if (entry.isWritten()) names += (names.empty() ? "" : ", ") + entry.info.name;
    }
    throw Error(ErrorKind::parameter, "format \"" + format + "\" cannot be written; there are " + names);
}

/// What is known of the labels, as the options would have it.
void describe(LabelFile& about, const ExportOptions& options) {
    if (options.image_size) about.image_size = options.image_size;
    if (options.frame_count) about.frame_count = options.frame_count;
    if (options.frame_rate_hz) about.frame_rate_hz = options.frame_rate_hz;
}

/// `about` must be described.
Preparation preparationFor(const LabelFormat& format, const LabelFile& about, const VisitFrames& frames,
                           const std::filesystem::path& path, const ExportOptions& options, ExportReport& report) {
    const Carries& carries = format.info.carries;
    std::optional<cv::Size> clip_at;
    if (options.clip.value_or(false) && !carries.rotation)
        clip_at = neededSize(about.image_size, path, "cutting boxes at the border");
    Preparation preparation(format.needs_id, clip_at);
    frames([&](FrameIndex, const std::vector<LabelBox>& in_frame) { preparation.survey(in_frame); });
    report.format = format.info.name;
    preparation.report(carries, report);
    return preparation;
}

void leaveIfStopped(const std::filesystem::path& path, const std::stop_token& stop) {
    if (stop.stop_requested()) throw Error(ErrorKind::output, path.string() + ": stopped before it was written");
}

VisitFrames stoppable(const VisitFrames& frames, const std::filesystem::path& path, const std::stop_token& stop) {
    return [frames, path, stop](const FrameVisitor& visitor) {
        frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
            leaveIfStopped(path, stop);
            visitor(frame, records);
        });
    };
}

ExportOptions withValidNames(ExportOptions options) {
    options.sequence = validUtf8(options.sequence);  // names of files may be anything
    return options;
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
    describe(labels, options);
    std::erase_if(labels.boxes, [](const auto& entry) { return entry.second.empty(); });
    LabelBoxes boxes = std::exchange(labels.boxes, {});
    const VisitFrames frames = framesOf(boxes);
    const Preparation preparation = preparationFor(known, labels, frames, path, options, report);
    if (known.write_frames) {
        const LabelStream stream{std::move(labels), Preparation::prepared(frames, preparation)};
        known.write_frames(stream, path, withValidNames(options), report);
    } else {
        labels.boxes = std::move(boxes);
        Preparation::Pass pass(preparation);
        for (auto& [frame, records] : labels.boxes) pass.apply(records);
        known.write(labels, path, withValidNames(options), report);
    }
    return report;
}

ExportReport writeLabels(const LabelStream& labels, const std::filesystem::path& path, const std::string& format,
                         const ExportOptions& options, const std::stop_token& stop) {
    const LabelFormat& known = formatToWrite(format);
    ExportReport report;
    LabelStream stream{labels.about, labels.frames};
    describe(stream.about, options);
    const VisitFrames until_stopped = stoppable(labels.frames, path, stop);
    const Preparation preparation = preparationFor(known, stream.about, until_stopped, path, options, report);
    leaveIfStopped(path, stop);
    // One file takes its place when it is whole. Of several the first would be left alone, and a folder in the way.
    const bool whole_or_nothing = !known.info.folder && filesToWrite(path, format, options).size() == 1;
    const bool can_stop = whole_or_nothing || known.write_frames == nullptr;
    stream.frames = Preparation::prepared(can_stop ? until_stopped : labels.frames, preparation);
    if (known.write_frames) {
        known.write_frames(stream, path, withValidNames(options), report);
    } else {
        known.write(collected(stream), path, withValidNames(options), report);
    }
    return report;
}

}  // namespace eyrie

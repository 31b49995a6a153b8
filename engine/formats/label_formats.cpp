#include "formats/label_formats.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>

#include "core/error.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/file_kind.h"
#include "io/folder.h"

namespace eyrie {
namespace {

const LabelFormat& formatNamed(const std::string& name) {
    std::string known;
    for (const LabelFormat& format : formatTable()) {
        if (format.info.name == name) return format;
        known += (known.empty() ? "" : ", ") + format.info.name;
    }
    throw Error(ErrorKind::parameter, "format \"" + name + "\" is unknown; there are " + known);
}

FileHead headOf(const std::filesystem::path& path) {
    FileHead head;
    head.path = path;
    head.folder = isFolder(path);
    if (head.folder) return head;
    checkReadableFile(path);
    std::ifstream stream(path, std::ios::binary);
    if (!stream) throw Error(ErrorKind::input, path.string() + ": cannot be read; check its permissions");
    head.text.resize(1 << 16);
    stream.read(head.text.data(), static_cast<std::streamsize>(head.text.size()));
    head.text.resize(static_cast<std::size_t>(stream.gcount()));
    const bool whole = stream.eof();
    if (head.text.starts_with("\xEF\xBB\xBF")) head.text.erase(0, 3);
    std::size_t begin = 0;
    while (begin < head.text.size() && head.lines.size() < 20) {
        const std::size_t end = head.text.find('\n', begin);
        if (end == std::string::npos && !whole && !head.lines.empty()) break;
        std::string line = head.text.substr(begin, end == std::string::npos ? end : end - begin);
        if (line.find_first_not_of(" \t\r") != std::string::npos) head.lines.push_back(std::move(line));
        if (end == std::string::npos) break;
        begin = end + 1;
    }
    return head;
}

/// Nothing that a reader let through may be beyond what can be worked with.
void checkLabels(const LabelFile& labels, const std::filesystem::path& path) {
    int lowest_id = 1, highest_id = 1;
    for (const auto& [frame, records] : labels.boxes) {
        std::set<int> ids;
        for (const LabelBox& record : records) {
            const OrientedBox& box = record.box;
            const std::string place = path.string() + ": frame " + std::to_string(frame);
            if (frame < 0 || frame >= kFrameLimit) {
                throw Error(ErrorKind::input, place + " is beyond any video; is the shift of frames right?");
            }
            lowest_id = std::min(lowest_id, record.id.value_or(lowest_id));
            highest_id = std::max(highest_id, record.id.value_or(highest_id));
            for (const double value : {box.centre.x, box.centre.y, box.length, box.width, box.heading}) {
                if (std::isfinite(value) && std::abs(value) <= 2 * kLargestCoordinate) continue;
                throw Error(ErrorKind::input, place + " has a box that lies outside any image");
            }
            for (const char c : record.object_class) {
                if (static_cast<unsigned char>(c) >= 0x20) continue;
                throw Error(ErrorKind::input, place + " has a class with control characters in its name");
            }
            if (record.id && !record.ignore && !ids.insert(*record.id).second) {
                throw Error(ErrorKind::input, place + " has two boxes of id " + std::to_string(*record.id) +
                                                  "; an object has one box in a frame");
            }
        }
    }
    // Ids of a project count from 1, to which all of a file are raised.
    if (1LL - lowest_id + highest_id > std::numeric_limits<int>::max()) {
        throw Error(ErrorKind::input, path.string() + ": ids reach from " + std::to_string(lowest_id) + " to " +
                                          std::to_string(highest_id) + "; number the objects from 1");
    }
}

std::string mapped(const std::string& name, const ImportOptions& options) {
    const auto found = options.class_map.find(name);
    return found == options.class_map.end() ? name : found->second;
}

OrientedBox scaled(OrientedBox box, double factor) {
    box = box.scaled(factor, factor);
    box.centre = {(box.centre.x + 0.5) * factor - 0.5, (box.centre.y + 0.5) * factor - 0.5};
    return box;
}

void applyOptions(LabelFile& labels, const ImportOptions& options, const std::filesystem::path& path) {
    if (!(options.scale > 0) || !std::isfinite(options.scale)) {
        throw Error(ErrorKind::parameter, "the scale must be a number above 0");
    }
    const auto shifted = [&](FrameIndex frame) -> FrameIndex {
        const long long sum = static_cast<long long>(frame) + options.frame_shift;
        if (sum >= 0 && sum < kFrameLimit) return static_cast<FrameIndex>(sum);
        throw Error(ErrorKind::parameter, path.string() + ": a shift by " + std::to_string(options.frame_shift) +
                                              " moves frame " + std::to_string(frame) + " out of the video");
    };
    LabelBoxes boxes;
    std::set<std::string> met;
    for (auto& [frame, records] : labels.boxes) {
        const FrameIndex there = shifted(frame);
        for (LabelBox& record : records) {
            met.insert(record.object_class);
            record.frame = there;
            record.box = scaled(record.box, options.scale);
            record.velocity *= options.scale;
            record.object_class = mapped(record.object_class, options);
        }
        boxes[there] = std::move(records);
    }
    labels.boxes = std::move(boxes);
    for (LabelledObject& object : labels.objects) {
        met.insert(object.object_class);
        object.object_class = mapped(object.object_class, options);
        object.last_frame = shifted(object.last_frame);
        for (Keyframe& keyframe : object.keyframes) {
            keyframe.frame = shifted(keyframe.frame);
            keyframe.box = scaled(keyframe.box, options.scale);
        }
    }
    met.insert(labels.classes.begin(), labels.classes.end());
    for (std::string& name : labels.classes) name = mapped(name, options);
    for (const auto& [from, to] : options.class_map) {
        if (!met.contains(from))
            labels.notes.push_back("no object has the class \"" + from + "\", which was to be mapped");
    }
    std::map<FrameIndex, std::string> names;
    for (auto& [frame, name] : labels.image_names) {
        const long long there = static_cast<long long>(frame) + options.frame_shift;
        if (there >= 0 && there < kFrameLimit) names[static_cast<FrameIndex>(there)] = std::move(name);
    }
    labels.image_names = std::move(names);
    if (labels.frame_count) {
        const long long frames = static_cast<long long>(*labels.frame_count) + options.frame_shift;
        labels.frame_count = static_cast<int>(std::clamp<long long>(frames, 0, kFrameLimit));
    }
    if (labels.image_size) {
        const auto side = [&](int length) { return cvRound(std::min(length * options.scale, kLargestCoordinate)); };
        labels.image_size = cv::Size(side(labels.image_size->width), side(labels.image_size->height));
    }
    if (labels.gsd_m) *labels.gsd_m /= options.scale;
}

}  // namespace

const std::vector<LabelFormatInfo>& labelFormats() {
    static const std::vector<LabelFormatInfo> infos = [] {
        std::vector<LabelFormatInfo> list;
        for (const LabelFormat& format : formatTable()) list.push_back(format.info);
        return list;
    }();
    return infos;
}

std::string labelFilePatterns() {
    std::set<std::string> patterns;
    for (const LabelFormatInfo& format : labelFormats()) {
        for (const std::string& extension : format.extensions) {
            if (format.reads) patterns.insert("*." + extension);
        }
    }
    std::string text;
    for (const std::string& pattern : patterns) text += (text.empty() ? "" : " ") + pattern;
    return text;
}

std::string sniffLabelFormat(const std::filesystem::path& path) {
    const FileHead head = headOf(path);
    for (const LabelFormat& format : formatTable()) {
        if (format.fits && format.fits(head)) return format.info.name;
    }
    if (!head.folder && head.lines.empty()) throw Error(ErrorKind::input, path.string() + ": is empty");
    const FileKind kind = head.folder ? FileKind::other : kindOfFile(path);
    if (kind == FileKind::video || kind == FileKind::image || kind == FileKind::project || kind == FileKind::model)
        throw Error(ErrorKind::input,
                    path.string() + ": is " + nameOf(kind) + " and no file of labels; choose another");
    throw Error(ErrorKind::input, path.string() +
                                      (head.folder ? ": the folder matches no known label format"
                                                   : ":1: the beginning matches no known format") +
                                      "; eyrie-cli import and the window's import can be told which it is (--format), "
                                      "or its columns (--columns)");
}

LabelFile readLabels(const std::filesystem::path& path, const std::string& format, const ImportOptions& options) {
    const bool sniff = format == "auto" && options.columns.empty();
    const std::string name = sniff ? sniffLabelFormat(path) : format == "auto" ? "columns" : format;
    const LabelFormat& known = formatNamed(name);
    if (!known.read) throw Error(ErrorKind::parameter, "format " + name + " can be written only");
    LabelFile labels = known.read(path, options);
    labels.format = name;
    checkLabels(labels, path);
    applyOptions(labels, options, path);
    checkLabels(labels, path);
    return labels;
}

}  // namespace eyrie

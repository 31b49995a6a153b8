#include <algorithm>
#include <cmath>
#include <limits>
#include <pugixml.hpp>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "formats/format_functions.h"
#include "formats/json_xml/cvat.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

/// How many frames the keyframes may span before the file is taken for damaged: CVAT lists every frame, so few elements
/// with very many frames between them are no labels.
constexpr std::int64_t kMostBoxes = 1'000'000;
constexpr std::int64_t kMostBoxesPerElement = 1000;
constexpr std::int64_t kMostLate = 10'000;  ///< frames by which labels of the right video may be late, so that it shows

/// The frame, as the file counts, from which on nothing is filled in.
std::int64_t filledUntil(const ImportOptions& options) {
    if (!options.frame_count) return std::numeric_limits<std::int64_t>::max();
    return std::int64_t{*options.frame_count} + kMostLate - options.frame_shift;
}

/// Names places in the text and reads attributes that nobody vouched for.
class CvatText {
 public:
    explicit CvatText(const std::filesystem::path& path) : path_(path), bytes_(readWholeFile(path)) {
        if (bytes_.starts_with("\xEF\xBB\xBF")) bytes_.erase(0, 3);
        if (!isUtf8(bytes_) || bytes_.find('\0') != std::string::npos) {
            throw Error(ErrorKind::input, path_.string() + ": is not UTF-8 text; export it again as UTF-8 XML");
        }
        if (bytes_.find("<!DOCTYPE") != std::string::npos || bytes_.find("<!ENTITY") != std::string::npos) {
            throw Error(ErrorKind::input,
                        path_.string() + ": declares a document type or entities, which labels never do");
        }
        const pugi::xml_parse_result result =
            document_.load_buffer(bytes_.data(), bytes_.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!result) failAt(result.offset, result.description());
    }
    pugi::xml_node root() const { return document_.child("annotations"); }

    [[noreturn]] void failAt(std::ptrdiff_t offset, const std::string& message) const {
        const auto end = bytes_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(bytes_));
        throw Error(ErrorKind::input,
                    path_.string() + ":" + std::to_string(1 + std::count(bytes_.begin(), end, '\n')) + ": " + message);
    }
    [[noreturn]] void fail(pugi::xml_node node, const std::string& message) const {
        failAt(node.offset_debug(), "<" + std::string(node.name()) + ">: " + message);
    }
    double real(pugi::xml_node node, const char* name, std::optional<double> fallback = std::nullopt) const {
        const pugi::xml_attribute attribute = node.attribute(name);
        if (!attribute && fallback) return *fallback;
        if (!attribute) fail(node, std::string("the attribute ") + name + " is missing");
        const std::optional<double> value = parseReal(attribute.value());
        if (!value || std::abs(*value) > kLargestCoordinate) {
            fail(node, std::string(name) + "=\"" + std::string(attribute.value()).substr(0, 40) +
                           "\", expected a number within an image");
        }
        return *value;
    }
    int whole(pugi::xml_node node, const char* name, std::optional<int> fallback = std::nullopt) const {
        const double value = real(node, name, fallback ? std::optional<double>(*fallback) : std::nullopt);
        if (value != std::floor(value)) fail(node, std::string(name) + " is not a whole number");
        return static_cast<int>(value);
    }
    /// The number that is an element's text, where there is such an element with text.
    std::optional<int> wholeIn(pugi::xml_node parent, const char* name) const {
        const pugi::xml_node node = parent.child(name);
        const std::string text = node.text().get();
        if (text.empty()) return std::nullopt;
        const std::optional<int> value = parseWhole(text);
        if (!value || *value < 0 || *value > kFrameLimit) fail(node, inQuotes(text) + " is not a number in range");
        return value;
    }

 private:
    std::filesystem::path path_;
    std::string bytes_;
    pugi::xml_document document_;
};

/// A keyframe as the file has it: angle apart from the unrotated edges.
struct FileBox {
    Keyframe keyframe;
    BoxEdges edges;
    double degrees = 0;
};

Keyframe finished(FileBox box) {
    box.keyframe.box = boxFromEdges(box.edges, 0);
    box.keyframe.box.heading = wrapPi(radiansFromDegrees(box.degrees));
    box.keyframe.heading_set = true;
    return box.keyframe;
}

bool isPolygon(pugi::xml_node node) {
    return std::string_view(node.name()) == "polygon" && node.attribute("points") && node.attribute("keyframe");
}

/// The edges around points="x,y;x,y;…".
BoxEdges edgesOfPolygon(const CvatText& text, pugi::xml_node node) {
    std::string_view rest = node.attribute("points").value();
    double left = 0, top = 0, right = 0, bottom = 0;
    for (bool first = true; first || !rest.empty(); first = false) {
        const std::size_t end = std::min(rest.find(';'), rest.size());
        const std::string_view point = rest.substr(0, end);
        const std::size_t comma = std::min(point.find(','), point.size());
        const auto x = parseReal(point.substr(0, comma));
        const auto y = parseReal(point.substr(std::min(comma + 1, point.size())));
        if (!x || !y || std::abs(*x) > kLargestCoordinate || std::abs(*y) > kLargestCoordinate)
            text.fail(node, "points holds " + inQuotes(point) + ", which is not a point");
        left = first ? *x : std::min(left, *x);
        right = first ? *x : std::max(right, *x);
        top = first ? *y : std::min(top, *y);
        bottom = first ? *y : std::max(bottom, *y);
        rest.remove_prefix(std::min(end + 1, rest.size()));
    }
    return {left, top, right - left, bottom - top};
}

BoxEdges edgesOfBox(const CvatText& text, pugi::xml_node node) {
    const double left = text.real(node, "xtl"), top = text.real(node, "ytl");
    const BoxEdges edges{left, top, text.real(node, "xbr") - left, text.real(node, "ybr") - top};
    if (edges.width < 0 || edges.height < 0) text.fail(node, "xbr or ybr lies before xtl or ytl");
    return edges;
}

FileBox readBox(const CvatText& text, pugi::xml_node node) {
    FileBox box;
    box.keyframe.frame = text.whole(node, "frame");
    if (box.keyframe.frame < 0 || box.keyframe.frame >= kFrameLimit) text.fail(node, "the frame is beyond any video");
    box.keyframe.outside = text.whole(node, "outside", 0) != 0;
    if (text.whole(node, "occluded", 0) != 0) box.keyframe.occlusion = Occlusion::partly;
    box.edges = isPolygon(node) ? edgesOfPolygon(text, node) : edgesOfBox(text, node);
    box.degrees = std::fmod(text.real(node, "rotation", 0.0), 360.0);
    for (const pugi::xml_node attribute : node.children("attribute")) {
        const std::string name = attribute.attribute("name").value(), value = attribute.text().get();
        if (name == cvat::kIgnoreAttribute) box.keyframe.ignore = value == "true";
        if (name == cvat::kOcclusionAttribute && value == "fully" && box.keyframe.occlusion != Occlusion::none) {
            box.keyframe.occlusion = Occlusion::fully;
        }
    }
    return box;
}

/// CVAT moves the unrotated edges linearly and the angle by the shorter arc.
FileBox between(const FileBox& a, const FileBox& b, FrameIndex frame) {
    const double t = double(frame - a.keyframe.frame) / (b.keyframe.frame - a.keyframe.frame);
    const auto mix = [t](double from, double to) { return from + (to - from) * t; };
    FileBox box = a;
    box.keyframe.frame = frame;
    const double right = mix(a.edges.left + a.edges.width, b.edges.left + b.edges.width);
    const double bottom = mix(a.edges.top + a.edges.height, b.edges.top + b.edges.height);
    box.edges.left = mix(a.edges.left, b.edges.left);
    box.edges.top = mix(a.edges.top, b.edges.top);
    box.edges.width = right - box.edges.left;
    box.edges.height = bottom - box.edges.top;
    box.degrees = a.degrees + std::remainder(b.degrees - a.degrees, 360.0) * t;
    return box;
}

class CvatReader {
 public:
    CvatReader(const std::filesystem::path& path, const ImportOptions& options)
        : text_(path), filled_until_(filledUntil(options)) {}

    LabelFile read() {
        const pugi::xml_node root = text_.root();
        if (!root) text_.failAt(0, "there is no <annotations>; this is not a CVAT file");
        readMeta(root.child("meta"));
        if (!root.child("track") && root.child("image")) {
            text_.fail(root.child("image"),
                       "these are labels of single images; export the task as \"CVAT for video 1.1\"");
        }
        for (const pugi::xml_node track : root.children("track")) readTrack(track);
        note();
        return std::move(labels_);
    }

 private:
    void readMeta(pugi::xml_node meta) {
        for (const char* kind : {"task", "job"}) {
            const pugi::xml_node task = meta.child(kind);
            if (!task) continue;
            stop_ = text_.wholeIn(task, "stop_frame");
            const std::optional<int> size = text_.wholeIn(task, "size");
            if (!stop_ && size && *size > 0) stop_ = text_.wholeIn(task, "start_frame").value_or(0) + *size - 1;
            if (stop_) labels_.frame_count = *stop_ + 1;
            for (const pugi::xml_node label : task.child("labels").children("label")) {
                labels_.classes.emplace_back(label.child("name").text().get());
            }
        }
        for (const pugi::xml_node place : {meta, meta.child("task"), meta.child("job")}) {
            const pugi::xml_node original = place.child("original_size");
            const auto width = text_.wholeIn(original, "width"), height = text_.wholeIn(original, "height");
            if (width && height && *width > 0 && *height > 0) labels_.image_size = cv::Size(*width, *height);
        }
    }
    int idOf(pugi::xml_node track) {
        const std::optional<int> told = parseWhole(track.attribute("id").value());
        int id = told && *told >= 0 ? *told : next_id_;
        if (!ids_.insert(id).second) {
            id = *ids_.rbegin() + 1;
            if (*ids_.rbegin() >= kFrameLimit) text_.fail(track, "there is no number left for this object");
            ids_.insert(id);
            ++renumbered_;
        }
        next_id_ = std::max(next_id_, id < kFrameLimit ? id + 1 : id);
        if (id > kFrameLimit) text_.fail(track, "the id is too high");
        return id;
    }
    void readTrack(pugi::xml_node track) {
        std::vector<FileBox> boxes;
        for (const pugi::xml_node node : track.children()) {
            if (node.type() != pugi::node_element) continue;
            polygons_ += isPolygon(node);
            if (std::string_view(node.name()) != "box" && !isPolygon(node)) {
                other_shapes_ += std::string_view(node.name()) != "attribute";
                continue;
            }
            ++elements_;
            if (text_.whole(node, "keyframe") != 0)
                boxes.push_back(readBox(text_, node));
            else
                text_.whole(node, "frame");
        }
        std::stable_sort(boxes.begin(), boxes.end(),
                         [](const FileBox& a, const FileBox& b) { return a.keyframe.frame < b.keyframe.frame; });
        for (std::size_t i = 1; i < boxes.size(); ++i) {
            if (boxes[i].keyframe.frame == boxes[i - 1].keyframe.frame) {
                text_.fail(track, "frame " + std::to_string(boxes[i].keyframe.frame) + " has two keyframes");
            }
        }
        const auto visible =
            std::find_if(boxes.begin(), boxes.end(), [](const FileBox& b) { return !b.keyframe.outside; });
        boxes.erase(boxes.begin(), visible);
        if (boxes.empty()) {
            ++empty_tracks_;
            return;
        }
        addObject(track, std::move(boxes));
    }
    void addObject(pugi::xml_node track, std::vector<FileBox> boxes) {
        LabelledObject object;
        object.id = idOf(track);
        object.object_class = track.attribute("label").value();
        if (object.object_class.empty()) text_.fail(track, "the label is missing");
        for (const char c : object.object_class) {
            if (static_cast<unsigned char>(c) < 0x20) text_.fail(track, "the label holds control characters");
        }
        object.origin = ObjectOrigin::imported;
        arriveOutside(boxes);
        const bool ended = boxes.back().keyframe.outside;
        while (boxes.back().keyframe.outside) boxes.pop_back();
        object.last_frame = boxes.back().keyframe.frame;
        if (!ended && stop_ && *stop_ > object.last_frame) {
            object.last_frame = *stop_;
            ++running_on_;
        }
        for (const FileBox& box : boxes) object.keyframes.push_back(finished(box));
        fill(track, object, boxes);
        labels_.objects.push_back(std::move(object));
    }
    /// CVAT moves a box towards where it is outside; our keyframes end where it is seen last.
    static void arriveOutside(std::vector<FileBox>& boxes) {
        for (std::size_t i = 1; i < boxes.size(); ++i) {
            const FrameIndex seen_last = boxes[i].keyframe.frame - 1;
            if (!boxes[i].keyframe.outside || boxes[i - 1].keyframe.outside) continue;
            if (boxes[i - 1].keyframe.frame == seen_last) continue;
            boxes.insert(boxes.begin() + static_cast<std::ptrdiff_t>(i), between(boxes[i - 1], boxes[i], seen_last));
            ++i;
        }
    }
    /// Every frame of the object, as CVAT shows it; far behind the video's end the keyframes only.
    void fill(pugi::xml_node track, const LabelledObject& object, const std::vector<FileBox>& boxes) {
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            if (boxes[i].keyframe.outside) continue;
            const bool last = i + 1 == boxes.size();
            const FrameIndex begin = boxes[i].keyframe.frame;
            const FrameIndex next = last ? object.last_frame + 1 : boxes[i + 1].keyframe.frame;
            const auto end = static_cast<FrameIndex>(std::clamp<std::int64_t>(filled_until_, begin + 1, next));
            labels_.not_filled += next - end;
            count_ += end - begin;
            if (count_ > kMostBoxes + kMostBoxesPerElement * elements_)
                text_.fail(track, "the keyframes span implausibly many frames");
            const bool moves = !last;
            for (FrameIndex frame = begin; frame < end; ++frame) {
                FileBox box = moves ? between(boxes[i], boxes[i + 1], frame) : boxes[i];
                box.keyframe.frame = frame;
                add(object, finished(box));
            }
        }
    }
    void add(const LabelledObject& object, const Keyframe& keyframe) {
        LabelBox record;
        record.frame = keyframe.frame;
        record.id = object.id;
        record.box = keyframe.box;
        record.object_class = object.object_class;
        record.ignore = keyframe.ignore;
        record.occlusion = keyframe.occlusion;
        labels_.boxes[record.frame].push_back(std::move(record));
    }
    void note() {
        const auto say = [&](int count, const char* one, const char* many, const char* what) {
            if (count > 0) labels_.notes.push_back(counted(count, one, many) + what);
        };
        say(running_on_, "track has", "tracks have", " no end and run to the end of the clip, as CVAT shows them");
        say(other_shapes_, "shape", "shapes", " other than boxes were skipped");
        say(polygons_, "polygon", "polygons", " became the boxes around them");
        say(empty_tracks_, "track holds", "tracks hold", " no visible keyframe and were left out");
        say(renumbered_, "track", "tracks", " got a new id, as another has it already");
    }

    CvatText text_;
    std::int64_t filled_until_;
    LabelFile labels_;
    std::optional<int> stop_;
    std::set<int> ids_;
    int next_id_ = 0;
    std::int64_t count_ = 0, elements_ = 0;
    int running_on_ = 0, other_shapes_ = 0, polygons_ = 0, empty_tracks_ = 0, renumbered_ = 0;
};

}  // namespace

LabelFile readCvat(const std::filesystem::path& path, const ImportOptions& options) {
    return CvatReader(path, options).read();
}

}  // namespace eyrie

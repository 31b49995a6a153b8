#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "core/angle.h"
#include "core/error.h"
#include "formats/coco.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/image_sequence.h"
#include "io/number_text.h"

namespace eyrie {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 32;  ///< nesting; labels need about six

/// A value together with where it stands. Places refer to the place they are in, which must outlive them.
class Place {
 public:
    Place(const std::filesystem::path& file, const Json& value) : file_(file), value_(value) {}

    const Json& value() const { return value_; }
    [[noreturn]] void fail(const std::string& message) const {
        const std::string place = name();
        throw Error(ErrorKind::input, file_.string() + ": " + (place.empty() ? "the file" : place) + ": " + message);
    }
    bool has(const char* key) const {
        if (!value_.is_object()) return false;
        const auto found = value_.find(key);
        return found != value_.end() && !found->is_null();
    }
    Place at(const char* key) const {
        if (!value_.is_object()) fail("is no object");
        const auto found = value_.find(key);
        if (found == value_.end() || found->is_null()) fail(std::string("\"") + key + "\" is missing");
        return {*this, *found, key, 0};
    }
    Place at(std::size_t index) const { return {*this, value_.at(index), nullptr, index}; }
    std::size_t size() const {
        if (!value_.is_array()) fail("is no list");
        return value_.size();
    }
    double real() const {
        if (!value_.is_number() || !std::isfinite(value_.get<double>())) fail("is no number");
        return value_.get<double>();
    }
    double pixels() const {
        const double number = real();
        if (std::abs(number) > kLargestCoordinate) fail("lies outside any image");
        return number;
    }
    int whole() const {
        const double number = real();
        if (number != std::floor(number) || std::abs(number) > 2e9) fail("is no whole number in range");
        return static_cast<int>(number);
    }
    std::string text() const {
        if (!value_.is_string()) fail("is no text");
        const std::string& text = value_.get_ref<const std::string&>();
        for (const char c : text) {
            if (static_cast<unsigned char>(c) < 0x20) fail("holds control characters");
        }
        return text;
    }
    /// A flag as JSON writes them: true, 1 or "true".
    bool flag() const {
        return (value_.is_boolean() && value_.get<bool>()) || (value_.is_number() && value_.get<double>() != 0) ||
               (value_.is_string() && value_.get_ref<const std::string&>() == "true");
    }

 private:
    Place(const Place& within, const Json& value, const char* key, std::size_t index)
        : file_(within.file_), value_(value), within_(&within), key_(key), index_(index) {}
    std::string name() const {
        if (within_ == nullptr) return {};
        const std::string before = within_->name();
        if (key_ == nullptr) return before + "[" + std::to_string(index_) + "]";
        return before.empty() ? key_ : before + "." + key_;
    }

    const std::filesystem::path& file_;
    const Json& value_;
    const Place* within_ = nullptr;
    const char* key_ = nullptr;  ///< none: `index_` counts
    std::size_t index_ = 0;
};

/// How deep brackets nest outside of texts.
int depthOf(const std::string& bytes) {
    int depth = 0, deepest = 0;
    bool in_text = false;
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const char c = bytes[i];
        if (in_text) {
            if (c == '\\') ++i;
            if (c == '"') in_text = false;
        } else if (c == '"') {
            in_text = true;
        } else if (c == '[' || c == '{') {
            deepest = std::max(deepest, ++depth);
        } else if (c == ']' || c == '}') {
            --depth;
        }
    }
    return deepest;
}

Json parse(const std::filesystem::path& path) {
    const std::string bytes = readWholeFile(path);
    if (depthOf(bytes) > kDeepest) {
        throw Error(ErrorKind::input, path.string() + ": is nested deeper than labels ever are");
    }
    try {
        return Json::parse(bytes);
    } catch (const Json::exception& error) {
        throw Error(ErrorKind::input, path.string() + ": is no valid JSON: " + error.what());
    }
}

struct Image {
    FrameIndex frame = 0;
    bool wanted = true;  ///< belongs to the chosen video
};

class CocoReader {
 public:
    CocoReader(const std::filesystem::path& path, const ImportOptions& options)
        : path_(path), options_(options), json_(parse(path)), root_(path_, json_) {}

    LabelFile read() {
        if (json_.is_array()) {
            readResults();
        } else {
            if (!json_.is_object() || !root_.has("images") || !root_.has("annotations")) {
                root_.fail("holds no \"images\" and \"annotations\"; is this COCO?");
            }
            readCategories();
            readImages();
            const Place annotations = root_.at("annotations");
            for (std::size_t i = 0; i < annotations.size(); ++i) readAnnotation(annotations.at(i));
        }
        note();
        return std::move(labels_);
    }

 private:
    void readCategories() {
        if (!root_.has("categories")) return;
        const Place categories = root_.at("categories");
        for (std::size_t i = 0; i < categories.size(); ++i) {
            const Place category = categories.at(i);
            const std::string name = category.at("name").text();
            categories_[category.at("id").whole()] = name;
            labels_.classes.push_back(name);
        }
    }
    /// The video asked for, where there are videos.
    std::optional<int> chosenVideo() {
        if (!root_.has("videos")) return std::nullopt;
        const Place videos = root_.at("videos");
        std::string names;
        std::optional<int> chosen;
        for (std::size_t i = 0; i < videos.size(); ++i) {
            const Place video = videos.at(i);
            const std::string name = video.has("name") ? video.at("name").text() : std::to_string(i);
            names += (i == 0 ? "" : ", ") + name;
            if (videos.size() > 1 && name != options_.sequence) continue;
            chosen = video.at("id").whole();
            for (const char* key : {"annotation_fps", "fps"}) {
                if (video.has(key) && video.at(key).value().is_number() && video.at(key).real() > 0) {
                    labels_.frame_rate_hz = video.at(key).real();
                }
            }
        }
        if (videos.size() > 1 && !chosen) videos.fail("holds several; choose one by name (--sequence): " + names);
        return chosen;
    }
    void readImages() {
        const std::optional<int> video = chosenVideo();
        const Place images = root_.at("images");
        struct Entry {
            int id;
            std::string name;
            std::optional<int> frame;
        };
        std::vector<Entry> entries;
        bool all_indexed = images.size() > 0, same_size = true;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const Place image = images.at(i);
            Entry entry{image.at("id").whole(), "", std::nullopt};
            if (images_.contains(entry.id))
                image.fail("another image has the id " + std::to_string(entry.id) + " already");
            if (image.has("file_name")) entry.name = image.at("file_name").text();
            const bool wanted = !video || !image.has("video_id") || image.at("video_id").whole() == *video;
            images_[entry.id] = {0, wanted};
            if (!wanted) continue;
            if (image.has("frame_index")) entry.frame = image.at("frame_index").whole();
            if (entry.frame && (*entry.frame < 0 || *entry.frame >= kFrameLimit)) {
                image.at("frame_index").fail("is beyond any video");
            }
            all_indexed = all_indexed && entry.frame.has_value();
            if (image.has("width") && image.has("height")) {
                const cv::Size size(image.at("width").whole(), image.at("height").whole());
                same_size = same_size && (!labels_.image_size || *labels_.image_size == size);
                if (size.width > 0 && size.height > 0) labels_.image_size = size;
            }
            entries.push_back(std::move(entry));
        }
        std::stable_sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
            return naturalOrder(a.name, b.name) || (a.name == b.name && a.id < b.id);
        });
        FrameIndex last = -1;
        for (std::size_t i = 0; i < entries.size(); ++i) {
            const FrameIndex frame = all_indexed ? entries[i].frame.value_or(0) : static_cast<FrameIndex>(i);
            images_[entries[i].id].frame = frame;
            if (!entries[i].name.empty()) labels_.image_names[frame] = entries[i].name;
            last = std::max(last, frame);
        }
        labels_.frame_count = last + 1;
        if (!same_size) {
            labels_.image_size.reset();
            labels_.notes.push_back("the images are of different sizes");
        }
        if (!all_indexed && !entries.empty())
            labels_.notes.push_back("frames are the images in the order of their names");
    }
    void readResults() {
        std::set<int> ids;
        for (std::size_t i = 0; i < root_.size(); ++i) {
            const Place result = root_.at(i);
            const int image = result.at("image_id").whole();
            if (image < 0 || image >= kFrameLimit) result.at("image_id").fail("is no frame");
            images_[image] = {image, true};
            readAnnotation(result);
        }
        labels_.notes.push_back("this is a list of results: frames are the numbers of its images");
    }
    void readAnnotation(const Place& annotation) {
        const auto image = images_.find(annotation.at("image_id").whole());
        if (image == images_.end()) annotation.at("image_id").fail("there is no such image");
        if (!image->second.wanted) return;
        if (!annotation.has("bbox")) {
            ++without_box_;
            return;
        }
        LabelBox record;
        record.frame = image->second.frame;
        record.box = boxOf(annotation);
        if (annotation.has("category_id")) {
            const int category = annotation.at("category_id").whole();
            const auto named = categories_.find(category);
            record.object_class = named == categories_.end() ? "class " + std::to_string(category) : named->second;
        }
        if (annotation.has("track_id")) record.id = trackOf(annotation.at("track_id"));
        if (annotation.has("score")) record.score = annotation.at("score").real();
        record.ignore = (annotation.has("iscrowd") && annotation.at("iscrowd").flag()) ||
                        (annotation.has("ignore") && annotation.at("ignore").flag());
        if (annotation.has("attributes")) {
            const Place attributes = annotation.at("attributes");
            if (attributes.has("track_id") && !record.id) record.id = trackOf(attributes.at("track_id"));
            if (attributes.has("occluded") && attributes.at("occluded").flag()) record.occlusion = Occlusion::partly;
            const bool fully = attributes.has("occlusion") && attributes.at("occlusion").value() == "fully";
            if (fully) record.occlusion = Occlusion::fully;
        }
        labels_.boxes[record.frame].push_back(std::move(record));
    }
    /// Ids may be names; these get numbers above all others at the end.
    int trackOf(const Place& track) {
        if (track.value().is_string()) {
            const std::string name = track.text();
            if (const auto number = parseWhole(name); number && *number >= 0) return *number;
            return named_.emplace(name, static_cast<int>(kFirstNamedId + static_cast<int>(named_.size())))
                .first->second;
        }
        const int id = track.whole();
        if (id < 0) track.fail("is negative");
        return id;
    }
    OrientedBox boxOf(const Place& annotation) {
        const Place bounds = annotation.at("bbox");
        if (bounds.size() != 4)
            bounds.fail(std::to_string(bounds.size()) + " numbers, expected left, top, width, height");
        BoxEdges e{bounds.at(std::size_t{0}).pixels(), bounds.at(1).pixels(), bounds.at(2).pixels(),
                   bounds.at(3).pixels()};
        if (e.width < 0 || e.height < 0) bounds.fail("the size is negative");
        const OrientedBox upright = boxFromEdges(e, 0);
        std::optional<double> rotation;
        if (annotation.has("dive_detection_attributes")) {
            const Place attributes = annotation.at("dive_detection_attributes");
            if (attributes.has("rotation")) {
                const Place turn = attributes.at("rotation");
                if (std::abs(turn.real()) > 1000) turn.fail("is no angle in radians");
                rotation = wrapPi(turn.real());
            }
        }
        const auto corners = outlineOf(annotation);
        if (!corners) {
            OrientedBox box = upright;
            if (rotation) box.heading = *rotation;
            return box;
        }
        if (rotation) return boxAround(*corners, *rotation);
        return boxOfOutline(*corners, upright);
    }
    std::optional<std::array<cv::Point2d, 4>> outlineOf(const Place& annotation) {
        if (!annotation.has("segmentation")) return std::nullopt;
        const Place polygons = annotation.at("segmentation");
        if (!polygons.value().is_array() || polygons.size() != 1 || !polygons.at(std::size_t{0}).value().is_array()) {
            return std::nullopt;  // runs of a mask, or several parts
        }
        const Place polygon = polygons.at(std::size_t{0});
        if (polygon.size() != 8) return std::nullopt;
        std::array<cv::Point2d, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = {polygon.at(2 * i).pixels() - 0.5, polygon.at(2 * i + 1).pixels() - 0.5};
        }
        return corners;
    }
    /// Four corners that nobody says the front of: a turned rectangle lies along its long side, anything else is
    /// bounds.
    OrientedBox boxOfOutline(const std::array<cv::Point2d, 4>& corners, const OrientedBox& upright) {
        const CornerBox fitted = boxFromCorners(corners);
        const double tolerance = std::max(1.0, 0.05 * std::hypot(fitted.box.length, fitted.box.width));
        if (fitted.departure > tolerance) {
            ++odd_outlines_;
            return upright;
        }
        if (std::abs(std::sin(2 * fitted.box.heading)) < 1e-3) return upright;
        ++without_front_;
        OrientedBox box = fitted.box;
        if (box.length < box.width) {
            std::swap(box.length, box.width);
            box.heading += kPi / 2;
        }
        box.heading = axisTurnBetween(0, box.heading);
        return box;
    }
    void note() {
        const auto say = [&](int count, const char* one, const char* many, const char* what) {
            if (count > 0) labels_.notes.push_back(counted(count, one, many) + what);
        };
        say(without_box_, "annotation has", "annotations have", " no bbox and were passed over");
        say(odd_outlines_, "outline is", "outlines are", " no rectangle; the bounds were taken");
        say(without_front_, "turned box does", "turned boxes do",
            " not say where the front is; the heading may be opposite");
        say(static_cast<int>(named_.size()), "track has a name", "tracks have names", " for an id and got a number");
    }

    static constexpr int kFirstNamedId = 1'000'000'000;
    const std::filesystem::path& path_;
    const ImportOptions& options_;
    Json json_;
    Place root_;
    LabelFile labels_;
    std::map<int, std::string> categories_;
    std::map<int, Image> images_;
    std::map<std::string, int> named_;
    int without_box_ = 0, odd_outlines_ = 0, without_front_ = 0;
};

}  // namespace

LabelFile readCoco(const std::filesystem::path& path, const ImportOptions& options) {
    return CocoReader(path, options).read();
}

}  // namespace eyrie

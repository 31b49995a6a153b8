#include <algorithm>
#include <set>

#include "core/error.h"
#include "formats/format_functions.h"
#include "formats/json_xml/coco.h"
#include "formats/json_xml/coco_shape.h"
#include "formats/json_xml/json_place.h"
#include "io/tables/number_text.h"
#include "io/video/image_sequence.h"

namespace eyrie {
namespace {

struct Image {
    FrameIndex frame = 0;
    bool wanted = true;  ///< belongs to the chosen video
};

class CocoReader {
 public:
    CocoReader(const std::filesystem::path& path, const ImportOptions& options)
        : path_(path), options_(options), json_(readLabelJson(path)), root_(path_, json_) {}

    LabelFile read() {
        if (json_.is_array()) {
            readResults();
        } else {
            if (!json_.is_object() || !root_.has("images") || !root_.has("annotations")) {
                root_.fail("holds no \"images\" and \"annotations\"; is this COCO?");
            }
            readCategories();
            readImages();
            const JsonPlace annotations = root_.at("annotations");
            for (std::size_t i = 0; i < annotations.size(); ++i) {
                const JsonPlace annotation = annotations.at(i);
                orLeaveOut([&] { readAnnotation(annotation); });
            }
        }
        note();
        return std::move(labels_);
    }

 private:
    /// One bad entry does not spoil the others, which the programs of the format read, too.
    template <class Read>
    void orLeaveOut(const Read& read) {
        try {
            read();
        } catch (const Error& reason) {
            left_out_.add(reason);
        }
    }
    void readCategories() {
        if (!root_.has("categories")) return;
        const JsonPlace categories = root_.at("categories");
        for (std::size_t i = 0; i < categories.size(); ++i) {
            const JsonPlace category = categories.at(i);
            categories_in_order_.emplace_back();
            orLeaveOut([&] {
                const int id = category.at("id").whole();
                std::string name = category.has("name") ? category.at("name").text() : "";
                categories_in_order_.back() = name;
                unnamed_categories_ += name.empty();
                if (name.empty()) name = "class " + std::to_string(id);
                categories_[id] = name;
                labels_.classes.push_back(name);
            });
        }
    }
    /// The video asked for, where there are videos.
    std::optional<int> chosenVideo() {
        if (!root_.has("videos")) return std::nullopt;
        const JsonPlace videos = root_.at("videos");
        std::string names;
        std::optional<int> chosen;
        for (std::size_t i = 0; i < videos.size(); ++i) {
            const JsonPlace video = videos.at(i);
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
        const JsonPlace images = root_.at("images");
        struct Entry {
            int id;
            std::string name;
            std::optional<int> frame;
        };
        std::vector<Entry> entries;
        bool all_indexed = images.size() > 0, same_size = true;
        for (std::size_t i = 0; i < images.size(); ++i) {
            const JsonPlace image = images.at(i);
            orLeaveOut([&] {
                Entry entry{image.at("id").whole(), "", std::nullopt};
                if (images_.contains(entry.id))
                    image.fail("another image has the id " + std::to_string(entry.id) + " already");
                if (image.has("file_name")) entry.name = image.at("file_name").text();
                const bool wanted = !video || !image.has("video_id") || image.at("video_id").whole() == *video;
                if (!wanted) {
                    images_[entry.id] = {0, false};
                    return;
                }
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
                images_[entry.id] = {0, true};
                entries.push_back(std::move(entry));
            });
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
        for (std::size_t i = 0; i < root_.size(); ++i) {
            const JsonPlace result = root_.at(i);
            orLeaveOut([&] {
                const int image = result.at("image_id").whole();
                if (image < 0 || image >= kFrameLimit) result.at("image_id").fail("is not a frame");
                images_[image] = {image, true};
                readAnnotation(result);
            });
        }
        labels_.notes.push_back("this is a list of results: frames are the numbers of its images");
    }
    void readAnnotation(const JsonPlace& annotation) {
        const auto image = images_.find(annotation.at("image_id").whole());
        if (image == images_.end()) annotation.at("image_id").fail("there is no such image");
        if (!image->second.wanted) return;
        const std::optional<OrientedBox> box = shapes_.boxOf(annotation);
        if (!box) return;
        LabelBox record;
        record.frame = image->second.frame;
        record.box = *box;
        record.object_class = classOf(annotation);
        if (annotation.has("track_id")) record.id = trackOf(annotation.at("track_id"));
        if (annotation.has("score")) record.score = annotation.at("score").real();
        record.ignore = (annotation.has("iscrowd") && annotation.at("iscrowd").flag()) ||
                        (annotation.has("ignore") && annotation.at("ignore").flag());
        if (annotation.has("attributes")) {
            const JsonPlace attributes = annotation.at("attributes");
            if (attributes.has("track_id") && !record.id) record.id = trackOf(attributes.at("track_id"));
            if (attributes.has("occluded") && attributes.at("occluded").flag()) record.occlusion = Occlusion::partly;
            const bool fully = attributes.has("occlusion") && attributes.at("occlusion").value() == "fully";
            if (fully) record.occlusion = Occlusion::fully;
        }
        if (annotation.has("dive_detection_attributes")) {
            const JsonPlace attributes = annotation.at("dive_detection_attributes");
            if (attributes.has("ignore") && attributes.at("ignore").flag()) record.ignore = true;
            const std::string hidden = attributes.has("occluded") && attributes.at("occluded").value().is_string()
                                           ? attributes.at("occluded").text()
                                           : "";
            if (record.occlusion == Occlusion::none && attributes.has("occluded")) {
                if (hidden == "partly" || attributes.at("occluded").flag()) record.occlusion = Occlusion::partly;
                if (hidden == "fully") record.occlusion = Occlusion::fully;
            }
        }
        if (record.id && !record.ignore && !taken_.insert({record.frame, *record.id}).second) {
            annotation.fail("its track has a box in frame " + std::to_string(record.frame) + " already");
        }
        labels_.boxes[record.frame].push_back(std::move(record));
    }
    /// The class of the highest confidence where several are told, as DIVE takes it.
    std::string classOf(const JsonPlace& annotation) {
        std::string primary;
        if (annotation.has("category_id")) {
            const int category = annotation.at("category_id").whole();
            const auto named = categories_.find(category);
            primary = named == categories_.end() ? "class " + std::to_string(category) : named->second;
        }
        const std::string surest = surestClassOf(annotation);
        if (surest.empty() || surest == primary) return primary;
        by_confidence_ += !primary.empty();
        return surest;
    }
    std::string surestClassOf(const JsonPlace& annotation) const {
        std::string surest;
        double highest = 0.001;  // less is none
        const auto offer = [&](const std::string& name, double confidence) {
            if (name.empty() || confidence <= highest) return;
            highest = confidence;
            surest = name;
        };
        if (annotation.has("dive_confidence_pairs") && annotation.at("dive_confidence_pairs").value().is_array()) {
            const JsonPlace pairs = annotation.at("dive_confidence_pairs");
            for (std::size_t i = 0; i < pairs.size(); ++i) {
                const nlohmann::json& pair = pairs.at(i).value();
                if (!pair.is_array() || pair.size() != 2 || !pair[0].is_string() || !pair[1].is_number()) continue;
                const JsonPlace told = pairs.at(i);
                offer(told.at(std::size_t{0}).text(), pair[1].get<double>());
            }
            if (!surest.empty()) return surest;
        }
        if (!annotation.has("prob") || !annotation.at("prob").value().is_array()) return {};
        const nlohmann::json& probabilities = annotation.at("prob").value();
        const std::set<std::string> names(categories_in_order_.begin(), categories_in_order_.end());
        const bool usable =
            probabilities.size() == categories_in_order_.size() && names.size() == categories_in_order_.size();
        for (std::size_t i = 0; usable && i < probabilities.size(); ++i) {
            if (probabilities[i].is_number()) offer(categories_in_order_[i], probabilities[i].get<double>());
        }
        return surest;
    }
    /// Ids may be names; these get numbers above all others at the end.
    int trackOf(const JsonPlace& track) {
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
    void note() {
        const auto say = [&](int count, const char* one, const char* many, const char* what) {
            if (count > 0) labels_.notes.push_back(counted(count, one, many) + what);
        };
        shapes_.tell(labels_);
        say(unnamed_categories_, "category has", "categories have", " no name and are called by their number");
        say(by_confidence_, "annotation takes", "annotations take",
            " the class of the highest confidence, which differs from category_id");
        say(static_cast<int>(named_.size()), "track has a name", "tracks have names", " for an id and got a number");
        left_out_.tell(labels_);
    }

    static constexpr int kFirstNamedId = 1'000'000'000;
    const std::filesystem::path& path_;
    const ImportOptions& options_;
    nlohmann::json json_;
    JsonPlace root_;
    LabelFile labels_;
    std::map<int, std::string> categories_;
    std::map<int, Image> images_;
    std::map<std::string, int> named_;
    std::vector<std::string> categories_in_order_;  ///< empty where one has no name
    std::set<std::pair<FrameIndex, int>> taken_;    ///< boxes that count, by frame and id
    CocoShapes shapes_;
    LeftOutRows left_out_;
    int unnamed_categories_ = 0, by_confidence_ = 0;
};

}  // namespace

LabelFile readCoco(const std::filesystem::path& path, const ImportOptions& options) {
    return CocoReader(path, options).read();
}

}  // namespace eyrie

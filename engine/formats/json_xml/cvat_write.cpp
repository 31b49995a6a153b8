#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/geometry/angle.h"
#include "core/text.h"
#include "formats/format_functions.h"
#include "formats/json_xml/cvat.h"
#include "io/atomic_file.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr double kTolerance = 0.02;  ///< px and degrees, about what two decimals leave
constexpr int kCvatDecimals = 2;

/// What is written of a box, rounded as it will be.
struct Written {
    FrameIndex frame = 0;
    std::array<double, 4> edges{};  ///< left, top, right, bottom of the unrotated box
    double degrees = 0;
    Occlusion occlusion = Occlusion::none;
    bool ignore = false;
    bool keyframe = true;
};

Written writtenOf(const LabelBox& record) {
    const auto rounded = [](double value) { return std::round(value * 100) / 100; };
    const OrientedBox& box = record.box;
    const BoxEdges e = edgesOf({box.centre, box.length, box.width, 0}, 0);
    Written written;
    written.frame = record.frame;
    written.edges = {rounded(e.left), rounded(e.top), rounded(e.left + e.width), rounded(e.top + e.height)};
    written.degrees = std::fmod(rounded(degreesFromRadians(box.heading)), 360.0);
    written.occlusion = record.occlusion;
    written.ignore = record.ignore;
    return written;
}

/// What is kept of an object: a row of frames would need more than one box of each to be at hand.
struct ObjectBoxes {
    std::vector<Written> boxes;
    std::map<std::string, int> votes;  ///< for its class

    std::map<std::string, int>::const_iterator winner() const {
        return std::max_element(votes.begin(), votes.end(),
                                [](const auto& a, const auto& b) { return a.second < b.second; });
    }
    std::string className() const { return winner()->first.empty() ? "object" : winner()->first; }
    int otherClass() const { return static_cast<int>(boxes.size()) - winner()->second; }
};

struct Gathered {
    std::map<int, ObjectBoxes> tracks;
    int frames = 1;  ///< that the task has
};

Gathered gather(const LabelStream& labels) {
    Gathered gathered;
    gathered.frames = std::max(1, labels.about.frame_count.value_or(0));
    labels.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
        gathered.frames = std::max(gathered.frames, frame + 1);
        for (const LabelBox& record : records) {
            if (!record.id) continue;
            ObjectBoxes& object = gathered.tracks[*record.id];
            ++object.votes[record.object_class];
            object.boxes.push_back(writtenOf(record));
        }
    });
    return gathered;
}

/// Whether the boxes between two keyframes are what CVAT makes of the keyframes.
bool interpolates(const std::vector<Written>& boxes, std::size_t from, std::size_t to) {
    const Written& a = boxes[from];
    const Written& b = boxes[to];
    const double turn = std::remainder(b.degrees - a.degrees, 360.0);
    for (std::size_t k = from + 1; k < to; ++k) {
        const double t = double(boxes[k].frame - a.frame) / (b.frame - a.frame);
        if (boxes[k].occlusion != a.occlusion || boxes[k].ignore != a.ignore) return false;
        for (std::size_t i = 0; i < 4; ++i) {
            if (std::abs(a.edges[i] + (b.edges[i] - a.edges[i]) * t - boxes[k].edges[i]) > kTolerance) return false;
        }
        if (std::abs(std::remainder(a.degrees + turn * t - boxes[k].degrees, 360.0)) > kTolerance) return false;
    }
    return true;
}

/// Keeps few keyframes in a stretch [first, last] without gaps: from each, as far as one bound by doubling reaches.
void chooseKeyframes(std::vector<Written>& boxes, std::size_t first, std::size_t last) {
    for (std::size_t k = first; k <= last; ++k) boxes[k].keyframe = false;
    boxes[first].keyframe = boxes[last].keyframe = true;
    std::size_t from = first;
    while (from < last) {
        std::size_t good = from + 1;
        std::size_t step = 2;
        while (from + step <= last && interpolates(boxes, from, from + step)) {
            good = from + step;
            step *= 2;
        }
        std::size_t bad = std::min(from + step, last + 1);
        while (good + 1 < bad) {
            const std::size_t middle = good + (bad - good) / 2;
            (interpolates(boxes, from, middle) ? good : bad) = middle;
        }
        boxes[good].keyframe = true;
        from = good;
    }
}

std::string boxText(const Written& box, bool outside) {
    std::string text = "    <box frame=\"" + std::to_string(box.frame) + "\" keyframe=\"" + (box.keyframe ? "1" : "0") +
                       "\" outside=\"" + (outside ? "1" : "0") + "\" occluded=\"" +
                       (box.occlusion == Occlusion::none ? "0" : "1") + "\"";
    const char* names[] = {" xtl=\"", " ytl=\"", " xbr=\"", " ybr=\""};
    for (std::size_t i = 0; i < 4; ++i) text += names[i] + fixedText(box.edges[i], kCvatDecimals) + "\"";
    if (box.degrees != 0) text += " rotation=\"" + fixedText(box.degrees, kCvatDecimals) + "\"";
    text += std::string(" z_order=\"0\">\n      <attribute name=\"") + cvat::kIgnoreAttribute + "\">" +
            (box.ignore ? "true" : "false") + "</attribute>\n      <attribute name=\"" + cvat::kOcclusionAttribute +
            "\">" + (box.occlusion == Occlusion::fully ? "fully" : "partly") + "</attribute>\n    </box>\n";
    return text;
}

/// Writes the boxes of a track, of which there may be a million; answers how many are keyframes.
int writeTrack(AtomicFileWriter& file, std::vector<Written> boxes, FrameIndex stop) {
    std::size_t begin = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        if (k + 1 < boxes.size() && boxes[k + 1].frame == boxes[k].frame + 1) continue;
        chooseKeyframes(boxes, begin, k);
        begin = k + 1;
    }
    int keyframes = 0;
    for (std::size_t k = 0; k < boxes.size(); ++k) {
        file.write(boxText(boxes[k], false));
        keyframes += boxes[k].keyframe;
        const bool gap = k + 1 == boxes.size() || boxes[k + 1].frame != boxes[k].frame + 1;
        if (!gap || boxes[k].frame >= stop) continue;
        Written end = boxes[k];
        ++end.frame;
        end.keyframe = true;
        file.write(boxText(end, true));
        ++keyframes;
    }
    return keyframes;
}

std::string metaText(int frames, const std::optional<cv::Size>& image_size, const std::set<std::string>& classes,
                     const std::string& name) {
    std::string text = "  <meta>\n    <task>\n      <name>" + markupEscaped(name) + "</name>\n      <size>" +
                       std::to_string(frames) +
                       "</size>\n      <mode>interpolation</mode>\n"
                       "      <start_frame>0</start_frame>\n      <stop_frame>" +
                       std::to_string(frames - 1) + "</stop_frame>\n      <labels>\n";
    for (const std::string& object_class : classes) {
        text += "        <label>\n          <name>" + markupEscaped(object_class) +
                "</name>\n          <attributes>\n"
                "            <attribute><name>" +
                cvat::kIgnoreAttribute +
                "</name><mutable>True</mutable><input_type>checkbox</input_type><default_value>false</default_value>"
                "<values>false\ntrue</values></attribute>\n            <attribute><name>" +
                cvat::kOcclusionAttribute +
                "</name><mutable>True</mutable><input_type>select</input_type><default_value>partly</default_value>"
                "<values>partly\nfully</values></attribute>\n          </attributes>\n        </label>\n";
    }
    text += "      </labels>\n";
    if (image_size) {
        text += "      <original_size>\n        <width>" + std::to_string(image_size->width) +
                "</width>\n        <height>" + std::to_string(image_size->height) +
                "</height>\n      </original_size>\n";
    }
    return text + "    </task>\n  </meta>\n";
}

LabelFormat described() {
    LabelFormat format;
    format.info = {"cvat", "CVAT for video 1.1", {"xml"}, false, true, true, {}};
    format.info.carries = {.rotation = true, .id = true, .object_class = true, .occlusion = true, .ignore = true};
    format.needs_id = true;
    format.read = readCvat;
    format.write_frames = writeCvat;
    format.fits = [](const FileHead& head) {
        return head.text.find("<annotations") != std::string::npos && head.text.find('<') < 200;
    };
    return format;
}

}  // namespace

void writeCvat(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions& options,
               ExportReport& report) {
    const Gathered gathered = gather(labels);
    std::set<std::string> classes;
    int other_class = 0, keyframes = 0;
    for (const auto& [id, track] : gathered.tracks) {
        classes.insert(track.className());
        other_class += track.otherClass();
    }
    classes.insert(labels.about.classes.begin(), labels.about.classes.end());
    classes.erase("");
    AtomicFileWriter file(path);
    file.write("<?xml version=\"1.0\" encoding=\"utf-8\"?>\n<annotations>\n  <version>1.1</version>\n" +
               metaText(gathered.frames, labels.about.image_size, classes, options.sequence));
    for (const auto& [id, track] : gathered.tracks) {
        file.write("  <track id=\"" + std::to_string(id) + "\" label=\"" + markupEscaped(track.className()) +
                   "\" source=\"manual\">\n");
        keyframes += writeTrack(file, track.boxes, gathered.frames - 1);
        file.write("  </track>\n");
    }
    file.write("</annotations>\n");
    file.finish();
    report.files.push_back(path);
    report.add(LossKind::class_name, other_class, "have another class than most of their track, which took that one");
    report.notes.push_back(counted(keyframes, "keyframe", "keyframes") + " reproduce all boxes within 0.02 px");
    report.notes.push_back("CVAT takes them into a task that has these labels with the attributes " +
                           std::string(cvat::kIgnoreAttribute) + " and " + cvat::kOcclusionAttribute +
                           "; the file's head describes both");
}

LabelFormat cvatFormat() {
    return described();
}

}  // namespace eyrie

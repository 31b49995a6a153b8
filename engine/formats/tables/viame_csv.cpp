#include <algorithm>
#include <cmath>
#include <set>

#include "core/geometry/angle.h"
#include "formats/format_functions.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"
#include "io/video/image_sequence.h"

/// VIAME CSV, as DIVE writes it too: lines that begin with "#" are comments or metadata; pixels and frames from 0.
///   id, image or time, frame, left, top, right, bottom, confidence, length (-1), [class, score]…, then attributes:
///   (atr) key value · (trk-atr) key value · (note) text · (kp) name x y · (poly) x y … · (hole) …
/// DIVE's attribute "rotation" turns the bounds about their centre, in radians; in its code positive is clockwise on
/// screen, whatever its text says. `occluded` and `ignore` are attributes of ours. Confidence and length may be empty.
/// Rows that cannot be taken are left out one by one, as DIVE reads on, too.
namespace eyrie {
namespace {

constexpr double kLeastRotation = 0.001;  ///< smaller ones are not written
constexpr std::size_t kClassField = 9;

/// "(atr) key value" → key and value; false for anything else.
bool viameAttributeIn(std::string_view text, std::string_view& key, std::string_view& value) {
    constexpr std::string_view kMark = "(atr)";
    if (!text.starts_with(kMark)) return false;
    text = trimmed(text.substr(kMark.size()));
    const std::size_t blank = text.find(' ');
    key = text.substr(0, blank);
    value = blank == std::string_view::npos ? std::string_view() : trimmed(text.substr(blank));
    return true;
}

void takeViameAttribute(const TextLine& line, std::size_t field, LabelBox& record, int& passed_over) {
    std::string_view key, value;
    if (!viameAttributeIn(line.text(field), key, value)) {
        ++passed_over;
        return;
    }
    if (key == "rotation") {
        const std::optional<double> turn = parseReal(value);
        if (!turn || std::abs(*turn) > 1000) line.fail(field, "the rotation is not an angle in radians");
        record.box.heading = wrapPi(*turn);
    } else if (key == "occluded") {
        record.occlusion = value == "fully"                       ? Occlusion::fully
                           : value == "partly" || value == "true" ? Occlusion::partly
                                                                  : Occlusion::none;
    } else if (key == "ignore") {
        record.ignore = value == "true";
    } else {
        ++passed_over;
    }
}

LabelBox viameBoxOf(const TextLine& line, int& passed_over) {
    if (line.size() < 9) {
        line.fail(0, std::to_string(line.size()) +
                         " columns, expected 9 or more: id,image,frame,left,top,right,bottom,confidence,length");
    }
    LabelBox record;
    record.id = line.identity(0);
    record.frame = line.frame(2, 0);
    record.box = boxByCorners(line, 3, 0);
    const double confidence = line.text(7).empty() ? -1 : line.number(7, "confidence");
    record.score = confidence < 0 ? 1 : confidence;  // −1 where nobody said
    if (!line.text(8).empty()) line.number(8, "length");
    double surest = -1;
    for (std::size_t field = kClassField; field < line.size(); ++field) {
        if (line.text(field).empty()) continue;
        if (line.text(field).front() == '(') {
            takeViameAttribute(line, field, record, passed_over);
            continue;
        }
        const std::string name = withoutFormulaGuard(line.word(field, "class"));
        const double score = line.number(++field, "score of the class");
        if (score <= surest) continue;
        surest = score;
        record.object_class = name;
    }
    return record;
}

void readMetadata(const std::string& text, LabelFile& labels) {
    std::size_t rate = text.find("fps:");
    if (rate == std::string::npos) rate = text.find("Fps:");  // older DIVE
    if (rate == std::string::npos) return;
    const std::size_t end = text.find_first_of(",\r", rate);
    const auto value =
        parseReal(std::string_view(text).substr(rate + 4, end == std::string::npos ? end : end - rate - 4));
    if (value && *value > 0) labels.frame_rate_hz = *value;
}

/// A row that could be taken.
struct Row {
    TextLine line;
    LabelBox record;
    std::string image;
};

/// Whether images are told apart by their names alone: some frame number has several.
bool framesAreMixed(const std::vector<Row>& rows) {
    std::map<FrameIndex, const std::string*> name_of_frame;
    for (const Row& row : rows) {
        if (row.image.empty()) continue;
        const auto [known, is_new] = name_of_frame.emplace(row.record.frame, &row.image);
        if (!is_new && *known->second != row.image) return true;
    }
    return false;
}

/// Frames by the names of the images, in natural order.
void numberByImages(std::vector<Row>& rows, LeftOutRows& left_out) {
    const auto before = [](const std::string& a, const std::string& b) {
        return naturalOrder(a, b) || (!naturalOrder(b, a) && a < b);
    };
    std::map<std::string, FrameIndex, decltype(before)> frames(before);
    std::erase_if(rows, [&](const Row& row) {
        if (!row.image.empty()) {
            frames.emplace(row.image, 0);
            return false;
        }
        try {
            row.line.fail(1, "names no image, and the numbers of frames are not to be trusted here");
        } catch (const Error& reason) {
            left_out.add(reason);
        }
        return true;
    });
    FrameIndex next = 0;
    for (auto& [name, frame] : frames) frame = next++;
    for (Row& row : rows) row.record.frame = frames.at(row.image);
}

std::vector<Row> readRows(const std::filesystem::path& path, LabelFile& labels, LeftOutRows& left_out) {
    std::vector<Row> rows;
    int number = 0, passed_over = 0;
    for (const std::string& text : readTextLines(path)) {
        ++number;
        const std::size_t first = text.find_first_not_of(" \t\r");
        if (first == std::string::npos) continue;
        if (text[first] == '#') {
            readMetadata(text, labels);
            continue;
        }
        try {
            TextLine line(path, number, text);
            LabelBox record = viameBoxOf(line, passed_over);
            std::string image = withoutFormulaGuard(line.word(1, "image"));
            rows.push_back({std::move(line), std::move(record), std::move(image)});
        } catch (const Error& reason) {
            left_out.add(reason);
        }
    }
    if (passed_over > 0) {
        labels.notes.push_back(counted(passed_over, "entry", "entries") +
                               " of other kinds (key points, polygons, notes, attributes) were skipped");
    }
    return rows;
}

LabelFile readViame(const std::filesystem::path& path, const ImportOptions&) {
    LabelFile labels;
    LeftOutRows left_out;
    std::vector<Row> rows = readRows(path, labels, left_out);
    if (framesAreMixed(rows)) {
        numberByImages(rows, left_out);
        labels.notes.emplace_back(
            "the same frame number stands for several images, so frames are the images in the order of their names");
    }
    std::map<int, std::string> last_class;
    std::set<std::pair<FrameIndex, int>> taken;
    for (Row& row : rows) {
        LabelBox& record = row.record;
        const int id = *record.id;
        try {
            if (!record.ignore && !taken.insert({record.frame, id}).second) {
                row.line.fail(0, "id " + std::to_string(id) + " has a box in this frame already");
            }
        } catch (const Error& reason) {
            left_out.add(reason);
            continue;
        }
        if (!row.image.empty()) labels.image_names[record.frame] = row.image;
        if (!record.object_class.empty()) last_class[id] = record.object_class;
        labels.boxes[record.frame].push_back(std::move(record));
    }
    // The classes of a track's last row count for the whole track.
    for (auto& [frame, records] : labels.boxes) {
        for (LabelBox& record : records) {
            const auto found = last_class.find(*record.id);
            if (found != last_class.end()) record.object_class = found->second;
        }
    }
    left_out.tell(labels);
    return labels;
}

void writeViame(const LabelFile& labels, const std::filesystem::path& path, const ExportOptions&,
                ExportReport& report) {
    std::string text =
        "# 1: Detection or Track-id,2: Video or Image Identifier,3: Unique Frame Identifier,4-7: Img-bbox(TL_x,TL_y,"
        "BR_x,BR_y),8: Detection or Length Confidence,9: Target Length (0 or -1 if invalid),10-11+: Repeated Species,"
        "Confidence Pairs or Attributes\n";
    // DIVE wrote it small and looked for it capital for a while; it takes what it knows.
    if (labels.frame_rate_hz)
        for (const char* key : {"fps", "Fps"})
            text += std::string("# metadata,") + key + ": " + shortestText(*labels.frame_rate_hz) + '\n';
    AtomicFileWriter file(path);
    file.write(text);
    for (const auto& [id, track] : boxesById(labels.boxes)) {
        for (const LabelBox* record : track) {
            const OrientedBox& box = record->box;
            const double turn = wrapPi(box.heading);
            const BoxEdges e = edgesOf({box.centre, box.length, box.width, 0}, 0);
            const auto name = labels.image_names.find(record->frame);
            text = std::to_string(id) + ',' +
                   (name == labels.image_names.end() ? numberedName(record->frame) : csvField(name->second)) + ',' +
                   std::to_string(record->frame);
            for (const double value : {e.left, e.top, e.left + e.width, e.top + e.height, record->score}) {
                text += ',' + fixedText(value, 4);
            }
            text += ",-1";
            if (!record->object_class.empty()) {
                text += ',' + csvField(record->object_class) + ',' + fixedText(record->score, 4);
            }
            if (std::abs(turn) > kLeastRotation) text += ",(atr) rotation " + fixedText(turn, 6);
            if (record->occlusion == Occlusion::partly) text += ",(atr) occluded partly";
            if (record->occlusion == Occlusion::fully) text += ",(atr) occluded fully";
            if (record->ignore) text += ",(atr) ignore true";
            file.write(text + '\n');
        }
    }
    file.finish();
    report.files.push_back(path);
    if (report.boxes > 0) {
        report.notes.push_back("rotations are DIVE's attribute \"rotation\": other readers see the unrotated boxes");
    }
}

bool looksLikeRow(const FileHead& head, const std::string& line) {
    if (line[line.find_first_not_of(" \t")] == '#') return false;
    try {
        const TextLine fields(head.path, 1, line);
        if (fields.size() < 9 || !parseWhole(fields.text(0))) return false;
        for (std::size_t field = 2; field < 9; ++field) {
            const bool may_be_empty = field > 6;
            if (!(may_be_empty && fields.text(field).empty()) && !parseReal(fields.text(field))) return false;
        }
        // Without a head, numbers alone could be a table of anything.
        return head.lines.front().starts_with('#') || !parseReal(fields.text(1));
    } catch (const Error&) {
        return false;
    }
}

}  // namespace

LabelFormat viameFormat() {
    LabelFormat format;
    format.info = {"viame", "VIAME CSV (DIVE)", {"csv"}, false, true, true, {}};
    format.info.carries = {
        .rotation = true, .id = true, .object_class = true, .occlusion = true, .ignore = true, .score = true};
    format.needs_id = true;
    format.read = readViame;
    format.write = writeViame;
    format.fits = [](const FileHead& head) {
        return !head.folder && std::any_of(head.lines.begin(), head.lines.end(),
                                           [&](const std::string& line) { return looksLikeRow(head, line); });
    };
    return format;
}

}  // namespace eyrie

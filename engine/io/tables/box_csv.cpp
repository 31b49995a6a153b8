#include "io/tables/box_csv.h"

#include <algorithm>
#include <limits>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "core/text.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {

namespace {

constexpr int kDecimals = 4;
constexpr int kFineDecimals = 6;

std::string headingText(double radians) {
    const std::string degrees = fixedText(degreesFromRadians(radians), kDecimals);
    return degrees == "360" ? "0" : degrees;
}

/// The columns that both tables begin with, up to the class.
std::string beginningOf(FrameIndex frame, const BoxRecord& record) {
    const OrientedBox& box = record.box;
    return std::to_string(frame) + ',' + (record.id ? std::to_string(*record.id) : "") + ',' +
           fixedText(box.centre.x, kDecimals) + ',' + fixedText(box.centre.y, kDecimals) + ',' +
           fixedText(box.length, kDecimals) + ',' + fixedText(box.width, kDecimals) + ',' + headingText(box.heading) +
           ',' + csvField(record.object_class);
}

bool parseIgnore(const CsvReader& csv) {
    const std::string text = csv.text("ignore");
    if (text.empty() || text == "false" || text == "False") return false;
    if (text == "true" || text == "True") return true;
    const int value = parseWhole(text).value_or(-1);
    if (value != 0 && value != 1) csv.refuse("ignore", "0 or 1");
    return value == 1;
}

/// `boxes` must outlive the result.
VisitBoxes oneByOne(const BoxesByFrame& boxes) {
    return [&boxes](const BoxVisitor& visitor) {
        for (const auto& [frame, records] : boxes) {
            for (const BoxRecord& record : records) visitor(frame, record);
        }
    };
}

double sizeIn(const CsvReader& csv, const char* column) {
    const double size = csv.real(column);
    if (size < 0) csv.refuse(column, "a length in px, 0 or more");
    return size;
}

}  // namespace

BoxesByFrame readBoxCsv(const std::filesystem::path& path) {
    CsvReader csv(path, {"frame", "x", "y", "length", "width", "heading"});
    BoxesByFrame boxes;
    std::map<std::string, std::vector<std::pair<FrameIndex, std::size_t>>> named;
    int highest_id = -1;
    while (csv.next()) {
        BoxRecord record;
        record.frame = csv.whole("frame");
        if (record.frame < 0) csv.refuse("frame", "a whole number, 0 or more");
        record.box.centre = {csv.real("x"), csv.real("y")};
        record.box.length = sizeIn(csv, "length");
        record.box.width = sizeIn(csv, "width");
        record.box.heading = wrapPi(radiansFromDegrees(csv.real("heading")));
        record.object_class = csv.text("class");
        record.ignore = parseIgnore(csv);
        record.score = csv.real("score", 1.0);
        record.velocity = {csv.real("vx", 0.0), csv.real("vy", 0.0)};
        record.origin = stateOriginOf(csv.text("origin"));

        const std::string id = csv.text("id");
        std::vector<BoxRecord>& in_frame = boxes[record.frame];
        if (const std::optional<int> number = parseWhole(id)) {
            if (*number < 0) csv.refuse("id", "a whole number, 0 or more, or nothing");
            record.id = number;
            highest_id = std::max(highest_id, *number);
        } else if (!id.empty()) {
            if (!record.ignore) csv.refuse("id", "a whole number or nothing");
            named[id].emplace_back(record.frame, in_frame.size());
        }
        in_frame.push_back(std::move(record));
    }
    if (!named.empty() && highest_id > std::numeric_limits<int>::max() - static_cast<int>(named.size())) {
        throw Error(ErrorKind::input, displayText(path) + ": id " + std::to_string(highest_id) +
                                          " leaves no number for the areas with names; use smaller ids");
    }
    for (const auto& [name, places] : named) {
        ++highest_id;
        for (const auto& [frame, place] : places) boxes[frame][place].id = highest_id;
    }
    return boxes;
}

void writeResultCsv(const std::filesystem::path& path, const BoxesByFrame& boxes) {
    writeResultCsv(path, oneByOne(boxes));
}

void writeGroundTruthCsv(const std::filesystem::path& path, const BoxesByFrame& boxes) {
    writeGroundTruthCsv(path, oneByOne(boxes));
}

void writeResultCsv(const std::filesystem::path& path, const VisitBoxes& boxes) {
    AtomicFileWriter file(path);
    file.write("frame,id,x,y,length,width,heading,class,score,vx,vy,origin\n");
    boxes([&](FrameIndex frame, const BoxRecord& record) {
        file.write(beginningOf(frame, record) + ',' + fixedText(record.score, kFineDecimals) + ',' +
                   fixedText(record.velocity.x, kFineDecimals) + ',' + fixedText(record.velocity.y, kFineDecimals) +
                   ',' + originText(record) + '\n');
    });
    file.finish();
}

void writeGroundTruthCsv(const std::filesystem::path& path, const VisitBoxes& boxes) {
    AtomicFileWriter file(path);
    file.write("frame,id,x,y,length,width,heading,class,ignore\n");
    boxes([&](FrameIndex frame, const BoxRecord& record) {
        file.write(beginningOf(frame, record) + (record.ignore ? ",1\n" : ",0\n"));
    });
    file.finish();
}

}  // namespace eyrie

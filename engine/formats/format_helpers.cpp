#include <algorithm>

#include "core/error.h"
#include "formats/format_functions.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr int kMostImages = 1'000'000;  ///< half a day of video
constexpr std::size_t kReasonsTold = 5;

}  // namespace

OrientedBox boxByEdges(const TextLine& line, std::size_t first, double first_pixel_edge) {
    return boxFromEdges({line.pixels(first, "left edge"), line.pixels(first + 1, "top edge"),
                         line.size(first + 2, "width"), line.size(first + 3, "height")},
                        first_pixel_edge);
}

OrientedBox boxByCorners(const TextLine& line, std::size_t first, double first_pixel_edge) {
    const double left = line.pixels(first, "left edge");
    const double top = line.pixels(first + 1, "top edge");
    const double right = line.pixels(first + 2, "right edge");
    const double bottom = line.pixels(first + 3, "bottom edge");
    if (right < left) line.fail(first + 2, "the right edge is left of the left one");
    if (bottom < top) line.fail(first + 3, "the bottom edge is above the top one");
    return boxFromEdges({left, top, right - left, bottom - top}, first_pixel_edge);
}

std::map<int, std::vector<const LabelBox*>> boxesById(const LabelBoxes& boxes) {
    std::map<int, std::vector<const LabelBox*>> tracks;
    for (const auto& [frame, records] : boxes) {
        for (const LabelBox& record : records) {
            if (record.id) tracks[*record.id].push_back(&record);
        }
    }
    return tracks;
}

void forEachLine(const std::filesystem::path& file, char separator, char comment,
                 const std::function<void(const TextLine&)>& take) {
    int number = 0;
    for (const std::string& text : readTextLines(file)) {
        ++number;
        const std::size_t first = text.find_first_not_of(" \t\r");
        if (first == std::string::npos || text[first] == comment) continue;
        take(TextLine(file, number, text, separator));
    }
}

std::vector<double> leadingNumbers(const std::string& line, char separator) {
    std::vector<double> numbers;
    std::size_t begin = 0;
    while (begin <= line.size()) {
        if (separator == ' ') begin = std::min(line.find_first_not_of(" \t\r", begin), line.size());
        const std::size_t end =
            std::min(separator == ' ' ? line.find_first_of(" \t\r", begin) : line.find(separator, begin), line.size());
        std::string field = line.substr(begin, end - begin);
        if (!field.empty() && field.back() == '\r') field.pop_back();
        const std::optional<double> number = parseReal(field);
        if (!number) break;
        numbers.push_back(*number);
        begin = end + 1;
    }
    return numbers;
}

std::string numberedName(FrameIndex frame) {
    const std::string digits = std::to_string(frame);
    return std::string(digits.size() < 6 ? 6 - digits.size() : 0, '0') + digits;
}

int imagesToWrite(const LabelFile& labels, const std::filesystem::path& path) {
    const int frames = framesToWrite(labels);
    if (frames <= kMostImages) return frames;
    throw Error(ErrorKind::parameter, path.string() + ": would list " + std::to_string(frames) +
                                          " images; is the last frame meant? Shift the frames (--shift)");
}

cv::Size neededSize(const std::optional<cv::Size>& size, const std::filesystem::path& path, const char* format) {
    if (size && size->width > 0 && size->height > 0) return *size;
    throw Error(ErrorKind::parameter,
                path.string() + ": " + format + " is relative to the image; say its size (--size WIDTHxHEIGHT)");
}

int framesToWrite(const LabelFile& labels) {
    const int needed = labels.boxes.empty() ? 0 : labels.boxes.rbegin()->first + 1;
    return std::max(labels.frame_count.value_or(0), needed);
}

void LeftOutRows::add(const Error& reason) {
    if (reason.kind() != ErrorKind::input) throw reason;
    if (++count_ <= static_cast<int>(kReasonsTold)) reasons_.emplace_back(reason.what());
}

void LeftOutRows::tell(LabelFile& labels) const {
    if (count_ == 0) return;
    if (labels.boxes.empty()) throw Error(ErrorKind::input, reasons_.front());
    for (const std::string& reason : reasons_) labels.notes.push_back("left out: " + reason);
    const int more = count_ - static_cast<int>(reasons_.size());
    if (more > 0) labels.notes.push_back("left out: " + counted(more, "row", "rows") + " more for such reasons");
}

std::string counted(int count, const char* one, const char* many) {
    return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string inQuotes(std::string_view text) {
    std::string quoted(1, '"');
    quoted += text.substr(0, 40);
    quoted += '"';
    return quoted;
}

}  // namespace eyrie

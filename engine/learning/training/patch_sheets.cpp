#include <algorithm>
#include <charconv>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "learning/models/window.h"
#include "learning/training/sample_set.h"

namespace eyrie {
namespace {

namespace fs = std::filesystem;

constexpr int kCellWidth = kWindowHeight;  // the axis is horizontal in the sheets
constexpr int kCellHeight = kWindowWidth;
constexpr double kLargestSize = 1e5;  // px
constexpr double kInCell = 0.95;      // share of a vehicle that has to be in its cell to be cut out of it

cv::Mat readSheet(const fs::path& path) {
    std::error_code ignored;
    if (!fs::is_regular_file(path, ignored)) {
        throw Error(ErrorKind::input, path.string() +
                                          ": no such sheet of samples; a folder with pos.png, neg.png and "
                                          "patches.csv is needed");
    }
    cv::Mat sheet;
    try {
        sheet = cv::imread(path.string(), cv::IMREAD_GRAYSCALE);
    } catch (const cv::Exception& error) {
        throw Error(ErrorKind::input, path.string() + ": cannot be read as an image: " + error.err);
    }
    if (sheet.empty()) throw Error(ErrorKind::input, path.string() + ": cannot be read as an image");
    if (sheet.cols % kCellWidth != 0 || sheet.rows % kCellHeight != 0) {
        throw Error(ErrorKind::input, path.string() + ": " + std::to_string(sheet.cols) + "×" +
                                          std::to_string(sheet.rows) +
                                          " px is not a sheet of cells 32 wide and 16 high");
    }
    return sheet;
}

std::vector<std::string> fieldsOf(std::string line) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    std::vector<std::string> fields(1);
    for (const char c : line) {
        if (c == ',') {
            fields.emplace_back();
        } else {
            fields.back() += c;
        }
    }
    return fields;
}

/// The table beside the sheets, a line at a time.
class PatchTable {
 public:
    explicit PatchTable(const fs::path& path) : path_(path), file_(path) {
        std::string header;
        if (!file_ || !std::getline(file_, header)) {
            throw Error(ErrorKind::input, path.string() + ": the table of the samples is missing or empty");
        }
        if (header.starts_with("\xEF\xBB\xBF")) header.erase(0, 3);
        names_ = fieldsOf(header);
        for (const char* name : {"kind", "row", "column", "group", "duplicate"}) indexOf(name);
    }

    bool next() {
        std::string line;
        do {
            ++line_;
            if (!std::getline(file_, line)) return false;
        } while (line.empty() || line == "\r");
        fields_ = fieldsOf(line);
        if (fields_.size() != names_.size()) {
            fail(std::to_string(fields_.size()) + " fields, but the header has " + std::to_string(names_.size()));
        }
        return true;
    }

    bool has(const char* name) const { return std::find(names_.begin(), names_.end(), name) != names_.end(); }

    const std::string& text(const char* name) const { return fields_[indexOf(name)]; }

    int number(const char* name) const { return valueOf<int>(name, "not a whole number"); }

    double size(const char* name) const {
        const char* const wrong = "not a size";
        const double value = valueOf<double>(name, wrong);
        if (!(value > 0 && value < kLargestSize)) failAt(name, wrong);
        return value;
    }

    [[noreturn]] void fail(const std::string& why) const {
        throw Error(ErrorKind::input, path_.string() + ", line " + std::to_string(line_) + ": " + why);
    }

 private:
    template <class Value>
    Value valueOf(const char* name, const char* wrong) const {
        const std::string& field = text(name);
        Value value{};
        const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
        if (error != std::errc() || end != field.data() + field.size()) failAt(name, wrong);
        return value;
    }

    [[noreturn]] void failAt(const char* name, const char* why) const {
        fail(std::string(name) + " is \"" + text(name).substr(0, 40) + "\", " + why);
    }

    std::size_t indexOf(const char* name) const {
        const auto at = std::find(names_.begin(), names_.end(), name);
        if (at == names_.end()) {
            throw Error(ErrorKind::input, path_.string() + ": the column \"" + name + "\" is missing");
        }
        return static_cast<std::size_t>(at - names_.begin());
    }

    fs::path path_;
    std::ifstream file_;
    std::vector<std::string> names_;
    std::vector<std::string> fields_;
    int line_ = 1;
};

/// A vehicle of that size in the middle of an upright cell.
OrientedBox inMiddle(double length, double width) {
    return {{(kWindowWidth - 1) / 2.0, (kWindowHeight - 1) / 2.0}, length, width, -kPi / 2};
}

}  // namespace

SampleSet readPatchSheets(const fs::path& folder, const WindowFit& fit) {
    PatchTable table(folder / "patches.csv");
    const cv::Mat vehicles = readSheet(folder / "pos.png");
    const cv::Mat others = readSheet(folder / "neg.png");
    fs::path named = fs::absolute(folder).lexically_normal();
    if (!named.has_filename()) named = named.parent_path();
    const bool cut_again = fit != WindowFit{} && table.has("length_px") && table.has("width_px");
    SampleSet samples;
    while (table.next()) {
        Sample sample;
        const std::string& kind = table.text("kind");
        if (kind != "pos" && kind != "neg") table.fail("kind is \"" + kind.substr(0, 40) + "\", expected pos or neg");
        sample.vehicle = kind == "pos";
        sample.source = named.filename().string();
        sample.group = table.text("group");
        sample.duplicate = table.number("duplicate") != 0;
        const int row = table.number("row");
        const int column = table.number("column");
        const cv::Mat& sheet = sample.vehicle ? vehicles : others;
        if (row < 0 || column < 0 || row >= sheet.rows / kCellHeight || column >= sheet.cols / kCellWidth) {
            table.fail("row " + std::to_string(row) + ", column " + std::to_string(column) +
                       " lies outside of its sheet");
        }
        const cv::Rect cell(column * kCellWidth, row * kCellHeight, kCellWidth, kCellHeight);
        cv::rotate(sheet(cell), sample.window, cv::ROTATE_90_COUNTERCLOCKWISE);
        if (cut_again) {
            const OrientedBox box = sample.vehicle ? inMiddle(table.size("length_px"), table.size("width_px"))
                                                   : inMiddle(kCarLengthInWindow, kCarWidthInWindow);
            if (areaInImage(box, sample.window.size()) < kInCell * box.area()) continue;
            sample.window = cutWindow(sample.window, box, fit);
        }
        samples.push_back(std::move(sample));
    }
    if (samples.empty()) throw Error(ErrorKind::input, (folder / "patches.csv").string() + ": lists no sample");
    return samples;
}

}  // namespace eyrie

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/geometry/angle.h"
#include "formats/format_functions.h"
#include "formats/tables/column_template.h"
#include "io/atomic_file.h"
#include "io/tables/csv_reader.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

const std::string kNumberedClass = "class ";

/// Fields of a line by their meaning, to the end of one box.
class FieldsOfBox {
 public:
    explicit FieldsOfBox(const TextLine& line) : line_(line) { fields_.fill(kNone); }
    void set(Column column, std::size_t field) { fields_[static_cast<std::size_t>(column)] = field; }
    bool has(Column column) const { return field(column) != kNone; }
    std::size_t field(Column column) const { return fields_[static_cast<std::size_t>(column)]; }
    double pixels(Column column, const char* name) const { return line_.pixels(field(column), name); }

    /// Low edge and extent along one axis from whichever two columns tell them.
    std::pair<double, double> extent(Column low, Column high, Column centre, Column size) const {
        const double length = has(size) ? line_.size(field(size), "size") : 0;
        double low_edge = 0, width = length;
        if (has(low)) {
            low_edge = pixels(low, "low edge");
            if (has(high)) width = pixels(high, "high edge") - low_edge;
            if (has(centre)) width = 2 * (pixels(centre, "centre") - low_edge);
        } else if (has(high)) {
            if (has(centre)) width = 2 * (pixels(high, "high edge") - pixels(centre, "centre"));
            low_edge = pixels(high, "high edge") - width;
        } else {
            low_edge = pixels(centre, "centre") - length / 2;
        }
        if (width < 0) line_.fail(field(has(high) ? high : centre), "the box has a negative size");
        return {low_edge, width};
    }

 private:
    static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
    const TextLine& line_;
    std::array<std::size_t, static_cast<std::size_t>(Column::unused) + 1> fields_{};
};

bool flagIn(const TextLine& line, std::size_t field, const char* name) {
    if (line.text(field) == "true" || line.text(field) == "True") return true;
    if (line.text(field) == "false" || line.text(field) == "False" || line.text(field).empty()) return false;
    return line.number(field, name) != 0;
}

LabelBox boxOf(const TextLine& line, const FieldsOfBox& fields, double first_pixel_edge) {
    LabelBox record;
    const auto [left, width] = fields.extent(Column::left, Column::right, Column::centre_x, Column::width);
    const auto [top, height] = fields.extent(Column::top, Column::bottom, Column::centre_y, Column::height);
    record.box = boxFromEdges({left, top, width, height}, first_pixel_edge);
    const auto at = [&](Column column) { return fields.field(column); };
    if (fields.has(Column::heading)) {
        const double degrees = line.number(at(Column::heading), "heading in degrees");
        if (std::abs(degrees) > 1e6) line.fail(at(Column::heading), "the heading is not an angle in degrees");
        record.box.heading = wrapPi(radiansFromDegrees(degrees));
    }
    if (fields.has(Column::id) && !line.text(at(Column::id)).empty()) {
        const int id = line.integer(at(Column::id), "id");
        if (id >= 0) record.id = id;
    }
    if (fields.has(Column::class_name))
        record.object_class = withoutFormulaGuard(line.word(at(Column::class_name), "class"));
    if (fields.has(Column::class_number)) {
        record.object_class = kNumberedClass + std::to_string(line.integer(at(Column::class_number), "class number"));
    }
    if (fields.has(Column::score)) record.score = line.number(at(Column::score), "score");
    if (fields.has(Column::ignore)) record.ignore = flagIn(line, at(Column::ignore), "flag (1: ignored)");
    if (fields.has(Column::occluded)) {
        const int occluded = line.integer(at(Column::occluded), "occlusion, 0 to 2");
        if (occluded < 0 || occluded > 2) line.fail(at(Column::occluded), "the occlusion is not 0, 1 or 2");
        record.occlusion = static_cast<Occlusion>(occluded);
    }
    return record;
}

/// Reads lines of the described table one by one.
class TableReader {
 public:
    TableReader(const ColumnTemplate& columns, const ImportOptions& options)
        : columns_(columns),
          first_frame_(options.first_frame_number.value_or(0)),
          first_pixel_edge_(options.first_pixel_edge.value_or(0)) {}

    void take(const TextLine& line) {
        FieldsOfBox fields(line);
        for (std::size_t i = 0; i < columns_.once.size(); ++i) fields.set(columns_.once[i], i);
        const std::size_t fixed = columns_.once.size();
        if (line.size() < fixed) refuseSize(line);
        const FrameIndex frame = frameOf(line, fields);
        if (columns_.repeated.empty()) {
            if (line.size() != fixed) refuseSize(line);
            add(line, fields, frame);
            return;
        }
        std::size_t size = line.size();
        if (size > fixed && line.text(size - 1).empty()) --size;  // a separator at the end
        const std::size_t each = columns_.repeated.size();
        if ((size - fixed) % each != 0) refuseSize(line);
        const std::size_t boxes = (size - fixed) / each;
        if (fields.has(Column::count)) {
            const int told = line.integer(fields.field(Column::count), "number of boxes");
            if (told < 0 || static_cast<std::size_t>(told) != boxes) {
                line.fail(fields.field(Column::count),
                          std::to_string(told) + " boxes are announced and " + std::to_string(boxes) + " follow");
            }
        }
        for (std::size_t box = 0; box < boxes; ++box) {
            for (std::size_t i = 0; i < each; ++i) fields.set(columns_.repeated[i], fixed + box * each + i);
            add(line, fields, frame);
        }
    }
    LabelFile finish() {
        labels_.first_frame_number = first_frame_;
        return std::move(labels_);
    }
    LabelFile& labels() { return labels_; }

 private:
    [[noreturn]] void refuseSize(const TextLine& line) const {
        line.fail(0, std::to_string(line.size()) + " columns, expected " + std::to_string(columns_.once.size()) +
                         (columns_.repeated.empty()
                              ? ""
                              : " and then " + std::to_string(columns_.repeated.size()) + " for each box"));
    }
    FrameIndex frameOf(const TextLine& line, const FieldsOfBox& fields) {
        FrameIndex frame = 0;
        const std::string image =
            fields.has(Column::image) ? withoutFormulaGuard(line.word(fields.field(Column::image), "image")) : "";
        if (fields.has(Column::frame)) {
            frame = line.frame(fields.field(Column::frame), first_frame_);
        } else {
            frame = frame_of_image_.emplace(image, static_cast<FrameIndex>(frame_of_image_.size())).first->second;
        }
        if (!image.empty()) labels_.image_names[frame] = image;
        return frame;
    }
    void add(const TextLine& line, const FieldsOfBox& fields, FrameIndex frame) {
        LabelBox record = boxOf(line, fields, first_pixel_edge_);
        record.frame = frame;
        labels_.boxes[frame].push_back(std::move(record));
    }

    const ColumnTemplate& columns_;
    int first_frame_;
    double first_pixel_edge_;
    std::map<std::string, FrameIndex> frame_of_image_;
    LabelFile labels_;
};

LabelFile readColumns(const std::filesystem::path& path, const ImportOptions& options) {
    if (options.columns.empty()) {
        throw Error(ErrorKind::parameter,
                    "format columns needs to know them: --columns frame,id,cname,x1,y1,x2,y2 or the like");
    }
    const ColumnTemplate columns = parseColumns(options.columns);
    TableReader reader(columns, options);
    bool first = true;
    forEachLine(path, columns.separator, '#', [&](const TextLine& line) {
        bool digits = false;
        for (std::size_t field = 0; field < line.size(); ++field) {
            const std::string_view text = line.text(field);
            digits = digits || (!text.empty() && text.find_first_of("0123456789") == 0);
        }
        if (first && !digits) {
            reader.labels().notes.push_back("the first line holds no number and was taken for a heading");
        } else {
            reader.take(line);
        }
        first = false;
    });
    if (!columns.has(Column::frame)) {
        reader.labels().notes.push_back("frames are images in the order of the file");
    }
    return reader.finish();
}

/// Numbers for classes: "class 7" keeps its own, others take their place among all.
std::map<std::string, int> numbersOfClasses(const VisitFrames& frames) {
    std::map<std::string, int> numbers;
    frames([&](FrameIndex, const std::vector<LabelBox>& records) {
        for (const LabelBox& record : records) numbers[record.object_class] = 0;
    });
    int next = 0;
    std::set<int> taken;
    for (auto& [name, number] : numbers) {
        if (!name.starts_with(kNumberedClass)) continue;
        number = parseWhole(name.substr(kNumberedClass.size())).value_or(0);
        taken.insert(number);
    }
    for (auto& [name, number] : numbers) {
        if (name.starts_with(kNumberedClass)) continue;
        while (taken.contains(next)) ++next;
        number = next++;
    }
    return numbers;
}

class TableWriter {
 public:
    TableWriter(const LabelStream& labels, const ExportOptions& options)
        : labels_(labels),
          columns_(parseColumns(options.columns)),
          first_frame_(options.first_frame_number.value_or(0)),
          first_pixel_edge_(options.first_pixel_edge.value_or(0)),
          class_numbers_(columns_.has(Column::class_number) ? numbersOfClasses(labels.frames)
                                                            : std::map<std::string, int>()) {}

    void write(AtomicFileWriter& file) const {
        labels_.frames([&](FrameIndex frame, const std::vector<LabelBox>& records) {
            if (columns_.repeated.empty()) {
                for (const LabelBox& record : records) file.write(joined({&record}, frame));
            } else {
                std::vector<const LabelBox*> all;
                for (const LabelBox& record : records) all.push_back(&record);
                file.write(joined(all, frame));
            }
        });
    }
    const ColumnTemplate& columns() const { return columns_; }
    const std::map<std::string, int>& classNumbersUsed() const { return class_numbers_; }

 private:
    std::string joined(const std::vector<const LabelBox*>& records, FrameIndex frame) const {
        std::string line;
        const auto append = [&](const std::string& field) {
            if (!line.empty()) line += columns_.separator;
            line += field;
        };
        for (const Column column : columns_.once) append(fieldOf(column, *records.front(), frame, records.size()));
        for (const LabelBox* record : records) {
            for (const Column column : columns_.repeated) append(fieldOf(column, *record, frame, records.size()));
        }
        return line + '\n';
    }
    std::string word(const std::string& name) const {
        if (columns_.separator == ',') return csvField(name);
        std::string kept = formulaGuarded(name);
        std::replace(kept.begin(), kept.end(), columns_.separator, '_');
        return kept.empty() ? "_" : kept;
    }
    std::string fieldOf(Column column, const LabelBox& record, FrameIndex frame, std::size_t count) const {
        const OrientedBox& box = record.box;
        const bool headed = columns_.has(Column::heading);
        const BoxEdges e = edgesOf(headed ? OrientedBox{box.centre, box.length, box.width, 0} : box, first_pixel_edge_);
        const auto px = [](double value) { return fixedText(value, 4); };
        const auto& names = labels_.about.image_names;
        const auto named = names.find(frame);
        switch (column) {
            case Column::frame:
                return std::to_string(frame + first_frame_);
            case Column::image:
                return word(named == names.end() ? numberedName(frame) + ".png" : named->second);
            case Column::id:
                return std::to_string(record.id.value_or(-1));
            case Column::class_name:
                return word(record.object_class);
            case Column::class_number:
                return std::to_string(class_numbers_.at(record.object_class));
            case Column::left:
                return px(e.left);
            case Column::top:
                return px(e.top);
            case Column::right:
                return px(e.left + e.width);
            case Column::bottom:
                return px(e.top + e.height);
            case Column::centre_x:
                return px(e.left + e.width / 2);
            case Column::centre_y:
                return px(e.top + e.height / 2);
            case Column::width:
                return px(e.width);
            case Column::height:
                return px(e.height);
            case Column::heading:
                return px(degreesFromRadians(box.heading));
            case Column::score:
                return fixedText(record.score, 6);
            case Column::ignore:
                return record.ignore ? "1" : "0";
            case Column::occluded:
                return std::to_string(static_cast<int>(record.occlusion));
            case Column::count:
                return std::to_string(count);
            case Column::unused:
                break;
        }
        return "0";
    }

    const LabelStream& labels_;
    ColumnTemplate columns_;
    int first_frame_;
    double first_pixel_edge_;
    std::map<std::string, int> class_numbers_;
};

void writeColumns(const LabelStream& labels, const std::filesystem::path& path, const ExportOptions& options,
                  ExportReport& report) {
    if (options.columns.empty()) {
        throw Error(ErrorKind::parameter,
                    "format columns needs to know them: --columns frame,id,cname,x1,y1,x2,y2 or the like");
    }
    const TableWriter writer(labels, options);
    const ColumnTemplate& columns = writer.columns();
    AtomicFileWriter file(path);
    writer.write(file);
    file.finish();
    report.files.push_back(path);
    const std::map<LossKind, bool> carried{
        {LossKind::rotation, columns.has(Column::heading)},
        {LossKind::heading, columns.has(Column::heading)},
        {LossKind::id, columns.has(Column::id)},
        {LossKind::class_name, columns.has(Column::class_name) || columns.has(Column::class_number)},
        {LossKind::occlusion, columns.has(Column::occluded)},
        {LossKind::ignore, columns.has(Column::ignore)},
        {LossKind::score, columns.has(Column::score)}};
    std::erase_if(report.losses, [&](const ExportLoss& loss) {
        const auto found = carried.find(loss.kind);
        return found != carried.end() && found->second;
    });
    if (columns.has(Column::class_number)) {
        for (const auto& [name, number] : writer.classNumbersUsed()) {
            report.notes.push_back("class number " + std::to_string(number) + " is \"" + name + "\"");
        }
    }
}

}  // namespace

LabelFormat columnsFormat() {
    LabelFormat format;
    format.info = {"columns", "Own columns (as DarkLabel)", {"txt", "csv"}, false, true, true, {}};
    format.read = readColumns;
    format.write_frames = writeColumns;
    return format;
}

}  // namespace eyrie

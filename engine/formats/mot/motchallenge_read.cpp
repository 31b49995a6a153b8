#include <charconv>
#include <map>
#include <utility>

#include "core/error.h"
#include "formats/mot/mot_classes.h"
#include "formats/mot/motchallenge.h"
#include "formats/tables/text_fields.h"
#include "io/tables/number_text.h"

namespace eyrie {
namespace {

constexpr std::size_t kFrame = 0;
constexpr std::size_t kId = 1;
constexpr std::size_t kLeft = 2;
constexpr std::size_t kTop = 3;
constexpr std::size_t kWidth = 4;
constexpr std::size_t kHeight = 5;
constexpr std::size_t kFlag = 6;
constexpr std::size_t kClass = 7;
constexpr std::size_t kVisibility = 8;

/// The columns that ground truth and results share.
LabelBox readMotBox(const TextLine& line, const MotOptions& options) {
    if (line.size() < 6 || line.size() > 10) {
        line.fail(0, std::to_string(line.size()) +
                         " columns, expected 6 to 10: frame,id,left,top,width,height,…; is this MOTChallenge text?");
    }
    LabelBox record;
    record.frame = line.frame(kFrame, options.first_frame_number);
    const int id = line.integer(kId, "id");
    if (id >= (options.class_list ? 1 : 0)) record.id = id;
    record.box = boxFromEdges({line.pixels(kLeft, "left edge"), line.pixels(kTop, "top edge"),
                               line.size(kWidth, "width"), line.size(kHeight, "height")},
                              options.first_pixel_edge);
    return record;
}

std::string classOf(int number, const MotOptions& options) {
    if (!options.class_list) return classFromMot(number);
    if (number < 1) return {};
    const auto place = static_cast<std::size_t>(number) - 1;
    return place < options.class_list->size() ? (*options.class_list)[place] : "class " + std::to_string(number);
}

/// Reads all lines; `complete` fills in the columns from the seventh on.
template <class Complete>
LabelBoxes readLines(const std::filesystem::path& file, const MotOptions& options, const Complete& complete) {
    LabelBoxes boxes;
    std::map<std::pair<FrameIndex, int>, int> line_of_id;
    int number = 0;
    for (const std::string& text : readTextLines(file)) {
        const TextLine line(file, ++number, text);
        if (line.blank()) continue;
        LabelBox record = readMotBox(line, options);
        complete(line, record);
        if (record.id && !record.ignore) {
            const auto [earlier, is_new] = line_of_id.insert({{record.frame, *record.id}, number});
            if (!is_new) {
                line.fail(kId, "id " + std::to_string(*record.id) + " has a box in this frame already, in line " +
                                   std::to_string(earlier->second));
            }
        }
        boxes[record.frame].push_back(std::move(record));
    }
    return boxes;
}

template <class Number>
Number iniNumber(const std::filesystem::path& file, int line, const std::string& key, const std::string& value) {
    Number number{};
    const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), number);
    if (error != std::errc() || end != value.data() + value.size() || !(number > 0)) {
        throw Error(ErrorKind::input, file.string() + ":" + std::to_string(line) + ": " + key + " = \"" + value +
                                          "\", expected a number above 0");
    }
    return number;
}

}  // namespace

LabelBoxes readMotTruth(const std::filesystem::path& file, const MotOptions& options) {
    return readLines(file, options, [&](const TextLine& line, LabelBox& record) {
        if (line.size() > kFlag) record.ignore = line.number(kFlag, "flag (0: ignored)") == 0;
        if (line.size() > kClass) record.object_class = classOf(line.integer(kClass, "class"), options);
        if (line.size() <= kVisibility) return;
        const double visibility = line.number(kVisibility, "visibility");  // −1 where nobody said
        if (visibility == 0) record.occlusion = options.class_list ? Occlusion::partly : Occlusion::fully;
        if (visibility > 0 && visibility < 1) record.occlusion = Occlusion::partly;
    });
}

BoxesByFrame readMotResult(const std::filesystem::path& file, const MotOptions& options) {
    return plainBoxes(readLines(file, options, [&](const TextLine& line, LabelBox& record) {
        if (line.size() > kFlag) record.score = line.number(kFlag, "confidence");
        if (options.class_list && line.size() > kClass) {
            record.object_class = classOf(line.integer(kClass, "class"), options);
        }
    }));
}

MotSequence readMotSequence(const std::filesystem::path& file) {
    MotSequence sequence;
    std::optional<int> width;
    std::optional<int> height;
    int number = 0;
    for (const std::string& line : readTextLines(file)) {
        ++number;
        const std::size_t equals = line.find('=');
        if (equals == std::string::npos) continue;
        const std::string key(trimmed(std::string_view(line).substr(0, equals)));
        const std::string value(trimmed(std::string_view(line).substr(equals + 1)));
        if (key == "imWidth") width = iniNumber<int>(file, number, key, value);
        if (key == "imHeight") height = iniNumber<int>(file, number, key, value);
        if (key == "seqLength") sequence.frame_count = iniNumber<int>(file, number, key, value);
        if (key == "frameRate") sequence.frame_rate_hz = iniNumber<double>(file, number, key, value);
    }
    if (width && height) sequence.image_size = cv::Size(*width, *height);
    return sequence;
}

}  // namespace eyrie

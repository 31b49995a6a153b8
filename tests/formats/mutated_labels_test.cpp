#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "formats/sample_labels.h"

/// Bytes of good files are changed at random: reading ends with labels or with an Error that names the file, and never
/// with a crash, another exception or a hang.
namespace eyrie::mutated_labels_test {
namespace {

using testing::HasSubstr;

/// A change such as damage, editors and people make: bytes flipped, cut, doubled, swapped for what parsers trip over.
std::string mutated(std::string text, std::mt19937& random) {
    const auto below = [&](std::size_t limit) { return limit == 0 ? 0 : static_cast<std::size_t>(random()) % limit; };
    static const std::vector<std::string> words{
        "-1",         "nan",    "1e308", "-",      "99999999999", "0",    ",",
        " ",          "\n",     "\"",    "<",      ">",           "&x;",  "[",
        "]",          "{",      "}",     ":",      "\xff",        "\xc3", std::string(1, '\0'),
        "2147483648", "1e-320", "null",  "4000000"};
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) {
        const std::size_t at = below(text.size());
        switch (below(6)) {
            case 0:
                text[at] = static_cast<char>(random() & 0xff);
                break;
            case 1:
                text.erase(at, 1 + below(8));
                break;
            case 2:
                text.insert(at, words[below(words.size())]);
                break;
            case 3: {  // a number or a word is swapped
                const std::size_t end = text.find_first_not_of("0123456789.", at);
                text.replace(at, (end == std::string::npos ? text.size() : end) - at, words[below(words.size())]);
                break;
            }
            case 4:
                text.resize(at);
                break;
            default: {
                const std::string piece = text.substr(at, 1 + below(200));
                text.insert(below(text.size()), piece);
            }
        }
    }
    return text;
}

class MutatedLabels : public testing::TestWithParam<std::string> {};

TEST_P(MutatedLabels, GiveLabelsOrAnErrorThatNamesTheFile) {
    const std::string format = GetParam();
    const test::TemporaryFolder folder;
    ExportOptions options;
    options.columns = "frame,n,[id,cname,x1,y1,w,h,heading,score,ignore,occluded]";
    const bool per_image = format == "dota" || format == "yolo-obb";
    if (format == "mot-cvat")
        writeLabels(test::sampleLabels(), folder / "changed", format, options);
    else if (per_image)
        writeLabels(test::sampleLabels(), folder / "good", format, options);
    else
        writeLabels(test::sampleLabels(), folder / "good_gt.txt", format, options);
    const auto source = format == "dota"       ? folder.path() / "good" / "labelTxt" / "000004.txt"
                        : format == "yolo-obb" ? folder.path() / "good" / "labels" / "000004.txt"
                        : format == "uavdt"    ? folder / "good_gt_whole.txt"
                        : format == "mot-cvat" ? folder / "changed/gt/gt.txt"
                                               : folder / "good_gt.txt";
    const std::string good = test::textOf(source);
    ASSERT_FALSE(good.empty());
    ImportOptions import;
    import.image_size = cv::Size(320, 240);
    if (format == "columns") import.columns = options.columns;

    std::mt19937 random(20261121);
    const auto file = folder / (format == "uavdt"      ? "changed_gt_whole.txt"
                                : format == "mot-cvat" ? "changed/gt/gt.txt"
                                                       : "changed.txt");
    int read = 0, refused = 0;
    for (int round = 0; round < 600; ++round) {
        const std::string text = mutated(good, random);
        test::writeText(file, text);
        const std::string as = round % 4 == 0 && format != "columns" ? "auto" : format;
        try {
            const LabelFile labels = readLabels(file, as, import);
            reportOn(labels);
            annotationsOf(labels);
            ++read;
        } catch (const Error& error) {
            ++refused;
            EXPECT_THAT(error.what(), HasSubstr("changed"));
        } catch (const std::exception& error) {
            FAIL() << format << ", round " << round << ": " << error.what() << "\n" << text;
        }
    }
    EXPECT_GT(read, 0);
    EXPECT_GT(refused, 0);
}

std::vector<std::string> formatNames() {
    std::vector<std::string> names;
    for (const LabelFormatInfo& info : labelFormats()) {
        if (info.reads && info.name != "trackeval") names.push_back(info.name);  // is MOTChallenge inside
    }
    return names;
}

INSTANTIATE_TEST_SUITE_P(Formats, MutatedLabels, testing::ValuesIn(formatNames()), [](const auto& entry) {
    std::string name = entry.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
});

}  // namespace
}  // namespace eyrie::mutated_labels_test

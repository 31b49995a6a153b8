#include "io/video/image_sequence.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

#include "io/numbered_video.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::image_sequence_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class Images : public testing::Test {
 protected:
    void write(const std::string& name, const cv::Mat& image) { cv::imwrite((folder_ / name).string(), image); }
    void writeFlat(const std::string& name, int level, int type = CV_8UC1, cv::Size size = {40, 30}) {
        write(name, cv::Mat(size, type, cv::Scalar::all(level)));
    }
    void truncate(const std::string& name, double share) {
        const std::string bytes = test::bytesOf(folder_ / name);
        test::writeBytes(folder_ / name,
                         bytes.substr(0, static_cast<std::size_t>(static_cast<double>(bytes.size()) * share)));
    }
    std::unique_ptr<FrameSource> open(double frame_rate_hz = 0) {
        SourceOptions options;
        options.frame_rate_hz = frame_rate_hz;
        return openSource(folder_.path(), options);
    }
    int levelOf(FrameSource& source, int index) { return source.read(index, false).gray.at<uchar>(5, 5); }
    test::TemporaryFolder folder_;
};

TEST(NaturalOrder, ComparesRunsOfDigitsAsNumbers) {
    std::vector<std::string> names = {"frame10", "frame2", "b",         "frame2b", "frame",
                                      "a10c2",   "a10c10", "frame002a", "9",       "10"};
    std::sort(names.begin(), names.end(), naturalOrder);
    EXPECT_THAT(names,
                ElementsAre("9", "10", "a10c2", "a10c10", "b", "frame", "frame2", "frame002a", "frame2b", "frame10"));
}

TEST(NaturalOrder, ANameComesBeforeWhatGoesOnInAnyLetter) {
    for (const std::string more : {"a", "1", "\xC3\xA4", "\xE8\xBB\x8A"}) {
        EXPECT_TRUE(naturalOrder("frame", "frame" + more)) << more;
        EXPECT_FALSE(naturalOrder("frame" + more, "frame")) << more;
    }
}

TEST(NaturalOrder, LettersBeyondAsciiComeAfterThoseOfIt) {
    std::vector<std::string> names = {"\xC3\xA4", "z2", "stra\xC3\x9Fz", "\xE8\xBB\x8A", "strand", "strassz"};
    std::sort(names.begin(), names.end(), naturalOrder);
    EXPECT_THAT(names, ElementsAre("strand", "strassz", "stra\xC3\x9Fz", "z2", "\xC3\xA4", "\xE8\xBB\x8A"));
}

TEST(NaturalOrder, IsAStrictOrder) {
    const std::vector<std::string> names = {
        "a1", "a01", "a001", "a1b", "a01b", "a", "", "a0", "a00", "12345678901234567890123", "1"};
    for (const auto& a : names)
        for (const auto& b : names) {
            EXPECT_FALSE(naturalOrder(a, b) && naturalOrder(b, a)) << a << " " << b;
            EXPECT_EQ(naturalOrder(a, b) || naturalOrder(b, a), a != b) << a << " " << b;
        }
}

TEST_F(Images, AreReadInNaturalOrderAndOthersPassedOver) {
    for (const int i : {10, 2, 1, 33}) writeFlat("frame" + std::to_string(i) + ".png", i * 5);
    writeFlat(".hidden.png", 1);
    test::writeBytes(folder_ / "notes.txt", "no image");
    test::writeBytes(folder_ / "Thumbs.db", "no image");
    std::filesystem::create_directory(folder_ / "more.png");
    const auto source = open();
    ASSERT_EQ(source->info().frame_count, 4);
    EXPECT_EQ(levelOf(*source, 0), 5);
    EXPECT_EQ(levelOf(*source, 1), 10);
    EXPECT_EQ(levelOf(*source, 2), 50);
    EXPECT_EQ(levelOf(*source, 3), 165);
    EXPECT_TRUE(source->info().is_image_sequence);
    EXPECT_EQ(source->info().codec, "png sequence");
    EXPECT_EQ(source->info().container, "folder");
}

TEST_F(Images, AFolderThatMoreComeIntoHasGrown) {
    writeFlat("1.png", 10);
    const auto source = open();
    test::writeBytes(folder_ / "notes.txt", "no image");
    EXPECT_FALSE(source->hasGrown());
    writeFlat("2.png", 20);
    EXPECT_TRUE(source->hasGrown());
    EXPECT_EQ(source->info().frame_count, 1) << "of when it was opened";
}

TEST_F(Images, EveryKindIsRead) {
    for (const char* name : {"1.png", "2.jpg", "3.JPEG", "4.tif", "5.TIFF", "6.pgm", "7.bmp"}) {
        cv::Mat image(30, 40, CV_8UC1, cv::Scalar(90));
        std::vector<uchar> bytes;
        std::string extension = std::filesystem::path(name).extension().string();
        std::transform(extension.begin(), extension.end(), extension.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        cv::imencode(extension, image, bytes);
        test::writeBytes(folder_ / name, std::string(bytes.begin(), bytes.end()));
    }
    const auto source = open();
    ASSERT_EQ(source->info().frame_count, 7);
    for (int i = 0; i < 7; ++i) {
        const Frame frame = source->read(i, true);
        EXPECT_EQ(frame.gray.type(), CV_8UC1);
        EXPECT_EQ(frame.colour.type(), CV_8UC3);
        EXPECT_NEAR(frame.gray.at<uchar>(3, 3), 90, 1) << i;
        EXPECT_NEAR(frame.colour.at<cv::Vec3b>(3, 3)[1], 90, 1) << i;
    }
}

TEST_F(Images, TimesFollowTheGivenRate) {
    for (int i = 0; i < 4; ++i) writeFlat(std::to_string(i) + ".png", i);
    EXPECT_EQ(open()->info().frame_rate_hz, 25);
    EXPECT_EQ(open()->timeOf(3), 120'000);
    EXPECT_EQ(open(2)->info().frame_rate_hz, 2);
    EXPECT_EQ(open(2)->timeOf(3), 1'500'000);
    EXPECT_TRUE(open()->info().frame_rate_assumed);
    EXPECT_FALSE(open(2)->info().frame_rate_assumed);
}

TEST_F(Images, ARememberedRateCountsUntilAnotherIsGiven) {
    writeFlat("0.png", 0);
    SourceOptions options;
    options.remembered_rate_hz = 30;
    EXPECT_EQ(openSource(folder_.path(), options)->info().frame_rate_hz, 30);
    EXPECT_FALSE(openSource(folder_.path(), options)->info().frame_rate_assumed);
    options.frame_rate_hz = 10;
    EXPECT_EQ(openSource(folder_.path(), options)->info().frame_rate_hz, 10);
}

TEST_F(Images, ColourBecomesGreyTheSameWithAndWithoutColour) {
    write("a.png", cv::Mat(30, 40, CV_8UC3, cv::Scalar(10, 200, 30)));
    const auto source = open();
    EXPECT_EQ(levelOf(*source, 0), source->read(0, true).gray.at<uchar>(5, 5));
    EXPECT_NEAR(levelOf(*source, 0), 0.114 * 10 + 0.587 * 200 + 0.299 * 30, 1);
    EXPECT_EQ(source->read(0, true).colour.at<cv::Vec3b>(2, 2), cv::Vec3b(10, 200, 30));
    EXPECT_TRUE(source->read(0, false).colour.empty());
}

cv::Mat ramp16(int low, int high) {
    cv::Mat image(30, 40, CV_16UC1);
    for (int y = 0; y < 30; ++y)
        for (int x = 0; x < 40; ++x)
            image.at<std::uint16_t>(y, x) = static_cast<std::uint16_t>(low + (high - low) * x / 39);
    return image;
}

TEST_F(Images, SixteenBitIsScaledByTheRangeOfTheFirstImage) {
    for (const char* extension : {".tif", ".pgm", ".png"}) {
        const test::TemporaryFolder folder;
        cv::imwrite((folder / std::string("0") += extension).string(), ramp16(0, 4095));  // a camera of 12 bit
        cv::imwrite((folder / std::string("1") += extension).string(), ramp16(0, 2048));
        cv::imwrite((folder / std::string("2") += extension).string(), ramp16(0, 65535));
        const auto source = openSource(folder.path());
        const cv::Mat first = source->read(0, false).gray;
        EXPECT_EQ(first.at<uchar>(0, 0), 0);
        EXPECT_EQ(first.at<uchar>(0, 39), 255);
        EXPECT_NEAR(source->read(1, false).gray.at<uchar>(0, 39), 127.5, 1) << "the same line, not one of its own";
        EXPECT_EQ(source->read(2, false).gray.at<uchar>(0, 39), 255) << "saturates";
    }
}

TEST_F(Images, SixteenBitWithLittleContrastIsStretched) {
    write("0.tif", ramp16(8000, 9000));  // a thermal camera
    const auto source = open();
    const cv::Mat gray = source->read(0, false).gray;
    EXPECT_NEAR(gray.at<uchar>(0, 0), 64, 2);
    EXPECT_NEAR(gray.at<uchar>(0, 39), 191, 2);
}

TEST_F(Images, ABlankSixteenBitStartDoesNotBlindTheRest) {
    write("0.png", cv::Mat(30, 40, CV_16UC1, cv::Scalar(0)));
    write("1.png", ramp16(0, 65535));
    EXPECT_NEAR(open()->read(1, false).gray.at<uchar>(0, 20), 131, 2);
}

TEST_F(Images, ABrokenImageAmidTheOthersIsNamedAndTheOthersAreRead) {
    for (const char* extension : {".png", ".jpg", ".tif", ".pgm", ".bmp"}) {
        const test::TemporaryFolder folder;
        cv::Mat image = test::numberedImage(5);
        if (std::string(extension) == ".pgm") cv::cvtColor(image, image, cv::COLOR_BGR2GRAY);
        for (const char* number : {"0", "1", "2"}) cv::imwrite((folder / number += extension).string(), image);
        const auto broken = folder / "1" += extension;
        const std::string whole = test::bytesOf(broken);
        for (const std::string& bytes :
             {whole.substr(0, whole.size() * 6 / 10), std::string("nonsense"), std::string()}) {
            test::writeBytes(broken, bytes);
            const auto source = openSource(folder.path());
            ASSERT_EQ(source->info().frame_count, 3);
            EXPECT_NO_THROW(source->read(0, false));
            EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(1, false); }),
                        HasSubstr(broken.filename().string()))
                << extension << " of " << bytes.size() << " bytes";
            EXPECT_NO_THROW(source->read(2, false));
        }
    }
}

TEST_F(Images, ChangingSizeIsNamedWithBothSizes) {
    writeFlat("0.png", 1);
    writeFlat("1.png", 2, CV_8UC1, {50, 30});
    const auto source = open();
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(1, false); }),
                AllOf(HasSubstr("1.png"), HasSubstr("50×30"), HasSubstr("40×30")));
}

TEST_F(Images, AnEmptyFolderIsRefused) {
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { open(); }), HasSubstr("no images"));
}

TEST_F(Images, AFirstImageThatIsBrokenIsRefused) {
    test::writeBytes(folder_ / "0.png", "nonsense");
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { open(); }), HasSubstr("0.png"));
}

TEST_F(Images, OneImageIsASequence) {
    writeFlat("only.png", 70);
    for (const auto& path : {folder_.path(), folder_ / "only.png", folder_.path() / ""}) {
        const auto source = openSource(path);
        EXPECT_EQ(source->info().frame_count, 1);
        EXPECT_EQ(levelOf(*source, 0), 70);
    }
}

TEST_F(Images, FramesOutsideAreRefused) {
    writeFlat("only.png", 70);
    const auto source = open();
    test::messageOf(ErrorKind::input, [&] { source->read(1, false); });
    test::messageOf(ErrorKind::input, [&] { source->timeOf(-1); });
}

TEST(RealImages, AreRead) {
    EYRIE_NEED_SHARED_DATA("cmu_sequence1");
    const auto source = openSource(test::sharedData("cmu_sequence1"));
    EXPECT_EQ(source->info().frame_count, 21);
    EXPECT_EQ(source->info().size, cv::Size(320, 240));
    EXPECT_GT(cv::mean(source->read(20, false).gray)[0], 20);
}

}  // namespace
}  // namespace eyrie::image_sequence_test

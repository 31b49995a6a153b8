#include "io/video/parts/part_source.h"

#include <gmock/gmock.h>

#include <random>

#include "io/numbered_video.h"
#include "io/video/frame_cache.h"
#include "support/temporary_folder.h"

namespace eyrie::part_source_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

/// Three videos whose frames are numbered on: 0 … 19, 20 … 26, 27 … 39.
class PartSourceTest : public testing::Test {
 protected:
    PartSourceTest() {
        options_.index_folder = folder_ / "index";
        write("rec_1.mp4", 0, 20);
        write("rec_2.mp4", 20, 7);
        write("rec_3.mp4", 27, 13);
    }
    void write(const std::string& name, int first, int frames, cv::Size size = {160, 64}, double rate = 25) {
        VideoWriterOptions options;
        options.frame_rate_hz = rate;
        options.key_frame_distance = 5;
        test::writeNumberedVideo(folder_ / name, frames, options, size, first);
    }
    std::vector<std::filesystem::path> files() {
        return {folder_ / "rec_1.mp4", folder_ / "rec_2.mp4", folder_ / "rec_3.mp4"};
    }
    std::filesystem::path list() { return folder_ / "rec_1-rec_3.parts"; }
    std::unique_ptr<FrameSource> open() { return openTogether(files(), {list()}, options_); }
    std::string refusalOf(const std::vector<std::filesystem::path>& files) {
        return test::messageOf(ErrorKind::input, [&] { openTogether(files, {list()}, options_); });
    }
    std::string refusalOfList() {
        return test::messageOf(ErrorKind::input, [&] { openSource(list(), options_); });
    }
    static void expectFrame(FrameSource& source, FrameIndex index) {
        const Frame frame = source.read(index, false);
        EXPECT_EQ(test::numberIn(frame.gray), index);
        EXPECT_EQ(frame.index, index);
        EXPECT_EQ(frame.time_us, index * 40'000);
        EXPECT_EQ(source.timeOf(index), frame.time_us);
    }

    test::TemporaryFolder folder_;
    SourceOptions options_;
};

}  // namespace

TEST_F(PartSourceTest, HasGrownWhereOneOfItsFilesHas) {
    const auto alone = openSource(folder_ / "rec_3.mp4", options_);
    const auto source = open();
    EXPECT_FALSE(source->hasGrown());
    EXPECT_FALSE(alone->hasGrown());
    test::writeBytes(folder_ / "rec_3.mp4", test::bytesOf(folder_ / "rec_3.mp4") + "and more");
    EXPECT_TRUE(source->hasGrown());
    EXPECT_TRUE(alone->hasGrown());
    std::filesystem::remove(folder_ / "rec_3.mp4");
    EXPECT_FALSE(alone->hasGrown());
}

TEST_F(PartSourceTest, FramesAndTimesRunOnOverTheSeams) {
    const auto source = open();
    ASSERT_EQ(source->info().frame_count, 40);
    EXPECT_EQ(source->info().size, cv::Size(160, 64));
    EXPECT_NEAR(source->info().frame_rate_hz, 25, 1e-6);
    EXPECT_EQ(source->info().path, list());
    for (FrameIndex frame = 0; frame < 40; ++frame) expectFrame(*source, frame);
}

TEST_F(PartSourceTest, AnyFrameIsReadFromAnyOther) {
    const auto source = open();
    for (FrameIndex frame = 39; frame >= 0; --frame) expectFrame(*source, frame);
    std::mt19937 random(4);
    for (int i = 0; i < 60; ++i) expectFrame(*source, static_cast<FrameIndex>(random() % 40));
    for (const FrameIndex frame : {19, 20, 19, 26, 27, 26, 39, 0}) expectFrame(*source, frame);
}

TEST_F(PartSourceTest, ReadsThePixelsOfTheFilesThemselves) {
    const auto source = open();
    const auto second = openSource(files()[1], options_);
    for (const FrameIndex frame : {20, 23, 26}) {
        const Frame whole = source->read(frame, true);
        const Frame part = second->read(frame - 20, true);
        EXPECT_EQ(cv::norm(whole.gray, part.gray, cv::NORM_INF), 0);
        EXPECT_EQ(cv::norm(whole.colour, part.colour, cv::NORM_INF), 0);
    }
}

TEST_F(PartSourceTest, AReadingIsGivenUpInAnyPart) {
    const auto source = open();
    const FrameIndex last = source->info().frame_count - 1;
    source->read(last, false);
    bool given_up = true;
    source->giveUpWhen([&] { return given_up; });
    for (const FrameIndex frame : {last - 3, 4}) {  // of a part that is open, and of one that is not
        given_up = true;
        EXPECT_THROW(source->read(frame, false), ReadingGivenUp);
        given_up = false;
        EXPECT_EQ(test::numberIn(source->read(frame, false).gray), frame);
    }
}

TEST_F(PartSourceTest, TellsItsParts) {
    const auto source = open();
    const VideoInfo& info = source->info();
    ASSERT_EQ(info.parts.size(), 3U);
    EXPECT_EQ(info.parts[1].file, folder_ / "rec_2.mp4");
    EXPECT_EQ(info.parts[1].first_frame, 20);
    EXPECT_EQ(info.parts[1].frame_count, 7);
    EXPECT_EQ(info.parts[1].first_time_us, 800'000);
    EXPECT_EQ(info.partOf(19), info.parts.data());
    EXPECT_EQ(info.partOf(20), &info.parts[1]);
    EXPECT_EQ(info.partOf(39), &info.parts[2]);
    EXPECT_EQ(info.partOf(40), nullptr);
    EXPECT_EQ(info.partOf(-1), nullptr);
    EXPECT_EQ(openSource(files()[0], options_)->info().partOf(3), nullptr) << "one file has no parts";
}

TEST_F(PartSourceTest, PicturesHaveOneClock) {
    const auto source = open();
    const std::vector<PictureStamp> pictures = source->pictureStamps();
    ASSERT_EQ(pictures.size(), 40U);
    for (const PictureStamp& picture : pictures) EXPECT_EQ(picture.stamp_us, picture.time_us);
    EXPECT_EQ(source->info().parts[2].first_picture, 27);
    EXPECT_EQ(shiftedStamp(5, 7), 12);
    EXPECT_EQ(shiftedStamp(kNoStamp, 7), kNoStamp);
    EXPECT_EQ(shiftedStamp(INT64_MAX, 1), kNoStamp);
}

TEST_F(PartSourceTest, TheListIsOpenedLikeAVideo) {
    open();
    bool indexed = false;
    const auto source = openSource(list(), options_, [&](double) { indexed = true; });
    EXPECT_EQ(source->info().frame_count, 40);
    expectFrame(*source, 20);
    EXPECT_TRUE(indexed);
    EXPECT_THAT(test::bytesOf(list()), HasSubstr("\nrec_2.mp4,,7,"));
}

TEST_F(PartSourceTest, OneFileIsItself) {
    const auto source = openTogether({files()[1]}, {list()}, options_);
    EXPECT_EQ(source->info().path, files()[1]);
    EXPECT_TRUE(source->info().parts.empty());
    EXPECT_FALSE(std::filesystem::exists(list()));
    test::writeBytes(list(), "file\nrec_2.mp4\n");
    EXPECT_EQ(openSource(list(), options_)->info().frame_count, 7) << "a list of one";
}

TEST_F(PartSourceTest, FramesOutsideAreRefused) {
    const auto source = open();
    for (const FrameIndex frame : {-1, 40}) {
        EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(frame, false); }),
                    HasSubstr("the video has frames 0 to 39"));
        EXPECT_THROW(source->timeOf(frame), Error);
    }
}

TEST_F(PartSourceTest, AFrameThatCannotBeReadIsNamedInTheVideoAndInItsFile) {
    const auto source = open();
    std::filesystem::remove(files()[1]);
    expectFrame(*source, 19);
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(22, false); }),
                AllOf(HasSubstr("rec_1-rec_3.parts: frame 22: "), HasSubstr("rec_2.mp4")));
    expectFrame(*source, 27);
}

TEST_F(PartSourceTest, APartThatChangesWhileItIsOpenIsToldAndNotShown) {
    const auto source = open();
    write("rec_2.mp4", 100, 9);
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { source->read(22, false); }),
                AllOf(HasSubstr("rec_2.mp4"), HasSubstr("has changed since it was opened")));
}

TEST_F(PartSourceTest, PartsThatAreNotAlikeAreRefusedByName) {
    write("rec_2.mp4", 20, 7, {200, 64});
    EXPECT_THAT(refusalOf(files()),
                AllOf(HasSubstr("part 2 of 3, "), HasSubstr("rec_2.mp4, is 200×64 px"), HasSubstr("convert it")));
    write("rec_2.mp4", 20, 7, {160, 64}, 30);
    EXPECT_THAT(refusalOf(files()),
                AllOf(HasSubstr("rec_2.mp4, has 30 frames/s, the parts before it 25 frames/s"), HasSubstr("--fps")));
    EXPECT_FALSE(std::filesystem::exists(list())) << "of what cannot be opened no list is made";
    options_.frame_rate_hz = 25;
    const auto source = open();
    for (const FrameIndex frame : {0, 19, 20, 26, 27, 39}) expectFrame(*source, frame);
    options_.frame_rate_hz = 0;
    EXPECT_THAT(refusalOfList(), HasSubstr("--fps"));
    options_.remembered_rate_hz = 25;
    expectFrame(*openSource(list(), options_), 26);
}

TEST_F(PartSourceTest, APartOfOneFrameHasNoRateOfItsOwn) {
    write("rec_2.mp4", 20, 1, {160, 64}, 30);
    const auto source = open();
    EXPECT_EQ(source->info().frame_count, 34);
    EXPECT_EQ(source->timeOf(21) - source->timeOf(19), 80'000);
}

TEST_F(PartSourceTest, PartsOfOneFrameEachHaveTheRateOfTheFirst) {
    for (int i = 0; i < 3; ++i) write("rec_" + std::to_string(i + 1) + ".mp4", i, 1);
    const auto source = open();
    EXPECT_EQ(source->info().frame_count, 3);
    EXPECT_EQ(source->info().frame_rate_hz, openSource(folder_ / "rec_1.mp4", options_)->info().frame_rate_hz);
    EXPECT_EQ(source->timeOf(2), 2 * source->timeOf(1));
    EXPECT_GT(source->timeOf(1), 0);
}

TEST_F(PartSourceTest, ARateThatAProjectRemembersCountsForAll) {
    open();
    options_.remembered_rate_hz = 12.5;
    const auto source = openSource(list(), options_);
    EXPECT_EQ(source->info().frame_rate_hz, 12.5);
    for (const FrameIndex frame : {0, 19, 20, 39}) EXPECT_EQ(source->read(frame, false).time_us, frame * 80'000);
    for (const PictureStamp& picture : source->pictureStamps()) EXPECT_EQ(picture.time_us % 80'000, 0);
}

TEST_F(PartSourceTest, WhatIsNoPartIsRefused) {
    const auto first = files()[0];
    EXPECT_THAT(refusalOf({first, folder_ / "none.mp4"}), HasSubstr("none.mp4"));
    EXPECT_THAT(refusalOf({first, files()[1], first}), HasSubstr("rec_1.mp4: is given twice"));
    std::filesystem::create_symlink(first, folder_ / "link.mp4");
    EXPECT_THAT(refusalOf({first, folder_ / "link.mp4"}), HasSubstr("link.mp4: is given twice"));
    EXPECT_THAT(refusalOf({first, folder_.path()}), HasSubstr("is a folder"));
    test::writeBytes(folder_ / "a.csv", "frame,id\n1,2\n");
    EXPECT_THAT(refusalOf({first, folder_ / "a.csv"}), HasSubstr("a.csv: is a table or text, not a video"));
    test::writeBytes(folder_ / "a.png", "\x89PNG");
    EXPECT_THAT(refusalOf({first, folder_ / "a.png"}), HasSubstr("into one folder"));
    test::writeBytes(folder_ / "b.parts", "file\nrec_2.mp4\n");
    EXPECT_THAT(refusalOf({first, folder_ / "b.parts"}), HasSubstr("is a list of parts already"));
    test::writeBytes(folder_ / "noise.mp4", std::string(5000, 'x') + std::string(10, '\xFE'));
    EXPECT_THAT(refusalOf({first, folder_ / "noise.mp4"}), HasSubstr("noise.mp4"));
    test::writeBytes(folder_ / "empty.mp4", "");
    EXPECT_THAT(refusalOf({first, folder_ / "empty.mp4"}), HasSubstr("empty.mp4"));
}

TEST_F(PartSourceTest, AListWithAPartThatIsGoneOrAnotherIsRefusedBeforeAnythingIsRead) {
    open();
    std::filesystem::rename(files()[2], folder_ / "x.mp4");
    EXPECT_THAT(refusalOfList(), AllOf(HasSubstr("part 3 of 3, "), HasSubstr("rec_3.mp4, is not there")));
    write("rec_3.mp4", 27, 14);
    EXPECT_THAT(refusalOfList(), HasSubstr("rec_3.mp4, has changed since the list was made"));
    std::filesystem::rename(folder_ / "x.mp4", files()[2]);
    EXPECT_EQ(openSource(list(), options_)->info().frame_count, 40);
    std::string text = test::bytesOf(list());
    text.replace(text.find(",7,"), 3, ",8,");
    test::writeBytes(list(), text);
    EXPECT_THAT(refusalOfList(), HasSubstr("rec_2.mp4, has 7 frames, not the 8"));
}

TEST_F(PartSourceTest, MissingPartsAreLocatedAndRemembered) {
    open();
    std::filesystem::create_directory(folder_ / "archive");
    for (int part = 1; part < 3; ++part)
        std::filesystem::rename(files()[static_cast<std::size_t>(part)],
                                folder_ / "archive" / files()[static_cast<std::size_t>(part)].filename());
    const auto source = openRelocated(list(), {folder_ / "archive" / "rec_3.mp4"}, options_);
    expectFrame(*source, 20);
    EXPECT_EQ(openSource(list(), options_)->info().frame_count, 40);
    std::filesystem::rename(folder_ / "archive", folder_ / "deep");
    const std::string before = test::bytesOf(list());
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { openRelocated(list(), {files()[0]}, options_); }),
                HasSubstr("rec_2.mp4, is not there"));
    EXPECT_EQ(test::bytesOf(list()), before);
}

TEST_F(PartSourceTest, TheListLiesWhereItCanBeWritten) {
    const auto source = openTogether(files(), {folder_ / "no such folder" / "a.parts", list()}, options_);
    EXPECT_EQ(source->info().path, list());
    EXPECT_THROW(openTogether(files(), {folder_ / "no such folder" / "a.parts"}, options_), Error);
    EXPECT_EQ(openTogether(files(), {}, options_)->info().frame_count, 40) << "without a list";
}

TEST_F(PartSourceTest, IndexingCanBeStopped) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THAT(
        test::messageOf(ErrorKind::input, [&] { openTogether(files(), {list()}, options_, {}, stop.get_token()); }),
        HasSubstr("stopped while indexing"));
}

TEST_F(PartSourceTest, ProgressRunsOnOverAllParts) {
    std::vector<double> shares;
    openTogether(files(), {list()}, options_, [&](double share) { shares.push_back(share); });
    ASSERT_GE(shares.size(), 3U);
    EXPECT_TRUE(std::is_sorted(shares.begin(), shares.end()));
    EXPECT_NEAR(shares.back(), 1, 1e-3);
}

TEST_F(PartSourceTest, TheWindowsCacheReadsOverSeams) {
    FrameCache cache(open());
    for (FrameIndex frame = 15; frame < 40; ++frame) EXPECT_EQ(test::numberIn(cache.get(frame)->gray), frame);
    for (FrameIndex frame = 39; frame >= 15; --frame) EXPECT_EQ(test::numberIn(cache.get(frame)->gray), frame);
}

TEST_F(PartSourceTest, FewFilesAreOpenHoweverManyPartsThereAre) {
    const auto openFiles = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/fd"),
                             std::filesystem::directory_iterator());
    };
    std::vector<std::filesystem::path> many;
    for (int part = 0; part < 12; ++part) {
        many.push_back(folder_ / ("many_" + std::to_string(part) + ".mp4"));
        std::filesystem::copy_file(files()[1], many.back());
    }
    const auto before = openFiles();
    const auto source = openTogether(many, {list()}, options_);
    ASSERT_EQ(source->info().frame_count, 84);
    for (FrameIndex frame = 0; frame < 84; ++frame)
        EXPECT_EQ(test::numberIn(source->read(frame, false).gray), 20 + frame % 7);
    EXPECT_LE(openFiles() - before, 3);
}

}  // namespace eyrie::part_source_test

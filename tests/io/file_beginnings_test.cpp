// What a file is by its first bytes, and which rate a video is given.
#include <gtest/gtest.h>

#include <fstream>

#include "io/file_kind.h"
#include "io/video/frame_source.h"
#include "support/temporary_folder.h"

namespace eyrie::file_beginnings_test {
namespace {

FileKind kindOf(const std::string& bytes, const char* name = "file") {
    const test::TemporaryFolder folder;
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return kindOfFile(folder / name);
}

}  // namespace

TEST(FileBeginnings, NetpbmPicturesHaveTheNumbersOneToSevenAndABlank) {
    for (const char* picture : {"P1\n2 2", "P5 2 2 255 ", "P7\nWIDTH"}) EXPECT_EQ(kindOf(picture), FileKind::image);
    for (const char* words : {"P0\n2 2", "P8\n2 2", "P5x", "P5", "Q5 2 2"})
        EXPECT_EQ(kindOf(words), FileKind::text) << words;
}

TEST(FileBeginnings, TransportStreamsHaveASyncMarkEvery188Bytes) {
    std::string stream(400, 'x');
    stream[0] = stream[188] = stream[376] = 'G';
    EXPECT_EQ(kindOf(stream), FileKind::video);
    stream[376] = 'x';
    EXPECT_EQ(kindOf(stream), FileKind::text);
    stream[377] = 'G';
    EXPECT_EQ(kindOf(stream), FileKind::text);
}

TEST(FileBeginnings, TextIsToldApartByItsFirstMark) {
    EXPECT_EQ(kindOf(""), FileKind::empty);
    EXPECT_EQ(kindOf(" \n\t"), FileKind::text);
    EXPECT_EQ(kindOf("frame,x\n"), FileKind::text);
    EXPECT_EQ(kindOf(" \r\n{}"), FileKind::json);
    EXPECT_EQ(kindOf("\xEF\xBB\xBF{}"), FileKind::json);
    EXPECT_EQ(kindOf("["), FileKind::json);
    EXPECT_EQ(kindOf("[1]"), FileKind::json);
    EXPECT_EQ(kindOf("[Sequence]"), FileKind::text);
    EXPECT_EQ(kindOf("<!DOCTYPE HTML>"), FileKind::html);
    EXPECT_EQ(kindOf("<html lang=\"en\">"), FileKind::html);
    EXPECT_EQ(kindOf("<?xml version=\"1.0\"?>"), FileKind::xml);
    EXPECT_EQ(kindOf("#!/bin/sh\n"), FileKind::other);
}

TEST(FileBeginnings, TextHasNoControlCharactersInItsFirstKilobyte) {
    EXPECT_EQ(kindOf("a\tb\fc\r\nd e~"), FileKind::text);
    EXPECT_EQ(kindOf("a\x1F"), FileKind::other);
    EXPECT_EQ(kindOf("a\x01"), FileKind::other);
    EXPECT_EQ(kindOf("a\x01", "film.mp4"), FileKind::video) << "by its name, where its bytes say nothing";
    EXPECT_EQ(kindOf("a,b\n", "film.mp4"), FileKind::text);
    std::string words(1030, 'a');
    words[1024] = '\x01';
    EXPECT_EQ(kindOf(words), FileKind::text);
    words[1023] = '\x01';
    EXPECT_EQ(kindOf(words), FileKind::other);
}

TEST(FrameRates, ARememberedRateCountsWhereItIsNotTheVideosOwn) {
    const auto rate = [](double given, double remembered) {
        SourceOptions options;
        options.frame_rate_hz = given;
        options.remembered_rate_hz = remembered;
        return overridingRate(options, 25);
    };
    EXPECT_EQ(rate(0, 0), 0);
    EXPECT_EQ(rate(30, 12), 30);
    EXPECT_EQ(rate(25, 0), 25) << "what a person says counts in any case";
    // Half a per cent: 0.125 Hz.
    EXPECT_EQ(rate(0, 25.12), 0);
    EXPECT_EQ(rate(0, 25.13), 25.13);
    EXPECT_EQ(rate(0, 24.88), 0);
    EXPECT_EQ(rate(0, 24.87), 24.87);
}

}  // namespace eyrie::file_beginnings_test

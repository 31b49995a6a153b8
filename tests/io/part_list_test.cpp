#include "io/video/parts/part_list.h"

#include <gmock/gmock.h>

#include "core/time/utc_time.h"
#include "io/file_digest.h"
#include "io/numbered_video.h"
#include "io/output_files.h"
#include "support/temporary_folder.h"

namespace eyrie::part_list_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class PartListTest : public testing::Test {
 protected:
    PartListTest() {
        for (const char* name : {"a.ts", "b.ts", "c.ts"}) test::writeBytes(folder_ / name, std::string("of ") + name);
    }
    ListedPart part(const std::string& name) {
        ListedPart part;
        part.file = folder_ / name;
        part.frames = 50;
        part.bytes = std::filesystem::file_size(folder_ / name);
        part.digest = edgeDigestOf(folder_ / name);
        return part;
    }
    std::vector<ListedPart> parts() { return {part("a.ts"), part("b.ts"), part("c.ts")}; }
    std::string refusalOf(const std::string& text) {
        test::writeBytes(list(), text);
        return test::messageOf(ErrorKind::input, [&] { readPartList(list()); });
    }
    std::filesystem::path list() { return folder_ / "all.parts"; }
    static std::vector<std::string> namesOf(const std::vector<ListedPart>& parts) {
        std::vector<std::string> names;
        for (const ListedPart& part : parts) names.push_back(part.file.filename().string());
        return names;
    }

    test::TemporaryFolder folder_;
};

}  // namespace

TEST_F(PartListTest, ReadsWhatWasWritten) {
    std::vector<ListedPart> written = parts();
    written[1].start_utc_us = utcOf("2026-11-21T08:05:00.25Z");
    std::filesystem::create_directory(folder_ / "far, \"off\"");
    written[2].file = folder_ / "far, \"off\"" / "=c.ts";
    test::writeBytes(written[2].file, "of c.ts");
    writePartList(list(), written);
    const std::vector<ListedPart> read = readPartList(list());
    ASSERT_EQ(read.size(), 3U);
    for (std::size_t i = 0; i < read.size(); ++i) {
        EXPECT_EQ(read[i].file, written[i].file);
        EXPECT_EQ(read[i].start_utc_us, written[i].start_utc_us);
        EXPECT_EQ(read[i].frames, 50);
        EXPECT_EQ(read[i].bytes, written[i].bytes);
        EXPECT_EQ(read[i].digest, written[i].digest);
        EXPECT_NO_THROW(checkPart(list(), read, i));
    }
}

TEST_F(PartListTest, NamesAloneAreEnough) {
    test::writeBytes(list(), "file\nb.ts\n\na.ts\n");
    const std::vector<ListedPart> read = readPartList(list());
    EXPECT_THAT(namesOf(read), ElementsAre("b.ts", "a.ts")) << "in the order of the list";
    EXPECT_NO_THROW(checkPart(list(), read, 0));
}

TEST_F(PartListTest, TheFolderCanBeMovedWithItsFiles) {
    std::filesystem::create_directory(folder_ / "day");
    for (const char* name : {"a.ts", "b.ts"}) std::filesystem::copy(folder_ / name, folder_ / "day" / name);
    std::vector<ListedPart> inside = {part("a.ts"), part("b.ts")};
    for (ListedPart& each : inside) each.file = folder_ / "day" / each.file.filename();
    writePartList(folder_ / "day" / "x.parts", inside);
    std::filesystem::rename(folder_ / "day", folder_ / "moved");
    for (const ListedPart& each : readPartList(folder_ / "moved" / "x.parts"))
        EXPECT_EQ(each.file.parent_path(), folder_ / "moved");
}

TEST_F(PartListTest, APartThatLiesBesideTheListNowIsFoundThere) {
    std::vector<ListedPart> listed = parts();
    listed[1].file = folder_ / "gone" / "b.ts";
    writePartList(list(), listed);
    EXPECT_EQ(readPartList(list())[1].file, folder_ / "b.ts");
}

TEST_F(PartListTest, WhatIsNoListIsRefusedWithItsLine) {
    EXPECT_THAT(refusalOf(""), HasSubstr("all.parts: the file is empty"));
    EXPECT_THAT(refusalOf("file\n"), HasSubstr("all.parts: names no part"));
    EXPECT_THAT(refusalOf("name\na.ts\n"), HasSubstr("all.parts:1: column file is missing"));
    EXPECT_THAT(refusalOf("file,frames\na.ts,many\n"), HasSubstr("all.parts:2: column frames = many"));
    EXPECT_THAT(refusalOf("file,frames\na.ts,-1\n"), HasSubstr("all.parts:2: column frames = -1"));
    EXPECT_THAT(refusalOf("file,bytes\na.ts,9x\n"), HasSubstr("all.parts:2: column bytes = 9x"));
    EXPECT_THAT(refusalOf("file,bytes\na.ts,99999999999999999999999\n"), HasSubstr("the size of the file in bytes"));
    EXPECT_THAT(refusalOf("file,digest\na.ts,abc\n"), HasSubstr("64 hexadecimal digits"));
    EXPECT_THAT(refusalOf("file,digest\na.ts," + std::string(64, 'g') + "\n"), HasSubstr("64 hexadecimal digits"));
    EXPECT_THAT(refusalOf("file,start_utc\na.ts,yesterday\n"), HasSubstr("expected a time in UTC"));
    EXPECT_THAT(refusalOf("file,frames\n,50\n"), HasSubstr("all.parts:2: column file is empty"));
    EXPECT_THAT(refusalOf("file\na.ts\nb.ts\n./a.ts\n"), HasSubstr("all.parts:4: column file = ./a.ts, expected each"));
    EXPECT_THAT(refusalOf("file,frames\na.ts,50\nb.t"), HasSubstr("all.parts:3")) << "a list that was cut off";
    EXPECT_THAT(refusalOf(std::string("file\na\0b\n", 9)), HasSubstr("not text"));
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { readPartList(folder_ / "none.parts"); }),
                HasSubstr("none.parts"));
}

TEST_F(PartListTest, APartThatIsMissingOrAnotherFileIsNamed) {
    const std::vector<ListedPart> listed = parts();
    const auto refusal = [&] { return test::messageOf(ErrorKind::input, [&] { checkPart(list(), listed, 1); }); };
    test::writeBytes(folder_ / "b.ts", "of B.ts");
    EXPECT_THAT(refusal(), testing::AllOf(HasSubstr("part 2 of 3, "), HasSubstr("b.ts, is another file")));
    test::writeBytes(folder_ / "b.ts", "of b.ts and more");
    EXPECT_THAT(refusal(), HasSubstr("b.ts, has changed since the list was made: it has 16 bytes, then 7"));
    std::filesystem::remove(folder_ / "b.ts");
    EXPECT_THAT(refusal(), HasSubstr("b.ts, is not there; put it back or beside the list"));
}

TEST_F(PartListTest, TheDigestOfTheEndsTellsLongFilesApart) {
    std::string bytes(300'000, 'x');
    test::writeBytes(folder_ / "long", bytes);
    const std::string digest = edgeDigestOf(folder_ / "long");
    bytes.back() = 'y';
    test::writeBytes(folder_ / "long", bytes);
    EXPECT_NE(edgeDigestOf(folder_ / "long"), digest);
    bytes.back() = 'x';
    bytes.front() = 'y';
    test::writeBytes(folder_ / "long", bytes);
    EXPECT_NE(edgeDigestOf(folder_ / "long"), digest);
    EXPECT_EQ(edgeDigestOf(folder_ / "a.ts"), sha256Of(folder_ / "a.ts")) << "a short file is read whole";
    EXPECT_THROW(edgeDigestOf(folder_ / "none"), Error);
}

TEST_F(PartListTest, IsKeptOnceAndNeverInThePlaceOfAnother) {
    EXPECT_EQ(keepPartList(list(), parts()), list());
    const std::string kept = test::bytesOf(list());
    EXPECT_EQ(keepPartList(list(), parts()), list());
    EXPECT_EQ(keepPartList(list(), {part("a.ts"), part("c.ts")}), folder_ / "all-2.parts");
    EXPECT_EQ(keepPartList(list(), {part("a.ts"), part("c.ts")}), folder_ / "all-2.parts");
    test::writeBytes(folder_ / "all-3.parts", "a note of mine");
    EXPECT_EQ(keepPartList(list(), {part("b.ts"), part("a.ts")}), folder_ / "all-4.parts") << "the order counts";
    EXPECT_EQ(test::bytesOf(list()), kept);
    EXPECT_EQ(test::bytesOf(folder_ / "all-3.parts"), "a note of mine");
}

TEST_F(PartListTest, AStartThatAPersonWroteStays) {
    std::vector<ListedPart> dated = parts();
    dated[0].start_utc_us = utcOf("2026-11-21T08:00:00Z");
    writePartList(list(), dated);
    EXPECT_EQ(keepPartList(list(), parts()), list());
    EXPECT_EQ(readPartList(list())[0].start_utc_us, dated[0].start_utc_us);
}

TEST_F(PartListTest, IsNamedAfterItsFirstAndLastFile) {
    EXPECT_EQ(partListName({"/x/rec_001.ts", "/y/rec_002.ts", "rec_003.ts"}), "rec_001-rec_003.parts");
    EXPECT_EQ(partListName({"/x/clip.ts", "/y/clip.ts"}), "clip.parts");
    const std::string umlauts = "x" + [] {
        std::string text;
        for (int i = 0; i < 80; ++i) text += "ä";
        return text;
    }();
    EXPECT_EQ(partListName({umlauts + ".ts", "b.ts"}), umlauts.substr(0, 99) + "-b.parts") << "no half letters";
    EXPECT_TRUE(hasPartListName("A.PARTS"));
    EXPECT_FALSE(hasPartListName("a.part"));
}

TEST_F(PartListTest, ANameThatNoTableHoldsIsRefused) {
    test::writeBytes(folder_ / "two\nlines.ts", "x");
    std::vector<ListedPart> odd = parts();
    odd[0].file = folder_ / "two\nlines.ts";
    EXPECT_THAT(test::messageOf(ErrorKind::input, [&] { writePartList(list(), odd); }), HasSubstr("rename it"));
}

TEST_F(PartListTest, MissingPartsAreFoundWhereOneOfThemWasChosen) {
    std::filesystem::create_directory(folder_ / "new");
    const std::vector<ListedPart> listed = parts();
    for (const char* name : {"b.ts", "c.ts"}) std::filesystem::rename(folder_ / name, folder_ / "new" / name);
    const auto found = relocatedParts(listed, {folder_ / "new" / "b.ts"});
    EXPECT_EQ(found[0].file, folder_ / "a.ts") << "it is where it was";
    EXPECT_EQ(found[1].file, folder_ / "new" / "b.ts");
    EXPECT_EQ(found[2].file, folder_ / "new" / "c.ts");
    EXPECT_EQ(relocatedParts(listed, {folder_ / "a.ts"})[1].file, listed[1].file) << "not found";
}

TEST_F(PartListTest, NoOutputReplacesAPart) {
    writePartList(list(), parts());
    for (const char* name : {"a.ts", "c.ts", "all.parts"}) {
        const std::string message = test::messageOf(ErrorKind::output, [&] {
            filesToReplace({{folder_ / name, FileKind::text}}, {list()});
        });
        EXPECT_THAT(message, HasSubstr("is read by this command"));
    }
}

TEST_F(PartListTest, TheDigestOfAListIsThatOfItsFilesAndTheirNames) {
    writePartList(list(), {part("b.ts"), part("a.ts")});
    test::writeBytes(folder_ / "all", std::string("b.ts\0of b.tsa.ts\0of a.ts", 24));
    EXPECT_EQ(sha256Of(list()), sha256Of(folder_ / "all"));
}

}  // namespace eyrie::part_list_test

#include "io/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "core/error.h"
#include "io/atomic_file.h"
#include "io/video/video_writer.h"
#include "support/temporary_folder.h"

namespace eyrie::output_files_test {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class OutputFiles : public testing::Test {
 protected:
    OutputFiles() {
        write("table.csv", "frame,id\n0,1\n");
        write("boxes.json", "{\"boxes\": []}");
        write("labels.xml", "<?xml version=\"1.0\"?><annotations/>");
        write("page.html", "<!DOCTYPE html><html></html>");
        write("tool.sh", "#!/bin/sh\nexit 0\n");
        write("p.eyrie", std::string("SQLite format 3\0", 16) + "rest");
        write("renamed", std::string("SQLite format 3\0", 16) + "rest");
        write("empty.csv", "");
        VideoWriter video(at("clip.mp4"), {32, 32});
        video.write(cv::Mat::zeros(32, 32, CV_8UC3));
        video.finish();
        fs::create_directory(at("frames"));
        cv::imwrite(at("frames/0001.png").string(), cv::Mat::zeros(8, 8, CV_8U));
    }
    fs::path at(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& bytes) const {
        std::ofstream(at(name), std::ios::binary) << bytes;
    }
    /// The refusal, or "" where the output is allowed.
    static std::string refusal(const std::vector<OutputFile>& outputs, const std::vector<fs::path>& inputs = {}) {
        try {
            filesToReplace(outputs, inputs);
            return {};
        } catch (const Error& error) {
            EXPECT_TRUE(error.kind() == ErrorKind::output || error.kind() == ErrorKind::project);
            return error.what();
        }
    }
    std::string refusal(const std::string& name, FileKind kind, const std::vector<fs::path>& inputs = {}) const {
        return refusal({{at(name), kind}}, inputs);
    }
    test::TemporaryFolder folder_;
};

TEST_F(OutputFiles, NewFilesNeedNoConsentAndThoseOfTheSameKindDo) {
    EXPECT_THAT(
        filesToReplace({{at("new.csv"), FileKind::text}, {at("new.mp4"), FileKind::video}, {"", FileKind::text}}, {}),
        IsEmpty());
    EXPECT_THAT(filesToReplace({{at("table.csv"), FileKind::text}, {at("clip.mp4"), FileKind::video}}, {}),
                ElementsAre(at("table.csv"), at("clip.mp4")));
    EXPECT_THAT(filesToReplace({{at("empty.csv"), FileKind::json}}, {}), IsEmpty()) << "nothing is lost";
}

TEST_F(OutputFiles, AFileOfAnotherKindIsNeverReplaced) {
    const std::vector<std::pair<std::string, FileKind>> files{
        {"table.csv", FileKind::text}, {"boxes.json", FileKind::json}, {"labels.xml", FileKind::xml},
        {"page.html", FileKind::html}, {"clip.mp4", FileKind::video},  {"frames/0001.png", FileKind::image}};
    for (const auto& [name, kind] : files) {
        for (const auto& [unused, wanted] : files) {
            EXPECT_EQ(refusal(name, wanted).empty(), kind == wanted) << name << " by " << nameOf(wanted);
        }
        EXPECT_THAT(refusal("tool.sh", kind), HasSubstr("another program"));
        EXPECT_THAT(refusal("p.eyrie", kind), HasSubstr("never overwritten"));
        EXPECT_THAT(refusal("renamed", kind), HasSubstr("never overwritten"));
    }
}

TEST_F(OutputFiles, WhatIsReadIsNeverWrittenHoweverItIsNamed) {
    const std::vector<fs::path> inputs{at("table.csv")};
    fs::create_symlink(at("table.csv"), at("soft.csv"));
    fs::create_hard_link(at("table.csv"), at("hard.csv"));
    for (const char* name : {"table.csv", "./table.csv", "frames/../table.csv", "soft.csv", "hard.csv"})
        EXPECT_THAT(refusal(name, FileKind::text, inputs), HasSubstr("is read by this command")) << name;
    EXPECT_THAT(refusal("frames/0001.png", FileKind::image, {at("frames")}), HasSubstr("in the folder"));
    EXPECT_EQ(refusal("frames/new.csv", FileKind::text, {at("frames")}), "");
}

TEST_F(OutputFiles, WhatBelongsToAProjectIsNeverWritten) {
    EXPECT_THAT(refusal("p.eyrie-wal", FileKind::text), HasSubstr("belongs to the project"));
    EXPECT_THAT(refusal("renamed-shm", FileKind::text, {at("renamed")}), HasSubstr("belongs to the project"));
    EXPECT_THAT(refusal({{at("new.eyrie"), FileKind::project, true}, {at("new.eyrie-journal"), FileKind::text}}),
                HasSubstr("belongs to the project"));
}

TEST_F(OutputFiles, TwoOutputsAreTwoFiles) {
    EXPECT_THAT(refusal({{at("a.csv"), FileKind::text}, {at("./a.csv"), FileKind::text}}), HasSubstr("two outputs"));
    fs::create_hard_link(at("table.csv"), at("hard.csv"));
    EXPECT_THAT(refusal({{at("table.csv"), FileKind::text}, {at("hard.csv"), FileKind::text}}),
                HasSubstr("two outputs"));
    EXPECT_EQ(refusal({{"/dev/null", FileKind::text}, {"/dev/null", FileKind::text}}), "");
}

TEST_F(OutputFiles, AProjectGrowsAndWhatIsNoneStaysUntouched) {
    EXPECT_EQ(refusal({{at("renamed"), FileKind::project, true}}, {at("renamed")}), "");
    for (const char* name : {"table.csv", "clip.mp4", "empty.csv"}) {
        try {
            filesToReplace({{at(name), FileKind::project, true}}, {});
            ADD_FAILURE() << name;
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::project);
            EXPECT_THAT(error.what(), HasSubstr("left untouched"));
        }
    }
    EXPECT_THAT(refusal({{at("clip.mp4"), FileKind::project, true}}, {at("clip.mp4")}), HasSubstr("is read"));
}

TEST_F(OutputFiles, FoldersMustBeThere) {
    EXPECT_THAT(refusal("no/where.csv", FileKind::text), HasSubstr("does not exist; make it first"));
    EXPECT_THAT(refusal("table.csv/x.csv", FileKind::text), HasSubstr("is not a folder"));
    EXPECT_THAT(refusal("frames", FileKind::text), HasSubstr("is a folder"));
    EXPECT_EQ(refusal({{at("no/where/x.csv"), FileKind::text, false, true}}), "");
    EXPECT_THAT(refusal({{at("table.csv/where/x.csv"), FileKind::text, false, true}}), HasSubstr("is not a folder"));
}

TEST_F(OutputFiles, LinksStayLinksWhenTheirTargetIsReplaced) {
    fs::create_symlink(at("table.csv"), at("soft.csv"));
    writeFileAtomically(at("soft.csv"), "new");
    EXPECT_TRUE(fs::is_symlink(at("soft.csv")));
    EXPECT_EQ(readWholeFile(at("table.csv")), "new");
}

TEST_F(OutputFiles, AVideoTakesItsPlaceOnlyWhenItIsComplete) {
    const std::string former = readWholeFile(at("clip.mp4"));
    {
        VideoWriter video(at("clip.mp4"), {32, 32});
        video.write(cv::Mat::zeros(32, 32, CV_8UC3));
        EXPECT_EQ(readWholeFile(at("clip.mp4")), former);
        video.finish();
    }
    for (const auto& entry : fs::directory_iterator(folder_.path()))
        EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST_F(OutputFiles, NamesMayBeAsLongAsTheFileSystemAllows) {
    const std::string longest(251, 'n');
    writeFileAtomically(at(longest + ".csv"), "x");
    EXPECT_EQ(readWholeFile(at(longest + ".csv")), "x");
    VideoWriter video(at(longest + ".mp4"), {32, 32});
    video.write(cv::Mat::zeros(32, 32, CV_8UC3));
    video.finish();
    EXPECT_EQ(kindOfFile(at(longest + ".mp4")), FileKind::video);
}

TEST_F(OutputFiles, APipeIsNoInputThatIsWaitedFor) {
    ASSERT_EQ(mkfifo(at("pipe").c_str(), 0600), 0);
    try {
        readWholeFile(at("pipe"));
        ADD_FAILURE();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::input);
        EXPECT_THAT(error.what(), HasSubstr("is a pipe"));
    }
}

}  // namespace
}  // namespace eyrie::output_files_test

#include "scoring/scoring.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "store/labels/annotation_store.h"
#include "support/error_message.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::scoring_test {
namespace {

using testing::AnyOf;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A car that drives in frames 10 to 19, in a file or as labels of a project.
class ScoringTest : public testing::Test {
 protected:
    static OrientedBox boxIn(int frame, double heading) { return {{50.0 + 4 * frame, 40}, 20, 10, heading}; }
    static GroundTruth truth(double heading) {
        GroundTruth truth;
        truth.name = "t.csv";
        for (int frame = 10; frame < 20; ++frame) {
            BoxRecord record;
            record.frame = frame;
            record.box = boxIn(frame, heading);
            truth.boxes[frame] = {record};
        }
        return truth;
    }
    std::filesystem::path write(const std::string& name, const std::string& text) const {
        std::ofstream(folder / name) << text;
        return folder / name;
    }
    std::filesystem::path project() const { return folder / "p.eyrie"; }
    /// Over 20 frames, in which the camera moves by `step` px a frame.
    RunRecord writeRun(double step) const {
        return test::writeRun(project(), 20, [&](int frame, FrameResult& result) {
            result.motion.registration.current_from_previous.matrix(0, 2) = frame % 2 == 0 ? -step : step;
        });
    }
    void label() const {
        ProjectFile file = ProjectFile::open(project());
        AnnotationStore store(file, sequencesOf(file).front().id);
        LabelledObject object;
        object.id = store.newObjectId();
        object.keyframes = {{.frame = 10, .box = boxIn(10, 0.5)}, {.frame = 18, .box = boxIn(10, 0.5)}};
        object.last_frame = 18;
        AnnotationEdit edit;
        edit.name = "draw";
        edit.objects.push_back({std::nullopt, object});
        store.apply(edit);
    }
    GroundTruth labels(const RunRecord& run) const {
        ProjectFile file = ProjectFile::open(project(), ProjectFile::Mode::read_only);
        return readGroundTruth({}, file, run);
    }

    const test::TemporaryFolder folder;
};

TEST_F(ScoringTest, onlyFramesThatTheResultCoversCount) {
    const Scoring all = scoringOf(truth(0.5), {}, std::nullopt);
    EXPECT_EQ(all.truth.boxes.size(), 10U);
    EXPECT_THAT(all.truth.remarks, IsEmpty());
    const Scoring some = scoringOf(truth(0.5), {}, ScoredFrames{15, 40});
    EXPECT_EQ(some.truth.boxes.size(), 5U);
    EXPECT_THAT(some.truth.remarks, ElementsAre(HasSubstr("covers frames 15 to 40, so 5 of 10")));
}

TEST_F(ScoringTest, aTruthOfOtherFramesIsRefused) {
    const auto messageOf = [](GroundTruth truth) {
        try {
            scoringOf(std::move(truth), {}, ScoredFrames{100, 200});
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input);
            return std::string(error.what());
        }
        return std::string();
    };
    const std::string beginning = "t.csv: holds no box in the frames to be measured, 100 to 200, ";
    EXPECT_THAT(messageOf(truth(0.5)), HasSubstr(beginning + "only in frames 10 to 19"));
    GroundTruth empty = truth(0.5);
    empty.boxes = {{150, {}}};
    EXPECT_THAT(messageOf(empty), HasSubstr(beginning + "none at all"));
}

TEST_F(ScoringTest, uprightBoxesAreComparedWhereThereAreNoHeadings) {
    GroundTruth without = truth(0);
    without.has_headings = false;
    const Scoring scoring = scoringOf(without, {}, std::nullopt);
    EXPECT_TRUE(scoring.options.upright);
    EXPECT_THAT(scoring.truth.remarks, ElementsAre(HasSubstr("no headings, so enclosing upright boxes")));
    const Scoring upright = scoringOf(truth(0), {}, std::nullopt);
    EXPECT_FALSE(upright.options.upright);
    EXPECT_THAT(upright.truth.remarks, ElementsAre(HasSubstr("if they have no headings")));
    EvaluationOptions wishes;
    wishes.upright = true;
    EXPECT_THAT(scoringOf(without, wishes, std::nullopt).truth.remarks, IsEmpty());
}

TEST_F(ScoringTest, aFormatWithoutHeadingsIsKnownByItsName) {
    const GroundTruth mot = readGroundTruth({write("gt.txt", "1,1,41.5,36.5,20,10,1,3,1\n")}, std::nullopt);
    EXPECT_FALSE(mot.has_headings);
    EXPECT_NEAR(mot.boxes.at(0).front().box.centre.x, 50, 1e-9);
    const GroundTruth shifted = readGroundTruth({folder / "gt.txt", 0}, std::nullopt);
    EXPECT_NEAR(shifted.boxes.at(0).front().box.centre.x, 51, 1e-9);
    const auto csv = write("t.csv", "frame,id,x,y,length,width,heading\n0,1,50,40,20,10,0\n");
    EXPECT_TRUE(readGroundTruth({csv}, std::nullopt).has_headings);
}

TEST_F(ScoringTest, filesThatCannotBeTheTruthAreRefused) {
    EXPECT_THROW(readGroundTruth({folder / "absent.csv"}, std::nullopt), Error);
    EXPECT_THROW(readGroundTruth({write("none.csv", "frame,id,x,y,length,width,heading\n")}, std::nullopt), Error);
}

TEST_F(ScoringTest, aTableOfNumbersIsTruthOrResultAsItIsAskedFor) {
    // The seventh number is a mark in truth, where 0 is to be left out, and a score in results.
    const auto table = write("numbers.txt", "1,7,41.5,36.5,20,10,0,-1,-1,-1\n2,7,41.5,36.5,20,10,0.5,-1,-1,-1\n");
    const BoxesByFrame result = readResultBoxes({table});
    ASSERT_EQ(result.size(), 2U);
    EXPECT_FALSE(result.at(0).front().ignore);
    EXPECT_EQ(result.at(1).front().score, 0.5);
    const GroundTruth truth = readGroundTruth({table}, std::nullopt);
    EXPECT_FALSE(truth.has_headings);
    EXPECT_EQ(truth.boxes.size(), 2U);
}

TEST_F(ScoringTest, errorsOfATableOfNumbersAreToldByTheirLine) {
    const auto messageOf = [&](const std::string& text, bool as_result) {
        const auto file = write("broken.txt", text);
        try {
            if (as_result)
                readResultBoxes({file});
            else
                readGroundTruth({file}, std::nullopt);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    for (const bool as_result : {false, true}) {
        // Whatever digit comes first, behind empty lines and blanks.
        for (const std::string first : {"0", "1", "5", "9"}) {
            const std::string row = first + ",1,41.5,here,20,10,1\n";
            EXPECT_THAT(messageOf(row, as_result), HasSubstr("broken.txt:1:")) << row;
            EXPECT_THAT(messageOf("\n \t\r\n \t" + row, as_result), HasSubstr("broken.txt:3:")) << row;
        }
        for (const std::string other : {"about,1,41.5\n", "12 cars\n", "-1,1,41.5,here\n", ":1,2\n", "\n\n", ""})
            EXPECT_THAT(messageOf(other, as_result), AnyOf(HasSubstr("matches no known format"), HasSubstr("is empty")))
                << other;
    }
}

TEST_F(ScoringTest, foldersAndMissingFilesAreToldAsSuch) {
    const auto messagesOf = [&](const std::filesystem::path& file) {
        return std::vector{test::messageOf([&] { readGroundTruth({file}, std::nullopt); }),
                           test::messageOf([&] { readResultBoxes({file}); })};
    };
    std::filesystem::create_directories(folder / "pictures");
    EXPECT_THAT(messagesOf(folder / "pictures"), Each(HasSubstr("pictures: the folder matches no known label format")));
    EXPECT_THAT(messagesOf(folder / "absent.txt"), Each(HasSubstr("absent.txt")));
    EXPECT_THAT(messagesOf(folder / "absent.txt"), Each(Not(HasSubstr("format"))));
}

TEST_F(ScoringTest, howATruthWasReadIsToldWhereThatIsNotPlain) {
    const std::string table = "1,1,41.5,36.5,20,10,1,3,1\n";
    EXPECT_THAT(readGroundTruth({write("gt.txt", table)}, std::nullopt).remarks, IsEmpty());
    // A file beside it was read, too.
    std::filesystem::create_directories(folder / "clip");
    const auto beside = write("clip/gt.txt", table);
    write("clip/seqinfo.ini", "imWidth=320\nimHeight=240\n");
    EXPECT_THAT(readGroundTruth({beside}, std::nullopt).remarks,
                ElementsAre(beside.string() + " was read as MOTChallenge ground truth together with seqinfo.ini"));
    // Something was odd.
    const auto odd = write("odd.csv",
                           "1,a.png,0,10,10,30,20,1,-1,car,1,(note) seen twice\n"
                           "1,b.png,1,10,10,30,20,1,-1,car,1\n");
    EXPECT_THAT(readGroundTruth({odd}, std::nullopt).remarks,
                ElementsAre(odd.string() + " was read as VIAME CSV (DIVE)", HasSubstr("1 entry of other kinds")));
}

TEST_F(ScoringTest, aRunCoversTheFramesThatItHasDone) {
    RunRecord run;
    run.first_frame = 40;
    run.last_frame = 99;
    run.frames_done = 10;
    EXPECT_EQ(coveredFrames(run), ScoredFrames(40, 49));
    const Scoring whole = scoringOf(truth(0.5), {}, ScoredFrames{10, 19});
    EXPECT_THAT(whole.truth.remarks, IsEmpty()) << "nothing was left out";
    EXPECT_EQ(scoringOf(truth(0.5), {}, ScoredFrames{19, 30}).truth.boxes.size(), 1U);
    EXPECT_EQ(scoringOf(truth(0.5), {}, ScoredFrames{0, 10}).truth.boxes.size(), 1U);
}

TEST_F(ScoringTest, labelsGoOverTheGroundAsTheRunRegisteredIt) {
    const RunRecord shaking = writeRun(6);
    const RunRecord standing = writeRun(0);
    label();
    EXPECT_NEAR(labels(standing).boxes.at(11).front().box.centre.x, 90, 0.01);
    EXPECT_NEAR(labels(shaking).boxes.at(11).front().box.centre.x, 96, 0.01);
    EXPECT_TRUE(labels(standing).boxes.at(3).empty()) << "a frame without objects is labelled, too";
    EXPECT_EQ(labels(standing).boxes.size(), 20U);
    EXPECT_THAT(labels(standing).name, HasSubstr("labels of the project"));
}

TEST_F(ScoringTest, aVideoThatNobodyLabelledSaysSo) {
    const RunRecord run = writeRun(0);
    try {
        labels(run);
        FAIL();
    } catch (const NothingLabelled& error) {
        EXPECT_EQ(error.kind(), ErrorKind::project);
        EXPECT_THAT(error.what(), HasSubstr("nobody has labelled /nowhere/clip.mp4 yet. Draw or import"));
    }
}

}  // namespace
}  // namespace eyrie::scoring_test

#include "diagnosis/run_evaluation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/error.h"
#include "diagnosis/error_csv.h"
#include "store/labels/annotation_store.h"
#include "support/temporary_folder.h"
#include "support/written_run.h"

namespace eyrie::run_evaluation_test {
namespace {

using testing::HasSubstr;

/// A project with two runs over the same ten frames. A car drives through all of them; the first run follows it in
/// frames 0 to 7, the second one in 0 to 3.
class RunEvaluations : public testing::Test {
 protected:
    RunEvaluations() {
        writeRun(8);
        writeRun(4);
    }
    std::filesystem::path path() const { return folder / "p.eyrie"; }
    void writeRun(int followed) const {
        test::writeRun(path(), 10, [&](int frame, FrameResult& result) {
            if (frame >= followed) return;
            TrackState track;
            track.id = 5;
            track.box = boxIn(frame);
            track.status = TrackStatus::confirmed;
            result.tracks.push_back(track);
        });
    }
    static OrientedBox boxIn(int frame) { return {{50.0 + 4 * frame, 40}, 20, 10, 0}; }
    void label() const {
        ProjectFile project = ProjectFile::open(path());
        AnnotationStore store(project, sequencesOf(project).front().id);
        LabelledObject object;
        object.id = store.newObjectId();
        object.keyframes = {{.frame = 0, .box = boxIn(0)}, {.frame = 9, .box = boxIn(9)}};
        object.last_frame = 9;
        AnnotationEdit edit;
        edit.name = "draw";
        edit.objects.push_back({std::nullopt, object});
        store.apply(edit);
    }
    std::filesystem::path truthFile(int first = 0, int last = 9) const {
        std::ofstream file(folder / "truth.csv");
        file << "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int frame = first; frame <= last; ++frame)
            file << frame << ",1," << 50 + 4 * frame << ",40,20,10,0,car,0\n";
        return folder / "truth.csv";
    }
    EvaluationRequest request(std::filesystem::path file = {}) const {
        EvaluationRequest wanted;
        wanted.project = path();
        wanted.run_id = 1;
        wanted.truth.file = std::move(file);
        return wanted;
    }
    static std::string messageOf(RunEvaluator& evaluator, const EvaluationRequest& wanted) {
        try {
            evaluator.evaluate(wanted);
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }

    const test::TemporaryFolder folder;
    RunEvaluator evaluator;
};

TEST_F(RunEvaluations, againstTheProjectsLabels) {
    label();
    const auto e = evaluator.evaluate(request());
    ASSERT_TRUE(e);
    ASSERT_EQ(e->table.size(), 3u);
    EXPECT_EQ(e->table[0].detection.true_positives, 8);
    EXPECT_EQ(e->table[0].detection.false_negatives, 2);
    ASSERT_EQ(e->errors.size(), 2u);
    EXPECT_EQ(e->errors[0].error.kind, ResultErrorKind::miss);
    EXPECT_EQ(e->errors[0].cause, ErrorCause::no_corners);
    EXPECT_EQ(e->errors[1].error.kind, ResultErrorKind::fragment);
    ASSERT_EQ(e->frames.size(), 10u);
    EXPECT_EQ(e->frames[8].missed, 1);
    EXPECT_EQ(e->frames[7].found, 1);
    EXPECT_NEAR(e->f_score.value, e->shown.detection.f_score, 1e-12);
}

TEST_F(RunEvaluations, againstAFileAndAnotherRun) {
    EvaluationRequest wanted = request(truthFile());
    wanted.other_run = 2;
    const auto e = evaluator.evaluate(wanted);
    EXPECT_EQ(e->shown.detection.true_positives, 8);
    ASSERT_TRUE(e->difference);
    // F-scores 2·8 / (2·8 + 2) and 2·4 / (2·4 + 6).
    EXPECT_NEAR(e->difference->difference.f_score.value, 16.0 / 18 - 8.0 / 14, 1e-9);
    wanted.run_id = 2;
    wanted.other_run.reset();
    EXPECT_EQ(evaluator.evaluate(wanted)->shown.detection.true_positives, 4);
}

TEST_F(RunEvaluations, labelsAreReadAgainAfterAChange) {
    label();
    EXPECT_EQ(evaluator.evaluate(request())->shown.detection.ground_truth, 10);
    label();  // a second object on the same place, which only one of them can have
    const auto e = evaluator.evaluate(request());
    EXPECT_EQ(e->shown.detection.ground_truth, 20);
    EXPECT_EQ(e->shown.detection.false_negatives, 12);
}

TEST_F(RunEvaluations, whatCannotBeComparedSaysWhatToDo) {
    EXPECT_THAT(messageOf(evaluator, request()), HasSubstr("Draw or import labels"));
    EXPECT_THAT(messageOf(evaluator, request(truthFile(100, 120))), HasSubstr("frames 100 to 120"));
    EXPECT_THAT(messageOf(evaluator, request(folder / "missing.csv")), HasSubstr("missing.csv"));
    std::ofstream(folder / "bad.csv") << "frame,id,x,y,length,width,heading\n1,2,abc,4,5,6,7\n";
    EXPECT_THAT(messageOf(evaluator, request(folder / "bad.csv")), HasSubstr("bad.csv:2"));
    EvaluationRequest wanted = request(truthFile());
    wanted.run_id = 17;
    EXPECT_THAT(messageOf(evaluator, wanted), HasSubstr("no run 17"));
    wanted = request(truthFile());
    wanted.options.overlap = 0;
    EXPECT_THAT(messageOf(evaluator, wanted), HasSubstr("overlap"));
}

TEST_F(RunEvaluations, aTruthThatIsLongerThanTheRunIsCut) {
    const auto e = evaluator.evaluate(request(truthFile(0, 30)));
    EXPECT_EQ(e->frames.size(), 10u);
    EXPECT_THAT(e->remarks.front(), HasSubstr("21 of 31"));
}

TEST_F(RunEvaluations, aRequestedStopAnswersNothing) {
    std::stop_source stop;
    stop.request_stop();
    EXPECT_EQ(evaluator.evaluate(request(truthFile()), stop.get_token()), nullptr);
}

TEST_F(RunEvaluations, theListAsATable) {
    const auto e = evaluator.evaluate(request(truthFile()));
    writeErrorCsv(folder / "errors.csv", e->errors);
    std::ifstream file(folder / "errors.csv");
    std::string line;
    std::getline(file, line);
    EXPECT_EQ(
        line,
        "kind,first_frame,last_frame,count,objects,tracks,frame,x,y,length,width,heading,cause,detail,frames_of_cause");
    std::getline(file, line);
    EXPECT_EQ(line, "miss,8,9,2,1,,9,86,40,20,10,0,no corners,,2");
    EXPECT_THROW(writeErrorCsv(folder / "no" / "where.csv", e->errors), Error);
}

}  // namespace
}  // namespace eyrie::run_evaluation_test

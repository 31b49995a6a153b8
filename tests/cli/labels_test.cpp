#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "cli/loaded_program.h"
#include "store/labels/annotation_store.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::labels_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class LabelCommands : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder_ / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(at(name), std::ios::binary) << text;
        return at(name);
    }
    std::string textOf(const std::string& name) const {
        std::stringstream text;
        text << std::ifstream(at(name), std::ios::binary).rdbuf();
        return text.str();
    }
    static test::ProcessResult cli(const std::vector<std::string>& arguments) { return test::runLoaded(arguments); }
    static double xOf(int frame) { return 40 + 3.0 * frame - 0.25 * frame; }
    /// A car at constant speed over the ground for 30 frames, seen by a camera that moves by 0.25 px; and a van that
    /// hides in frames 10 to 14.
    std::string truth() const {
        std::string text = "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int frame = 0; frame < 30; ++frame) {
            const std::string number = std::to_string(frame);
            text += number + ",7," + std::to_string(xOf(frame)) + ",40,20,10,0,car,0\n";
            if (frame < 10 || frame > 14) {
                text += number + ",9," + std::to_string(30 - 0.25 * frame) + ",80,24,11,30,van," +
                        (frame > 19 ? "1\n" : "0\n");
            }
        }
        return write("truth.csv", text);
    }
    /// A project whose run followed the car.
    std::string project() const {
        RunRecord run;
        run.sequence = {.path = "/nowhere/clip.mp4", .size = {160, 120}, .frame_count = 30, .frame_rate_hz = 25};
        run.last_frame = 29;
        ProjectFile::openOrCreate(at("p.eyrie"));
        ResultWriter writer(at("p.eyrie"), run, {});
        for (int frame = 0; frame < 30; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.image_size = {160, 120};
            auto& registration = result.motion.registration;
            registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            registration.current_from_previous.from_frame = frame == 0 ? 0 : frame - 1;
            registration.current_from_previous.to_frame = frame;
            registration.current_from_previous.matrix(0, 2) = -0.25;
            TrackState track;
            track.id = 5;
            track.box = {{xOf(frame), 40}, 20, 10, 0};
            track.status = TrackStatus::confirmed;
            result.tracks.push_back(track);
            writer.write(result);
        }
        writer.finish(RunState::finished, "");
        return at("p.eyrie");
    }
    AnnotationSet labelsOf(const std::string& path) const {
        ProjectFile file = ProjectFile::open(path, ProjectFile::Mode::read_only);
        return readAnnotations(file, sequencesOf(file).front().id);
    }
    test::TemporaryFolder folder_;
};

TEST_F(LabelCommands, ShowOnlyShows) {
    const std::string path = project();
    const auto shown = cli({"import", truth(), "--project", path, "--show", "--class-map", "van=truck"});
    EXPECT_EQ(shown.exit_code, 0) << shown.errors;
    EXPECT_THAT(shown.output, AllOf(HasSubstr("format      native"), HasSubstr("30 frames with boxes, 0 to 29"),
                                    HasSubstr("ids         2, 7 to 9"), HasSubstr("car 30, truck 25"),
                                    HasSubstr("10 ignored"), HasSubstr("tracks of run 1 fit best as it is")));
    EXPECT_TRUE(labelsOf(path).objects.empty());
    const auto late = cli({"import", truth(), "--project", path, "--show", "--shift", "3"});
    EXPECT_THAT(late.output, HasSubstr("--shift -3 more"));
}

TEST_F(LabelCommands, ARateThatNobodySaidStaysOneInAProjectThatImportMakes) {
    std::filesystem::create_directories(at("images"));
    for (int frame = 0; frame < 3; ++frame)
        cv::imwrite(at("images/" + std::to_string(frame) + ".png"), cv::Mat(60, 80, CV_8UC1, cv::Scalar(90)));
    const std::string table = write("gt.csv",
                                    "frame,id,x,y,length,width,heading,class,ignore\n0,1,40,30,20,10,0,car,0\n"
                                    "2,1,42,30,20,10,0,car,0\n");
    const auto done = cli({"import", table, "--project", at("new.eyrie"), "--video", at("images")});
    ASSERT_EQ(done.exit_code, 0) << done.errors;
    ProjectFile file = ProjectFile::open(at("new.eyrie"), ProjectFile::Mode::read_only);
    EXPECT_TRUE(sequencesOf(file).front().rate_assumed);
}

TEST_F(LabelCommands, ImportMakesFewKeyframesAndOneStep) {
    const std::string path = project();
    const auto done = cli({"import", truth(), "--project", path});
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    EXPECT_THAT(done.output, HasSubstr("2 objects with"));
    const AnnotationSet labels = labelsOf(path);
    ASSERT_EQ(labels.objects.size(), 2u);
    const LabelledObject& car = labels.objects.at(7);
    EXPECT_LE(car.keyframes.size(), 2u);  // constant speed over the ground
    EXPECT_EQ(car.last_frame, 29);
    EXPECT_EQ(car.origin, ObjectOrigin::imported);
    const LabelledObject& van = labels.objects.at(9);
    EXPECT_LE(van.keyframes.size(), 6u);  // stands; a gap, a flag
    const auto outside =
        std::find_if(van.keyframes.begin(), van.keyframes.end(), [](const Keyframe& k) { return k.outside; });
    ASSERT_NE(outside, van.keyframes.end());
    EXPECT_EQ(outside->frame, 10);
    ProjectFile file = ProjectFile::open(path);
    AnnotationStore store(file, sequencesOf(file).front().id);
    EXPECT_EQ(store.undoCount(), 1);
    EXPECT_EQ(store.undoName(), "Import 2 objects");
    store.undo();
    EXPECT_TRUE(store.annotations().objects.empty());
}

TEST_F(LabelCommands, LabelsComeOutAsTheyWentIn) {
    const std::string path = project();
    ASSERT_EQ(cli({"import", truth(), "--project", path}).exit_code, 0);
    const auto out = cli({"export", "--project", path, "--labels", "--format", "native", "--out", at("back.csv")});
    EXPECT_EQ(out.exit_code, 0) << out.errors;
    EXPECT_THAT(out.output, HasSubstr("55 boxes written as native"));
    const auto measured =
        cli({"evaluate", "--ground-truth", at("truth.csv"), "--result", at("back.csv"), "--overlap", "0.9"});
    EXPECT_EQ(measured.exit_code, 0) << measured.errors;
    EXPECT_THAT(measured.output, HasSubstr("FN                            0"));
    EXPECT_THAT(measured.output, HasSubstr("ignored results              10"));
    // again: it is there already
    const auto twice = cli({"import", at("back.csv"), "--project", path});
    EXPECT_EQ(twice.exit_code, 0) << twice.errors;
    EXPECT_THAT(twice.output,
                AllOf(HasSubstr("2 objects or regions are labelled already"), HasSubstr("--add-doubles")));
    EXPECT_EQ(labelsOf(path).objects.size(), 2u);
    // all the same: what is there stays, ids are new
    ASSERT_EQ(cli({"import", at("back.csv"), "--project", path, "--tolerance", "0", "--add-doubles"}).exit_code, 0);
    const AnnotationSet labels = labelsOf(path);
    EXPECT_EQ(labels.objects.size(), 4u);
    EXPECT_TRUE(labels.objects.contains(7));
    EXPECT_TRUE(labels.objects.contains(10));
    EXPECT_EQ(labels.objects.at(10).keyframes.size(), 30u);
}

TEST_F(LabelCommands, EveryFormatGoesOutAndComesBack) {
    for (const std::string format : {"native", "native-result", "mot", "mot-result", "trackeval", "cvat", "coco",
                                     "kwcoco", "dota", "yolo-obb", "visdrone", "kw18", "virat", "viame", "vivid"}) {
        const auto out = cli({"export", "--from", truth(), "--format", format, "--out", at(format), "--size", "160x120",
                              "--name", "clip"});
        EXPECT_EQ(out.exit_code, 0) << format << out.errors;
        EXPECT_THAT(out.output, HasSubstr("55 boxes written as " + format));
        const auto back = cli({"import", at(format), "--show"});
        EXPECT_EQ(back.exit_code, 0) << format << back.errors;
        EXPECT_THAT(back.output, HasSubstr("boxes       55:")) << format;
    }
}

TEST_F(LabelCommands, LossesAreSaid) {
    const auto out = cli({"export", "--from", truth(), "--format", "kw18", "--out", at("t.kw18")});
    EXPECT_THAT(out.output,
                AllOf(HasSubstr("lost        25 boxes lost their rotation"), HasSubstr("55 boxes lost their class"),
                      HasSubstr("10 boxes are ignored, which was not kept")));
}

TEST_F(LabelCommands, TracksOfRunsMakeATrackEvalTree) {
    const std::string path = project();
    ASSERT_EQ(
        cli({"export", "--from", truth(), "--format", "trackeval", "--out", at("data"), "--name", "clip"}).exit_code,
        0);
    const auto out =
        cli({"export", "--project", path, "--format", "trackeval", "--tracker", "eyrie", "--out", at("data")});
    EXPECT_EQ(out.exit_code, 0) << out.errors;
    EXPECT_THAT(textOf("data/trackers/mot_challenge/EYRIE-train/eyrie/data/clip.txt"), HasSubstr("1,1,31.5,"));
    EXPECT_THAT(textOf("data/gt/mot_challenge/EYRIE-train/clip/seqinfo.ini"), HasSubstr("seqLength=30\n"));
    EXPECT_EQ(cli({"export", "--project", path, "--run", "4", "--format", "kw18", "--out", at("x")}).exit_code, 2);
}

TEST_F(LabelCommands, OwnColumnsConvert) {
    const std::string table = write("dark.txt", "0,2,1,10,20,30,40,2,50,20,30,40\n1,1,1,12,20,30,40\n");
    const auto done =
        cli({"import", table, "--columns", "frame,n,[id,x,y,w,h]", "--class-map", "=car", "--out", at("own.csv")});
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    EXPECT_THAT(textOf("own.csv"),
                AllOf(HasSubstr("0,1,24.5,39.5,30,40,0,car,0"), HasSubstr("1,1,26.5,39.5,30,40,0,car,0")));
    const auto back = cli({"export", "--from", at("own.csv"), "--format", "columns", "--columns",
                           "frame,n,[id,x,y,w,h]", "--out", at("dark2.txt")});
    EXPECT_EQ(back.exit_code, 0) << back.errors;
    EXPECT_EQ(textOf("dark2.txt"), textOf("dark.txt"));
}

TEST_F(LabelCommands, BoxesWithoutIdReachTheProject) {
    const std::string path = project();
    ASSERT_EQ(cli({"export", "--from", truth(), "--format", "coco", "--out", at("c.json")}).exit_code, 0);
    const auto single = cli({"import", at("c.json"), "--project", path});
    EXPECT_EQ(single.exit_code, 0) << single.errors;
    EXPECT_THAT(single.output, AllOf(HasSubstr("45 objects with"), HasSubstr("have no id"), HasSubstr("--link")));
    EXPECT_EQ(labelsOf(path).objects.size(), 45u);
    std::filesystem::remove(path);
    const auto linked = cli({"import", at("c.json"), "--project", project(), "--link"});
    EXPECT_EQ(linked.exit_code, 0) << linked.errors;
    EXPECT_EQ(labelsOf(path).objects.size(), 3u) << "the van hides once";
}

TEST_F(LabelCommands, ALabelsTextBesideMotCountsInEvaluateToo) {
    std::filesystem::create_directories(at("task/gt"));
    write("task/gt/gt.txt", "1,1,10,20,30,40,1,1,1.0\n2,1,12,20,30,40,1,1,1.0\n");
    write("task/gt/labels.txt", "car");
    write("r.csv",
          "frame,id,x,y,length,width,heading,class,ignore\n0,5,24.5,39.5,30,40,0,car,0\n"
          "1,5,26.5,39.5,30,40,0,car,0\n");
    const auto exact = cli({"evaluate", "--ground-truth", at("task/gt/gt.txt"), "--result", at("r.csv"), "--overlap",
                            "0.999", "--vehicles"});
    EXPECT_EQ(exact.exit_code, 0) << exact.errors;
    EXPECT_THAT(exact.output, HasSubstr("FN                            0"));
    const auto told = cli({"evaluate", "--ground-truth", at("task/gt/gt.txt"), "--result", at("r.csv"), "--overlap",
                           "0.999", "--vehicles", "--mot-origin", "1"});
    EXPECT_THAT(told.output, HasSubstr("FN                            2"));
}

TEST_F(LabelCommands, AFileWithoutAnyBoxSaysWhy) {
    const auto shown =
        cli({"import",
             write("n.json",
                   R"({"images":[{"id":1,"file_name":"a.png"}],"annotations":[{"id":1,"image_id":1,"bbox":[]}]})"),
             "--show"});
    EXPECT_EQ(shown.exit_code, 0) << shown.errors;
    EXPECT_THAT(shown.output, AllOf(HasSubstr("boxes       none"), HasSubstr("no bbox and no polygon")));
}

TEST_F(LabelCommands, WrongUseIsToldApart) {
    EXPECT_EQ(cli({"import", truth()}).exit_code, 2);
    EXPECT_EQ(cli({"import", at("absent.csv"), "--show"}).exit_code, 3);
    EXPECT_EQ(cli({"import", write("bad.txt", "prose\n"), "--show"}).exit_code, 3);
    EXPECT_EQ(cli({"import", truth(), "--show", "--class-map", "car"}).exit_code, 2);
    EXPECT_EQ(cli({"import", truth(), "--show", "--format", "nonsense"}).exit_code, 2);
    EXPECT_EQ(cli({"import", truth(), "--show", "--scale", "0"}).exit_code, 2);
    EXPECT_EQ(cli({"import", truth(), "--project", at("none.eyrie")}).exit_code, 5);
    EXPECT_EQ(cli({"export", "--format", "cvat", "--out", at("x")}).exit_code, 2);
    EXPECT_EQ(cli({"export", "--from", truth(), "--format", "cvat", "--out", at("no/where/x.xml")}).exit_code, 4);
    ProjectFile::openOrCreate(at("empty.eyrie"));
    EXPECT_EQ(cli({"import", truth(), "--project", at("empty.eyrie")}).exit_code, 5);
    EXPECT_EQ(
        cli({"export", "--project", at("empty.eyrie"), "--labels", "--format", "cvat", "--out", at("x")}).exit_code, 5);
}

TEST_F(LabelCommands, AProjectBeingLabelledElsewhereIsLeftAlone) {
    const std::string path = project();
    ProjectFile file = ProjectFile::open(path);
    const AnnotationStore window(file, sequencesOf(file).front().id);
    const auto refused = cli({"import", truth(), "--project", path});
    EXPECT_EQ(refused.exit_code, 4) << refused.output;
    EXPECT_FALSE(refused.errors.empty());
}

TEST_F(LabelCommands, RealUavdtGoesIntoAProjectAndOut) {
    EYRIE_NEED_SHARED_DATA("uavdt_m1303");
    const auto data = test::sharedData("uavdt_m1303");
    const auto done = cli({"import", (data / "gt" / "M1303_gt.txt").string(), "--project", at("u.eyrie"), "--video",
                           (data / "img1").string()});
    EXPECT_EQ(done.exit_code, 0) << done.errors;
    EXPECT_THAT(done.output, AllOf(HasSubstr("44 objects"), Not(HasSubstr("0 ignore regions"))));
    const auto out = cli({"export", "--project", at("u.eyrie"), "--labels", "--format", "uavdt", "--out", at("again")});
    EXPECT_EQ(out.exit_code, 0) << out.errors;
    const auto back = cli({"import", at("again_gt.txt"), "--show"});
    EXPECT_THAT(back.output, AllOf(HasSubstr("boxes       4734:"), HasSubstr("300 ignored"), HasSubstr("car 4434")));
}

}  // namespace
}  // namespace eyrie::labels_test

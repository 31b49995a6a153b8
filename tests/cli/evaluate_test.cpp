#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "cli/loaded_program.h"
#include "store/project/project_file.h"
#include "store/runs/result_writer.h"
#include "store/runs/run_store.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

namespace eyrie::evaluate_test {
namespace {

using testing::HasSubstr;
using testing::Not;

class Evaluate : public testing::Test {
 protected:
    std::string at(const std::string& name) const { return (folder / name).string(); }
    std::string write(const std::string& name, const std::string& text) const {
        std::ofstream(at(name)) << text;
        return at(name);
    }
    static test::ProcessResult evaluate(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), "evaluate");
        return test::runLoaded(arguments);
    }
    /// Two cars for four frames; the second one stands and is ignored.
    std::string truth() const {
        std::string text = "frame,id,x,y,length,width,heading,class,ignore\n";
        for (int frame = 0; frame < 4; ++frame) {
            text += std::to_string(frame) + ",1," + std::to_string(50 + 4 * frame) + ",40,20,10,0,car,0\n";
            text += std::to_string(frame) + ",i2,90,80,20,10,30,car,1\n";
        }
        return write("truth.csv", text);
    }
    /// A project whose run followed the first car through frames 0 to 2.
    std::string project() const {
        RunRecord run;
        run.sequence = {.path = "/nowhere/clip.mp4", .size = {160, 120}, .frame_count = 4, .frame_rate_hz = 25};
        run.last_frame = 3;
        ProjectFile::openOrCreate(at("p.eyrie"));
        ResultWriter writer(at("p.eyrie"), run, {});
        for (int frame = 0; frame < 3; ++frame) {
            FrameResult result;
            result.motion.frame = frame;
            result.motion.image_size = {160, 120};
            auto& registration = result.motion.registration;
            registration.state = frame == 0 ? RegistrationState::first : RegistrationState::registered;
            registration.current_from_previous.from_frame = frame == 0 ? 0 : frame - 1;
            registration.current_from_previous.to_frame = frame;
            registration.current_from_previous.matrix(0, 2) = 0.25;
            TrackState track;
            track.id = 5;
            track.box = {{50.0 + 4 * frame, 40}, 20, 10, 0};
            track.status = TrackStatus::confirmed;
            result.tracks.push_back(track);
            Detection detection;
            detection.box = track.box;
            result.detections = {detection, detection};
            result.detections[1].box.centre.y = 100;
            writer.write(result);
        }
        writer.finish(RunState::stopped, "");
        return at("p.eyrie");
    }

    const test::TemporaryFolder folder;
};

TEST_F(Evaluate, writesPrecisionAndRecallOverTheScore) {
    // The first car at .9, a false box at .4.
    std::string text = "frame,id,x,y,length,width,heading,score\n";
    for (int frame = 0; frame < 4; ++frame) {
        text += std::to_string(frame) + ",1," + std::to_string(50 + 4 * frame) + ",40,20,10,0,0.9\n";
        text += std::to_string(frame) + ",2,20,100,20,10,0,0.4\n";
    }
    const auto result =
        evaluate({"--ground-truth", truth(), "--result", write("result.csv", text), "--score-curve", at("curve.csv")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    std::stringstream curve;
    curve << std::ifstream(at("curve.csv")).rdbuf();
    EXPECT_EQ(curve.str(),
              "threshold,tracks,tp,fp,fn,precision,recall,f_score\n"
              "0.40000000000000002,2,4,4,0,0.500000,1.000000,0.666667\n"
              "0.90000000000000002,1,4,0,0,1.000000,1.000000,1.000000\n");
    const auto refused = evaluate({"--ground-truth", truth(), "--result", truth(), "--score-curve", truth()});
    EXPECT_EQ(refused.exit_code, 4) << "it would be overwritten";
}

TEST_F(Evaluate, tableNamesConventionAndMeasures) {
    const auto result = evaluate({"--ground-truth", truth(), "--result", truth(), "--overlap", "0.25"});
    EXPECT_EQ(result.exit_code, 0) << result.errors;
    EXPECT_THAT(result.output, HasSubstr("thesis (Teutsch §7.1)"));
    EXPECT_THAT(result.output, testing::ContainsRegex("T_ov +0.25\n"));
    EXPECT_THAT(result.output, testing::ContainsRegex("f-score +1.0000\n"));
    EXPECT_THAT(result.output, testing::ContainsRegex("MOTA +1.0000\n"));
    EXPECT_THAT(result.output, Not(HasSubstr("Note:")));
}

TEST_F(Evaluate, aProjectIsMeasuredOverTheFramesItsRunReached) {
    const auto result = evaluate({"--ground-truth", truth(), "--project", project(), "--json", "--homographies",
                                  write("h.csv",
                                        "frame,h00,h01,h02,h10,h11,h12,h20,h21,h22\n"
                                        "0,1,0,0,0,1,0,0,0,1\n1,1,0,0,0,1,0,0,0,1\n2,1,0,0,0,1,0,0,0,1\n")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    ASSERT_EQ(json["measures"].size(), 3u);
    EXPECT_EQ(json["measures"][2]["overlap"], 0.3);
    EXPECT_EQ(json["measures"][2]["tp"], 3);
    EXPECT_EQ(json["measures"][2]["fn"], 0);
    EXPECT_EQ(json["measures"][2]["mota"], 1.0);
    EXPECT_EQ(json["registration"]["frames"], 2);
    EXPECT_NEAR(json["registration"]["mean_px"].get<double>(), 0.25, 1e-9);
    EXPECT_THAT(json["remarks"].dump(), HasSubstr("covers frames 0 to 2"));
}

TEST_F(Evaluate, detectionsHaveNoTrackingMeasures) {
    const auto result = evaluate({"--ground-truth", truth(), "--project", project(), "--detections", "--json"});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    const auto json = nlohmann::json::parse(result.output);
    EXPECT_EQ(json["measures"][0]["tp"], 3);
    EXPECT_EQ(json["measures"][0]["fp"], 3);
    EXPECT_TRUE(json["measures"][0]["mota"].is_null());
    const auto table = evaluate({"--ground-truth", truth(), "--project", at("p.eyrie"), "--detections"});
    EXPECT_THAT(table.output, testing::ContainsRegex("MOTA +– +– +–\n"));
}

TEST_F(Evaluate, theListOfErrorsNamesCausesOfAStoredRun) {
    const auto result =
        evaluate({"--ground-truth", truth(), "--project", project(), "--detections", "--errors", at("errors.csv")});
    ASSERT_EQ(result.exit_code, 0) << result.errors;
    std::stringstream text;
    text << std::ifstream(at("errors.csv")).rdbuf();
    EXPECT_THAT(text.str(), HasSubstr("kind,first_frame,last_frame,count"));
    EXPECT_THAT(text.str(), HasSubstr("false alarm,0,"));
    const auto refused =
        evaluate({"--ground-truth", truth(), "--project", at("p.eyrie"), "--errors", at("no/where/errors.csv")});
    EXPECT_EQ(refused.exit_code, 4);
    EXPECT_THAT(refused.errors, HasSubstr("errors.csv"));
}

TEST_F(Evaluate, motChallengeTextIsRecognised) {
    const auto gt = write("gt.txt", "1,1,41.5,36.5,20,10,1,3,1\n2,1,45.5,36.5,20,10,1,3,1\n");
    const auto own = evaluate({"--ground-truth", gt, "--result", truth(), "--json"});
    ASSERT_EQ(own.exit_code, 0) << own.errors;
    const auto json = nlohmann::json::parse(own.output);
    EXPECT_EQ(json["measures"][0]["tp"], 2);
    EXPECT_NEAR(json["measures"][0]["n_modp"].get<double>(), 1, 1e-9);  // 41.5 + 20 / 2 − 1.5 = 50
    EXPECT_EQ(json["upright"], true);  // the result holds turned boxes, the truth cannot
    const auto trackeval = evaluate({"--ground-truth", gt, "--result", gt, "--convention", "trackeval"});
    EXPECT_THAT(trackeval.output, HasSubstr("trackeval"));
    EXPECT_THAT(trackeval.output, testing::ContainsRegex("HOTA +1.0000"));
}

TEST_F(Evaluate, theLabelsOfTheProjectAreTheTruthWhereNoneIsNamed) {
    const std::string path = project();
    const auto none = evaluate({"--project", path});
    EXPECT_EQ(none.exit_code, 5);
    EXPECT_THAT(none.errors, HasSubstr("nobody has labelled /nowhere/clip.mp4"));
    write("labels.csv",
          "frame,id,x,y,length,width,heading\n0,1,50,40,20,10,0\n1,1,54,40,20,10,0\n2,1,58,40,20,10,0\n"
          "3,1,62,40,20,10,0\n");
    const auto labels = test::runLoaded({"import", at("labels.csv"), "--project", path});
    ASSERT_EQ(labels.exit_code, 0) << labels.errors;
    const auto table = evaluate({"--project", path});
    EXPECT_EQ(table.exit_code, 0) << table.errors;
    EXPECT_THAT(table.output, HasSubstr("labels of the project " + path));
    const auto json = nlohmann::json::parse(
        evaluate({"--project", path, "--json", "--border", "3", "--errors", at("e.csv"), "--overlap", "0.3"}).output);
    EXPECT_EQ(json["measures"][0]["tp"], 3);
    EXPECT_EQ(json["measures"][0]["fn"], 0);
    EXPECT_TRUE(std::filesystem::exists(at("e.csv")));
    // A file that is named goes before them.
    EXPECT_THAT(evaluate({"--project", path, "--ground-truth", truth()}).output, HasSubstr("truth.csv"));
}

TEST_F(Evaluate, theTruthMayHaveAnyFormatThatImportReads) {
    write("plain.csv",
          "frame,id,x,y,length,width,heading,class\n0,1,50,40,20,10,0,car\n1,1,54,40,20,10,0,car\n"
          "2,1,58,40,20,10,0,car\n");
    const std::string path = project();
    for (const std::string format : {"cvat", "coco", "kwcoco", "dota", "yolo-obb", "visdrone", "uavdt", "kw18", "virat",
                                     "viame", "vivid", "trackeval", "mot"}) {
        write("video.csv", "");
        const std::string out = at(format + (format == "uavdt" ? "_gt.txt" : ""));
        write("seqinfo.ini", "[Sequence]\nimWidth=160\nimHeight=120\n");
        const auto made = test::runLoaded({"export", "--from", at("plain.csv"), "--format", format, "--out", out});
        ASSERT_EQ(made.exit_code, 0) << format << made.errors;
        std::filesystem::remove(at("seqinfo.ini"));
        const auto result = evaluate({"--ground-truth", out, "--project", path, "--json", "--overlap", "0.7"});
        ASSERT_EQ(result.exit_code, 0) << format << result.errors;
        const auto json = nlohmann::json::parse(result.output);
        EXPECT_EQ(json["measures"][0]["tp"], 3) << format;
        EXPECT_EQ(json["measures"][0]["fn"], 0) << format;
        EXPECT_EQ(json["measures"][0]["fp"], 0) << format;
    }
}

TEST_F(Evaluate, oneClassIsMeasuredAlone) {
    const std::string truth = write("both.csv",
                                    "frame,id,x,y,length,width,heading,class,ignore\n"
                                    "0,1,50,40,20,10,0,car,0\n0,2,50,90,10,4,0,motorcycle,0\n");
    const std::string result = write("named.csv",
                                     "frame,id,x,y,length,width,heading,class,score\n"
                                     "0,7,50,40,20,10,0,two_wheeler,1\n0,8,50,90,10,4,0,two_wheeler,1\n");
    const auto measured = [&](const std::string& classes) {
        const auto done =
            evaluate({"--ground-truth", truth, "--result", result, "--classes", classes, "--overlap", "0.5", "--json"});
        EXPECT_EQ(done.exit_code, 0) << done.errors;
        auto json = nlohmann::json::parse(done.output);
        EXPECT_EQ(json["classes"], classes);
        json = json["measures"][0];
        return std::vector<int>{json["tp"].get<int>(), json["fp"].get<int>(), json["fn"].get<int>()};
    };
    EXPECT_EQ(measured("all"), (std::vector<int>{2, 0, 0}));
    EXPECT_EQ(measured("two_wheelers"), (std::vector<int>{1, 0, 0})) << "what is on the car counts neither way";
    EXPECT_EQ(measured("vehicles"), (std::vector<int>{0, 0, 1})) << "the car was called something else";
    EXPECT_EQ(measured("persons"), (std::vector<int>{0, 0, 0}));
    EXPECT_THAT(evaluate({"--ground-truth", truth, "--result", result, "--classes", "two_wheelers"}).output,
                HasSubstr("two-wheelers only, without results of other classes"));
    const auto unknown = evaluate({"--ground-truth", truth, "--result", result, "--classes", "bikes"});
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.errors, AllOf(HasSubstr("bikes"), HasSubstr("two_wheelers")));
    EXPECT_EQ(evaluate({"--ground-truth", truth, "--result", result, "--classes", "persons", "--vehicles"}).exit_code,
              2);
}

TEST_F(Evaluate, theBorderFindsTheSizeOfTheImage) {
    const auto arguments = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"--ground-truth", truth(), "--result", truth(), "--border", "3"};
        all.insert(all.end(), more.begin(), more.end());
        return all;
    };
    const auto unknown = evaluate(arguments({}));
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.errors, HasSubstr("--size"));
    EXPECT_THAT(evaluate(arguments({"--size", "160x120"})).output, HasSubstr("3 px of the edge of 160x120"));
    EXPECT_EQ(evaluate(arguments({"--size", "160by120"})).exit_code, 2);
    write("meta.json", R"({"width": 320, "height": 224})");
    EXPECT_THAT(evaluate(arguments({})).output, HasSubstr("320x224"));
    write("meta.json", "{");
    EXPECT_EQ(evaluate(arguments({})).exit_code, 3);
    EXPECT_THAT(
        evaluate({"--ground-truth", truth(), "--project", project(), "--border", "3", "--size", "200x100"}).output,
        HasSubstr("200x100"));
}

TEST_F(Evaluate, filesThatDoNotMeetAreNoticed) {
    const auto far = write("far.csv", "frame,id,x,y,length,width,heading\n700,1,50,40,20,10,0\n");
    const auto result = evaluate({"--ground-truth", truth(), "--result", far});
    EXPECT_EQ(result.exit_code, 0);
    EXPECT_THAT(result.output, HasSubstr("no frame in common"));
}

TEST_F(Evaluate, wrongUseIsRefusedWithTheRemedy) {
    EXPECT_EQ(evaluate({"--result", truth()}).exit_code, 2);
    EXPECT_THAT(evaluate({"--result", truth()}).errors, HasSubstr("--ground-truth"));
    const auto neither = evaluate({"--ground-truth", truth()});
    EXPECT_EQ(neither.exit_code, 2);
    EXPECT_THAT(neither.errors, HasSubstr("--result FILE or --project FILE"));
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--result", truth(), "--project", "p"}).exit_code, 2);
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--result", truth(), "--run", "1"}).exit_code, 2);
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--result", truth(), "--overlap", "0"}).exit_code, 2);
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--result", truth(), "--overlap", "nan"}).exit_code, 2);
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--result", truth(), "--convention", "mine"}).exit_code, 2);
    const auto run = evaluate({"--ground-truth", truth(), "--project", project(), "--run", "7"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.errors, HasSubstr("holds run 1 alone"));
}

TEST_F(Evaluate, unreadableFilesAreRefusedWithTheirPlace) {
    EXPECT_EQ(evaluate({"--ground-truth", at("absent.csv"), "--result", truth()}).exit_code, 3);
    EXPECT_EQ(evaluate({"--ground-truth", folder.path().string(), "--result", truth()}).exit_code, 3);
    EXPECT_EQ(evaluate({"--ground-truth", write("empty.csv", ""), "--result", truth()}).exit_code, 3);
    EXPECT_EQ(evaluate({"--ground-truth", write("prose.txt", "Dear reader\n"), "--result", truth()}).exit_code, 3);
    const auto broken = evaluate({"--ground-truth", write("broken.txt", "1,1,10,ten,5,5\n"), "--result", truth()});
    EXPECT_EQ(broken.exit_code, 3);
    EXPECT_THAT(broken.errors, HasSubstr("broken.txt:1:8"));
    EXPECT_EQ(evaluate({"--ground-truth", truth(), "--project", write("no.eyrie", "no project")}).exit_code, 5);
}

}  // namespace
}  // namespace eyrie::evaluate_test

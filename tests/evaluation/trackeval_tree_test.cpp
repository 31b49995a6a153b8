#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "core/geometry/angle.h"
#include "evaluation/evaluate.h"
#include "formats/label_formats.h"
#include "formats/mot/motchallenge.h"
#include "support/shared_data.h"
#include "support/temporary_folder.h"

/// What TrackEval finds in an exported tree gives the figures of our own evaluation.
namespace eyrie::trackeval_tree_test {
namespace {

constexpr double kSame = 1e-6;

/// Vehicles of all directions that turn slowly, so that many boxes lie nearly along the axes; results are a little off.
struct Traffic {
    BoxesByFrame truth;
    BoxesByFrame result;
};

Traffic turningTraffic() {
    Traffic traffic;
    for (int frame = 0; frame < 40; ++frame) {
        for (int id = 1; id <= 12; ++id) {
            BoxRecord car;
            car.frame = frame;
            car.id = id * 3;
            car.object_class = "car";
            car.box.centre = {35.3 * id + 2.1 * frame, 50 + 20 * std::sin(0.1 * frame + id)};
            car.box.length = 17 + 0.31 * id;
            car.box.width = 8.13;
            car.box.heading = wrapPi(radiansFromDegrees(15.0 * id + 0.11 * frame - 1.5));
            car.ignore = id == 7 && frame > 20;
            traffic.truth[frame].push_back(car);
            if ((frame + id) % 9 == 0) continue;
            BoxRecord found = car;
            found.id = 100 + (frame > 25 ? (id + 1) % 12 : id);
            found.ignore = false;
            found.box.centre.x += 4.3 * std::sin(1.7 * frame + id);
            found.box.centre.y += 1.9 * std::cos(0.9 * frame + 2 * id);
            found.box.heading += 0.02 * std::sin(frame + id);
            traffic.result[frame].push_back(found);
        }
    }
    return traffic;
}

LabelFile fileOf(const BoxesByFrame& boxes, int frames) {
    LabelFile labels;
    labels.boxes = labelBoxes(boxes);
    labels.frame_count = frames;
    return labels;
}

class TrackEvalTree : public testing::Test {
 protected:
    std::filesystem::path root() const { return folder_ / "tree"; }
    /// Truth and result as TrackEval reads them in the tree.
    Traffic throughTree(const Traffic& traffic, int frames) {
        ExportOptions options;
        options.sequence = "clip";
        writeLabels(fileOf(traffic.truth, frames), root(), "trackeval", options);
        options.tracker = "ours";
        writeLabels(fileOf(traffic.result, frames), root(), "trackeval", options);
        return {plainBoxes(readMotTruth(root() / "gt/mot_challenge/EYRIE-train/clip/gt/gt.txt")),
                readMotResult(root() / "trackers/mot_challenge/EYRIE-train/ours/data/clip.txt")};
    }
    static EvaluationOptions options(double overlap, int frames) {
        EvaluationOptions options;
        options.overlap = overlap;
        options.convention = Convention::trackeval;
        options.frame_count = frames;
        return options;
    }
    test::TemporaryFolder folder_;
};

std::map<std::string, double> figures(const Measures& m) {
    return {{"MOTA", m.tracking.value().mota},        {"MOTP", m.tracking.value().motp},
            {"FP", m.detection.false_positives},      {"FN", m.detection.false_negatives},
            {"IDSW", m.tracking.value().id_switches}, {"IDF1", m.identity.value().idf1},
            {"HOTA", meanOf(m.hota.value().hota)},    {"LocA", meanOf(m.hota.value().loc_a)},
            {"AssA", meanOf(m.hota.value().ass_a)}};
}

TEST_F(TrackEvalTree, HoldsTheUprightBoxesThatEvaluateCompares) {
    const Traffic traffic = turningTraffic();
    const Traffic read = throughTree(traffic, 40);
    for (const double overlap : {0.3, 0.5, 0.7}) {
        EvaluationOptions upright = options(overlap, 40);
        upright.upright = true;
        const auto ours = figures(evaluate(traffic.truth, traffic.result, upright));
        const auto theirs = figures(evaluate(read.truth, read.result, options(overlap, 40)));
        EXPECT_LT(ours.at("MOTA"), 0.95) << "a test of something";
        EXPECT_GT(ours.at("IDF1"), 0.05);
        for (const auto& [name, value] : ours) EXPECT_NEAR(theirs.at(name), value, kSame) << name << " at " << overlap;
    }
}

TEST_F(TrackEvalTree, GivesTheFiguresThatTrackEvalRecorded) {
    EYRIE_NEED_SHARED_DATA("trackeval_parity");
    const auto folder = test::sharedData("trackeval_parity") / "noisy";
    const int frames = readMotSequence(folder / "seqinfo.ini").frame_count.value();
    const Traffic read =
        throughTree({plainBoxes(readMotTruth(folder / "gt.txt")), readMotResult(folder / "result.txt")}, frames);
    for (const std::string overlap : {"0.3", "0.5"}) {
        const auto recorded = nlohmann::json::parse(std::ifstream(folder / ("expected_iou_" + overlap + ".json")));
        const Measures m = evaluate(read.truth, read.result, options(std::stod(overlap), frames));
        EXPECT_NEAR(m.tracking.value().mota, recorded["CLEAR.MOTA"].get<double>(), kSame);
        EXPECT_NEAR(m.tracking.value().motp, recorded["CLEAR.MOTP"].get<double>(), kSame);
        EXPECT_NEAR(m.identity.value().idf1, recorded["Identity.IDF1"].get<double>(), kSame);
        EXPECT_NEAR(meanOf(m.hota.value().hota), recorded["HOTA.HOTA"].get<double>(), kSame);
        EXPECT_NEAR(meanOf(m.hota.value().ass_a), recorded["HOTA.AssA"].get<double>(), kSame);
        EXPECT_NEAR(m.tracking.value().id_switches, recorded["CLEAR.IDSW"].get<double>(), 0);
        EXPECT_NEAR(m.tracking.value().fragments, recorded["CLEAR.Frag"].get<double>(), 0);
    }
}

/// TrackEval ends with an exception for a frame behind the end; our evaluation leaves it out.
TEST_F(TrackEvalTree, ResultsBehindTheEndStayOutOfIt) {
    Traffic traffic = turningTraffic();
    traffic.truth.erase(traffic.truth.lower_bound(30), traffic.truth.end());
    const Traffic read = throughTree(traffic, 30);
    EXPECT_EQ(read.result.rbegin()->first, 29);
    EvaluationOptions upright = options(0.5, 30);
    upright.upright = true;
    const auto ours = figures(evaluate(traffic.truth, traffic.result, upright));
    const auto theirs = figures(evaluate(read.truth, read.result, options(0.5, 30)));
    for (const auto& [name, value] : ours) EXPECT_NEAR(theirs.at(name), value, kSame) << name;
}

TEST_F(TrackEvalTree, TheCommandNamesEverythingThatTrackEvalNeeds) {
    ExportOptions options;
    options.sequence = "clip";
    options.benchmark = "Own";
    options.split = "test";
    options.tracker = "my tracker";
    const ExportReport report =
        writeLabels(fileOf(turningTraffic().result, 40), folder_ / "a tree", "trackeval", options);
    std::string command;
    for (const std::string& note : report.notes)
        if (note.starts_with("run_mot_challenge.py")) command = note;
    const std::string place = (folder_ / "a tree").string();
    EXPECT_EQ(command, "run_mot_challenge.py --GT_FOLDER '" + place + "/gt/mot_challenge' --TRACKERS_FOLDER '" + place +
                           "/trackers/mot_challenge' --BENCHMARK Own --SPLIT_TO_EVAL test --TRACKERS_TO_EVAL "
                           "my_tracker --METRICS HOTA CLEAR Identity --DO_PREPROC False");
}

}  // namespace
}  // namespace eyrie::trackeval_tree_test

#include "sweep/sweep_runner.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "evaluation/evaluate.h"
#include "support/temporary_folder.h"
#include "sweep/results/sweep_report.h"
#include "sweep/results/sweep_table.h"
#include "sweep/sweep_scene.h"

namespace eyrie::sweep_runner_test {
namespace {

using testing::HasSubstr;

SweepTable swept(const SweepPlan& plan) {
    SweepTable table;
    table.plan = plan;
    SweepRunOptions options;
    options.on_point = [&](const SweepPoint& point) { table.points[point.position] = point.figures; };
    runSweep(plan, test::sweepInputs(), workOrder(plan), {}, options);
    return table;
}

/// A table with made-up f-scores of detections at one overlap.
SweepTable madeUp(const std::vector<std::string>& axes, const std::vector<double>& scores) {
    SweepTable table;
    table.plan = test::sweepPlan(axes);
    table.plan.overlaps = {0.1};
    for (std::size_t i = 0; i < scores.size(); ++i) {
        if (scores[i] < 0) continue;
        SweepFigures figures;
        figures.overlap = 0.1;
        figures.values = {{"f_score", scores[i]}, {"fp", 100 - 100 * scores[i]}};
        table.points[static_cast<int>(i)] = {figures};
    }
    return table;
}

}  // namespace

TEST(SweepRunner, MeasuresWhatSeparateEvaluationsMeasure) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.05,0.3", "tracking.min_overlap=0.05,0.4"});
    const SweepTable table = swept(plan);
    ASSERT_EQ(table.points.size(), 4U);
    EXPECT_TRUE(table.missing().empty());
    for (const auto& [position, figures] : table.points) {
        StageCache alone(test::sweepSource, {}, test::kSweepScale);
        const auto result = alone.run(plan.optionsOf(position), {});
        for (const SweepFigures& one : figures) {
            EvaluationOptions options;
            options.overlap = one.overlap;
            const Measures measures =
                evaluate(test::sweepTruth(), one.tracks ? *result->tracks : *result->detections, options);
            for (const NamedMeasure& m : listMeasures(measures)) {
                if (!one.tracks && isOfTracks(m.group)) continue;
                EXPECT_EQ(one.at(m.key), m.value) << plan.describe(position) << " " << m.key;
            }
        }
        EXPECT_EQ(figures.size(), 6U);
    }
    EXPECT_GT(valueAt(table, 0, {}).value(), 0.5);
}

TEST(SweepRunner, StopsAndTellsHowFarItCame) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.05:0.05:0.5"});
    const auto inputs = test::sweepInputs();
    std::stop_source stop;
    int points = 0;
    SweepProgress last;
    SweepRunOptions options;
    options.threads = 1;
    options.on_point = [&](const SweepPoint&) {
        if (++points == 3) stop.request_stop();
    };
    options.on_progress = [&](const SweepProgress& progress) { last = progress; };
    EXPECT_EQ(runSweep(plan, inputs, workOrder(plan), stop.get_token(), options), 3);
    EXPECT_EQ(points, 3);
    EXPECT_EQ(last.points_done, 3);
    EXPECT_EQ(last.points_total, 10);
    EXPECT_GT(last.seconds_left, 0);
}

TEST(SweepRunner, TellsWhatIsLeftFromTheSecondPointOn) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.05:0.05:0.2"});
    SweepRunOptions options;
    options.threads = 1;
    int told = 0;
    options.on_progress = [&](const SweepProgress& progress) {
        if (progress.points_done < 2) {
            EXPECT_EQ(progress.points_per_second, 0);
            EXPECT_EQ(progress.seconds_left, 0);
        } else {
            ++told;
            ASSERT_GT(progress.points_per_second, 0) << progress.points_done;
            EXPECT_NEAR(progress.seconds_left * progress.points_per_second, 4 - progress.points_done, 1e-9);
        }
    };
    runSweep(plan, test::sweepInputs(), workOrder(plan), {}, options);
    EXPECT_GT(told, 2);
}

TEST(SweepRunner, AnErrorOfWhoKeepsThePointsEndsIt) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.05:0.05:0.5"});
    SweepRunOptions options;
    int kept = 0;
    options.on_point = [&](const SweepPoint&) {
        if (++kept > 2) throw Error(ErrorKind::output, "the disk is full");
    };
    try {
        runSweep(plan, test::sweepInputs(), workOrder(plan), {}, options);
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::output);
    }
    EXPECT_EQ(kept, 3);
}

TEST(SweepTable, ResumesAndMergesToTheSameTable) {
    const test::TemporaryFolder folder;
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,4"});
    const auto inputs = test::sweepInputs();
    const auto run = [&](const std::filesystem::path& file, const std::vector<int>& positions, SweepFound found) {
        ProjectFile project = ProjectFile::openOrCreate(file);
        const int id = beginSweep(project, plan, "", found);
        SweepRunOptions options;
        options.on_point = [&](const SweepPoint& point) { storePoint(project, id, point); };
        runSweep(plan, inputs, positions, {}, options);
        return readSweep(project, id);
    };
    const SweepTable whole = run(folder / "whole.eyrie", workOrder(plan), SweepFound::refused);
    EXPECT_THROW(run(folder / "whole.eyrie", workOrder(plan), SweepFound::refused), Error);
    run(folder / "parts.eyrie", {0, 1, 2}, SweepFound::refused);
    const SweepTable resumed = run(folder / "parts.eyrie", {3, 4, 5}, SweepFound::resumed);
    EXPECT_EQ(csvText(resumed), csvText(whole));
    EXPECT_EQ(resumed.id, 1);

    for (int i = 1; i <= 3; ++i)
        run(folder / ("shard" + std::to_string(i) + ".eyrie"), shardOf(workOrder(plan), i, 3), SweepFound::resumed);
    const SweepTable two = mergeSweeps({folder / "shard3.eyrie", folder / "shard1.eyrie"}, folder / "m.eyrie");
    EXPECT_THAT(two.missing(), testing::ElementsAre(2, 3));
    EXPECT_EQ(listOf(plan, two.missing()),
              "gradient.quantile = 0.2, outliers.min_vectors = 2; gradient.quantile = 0.2, outliers.min_vectors = 4");
    const SweepTable all = mergeSweeps({folder / "shard2.eyrie"}, folder / "m.eyrie");
    EXPECT_EQ(csvText(all), csvText(whole));

    SweepPlan other = test::sweepPlan({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,5"});
    ProjectFile foreign = ProjectFile::openOrCreate(folder / "foreign.eyrie");
    beginSweep(foreign, other, "", SweepFound::refused);
    try {
        mergeSweeps({folder / "shard1.eyrie", folder / "foreign.eyrie"}, folder / "n.eyrie");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("not parts of one sweep: the values of outliers.min_vectors differ"));
    }
    EXPECT_FALSE(std::filesystem::exists(folder / "n.eyrie"));

    ProjectFile forged = ProjectFile::openOrCreate(folder / "forged.eyrie");
    const int id = beginSweep(forged, plan, "", SweepFound::refused);
    SweepStore(forged).addPoint(id, {0, 1, "[]"});
    EXPECT_THROW(mergeSweeps({folder / "shard1.eyrie", folder / "forged.eyrie"}, folder / "n.eyrie"), Error);
    SweepStore(forged).addPoint(id, {1, 1, "no figures"});
    EXPECT_THROW(readSweep(forged), Error);
    EXPECT_THROW(readSweep(forged, 9), Error);
}

TEST(SweepBest, FindsTheBestPointAndHowFarOneMayGo) {
    const SweepTable curve = madeUp({"gradient.quantile=0.1,0.2,0.3,0.4,0.5"}, {0.5, 0.795, 0.8, 0.799, 0.3});
    auto best = bestPoint(curve, {}, 0.01);
    ASSERT_TRUE(best);
    EXPECT_EQ(best->position, 2);
    EXPECT_DOUBLE_EQ(best->value, 0.8);
    EXPECT_EQ(best->neighbourhood.front(), std::make_pair(1, 3));
    EXPECT_THAT(bestText(curve, {}), HasSubstr("0.8000 at gradient.quantile = 0.3"));
    EXPECT_THAT(bestText(curve, {}), HasSubstr("gradient.quantile 0.2 to 0.4"));

    // Of equal ones the middle; missing points end a neighbourhood.
    best = bestPoint(madeUp({"gradient.quantile=0.1,0.2,0.3,0.4,0.5"}, {0.8, 0.8, 0.8, -1, 0.8}), {});
    EXPECT_EQ(best->position, 1);
    EXPECT_EQ(best->neighbourhood.front(), std::make_pair(0, 2));
    // For false alarms less is better.
    best = bestPoint(curve, {"fp", false, {}, {}});
    EXPECT_EQ(best->position, 2);

    const SweepTable grid =
        madeUp({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,3"}, {0.5, 0.6, 0.7, 0.9, 0.899, 0.2});
    best = bestPoint(grid, {});
    EXPECT_EQ(best->position, 3);
    EXPECT_EQ(best->neighbourhood[0], std::make_pair(1, 1));
    EXPECT_EQ(best->neighbourhood[1], std::make_pair(1, 1));
    EXPECT_FALSE(bestPoint(madeUp({"gradient.quantile=0.1"}, {}), {}));
    EXPECT_FALSE(bestPoint(curve, {"f_score", true, {}, {}}));
    EXPECT_THROW(bestPoint(curve, {"magic", false, {}, {}}), Error);
}

TEST(SweepBest, TracksAreJudgedWhereOnlyTheyChange) {
    EXPECT_FALSE(usualCriterion(test::sweepPlan({"gradient.quantile=0.1"})).tracks);
    EXPECT_FALSE(usualCriterion(test::sweepPlan({"gradient.quantile=0.1", "tracking.min_overlap=0.1"})).tracks);
    EXPECT_TRUE(usualCriterion(test::sweepPlan({"finishing.stop_speed=1", "tracking.min_overlap=0.1"})).tracks);
}

TEST(SweepBest, TradesPrecisionForRecall) {
    SweepTable table = madeUp({"gradient.quantile=0.1,0.2,0.3"}, {0, 0, 0});
    const std::vector<std::pair<double, double>> recall_precision{{0.2, 1.0}, {0.6, 0.8}, {1.0, 0.4}};
    for (int i = 0; i < 3; ++i) {
        const auto [recall, precision] = recall_precision[static_cast<std::size_t>(i)];
        table.points[i][0].values = {{"recall", recall}, {"precision", precision}, {"fp_per_frame", 3.0 * i}};
    }
    const TradeOffCurve curve = tradeOff(table, false, 0.1);
    ASSERT_EQ(curve.points.size(), 3U);
    EXPECT_DOUBLE_EQ(curve.points[2].false_per_frame, 6);
    EXPECT_NEAR(curve.precision_recall_area, 0.4 * 0.9 + 0.4 * 0.6, 1e-12);
}

TEST(SweepReport, EveryLineOfTheCsvHasEveryColumn) {
    const SweepTable table = swept(test::sweepPlan({"detection.method=gradient,clusters"}));
    const std::string csv = csvText(table);
    EXPECT_THAT(csv, testing::StartsWith("detection.method,sequence,of,overlap,ground_truth,tp,fp,fn"));
    std::istringstream lines(csv);
    std::string line;
    std::getline(lines, line);
    const auto commas = std::count(line.begin(), line.end(), ',');
    int count = 0;
    while (std::getline(lines, line)) {
        ++count;
        EXPECT_EQ(std::count(line.begin(), line.end(), ','), commas) << line;
    }
    EXPECT_EQ(count, 2 * 2 * 3);
    EXPECT_THAT(tableText(table, {}), HasSubstr("clusters"));
    EXPECT_THAT(jsonText(table, {}), HasSubstr("\"neighbourhood\""));
    const SweepTable grid = madeUp({"gradient.quantile=0.1,0.2", "outliers.min_vectors=2,3"}, {0.5, -1, 0.7, 0.9});
    EXPECT_THAT(tableText(grid, {}), HasSubstr("3 of 4 points are done"));
}

}  // namespace eyrie::sweep_runner_test

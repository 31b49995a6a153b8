#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/error.h"
#include "sweep/area_table.h"
#include "sweep/results/sweep_report.h"
#include "sweep/sweep_scene.h"

/// What a sweep is said to show, of made-up figures.
namespace eyrie::sweep_results_by_hand_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

SweepFigures figures(double f_score, bool tracks = false, double overlap = 0.1, int clip = 0) {
    SweepFigures made;
    made.clip = clip;
    made.tracks = tracks;
    made.overlap = overlap;
    made.values = {{"f_score", f_score}};
    return made;
}

/// Detections' f-scores in the order of positions; below 0: not done.
SweepTable tableOf(const std::vector<std::string>& axes, const std::vector<double>& scores) {
    SweepTable table;
    table.plan = test::sweepPlan(axes);
    table.plan.overlaps = {0.1};
    for (std::size_t i = 0; i < scores.size(); ++i)
        if (scores[i] >= 0) table.points[static_cast<int>(i)] = {figures(scores[i])};
    return table;
}

TEST(SweepResultsByHand, AValueIsTheMeanOverAllThatIsNotNamed) {
    SweepTable table = tableOf({"gradient.quantile=0.1,0.2"}, {});
    table.points[0] = {figures(0.2, false, 0.1, 0), figures(0.4, false, 0.2, 0), figures(0.6, false, 0.1, 1),
                       figures(0.8, false, 0.2, 1), figures(0.1, true, 0.1, 0)};
    EXPECT_NEAR(*valueAt(table, 0, {}), 0.5, 1e-12);
    EXPECT_NEAR(*valueAt(table, 0, {"f_score", false, 0.1, {}}), 0.4, 1e-12);
    EXPECT_NEAR(*valueAt(table, 0, {"f_score", false, {}, 1}), 0.7, 1e-12);
    EXPECT_NEAR(*valueAt(table, 0, {"f_score", false, 0.1, 1}), 0.6, 1e-12);
    EXPECT_NEAR(*valueAt(table, 0, {"f_score", true, {}, {}}), 0.1, 1e-12);
    EXPECT_FALSE(valueAt(table, 1, {})) << "not done";
    EXPECT_FALSE(valueAt(table, 0, {"f_score", false, 0.3, {}})) << "not measured";
    EXPECT_FALSE(valueAt(table, 0, {"recall", false, {}, {}}));
    table.points[0].push_back(figures(0.9));
    table.points[0].back().values.clear();
    EXPECT_FALSE(valueAt(table, 0, {})) << "not defined in a part of it";
}

TEST(SweepResultsByHand, TheNeighbourhoodIsFollowedAlongEachAxis) {
    // Within a hundredth of 0.8 is 0.792.
    const SweepTable grid = tableOf({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,3,4"},
                                    {0.5, 0.795, 0.5, 0.79, 0.8, 0.797, 0.5, 0.793, 0.6});
    const auto best = bestPoint(grid, {});
    ASSERT_TRUE(best);
    EXPECT_EQ(best->position, 4);
    EXPECT_THAT(best->neighbourhood, ElementsAre(std::pair(0, 2), std::pair(1, 2)));
    EXPECT_THAT(bestPoint(grid, {}, 0)->neighbourhood, ElementsAre(std::pair(1, 1), std::pair(1, 1)));
    EXPECT_THAT(bestPoint(grid, {}, 0.02)->neighbourhood, ElementsAre(std::pair(0, 2), std::pair(0, 2)));
    // A step that is too bad ends the way, whatever comes behind it.
    const auto split = bestPoint(tableOf({"gradient.quantile=0.1,0.2,0.3,0.4"}, {0.8, 0.1, 0.795, 0.79}), {});
    EXPECT_THAT(split->neighbourhood, ElementsAre(std::pair(0, 0)));
}

TEST(SweepResultsByHand, OfEqualPointsTheOneInTheMiddleOfTheWholeIsBest) {
    const SweepTable grid = tableOf({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,3,4"},
                                    {0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8, 0.8});
    EXPECT_EQ(bestPoint(grid, {})->position, 4);
    EXPECT_EQ(bestPoint(tableOf({"gradient.quantile=0.1,0.2"}, {0.8, 0.8}), {})->position, 0) << "the first of two";
    // Five that are equal, behind two that are not: the middle of the five.
    EXPECT_EQ(
        bestPoint(tableOf({"gradient.quantile=0.1,0.2,0.3,0.4,0.5,0.6,0.7"}, {0.1, 0.2, 0.8, 0.8, 0.8, 0.8, 0.8}), {})
            ->position,
        4);
}

TEST(SweepResultsByHand, ACurveIsFollowedAtOneValueOfTheOtherAxis) {
    SweepTable table = tableOf({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,3"}, {0, 0, 0, 0, 0, 0});
    const auto set = [&](int position, double recall, double precision) {
        table.points[position][0].values = {{"recall", recall}, {"precision", precision}, {"fp_per_frame", 2}};
    };
    set(1, 1.0, 0.4);
    set(3, 0.5, 0.4);
    set(5, 0.5, 0.8);
    const TradeOffCurve curve = tradeOff(table, false, 0.1, 1);
    ASSERT_EQ(curve.points.size(), 3U);
    EXPECT_EQ(curve.points[0].position, 1);
    EXPECT_EQ(curve.points[2].precision, 0.8);
    EXPECT_NEAR(curve.precision_recall_area, 0.5 * (0.8 + 0.4) / 2, 1e-12) << "of equal recall the best precision";
    EXPECT_TRUE(tradeOff(table, false, 0.1, 0).points.empty()) << "nothing was measured there";
    EXPECT_EQ(tradeOff(table, false, 0.1, 0).precision_recall_area, 0);
}

TEST(SweepResultsByHand, OneParameterIsATableOfALineEach) {
    SweepTable table = tableOf({"gradient.quantile=0.1,0.25"}, {0.5});
    table.points[0][0].values = {{"precision", 0.25}, {"recall", 1}, {"f_score", 0.5}};
    const std::string best = "best " + measureText("f_score").label +
                             " of detections at T_ov 0.1: 0.5000 at gradient.quantile = 0.1\n"
                             "within 1 % of it: gradient.quantile 0.1\n";
    EXPECT_EQ(bestText(table, {}), best);
    EXPECT_EQ(tableText(table, {}),
              "detections\n"
              "gradient.quantile   prec@0.1    rec@0.1      f@0.1   MOTA@0.1   IDF1@0.1       HOTA\n"
              "0.1                   0.2500     1.0000     0.5000          -          -          -\n"
              "0.25                       -          -          -          -          -          -   not done\n"
              "\n" +
                  best + "1 of 2 points are done\n");
}

TEST(SweepResultsByHand, TwoParametersAreAGrid) {
    SweepTable table = tableOf({"gradient.quantile=0.1,0.25", "outliers.min_vectors=2,3"}, {0.5, -1, 0.7, 0.9});
    EXPECT_THAT(tableText(table, {}), HasSubstr("\ngradient.quantile down, outliers.min_vectors across\n"
                                                "                2        3\n"
                                                "     0.1   0.5000        -\n"
                                                "    0.25   0.7000   0.9000\n\n"));
    EXPECT_THAT(table.missing(), ElementsAre(1));
    EXPECT_THAT(bestText(table, {}), HasSubstr("gradient.quantile 0.25, outliers.min_vectors 3\n"));
}

TEST(SweepResultsByHand, ListsNameTheFirstAndCountTheOthers) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2,0.3"});
    EXPECT_EQ(listOf(plan, {0, 2}, 2), "gradient.quantile = 0.1; gradient.quantile = 0.3");
    EXPECT_EQ(listOf(plan, {0, 1, 2}, 2), "gradient.quantile = 0.1; gradient.quantile = 0.2 and 1 more");
    EXPECT_EQ(listOf(plan, {}, 2), "");
}

TEST(SweepResultsByHand, DetectionsHaveNoMeasuresOfTracks) {
    const SweepFigures of_detections = figuresOf(Measures(), 0, false);
    for (const auto& [key, value] : of_detections.values) {
        EXPECT_NE(measureText(key).group, "tracking") << key;
        EXPECT_NE(measureText(key).group, "identity") << key;
    }
    Measures of_tracks;
    of_tracks.tracking = TrackingMeasures();
    EXPECT_EQ(figuresOf(of_tracks, 0, false).values.size(), of_detections.values.size());
    EXPECT_GT(figuresOf(of_tracks, 0, true).values.size(), of_detections.values.size());
}

TEST(ClipFramesByHand, ARangeLiesWithinTheVideo) {
    const std::size_t enough = 1U << 30U;
    const auto countOf = [&](FrameIndex first, FrameIndex last) {
        return ClipFrames(test::sweepSource, {first, last}, enough).count();
    };
    EXPECT_EQ(countOf(0, -1), test::kSweepFrames);
    EXPECT_EQ(countOf(0, test::kSweepFrames - 1), test::kSweepFrames);
    EXPECT_EQ(countOf(29, 29), 1);
    EXPECT_THROW(countOf(0, test::kSweepFrames), Error);
    EXPECT_THROW(countOf(-1, 3), Error);
    EXPECT_THROW(countOf(5, 4), Error);
}

TEST(ClipFramesByHand, FramesAreKeptWhereTheyFitToTheByte) {
    const std::size_t bytes = std::size_t{320} * 240 * 3;
    ClipFrames kept(test::sweepSource, {4, 6}, bytes);
    EXPECT_TRUE(kept.inMemory());
    ClipFrames read(test::sweepSource, {4, 6}, bytes - 1);
    EXPECT_FALSE(read.inMemory());
    ClipFrames::Reader reader = kept.reader();
    const cv::Mat first = reader.read(4).gray;
    EXPECT_EQ(reader.read(4).gray.data, first.data) << "the same, not a copy";
    EXPECT_EQ(reader.read(6).index, 6);
    EXPECT_EQ(read.reader().read(6).index, 6);
    EXPECT_EQ(cv::norm(read.reader().read(5).gray, reader.read(5).gray, cv::NORM_INF), 0);
}

TEST(AxisByHand, RangesAreCountedToTheirEnds) {
    EXPECT_EQ(countValues("a=1:1:3"), 3);
    EXPECT_EQ(countValues("a=3:-1:1"), 3);
    EXPECT_EQ(countValues("a=1:2:4"), 2);
    EXPECT_EQ(countValues("a=1:1:1"), 1);
    EXPECT_EQ(countValues("a=1:2"), 1) << "no range";
    EXPECT_EQ(countValues("a=x:1:3"), 0);
    EXPECT_THAT(parseAxis("outliers.min_vectors=1:2:8", {}).values, ElementsAre("1", "3", "5", "7"));
    EXPECT_THAT(parseAxis("gradient.quantile=0:0.5:1", {}).values, ElementsAre("0", "0.5", "1"));
    EXPECT_THROW(parseAxis("gradient.quantile=-0.5:0.5:1", {}), Error) << "the first value is too low";
    EXPECT_THROW(parseAxis("gradient.quantile=0:0.5:1.5", {}), Error) << "the last one is too high";
    EXPECT_THAT(parseAxis("stacking.enabled=0,1", {}).values, ElementsAre("false", "true"));
    EXPECT_THAT(parseAxis("stacking.enabled=yes,no", {}).values, ElementsAre("true", "false"));
}

TEST(PlanByHand, PositionsOfThreeByTwo) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,4"});
    EXPECT_THAT(plan.indicesOf(0), ElementsAre(0, 0));
    EXPECT_THAT(plan.indicesOf(1), ElementsAre(0, 1));
    EXPECT_THAT(plan.indicesOf(2), ElementsAre(1, 0));
    EXPECT_THAT(plan.valuesOf(3), ElementsAre("0.2", "4"));
    EXPECT_EQ(test::sweepPlan({}).pointCount(), 0);
}

TEST(PlanByHand, ShardsAreCutEvenlyAndInOrder) {
    const std::vector<int> order{9, 8, 7, 6, 5};
    EXPECT_THAT(shardOf(order, 1, 2), ElementsAre(9, 8));
    EXPECT_THAT(shardOf(order, 2, 2), ElementsAre(7, 6, 5));
    EXPECT_THAT(shardOf(order, 1, 1), ElementsAre(9, 8, 7, 6, 5));
    EXPECT_THROW(shardOf(order, 1, 0), Error);
    EXPECT_THROW(shardOf(order, 0, 1), Error);
    EXPECT_THROW(shardOf(order, 2, 1), Error);
}

TEST(AreaTableByHand, KeepsWhatFitsAndKnowsItByAllOfTheCluster) {
    MotionCluster cluster;
    cluster.box = {{10, 20}, 8, 4, 0.5};
    cluster.velocity = {1, 2};
    cluster.members = {3, 5};
    AreaTable<int> table(2, 10'000);
    table.keep(1, cluster, std::make_shared<const int>(7), 100);
    ASSERT_TRUE(table.find(1, cluster));
    EXPECT_EQ(*table.find(1, cluster), 7);
    EXPECT_FALSE(table.find(0, cluster)) << "another frame";
    MotionCluster other = cluster;
    other.members = {3, 6};
    EXPECT_FALSE(table.find(1, other));
    other = cluster;
    other.box.heading = 0.6;
    EXPECT_FALSE(table.find(1, other));
    const std::size_t before = table.bytes();
    table.keep(0, cluster, std::make_shared<const int>(8), 10'000);
    EXPECT_FALSE(table.find(0, cluster)) << "more than may be kept";
    EXPECT_EQ(table.bytes(), before);
}

}  // namespace
}  // namespace eyrie::sweep_results_by_hand_test

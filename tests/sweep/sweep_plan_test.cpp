#include "sweep/plan/sweep_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <iomanip>
#include <sstream>

#include "core/error.h"
#include "sweep/sweep_scene.h"

namespace eyrie::sweep_plan_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string refusal(const std::function<void()>& work) {
    try {
        work();
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::parameter);
        return error.what();
    }
    return "accepted";
}

std::string refusedAxis(const std::string& text) {
    return refusal([&] { parseAxis(text, {}); });
}

}  // namespace

TEST(SweepAxis, RangesHoldBothEndsInTidyNumbers) {
    EXPECT_THAT(parseAxis("gradient.quantile=0.1:0.1:0.5", {}).values, ElementsAre("0.1", "0.2", "0.3", "0.4", "0.5"));
    EXPECT_EQ(parseAxis("gradient.quantile=0.05:0.01:0.5", {}).values.size(), 46U);
    EXPECT_EQ(parseAxis("gradient.quantile=0.05:0.01:0.5", {}).values[10], "0.15");
    EXPECT_THAT(parseAxis("outliers.min_vectors=1:2:8", {}).values, ElementsAre("1", "3", "5", "7"));
    EXPECT_THAT(parseAxis("outliers.min_vectors=3:-1:1", {}).values, ElementsAre("3", "2", "1"));
    EXPECT_THAT(parseAxis(" gradient.quantile = 0.2 : 1 : 0.2 ", {}).values, ElementsAre("0.2"));
}

TEST(SweepAxis, ListsMayBeNumbersWordsAndSwitches) {
    EXPECT_THAT(parseAxis("gradient.quantile=0.5, 0.10,0.3", {}).values, ElementsAre("0.5", "0.1", "0.3"));
    EXPECT_THAT(parseAxis("detection.method=gradient,mser", {}).values, ElementsAre("gradient", "mser"));
    EXPECT_THAT(parseAxis("stacking.enabled=off,on", {}).values, ElementsAre("false", "true"));
    EXPECT_THAT(parseAxis("sliding_window.model=/a/b.m,/c:d.m", {}).values, ElementsAre("/a/b.m", "/c:d.m"));
}

TEST(SweepAxis, CountsWithoutReading) {
    EXPECT_EQ(countValues("gradient.quantile=0.05:0.01:0.5"), 46);
    EXPECT_EQ(countValues("a=0:0.000001:1"), 1000001);
    EXPECT_EQ(countValues("a=5:1:1"), 0);
    EXPECT_EQ(countValues("a=1:0:5"), 0);
    EXPECT_EQ(countValues("a="), 0);
    EXPECT_EQ(countValues("a=x,y,z"), 3);
    EXPECT_EQ(countValues("0.5"), 1);
}

TEST(SweepAxis, RefusesWhatCannotBeMeant) {
    EXPECT_THAT(refusedAxis("gradient.quantile=0.5:0.1:0.1"), HasSubstr("is empty"));
    EXPECT_THAT(refusedAxis("gradient.quantile=0.1:0:0.5"), HasSubstr("step of 0"));
    EXPECT_THAT(refusedAxis("gradient.quantile="), HasSubstr("no value"));
    EXPECT_THAT(refusedAxis("gradient.quantile"), HasSubstr("expected NAME="));
    EXPECT_THAT(refusedAxis("gradient.quantil=0.1"), HasSubstr("the nearest is \"gradient.quantile\""));
    EXPECT_THAT(refusedAxis("gradient.quantile=0.1:0.1:7"), HasSubstr("expected 0..1"));
    EXPECT_THAT(refusedAxis("gradient.quantile=a:b:c"), HasSubstr("in numbers"));
    EXPECT_THAT(refusedAxis("gradient.quantile=0.1:0.2"), HasSubstr("neither"));
    EXPECT_THAT(refusedAxis("gradient.quantile=0.1,,0.2"), HasSubstr("expected"));
    EXPECT_THAT(refusedAxis("gradient.quantile=nan"), HasSubstr("expected"));
    EXPECT_THAT(refusedAxis("gradient.quantile=0:1e-30:1"), HasSubstr("ten million"));
    EXPECT_THAT(refusedAxis("gradient.quantile=0.1,0.10"), HasSubstr("twice"));
    EXPECT_THAT(refusedAxis("stacking.enabled=on,true"), HasSubstr("twice"));
    EXPECT_THAT(refusedAxis("outliers.min_vectors=1:0.5:3"), HasSubstr("expected"));
    EXPECT_THAT(refusedAxis("detection.method=magic"), HasSubstr("one of"));
}

TEST(SweepPlan, CountsPositionsWithTheLastAxisFastest) {
    const SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,4"});
    EXPECT_EQ(plan.pointCount(), 6);
    EXPECT_THAT(plan.indicesOf(5), ElementsAre(2, 1));
    for (int i = 0; i < 6; ++i) EXPECT_EQ(plan.positionOf(plan.indicesOf(i)), i);
    EXPECT_EQ(plan.describe(1), "gradient.quantile = 0.1, outliers.min_vectors = 4");
    EXPECT_DOUBLE_EQ(plan.optionsOf(4).detection.gradient.quantile, 0.3);
    EXPECT_EQ(plan.optionsOf(4).outliers.min_vectors, 2);
    EXPECT_EQ(plan.optionsOf(4).detection.method, DetectionMethod::gradient);
}

TEST(SweepPlan, WorksSoThatTheEarlierStageChangesSlowest) {
    EXPECT_THAT(workOrder(test::sweepPlan({"gradient.quantile=0.1,0.2,0.3", "outliers.min_vectors=2,4"})),
                ElementsAre(0, 1, 2, 3, 4, 5));
    EXPECT_THAT(workOrder(test::sweepPlan({"outliers.min_vectors=2,4", "gradient.quantile=0.1,0.2,0.3"})),
                ElementsAre(0, 3, 1, 4, 2, 5));
}

TEST(SweepPlan, ShardsDoEachPointOnce) {
    const std::vector<int> order = workOrder(test::sweepPlan({"gradient.quantile=0.05:0.01:0.5"}));
    for (const int count : {1, 3, 7, 46, 50}) {
        std::vector<int> joined;
        for (int i = 1; i <= count; ++i) {
            const auto shard = shardOf(order, i, count);
            joined.insert(joined.end(), shard.begin(), shard.end());
        }
        EXPECT_EQ(joined, order) << count;
    }
    EXPECT_THAT(refusal([&] { shardOf(order, 0, 3); }), HasSubstr("expected PART/PARTS"));
    EXPECT_THAT(refusal([&] { shardOf(order, 4, 3); }), HasSubstr("expected PART/PARTS"));
}

TEST(SweepPlan, RefusesPlansThatCannotBeCarriedOut) {
    SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2"});
    EXPECT_NO_THROW(check(plan));
    plan.overlaps = {0};
    EXPECT_THAT(refusal([&] { check(plan); }), HasSubstr("overlap"));
    plan = test::sweepPlan({"gradient.quantile=0.1,0.2", "gradient.quantile=0.3"});
    EXPECT_THAT(refusal([&] { check(plan); }), HasSubstr("twice"));
    plan = test::sweepPlan({});
    EXPECT_THAT(refusal([&] { check(plan); }), HasSubstr("one or two"));
    plan = test::sweepPlan({"gradient.quantile=0.1"});
    plan.clips.clear();
    EXPECT_THAT(refusal([&] { check(plan); }), HasSubstr("no sequence"));
    plan = test::sweepPlan({"registration.max_corners=100:1:5000", "gradient.quantile=0.1:0.0001:0.9"});
    EXPECT_THAT(refusal([&] { check(plan); }), HasSubstr("at most"));
}

TEST(SweepPlan, EveryModelIsTriedBeforeASweepBegins) {
    const auto refused = [](const std::string& axis, DetectionMethod method, const std::string& model) {
        SweepPlan plan = test::sweepPlan({axis});
        ChainOptions options;
        options.detection.method = method;
        options.detection.sliding_window.model = model;
        plan.base = parameterValues(options);
        try {
            check(plan);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("accepted");
    };
    const std::string nowhere = "nowhere.eyriemodel";
    constexpr DetectionMethod kWindow = DetectionMethod::sliding_window;
    EXPECT_THAT(refused("sliding_window.model=" + nowhere, kWindow, ""),
                HasSubstr("sliding_window.model = " + nowhere));
    EXPECT_THAT(refused("sliding_window.descriptor=none", kWindow, ""), HasSubstr("sliding_window.descriptor = none"));
    EXPECT_THAT(refused("detection.method=gradient,sliding_window", DetectionMethod::gradient, nowhere),
                HasSubstr("detection.method = sliding_window"));
    EXPECT_EQ(refused("gradient.quantile=0.1", DetectionMethod::gradient, nowhere), "accepted");
}

TEST(SweepPlan, SurvivesItsFileAndKnowsItsLike) {
    SweepPlan plan = test::sweepPlan({"gradient.quantile=0.1,0.2", "detection.method=gradient,mser"});
    plan.border = 2.5;
    plan.vehicles_only = true;
    plan.one_class = TrackClass::vehicle;
    SweepPlan read = planFrom(textOf(plan), "here");
    EXPECT_EQ(textOf(read), textOf(plan));
    EXPECT_EQ(differenceOf(plan, read), "");
    read.clips[0].sequence = "/elsewhere/clip.mp4";
    EXPECT_EQ(differenceOf(plan, read), "");
    read.clips[0].digest = "1";
    EXPECT_THAT(differenceOf(plan, read), HasSubstr("sequence 1"));
    read = plan;
    read.axes[0].values.pop_back();
    EXPECT_THAT(differenceOf(plan, read), HasSubstr("values of gradient.quantile"));
    read = plan;
    read.base[3].second = "?";
    EXPECT_THAT(differenceOf(plan, read), HasSubstr(plan.base[3].first));
    read = plan;
    read.engine_version = "9";
    EXPECT_THAT(differenceOf(plan, read), HasSubstr("versions"));
    read = plan;
    read.overlaps.push_back(0.5);
    EXPECT_THAT(differenceOf(plan, read), HasSubstr("overlaps"));
    read = plan;
    read.one_class = TrackClass::person;
    EXPECT_THAT(differenceOf(plan, read), HasSubstr("classes"));
    std::string text = textOf(plan);
    const std::string classes = R"("classes":"vehicles",)";
    ASSERT_NE(text.find(classes), std::string::npos);
    text.replace(text.find(classes), classes.size(), "");
    EXPECT_FALSE(planFrom(text, "here").one_class) << "plans of before classes were told apart";
    text.insert(1, R"("classes":"trams",)");
    EXPECT_THROW(planFrom(text, "here"), Error);
    for (const char* damaged : {"", "{", "[]", "{}", R"({"eyrie_sweep":1})", R"({"eyrie_sweep":7})"})
        EXPECT_THROW(planFrom(damaged, "here"), Error) << damaged;
}

TEST(SweepPlan, DigestsTellClipsAndTruthsApart) {
    const auto source = test::sweepSource();
    const Frame first = source->read(0, false);
    BoxesByFrame truth = test::sweepTruth();
    const std::string digest = digestOf(first, truth);
    EXPECT_EQ(digest, digestOf(source->read(0, false), test::sweepTruth()));
    EXPECT_NE(digest, digestOf(source->read(1, false), truth));
    truth[3][0].ignore = true;
    EXPECT_NE(digest, digestOf(first, truth));
}

TEST(SweepPlan, DigestsAreThoseOfOtherMachinesAndVersions) {
    // FNV-1a of "a" and of "foobar", as its authors publish them.
    const auto ofRow = [](const std::string& bytes) {
        Frame frame;
        // Lies in a wider picture, whose other pixels do not count.
        cv::Mat wide(3, 20, CV_8UC1, cv::Scalar(77));
        frame.gray = wide(cv::Rect(2, 1, static_cast<int>(bytes.size()), 1));
        for (int x = 0; x < frame.gray.cols; ++x)
            frame.gray.at<uchar>(x) = static_cast<uchar>(bytes[static_cast<std::size_t>(x)]);
        return digestOf(frame, {});
    };
    EXPECT_EQ(ofRow("a"), "af63dc4c8601ec8c");
    EXPECT_EQ(ofRow("foobar"), "85944171f73967e8");
    // Of a box its numbers as they lie in memory, each to its last byte.
    Frame none;
    BoxRecord record;
    record.id = 7;
    record.box = {{1.5, -2}, 4, 2, 0.5};
    record.ignore = true;
    record.object_class = "car";
    std::string bytes;
    const auto lay = [&bytes](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
    lay(12);
    lay(7);
    for (const double number : {1.5, -2.0, 4.0, 2.0, 0.5}) lay(number);
    lay(true);
    bytes += "car";
    std::uint64_t state = 14695981039346656037ULL;
    for (const char byte : bytes) {
        state ^= static_cast<unsigned char>(byte);
        state *= 1099511628211ULL;
    }
    std::ostringstream hexadecimal;
    hexadecimal << std::hex << std::setw(16) << std::setfill('0') << state;
    EXPECT_EQ(digestOf(none, {{12, {record}}}), hexadecimal.str());
}

}  // namespace eyrie::sweep_plan_test

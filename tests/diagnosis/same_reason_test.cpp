#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "diagnosis/hindered_run.h"

namespace eyrie::same_reason_test {
namespace {

using test::HinderedRun;
using testing::HasSubstr;

/// Parameters that keep the vectors of a vehicle out of a cluster, and what both answers have to name.
struct Hindrance {
    std::string name;
    void (*hinder)(MotionClusteringOptions& options);
    std::string parameter;  ///< empty: any of clustering
    ErrorCause cause;
};

TEST(SameReason, WhyAndTheCauseOfAMissNameTheSameParameterOfClustering) {
    const std::vector<Hindrance> hindrances{
        {"too few", [](auto& o) { o.min_members = 200; }, "clustering.min_members", ErrorCause::too_few_vectors},
        {"too far apart",
         [](auto& o) {
             o.along_m = o.across_m = 0.02;
             o.min_distance = o.roof_length_m = 0;
         },
         "", ErrorCause::not_clustered},
        {"too long", [](auto& o) { o.max_length_m = 0.5; }, "clustering.max_length", ErrorCause::not_clustered},
        {"too wide", [](auto& o) { o.max_width_m = 0.2; }, "clustering.max_width", ErrorCause::not_clustered},
    };
    for (const Hindrance& hindrance : hindrances) {
        ChainOptions options;
        hindrance.hinder(options.clustering);
        HinderedRun run(options);
        const Explanation told = run.explanation();
        const DiagnosedError miss = run.diagnosis();
        EXPECT_FALSE(told.found) << hindrance.name;
        ASSERT_EQ(told.parameter.substr(0, 11), "clustering.") << hindrance.name << ": " << told.sentence;
        EXPECT_THAT(miss.text, HasSubstr("(" + told.parameter + ")")) << hindrance.name << ": " << told.sentence;
        if (!hindrance.parameter.empty()) {
            EXPECT_EQ(told.parameter, hindrance.parameter) << told.sentence;
        }
        EXPECT_EQ(miss.cause, hindrance.cause) << miss.text;
        EXPECT_THAT(told.sentence, HasSubstr(test::comparisonIn(miss))) << "one wording for both";
    }
}

TEST(SameReason, WhereDifferenceImagesAreToFindWhatMoves) {
    ChainOptions options;
    options.difference.method = MotionMethod::two_frame_difference;
    options.difference.min_contrast = 255;
    HinderedRun run(options);
    ASSERT_TRUE(run.result().clusters.empty());
    const Explanation told = run.explanation();
    EXPECT_EQ(told.parameter, "motion.method") << told.sentence;
    const DiagnosedError miss = run.diagnosis();
    EXPECT_EQ(miss.cause, ErrorCause::not_clustered);
    EXPECT_THAT(miss.text, HasSubstr("(motion.method)"));
}

}  // namespace
}  // namespace eyrie::same_reason_test

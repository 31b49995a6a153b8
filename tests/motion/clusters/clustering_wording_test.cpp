#include "motion/clusters/clustering_wording.h"

#include <gtest/gtest.h>

namespace eyrie::clustering_wording_test {
namespace {

const SceneScale kKnown{0.25, 25, true};

ClusteringVerdict refused(ClusterRefusal refusal, double value = 0, double limit = 0) {
    ClusteringVerdict verdict;
    verdict.refusal = refusal;
    verdict.here = 4;
    verdict.needed = 3;
    verdict.group = {0, 1};
    verdict.value = value;
    verdict.limit = limit;
    return verdict;
}

TEST(ClusteringWording, TellsWhatWasComparedAndWithWhat) {
    EXPECT_EQ(textOf(refused(ClusterRefusal::too_few), kKnown), "2 motion vectors, 3 are needed");
    EXPECT_EQ(textOf(refused(ClusterRefusal::not_linked), kKnown), "4 motion vectors lie here, but only 2 are linked");
    EXPECT_EQ(textOf(refused(ClusterRefusal::too_long, 62, 40), kKnown),
              "the vectors linked here are 62 px (15.5 m) long, 40 px (10 m) are allowed");
    EXPECT_EQ(textOf(refused(ClusterRefusal::too_wide, 62, 40), {0.25, 25, false}),
              "the vectors linked here are 62 px wide, 40 px are allowed");
    EXPECT_EQ(textOf(refused(ClusterRefusal::split_off, 62, 40), kKnown),
              "the vectors here were left over when a cluster of 62 px (15.5 m), more than 40 px (10 m), was split");
}

TEST(ClusteringWording, WhereNothingWasComparedNothingIsSaid) {
    EXPECT_EQ(textOf({}, kKnown), "");
    EXPECT_EQ(textOf(refused(ClusterRefusal::not_finite), kKnown), "");
}

}  // namespace
}  // namespace eyrie::clustering_wording_test

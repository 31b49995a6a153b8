#include "removal/removal_wording.h"

#include <gtest/gtest.h>

namespace eyrie::removal_wording_test {
namespace {

const SceneScale kKnown{0.25, 25, true};

TEST(RemovalWording, TellsWhatWasComparedAndWithWhat) {
    EXPECT_EQ(textOf({Rejection::outlier, "outliers.min_vectors", 1, 3, false}, kKnown),
              "1 motion vector inside, 3 are needed");
    EXPECT_EQ(textOf({Rejection::none, "outliers.min_vectors", 5, 3, false}, kKnown),
              "5 motion vectors inside, 3 are needed")
        << "of what was kept, too";
    EXPECT_EQ(textOf({Rejection::outlier, "outliers.min_vectors", 2, 3, false, true}, kKnown),
              "2 motion vectors move with the box, 3 are needed")
        << "others may lie inside";
    EXPECT_EQ(textOf({Rejection::outlier, "outliers.min_vectors", 1, 3, false, true}, kKnown),
              "1 motion vector moves with the box, 3 are needed");
    EXPECT_EQ(textOf({Rejection::outlier, "outliers.min_vectors", 0, 1, false, false}, kKnown),
              "0 motion vectors inside, 1 is needed");
    EXPECT_EQ(textOf({Rejection::size, "outliers.max_length", 130, 120, true}, kKnown),
              "130 px (32.5 m), at most 120 px (30 m)");
    EXPECT_EQ(textOf({Rejection::size, "outliers.min_area", 6, 10, false}, kKnown), "6 px², at least 10 px²");
    EXPECT_EQ(textOf({Rejection::size, "outliers.inside_image", 0.25, 1, false}, kKnown),
              "25 % of the box is in the picture, all of it must be");
    EXPECT_EQ(textOf({Rejection::size, "outliers.inside_image", 0.99996, 1, false}, kKnown),
              "99.9 % of the box is in the picture, all of it must be");
    EXPECT_EQ(textOf({Rejection::duplicate, {}, 0, 0, false}, kKnown), "removed as a duplicate of another detection");
}

TEST(RemovalWording, NobodyIsShownMetresThatAreAssumed) {
    EXPECT_EQ(textOf({Rejection::size, "outliers.min_length", 4, 4.8, false}, {0.25, 25, false}),
              "4 px, at least 4.8 px");
}

TEST(RemovalWording, WhereNothingWasComparedNothingIsSaid) {
    EXPECT_EQ(textOf({Rejection::outlier, {}, 0, 0, false}, kKnown), "");
    EXPECT_EQ(textOf({Rejection::size, {}, 0, 0, false}, kKnown), "");
}

}  // namespace
}  // namespace eyrie::removal_wording_test

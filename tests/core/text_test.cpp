#include "core/text.h"

#include <gtest/gtest.h>

namespace eyrie {
namespace {

TEST(Text, IsMadeSafeForMarkup) {
    EXPECT_EQ(markupEscaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
    EXPECT_EQ(markupEscaped("&amp;"), "&amp;amp;");
    EXPECT_EQ(markupEscaped(std::string_view("a\0b\x1b\n\t", 6)), "a_b_\n\t");
    EXPECT_EQ(markupEscaped("Ü–"), "Ü–");
}

TEST(Text, DistanceCountsSwapsOnce) {
    EXPECT_EQ(editDistance("run", "run"), 0u);
    EXPECT_EQ(editDistance("rnu", "run"), 1u);
    EXPECT_EQ(editDistance("", "run"), 3u);
    EXPECT_EQ(editDistance("kitten", "sitting"), 3u);
    EXPECT_EQ(editDistance("sitting", "kitten"), 3u);
}

TEST(Text, TheNearestWordIsFoundWhereOneIsNear) {
    const std::vector<std::string> known{"run", "render", "report", "evaluate"};
    EXPECT_EQ(nearestWord("rnu", known), "run");
    EXPECT_EQ(nearestWord("rendr", known), "render");
    EXPECT_EQ(nearestWord("evalaute", known), "evaluate");
    EXPECT_FALSE(nearestWord("dance", known));
    EXPECT_FALSE(nearestWord("x", {"ab"}));
    EXPECT_FALSE(nearestWord("run", {}));
}

TEST(Text, DecimalCommasAreRecognised) {
    EXPECT_EQ(withDecimalPoint("0,08"), "0.08");
    EXPECT_EQ(withDecimalPoint("-1,5"), "-1.5");
    EXPECT_EQ(withDecimalPoint(",5"), ".5");
    for (const char* other : {"0.08", "1,2,3", "a,b", "1,", "", ",", "1,5x"}) EXPECT_FALSE(withDecimalPoint(other));
}

}  // namespace
}  // namespace eyrie

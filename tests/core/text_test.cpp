#include "core/text.h"

#include <gtest/gtest.h>

namespace eyrie::text_test {
namespace {

TEST(Text, IsMadeSafeForMarkup) {
    EXPECT_EQ(markupEscaped("a < b & \"c\" > d"), "a &lt; b &amp; &quot;c&quot; &gt; d");
    EXPECT_EQ(markupEscaped("&amp;"), "&amp;amp;");
    EXPECT_EQ(markupEscaped(std::string_view("a\0b\x1b\n\t", 6)), "a_b_\n\t");
    EXPECT_EQ(markupEscaped("Ü–"), "Ü–");
}

TEST(Text, BytesThatAreNotUtf8AreReplacedOneByOne) {
    const std::string replacement = "\xEF\xBF\xBD";
    EXPECT_EQ(validUtf8("na\xC3\xAFve \xF0\x9F\x9A\x97"), "na\xC3\xAFve \xF0\x9F\x9A\x97");
    EXPECT_EQ(validUtf8("clip\xFF.mp4"), "clip" + replacement + ".mp4");
    EXPECT_EQ(validUtf8("\xC3"), replacement) << "cut off";
    EXPECT_EQ(validUtf8("\xC0\xAF"), replacement + replacement) << "an overlong form";
    EXPECT_EQ(validUtf8("\xED\xA0\x80"), replacement + replacement + replacement) << "half of a surrogate pair";
    EXPECT_EQ(displayText(std::filesystem::path("a\xE9/b")), "a" + replacement + "/b");
    EXPECT_EQ(markupEscaped("a\xE9<"), "a" + replacement + "&lt;");
}

TEST(Text, EndingsOfNamesAreThoseBehindTheLastDot) {
    for (const char* name : {"a.ts", "/x.y/A.TS", "rec.001.Ts"}) EXPECT_TRUE(hasEnding(name, ".ts")) << name;
    for (const char* name : {"a.tsx", "ats", ".ts", "a.ts/b", "a.t", ""}) EXPECT_FALSE(hasEnding(name, ".ts")) << name;
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
}  // namespace eyrie::text_test

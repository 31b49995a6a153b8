#include "core/text.h"

#include <gtest/gtest.h>

#include <algorithm>

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

TEST(Text, TheFirstAndTheLastCharacterOfEachLengthAreUtf8AndTheirNeighboursAreNot) {
    for (const char* good : {"\x7F", "\xC2\x80", "\xDF\xBF", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEE\x80\x80",
                             "\xEF\xBF\xBF", "\xF0\x90\x80\x80", "\xF1\x80\x80\x80", "\xF4\x8F\xBF\xBF"})
        EXPECT_EQ(validUtf8(good), good);
    for (const char* bad : {"\x80", "\xC1\xBF", "\xC2\xC0", "\xC2\x7F", "\xE0\x9F\xBF", "\xED\xA0\x80",
                            "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xF0\x90\x80"})
        EXPECT_TRUE(validUtf8(bad).starts_with("\xEF\xBF\xBD")) << bad;
    EXPECT_EQ(validUtf8("\xE2\x82"
                        "A"),
              "\xEF\xBF\xBD\xEF\xBF\xBD"
              "A")
        << "the third byte is another character";
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

/// Slow and obvious, by the last characters.
std::size_t slowDistance(std::string_view a, std::string_view b) {
    if (a.empty() || b.empty()) return a.size() + b.size();
    const std::string_view shorter_a = a.substr(0, a.size() - 1);
    const std::string_view shorter_b = b.substr(0, b.size() - 1);
    std::size_t best = slowDistance(shorter_a, shorter_b) + (a.back() == b.back() ? 0 : 1);
    best = std::min({best, slowDistance(shorter_a, b) + 1, slowDistance(a, shorter_b) + 1});
    if (shorter_a.empty() || shorter_b.empty() || a.back() != shorter_b.back() || b.back() != shorter_a.back())
        return best;
    return std::min(best, slowDistance(a.substr(0, a.size() - 2), b.substr(0, b.size() - 2)) + 1);
}

TEST(Text, DistanceIsTheLeastNumberOfChanges) {
    std::vector<std::string> words{""};
    for (std::size_t i = 0; words.at(i).size() < 3; ++i)
        for (const char c : {'a', 'b', 'c'}) words.push_back(words.at(i) + c);
    ASSERT_EQ(words.size(), 40U);
    for (const std::string& a : words)
        for (const std::string& b : words) ASSERT_EQ(editDistance(a, b), slowDistance(a, b)) << a << ' ' << b;
}

TEST(Text, TheDistanceOfPartsOfATextSeesNothingOfTheRest) {
    const std::string_view a = "ba", b = "xab", c = "bay";
    EXPECT_EQ(editDistance(a.substr(1), b.substr(1)), 1u) << "a and ab, behind b and x";
    EXPECT_EQ(editDistance(b.substr(1), a.substr(1)), 1u);
    EXPECT_EQ(editDistance(a.substr(1), c.substr(1, 1)), 0u);
    EXPECT_EQ(editDistance(b.substr(1, 1), c.substr(0, 2)), 1u) << "a and ba";
    EXPECT_EQ(nearestWord(b.substr(1), {"ac", "ba"}), "ac") << "as near as the swap behind it";
}

TEST(Text, TheNearestWordIsFoundWhereOneIsNear) {
    const std::vector<std::string> known{"run", "render", "report", "evaluate"};
    EXPECT_EQ(nearestWord("rnu", known), "run");
    EXPECT_EQ(nearestWord("rendr", known), "render");
    EXPECT_EQ(nearestWord("evalaute", known), "evaluate");
    EXPECT_FALSE(nearestWord("dance", known));
    EXPECT_FALSE(nearestWord("x", {"ab"}));
    EXPECT_FALSE(nearestWord("run", {}));
    EXPECT_EQ(nearestWord("cap", {"cat", "car"}), "cat") << "the first of two that are as near";
    EXPECT_EQ(nearestWord("abcdef", {"abcdxy"}), "abcdxy");
    EXPECT_FALSE(nearestWord("abcdef", {"abcxyz"})) << "up to eight characters, two may be wrong";
    EXPECT_EQ(nearestWord("abcdefghi", {"abcdefxyz"}), "abcdefxyz") << "then a third of them";
    EXPECT_FALSE(nearestWord("abcdefghi", {"abcdewxyz"}));
}

TEST(Text, DecimalCommasAreRecognised) {
    EXPECT_EQ(withDecimalPoint("0,08"), "0.08");
    EXPECT_EQ(withDecimalPoint("-1,5"), "-1.5");
    EXPECT_EQ(withDecimalPoint(",5"), ".5");
    EXPECT_EQ(withDecimalPoint("+9,09"), "+9.09");
    for (const char* other : {"0.08", "1,2,3", "a,b", "1,", "", ",", "1,5x", "1-,5", "1,/", "1,:"})
        EXPECT_FALSE(withDecimalPoint(other));
}

}  // namespace
}  // namespace eyrie::text_test

#include "io/tables/number_text.h"

#include <gtest/gtest.h>

#include <limits>

namespace eyrie::number_text_test {

TEST(NumberText, TheWholeTextMustBeAFiniteNumber) {
    EXPECT_EQ(parseReal("12.5"), 12.5);
    EXPECT_EQ(parseReal(" \t-0.25\t "), -0.25);
    EXPECT_EQ(parseReal("+7"), 7);
    EXPECT_EQ(parseReal("1e-3"), 0.001);
    EXPECT_EQ(parseReal("7"), 7);
    for (const char* text : {"", " ", "+", "-", "+-7", "++7", "12.5px", "1,5", "1 2", "nan", "inf", "1e999"})
        EXPECT_EQ(parseReal(text), std::nullopt) << text;
}

TEST(NumberText, WholeNumbersHaveNoFractionAndFit) {
    EXPECT_EQ(parseWhole("12.0"), 12);
    EXPECT_EQ(parseWhole("-3"), -3);
    EXPECT_EQ(parseWhole("2147483647"), std::numeric_limits<int>::max());
    EXPECT_EQ(parseWhole("-2147483648"), std::numeric_limits<int>::min());
    for (const char* text : {"12.5", "2147483648", "-2147483649", "x", ""})
        EXPECT_EQ(parseWhole(text), std::nullopt) << text;
}

TEST(NumberText, DecimalsEndWithTheLastThatSaysSomething) {
    EXPECT_EQ(fixedText(1.25, 1), "1.2") << "ties to even, as the bits are exact";
    EXPECT_EQ(fixedText(1.35, 3), "1.35");
    EXPECT_EQ(fixedText(2, 3), "2");
    EXPECT_EQ(fixedText(2000, 0), "2000") << "no decimals, no zeros to leave out";
    EXPECT_EQ(fixedText(1.5004, 3), "1.5");
    EXPECT_EQ(fixedText(-0.0004, 3), "0");
    EXPECT_EQ(fixedText(-0.5, 3), "-0.5");
    EXPECT_EQ(fixedText(1e300, 2).size(), 301U);
}

TEST(NumberText, TheShortestTextReadsBackIdentically) {
    for (const double value : {0.1, 1.0 / 3, 1e-300, -123456789.125, 1e22}) {
        const auto read = parseReal(shortestText(value));
        ASSERT_TRUE(read) << value;
        EXPECT_EQ(*read, value);
    }
    EXPECT_EQ(shortestText(0.1), "0.1");
    EXPECT_EQ(shortestText(3), "3");
}

TEST(NumberText, BlanksGoAtTheEndsOnly) {
    EXPECT_EQ(trimmed("\t a b \t"), "a b");
    EXPECT_EQ(trimmed("x"), "x");
    EXPECT_EQ(trimmed(" \t "), "");
    EXPECT_EQ(trimmed(""), "");
}

}  // namespace eyrie::number_text_test

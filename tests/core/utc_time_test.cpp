#include "core/time/utc_time.h"

#include <gtest/gtest.h>

#include <limits>

namespace eyrie::utc_time_test {

TEST(UtcTime, TextsOfMomentsAreThoseOfTheCalendar) {
    EXPECT_EQ(utcTextOfSeconds(0), "1970-01-01T00:00:00Z");
    EXPECT_EQ(utcTextOfSeconds(951'782'400), "2000-02-29T00:00:00Z");
    EXPECT_EQ(utcTextOfSeconds(-1), "1969-12-31T23:59:59Z");
    EXPECT_EQ(utcText(1'231'798'102'000'000), "2009-01-12T22:08:22.000000Z");
    EXPECT_EQ(utcText(-1), "1969-12-31T23:59:59.999999Z");
    EXPECT_EQ(utcTextToMilliseconds(1'231'798'102'034'999), "2009-01-12T22:08:22.034Z");
}

TEST(UtcTime, WhatHasNoFourDigitsOfYearHasNoText) {
    EXPECT_EQ(utcTextOfSeconds(253'402'300'799), "9999-12-31T23:59:59Z");
    EXPECT_EQ(utcTextOfSeconds(253'402'300'800), "");
    for (const auto extreme : {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
        EXPECT_EQ(utcText(extreme), "");
        EXPECT_EQ(utcTextOfSeconds(extreme), "");
    }
}

TEST(UtcTime, TheFirstAndTheLastMomentOfTheCalendarHaveTexts) {
    constexpr std::int64_t kFirst_s = -62'167'219'200;
    EXPECT_EQ(utcTextOfSeconds(kFirst_s), "0000-01-01T00:00:00Z");
    EXPECT_EQ(utcTextOfSeconds(kFirst_s - 1), "");
    EXPECT_EQ(utcText(kFirst_s * 1'000'000), "0000-01-01T00:00:00.000000Z");
    EXPECT_EQ(utcText(kFirst_s * 1'000'000 - 1), "");
    EXPECT_EQ(utcText(253'402'300'799'999'999), "9999-12-31T23:59:59.999999Z");
    EXPECT_EQ(utcText(253'402'300'800'000'000), "");
    EXPECT_EQ(utcOf("9999-12-31T23:59:59.999999Z"), 253'402'300'799'999'999);
    EXPECT_EQ(utcOf("0000-01-01T00:00:00Z"), kFirst_s * 1'000'000);
}

TEST(UtcTime, TheTimeOfTheDayStandsAlone) {
    EXPECT_EQ(timeOfDayText(1'231'798'102'999'999), "22:08:22") << "cut off, as clocks do";
    EXPECT_EQ(timeOfDayText(1'231'798'102'540'000, 2), "22:08:22.54");
    EXPECT_EQ(timeOfDayText(1'231'798'102'540'000, 1), "22:08:22.5");
    EXPECT_EQ(timeOfDayText(1'231'798'102'540'001, 6), "22:08:22.540001");
    EXPECT_EQ(timeOfDayText(1'231'798'102'540'001, 9), "22:08:22.540001") << "there are no more";
    EXPECT_EQ(timeOfDayText(1'231'798'102'540'001, -1), "22:08:22");
    EXPECT_EQ(timeOfDayText(0), "00:00:00");
    EXPECT_EQ(timeOfDayText(std::numeric_limits<std::int64_t>::max()), "");
}

TEST(UtcTime, TextsAreReadBack) {
    for (const std::int64_t us : {0LL, 1'231'798'102'034'567LL, -86'400'000'001LL, 4'107'542'400'000'000LL})
        EXPECT_EQ(utcOf(utcText(us)), us) << us;
    EXPECT_EQ(utcOf("2009-01-12 22:08:22"), 1'231'798'102'000'000);
    EXPECT_EQ(utcOf("2009-01-12T22:08:22.5Z"), 1'231'798'102'500'000);
    EXPECT_EQ(utcOf("2009-01-12T22:08:22.000001Z"), 1'231'798'102'000'001);
    EXPECT_EQ(utcOf("1999-09-19T19:59:09.99"), 937'771'149'990'000);
    EXPECT_EQ(utcOf(nowUtc()).has_value(), true);
}

TEST(UtcTime, WhatIsNoMomentIsRefused) {
    for (const char* text : {"",
                             "now",
                             "2009-01-12",
                             "2009-01-12T22:08",
                             "2009-02-29T00:00:00Z",
                             "2009-13-01T00:00:00Z",
                             "2009-00-10T00:00:00Z",
                             "2009-01-12T24:00:00Z",
                             "2009-01-12T22:60:22Z",
                             "2009-01-12T22:08:60Z",
                             "2009-01-12T22:08:22.Z",
                             "2009-01-12T22:08:22.1234567Z",
                             "2009-01-12T22:08:22+01:00",
                             "2009-01-12T22:08:22ZZ",
                             " 2009-01-12T22:08:22Z",
                             "-009-01-12T22:08:22Z",
                             "2009-1-12T22:08:22Z",
                             "2009-01-12x22:08:22Z",
                             "2009 01-12T22:08:22Z",
                             "2009-01-12T22 08:22Z",
                             "20:9-01-12T22:08:22Z",
                             "20/9-01-12T22:08:22Z",
                             "2009-01-32T22:08:22Z",
                             "2009-01-00T22:08:22Z",
                             "2009-01-12T22:08:22,5Z"})
        EXPECT_EQ(utcOf(text), std::nullopt) << text;
}

}  // namespace eyrie::utc_time_test

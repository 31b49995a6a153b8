#include <gtest/gtest.h>

#include "formats/tables/text_fields.h"

namespace eyrie::utf8_test {

TEST(Utf8, IsWhatTheStandardAllowsAndNothingElse) {
    for (const char* good : {"", "car", "\xC3\xA9", "\xE0\xA0\x80", "\xED\x9F\xBF", "\xEF\xBF\xBF", "\xF0\x90\x80\x80",
                             "\xF4\x80\x80\x80", "\xF4\x8F\xBF\xBF", "a\xC2\x80z"})
        EXPECT_TRUE(isUtf8(good)) << good;
    for (const char* bad : {"\x80", "\xC1\xBF", "\xC3", "\xC3z", "\xE0\x9F\xBF", "\xED\xA0\x80", "\xE2\x82",
                            "\xE2z\x80", "\xF0\x8F\xBF\xBF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xF0\x90\x80"})
        EXPECT_FALSE(isUtf8(bad)) << testing::PrintToString(bad);
}

}  // namespace eyrie::utf8_test

#include "metadata/metadata_text.h"

#include <gtest/gtest.h>

namespace eyrie::metadata_text_test {

TEST(MetadataText, ValuesHaveTheDecimalsThatTheirCodingTellsApart) {
    EXPECT_EQ(valueText(13, 48.13715412345), "48.1371541");  // four bytes over a half circle
    EXPECT_EQ(valueText(5, 123.4567), "123.457");            // two bytes over a circle
    EXPECT_EQ(valueText(15, 1234.567), "1234.6");            // two bytes over 20 km
    EXPECT_EQ(valueText(8, 42), "42");
    EXPECT_EQ(valueText(4711, 0.5), "0.500");  // of a tag that is not known
    EXPECT_EQ(unitText(13), "°");
    EXPECT_EQ(unitText(15), "m");
    EXPECT_EQ(unitText(63), "");
    EXPECT_EQ(unitText(4711), "");
}

TEST(MetadataText, WhatWasDamagedIsCountedByItsReason) {
    MetadataStream stream;
    EXPECT_EQ(damageText(stream), "");
    stream.faults[1] = 12;
    stream.faults[2] = 1;
    EXPECT_EQ(damageText(stream), std::string(klv::nameOf(static_cast<klv::Fault>(1))) + " 12×, " +
                                      klv::nameOf(static_cast<klv::Fault>(2)) + " 1×");
    const std::string without = damageText(stream);
    stream.first_damage = MetadataPlace{310};
    EXPECT_EQ(damageText(stream), without + "; the first near frame 310");
}

TEST(MetadataText, MomentsAreUtc) {
    EXPECT_EQ(valueText(72, 1'231'798'102'000'000), "2009-01-12T22:08:22.000000Z");
    EXPECT_EQ(unitText(72), "");
    EXPECT_EQ(valueText(72, 1.8e19), "18000000000000000000");  // no calendar has it
}

}  // namespace eyrie::metadata_text_test

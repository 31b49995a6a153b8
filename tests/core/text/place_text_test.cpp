#include "core/geometry/place_text.h"

#include <gtest/gtest.h>

namespace eyrie::place_text_test {

TEST(PlaceText, IsWhatMapsTake) {
    EXPECT_EQ(placeText({48.1371541, 11.5761239}), "48.137154, 11.576124");
    EXPECT_EQ(placeText({-33.5, -70}), "-33.500000, -70.000000");
}

TEST(PlaceText, IsReadAsPeopleCopyIt) {
    for (const char* text :
         {"48.137154, 11.576124", "48.137154,11.576124", " 48.137154 11.576124\n", "48.137154;11.576124",
          "48,137154 11,576124", "48,137154; 11,576124", "48,137154, 11,576124", "48.137154N 11.576124E",
          "N48.137154 E11.576124", "48.137154° N, 11.576124° E", "11.576124 E 48.137154 N", "48.137154n11.576124e",
          "48°08'13.7544\"N 11°34'34.0464\"E", "48° 08′ 13.7544″ N 11° 34′ 34.0464″ E", "48°8.22924'N 11°34.56744'E",
          "+48.137154\t+11.576124"}) {
        const auto place = placeOfText(text);
        ASSERT_TRUE(place) << text;
        EXPECT_NEAR(place->latitude_deg, 48.137154, 1e-8) << text;
        EXPECT_NEAR(place->longitude_deg, 11.576124, 1e-8) << text;
    }
    const auto south = placeOfText("33°30' S, 70 W");
    ASSERT_TRUE(south);
    EXPECT_NEAR(south->latitude_deg, -33.5, 1e-12);
    EXPECT_EQ(south->longitude_deg, -70);
    const auto plain = placeOfText("48,11");
    ASSERT_TRUE(plain);
    EXPECT_EQ(plain->latitude_deg, 48);
    EXPECT_EQ(plain->longitude_deg, 11);
    EXPECT_EQ(placeOfText("-33.5, -70.25")->longitude_deg, -70.25);
    const auto seconds = placeOfText("12°30'36\"S 0°0'9\"W");
    ASSERT_TRUE(seconds);
    EXPECT_NEAR(seconds->latitude_deg, -12.51, 1e-12);
    EXPECT_NEAR(seconds->longitude_deg, -0.0025, 1e-12);
    for (const double sign : {-1.0, 1.0}) {
        const auto corner = placeOfText(placeText({sign * 90, sign * 180}));
        ASSERT_TRUE(corner) << "the poles and the date line are places";
        EXPECT_EQ(*corner, (GeoPoint{sign * 90, sign * 180}));
    }
    EXPECT_EQ(placeOfText("0, 9"), (GeoPoint{0, 9}));
}

TEST(PlaceText, WhatIsNoPlaceIsRefused) {
    for (const char* text : {"",
                             "48.1",
                             "Munich",
                             "91, 11",
                             "48, 181",
                             "48.1, 11.5, 3",
                             "48.1N 11.5N",
                             "48.1E 11.5W",
                             "-48.1S, 11.5E",
                             "48.1 11.5 m",
                             "48°61'N 11°E",
                             "48°60'N 11°E",
                             "48°1'60\"N 11°E",
                             "90.1, 11",
                             "48, -180.1",
                             "48;",
                             ",",
                             "48.1 N",
                             "nan, 11",
                             "1e5, 3",
                             "48.1-11.5"})
        EXPECT_FALSE(placeOfText(text)) << text;
}

TEST(PlaceText, ReadsWhatItWrites) {
    const auto place = placeOfText(placeText({-0.000123, 179.999999}));
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->latitude_deg, -0.000123, 1e-9);
    EXPECT_NEAR(place->longitude_deg, 179.999999, 1e-9);
}

}  // namespace eyrie::place_text_test

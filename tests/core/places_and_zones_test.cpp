#include <gtest/gtest.h>

#include "core/geometry/local_plane.h"
#include "core/geometry/outline_map.h"
#include "core/review/zone.h"

namespace eyrie::places_and_zones_test {

TEST(LocalPlane, ADegreeIsAsLongAsOnTheEllipsoid) {
    // WGS 84: lengths of a degree of latitude and of longitude at 0°, 45° and 60°, m.
    for (const auto& [latitude, north, east] :
         {std::tuple{0.0, 110574.3, 111319.5}, {45.0, 111131.8, 78846.8}, {60.0, 111412.3, 55800.0}}) {
        const LocalPlane plane({latitude, 8});
        const cv::Point2d metres = plane.metresOf({latitude + 1, 9});
        EXPECT_NEAR(metres.y, north, 2) << latitude;
        EXPECT_NEAR(metres.x, east, 2) << latitude;
        const GeoPoint back = plane.placeOf(metres);
        EXPECT_NEAR(back.latitude_deg, latitude + 1, 1e-9);
        EXPECT_NEAR(back.longitude_deg, 9, 1e-9);
    }
    EXPECT_NEAR(LocalPlane({0, 179.5}).metresOf({0, -179.5}).x, 111319.5, 2) << "across the date line";
}

TEST(OutlineMap, TakesTheCornersOfAPictureToThoseOfAnyQuadrilateral) {
    const cv::Size size(640, 480);
    for (const std::array<cv::Point2d, 4>& quad :
         {std::array<cv::Point2d, 4>{{{10, 20}, {210, 40}, {180, 190}, {30, 160}}},
          {{{0, 0}, {4, 0}, {4, 3}, {0, 3}}}}) {
        const cv::Matx33d map = outlineOnto(quad, size);
        const auto outline = outlineOf(size);
        for (std::size_t i = 0; i < 4; ++i) {
            const cv::Vec3d p = map * cv::Vec3d(outline[i].x, outline[i].y, 1);
            EXPECT_GT(p[2], 0);
            EXPECT_NEAR(p[0] / p[2], quad[i].x, 1e-9) << i;
            EXPECT_NEAR(p[1] / p[2], quad[i].y, 1e-9) << i;
        }
    }
}

TEST(Zone, FaultsAreThoseThatMakeItUseless) {
    const auto fault = [](ZoneShape shape, std::vector<cv::Point2d> points) {
        Zone zone;
        zone.shape = shape;
        zone.points = std::move(points);
        return faultOf(zone);
    };
    EXPECT_EQ(fault(ZoneShape::line, {{0, 0}, {30, 0}}), "");
    EXPECT_EQ(fault(ZoneShape::line, {{5, 5}, {5, 5}}), "the line has no length: draw its points apart");
    EXPECT_EQ(fault(ZoneShape::line, {{5, 5}}), "a line needs two points or more");
    EXPECT_EQ(fault(ZoneShape::arrow, {{0, 0}, {30, 0}, {40, 5}}), "");
    EXPECT_EQ(fault(ZoneShape::arrow, {{5, 5}, {5, 5}}), "the arrow has no length: draw its points apart");
    EXPECT_EQ(fault(ZoneShape::arrow, {{5, 5}}), "an arrow needs two points or more");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {30, 0}}), "an area needs three points or more");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {30, 0}, {30, 20}}), "");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {30, 0}, {30, 20}, {0, 20}}), "");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {30, 20}, {30, 0}, {0, 20}}),
              "the outline crosses itself: give its corners in their order around the area");
    EXPECT_EQ(fault(ZoneShape::area, {{0, 0}, {10, 10}, {20, 20}}),
              "the zone has no area: its corners must not be on one line");
}

}  // namespace eyrie::places_and_zones_test

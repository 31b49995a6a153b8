#include "scene/traffic/vehicle_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

/// Every corner and colour of bodies whose sizes make them easy to work out, and the spread of what is left to chance.
namespace eyrie::vehicle_shape_test {
namespace {

using Outline = std::vector<cv::Point2d>;

constexpr std::uint32_t kSeeds = 1000;
const cv::Vec3f kPaint(100, 200, 50);
const cv::Vec3f kRubberTone(34, 34, 34);
const cv::Vec3f kGlassTone(46, 42, 38);

ObjectLook lookOf(ObjectKind kind, double length, double width, double height, std::uint32_t seed = 1) {
    return {kind, length, width, height, kPaint, seed};
}

Outline box(double rear, double front, double left, double right) {
    return {{rear, left}, {front, left}, {front, right}, {rear, right}};
}

void expectColour(const Face& face, const cv::Vec3f& colour, const std::string& what) {
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(face.colour[i], colour[i], 1e-3) << what << ", channel " << i;
}

void expectLid(const Face& face, const Outline& outline, double z, const cv::Vec3f& colour, const std::string& what) {
    ASSERT_EQ(face.corners.size(), outline.size()) << what;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        EXPECT_NEAR(face.corners[i].x, outline[i].x, 1e-9) << what << ", corner " << i;
        EXPECT_NEAR(face.corners[i].y, outline[i].y, 1e-9) << what << ", corner " << i;
        EXPECT_NEAR(face.corners[i].z, z, 1e-9) << what << ", corner " << i;
    }
    expectColour(face, colour, what);
}

/// Walls around an outline, from face `at` on.
void expectWalls(const Mesh& mesh, std::size_t at, const Outline& outline, double bottom, double top,
                 const cv::Vec3f& colour, const std::string& what) {
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const Face& wall = mesh.faces[at + i];
        const cv::Point2d a = outline[i], b = outline[(i + 1) % outline.size()];
        const std::vector<cv::Point3d> corners{
            {b.x, b.y, top}, {a.x, a.y, top}, {a.x, a.y, bottom}, {b.x, b.y, bottom}};
        ASSERT_EQ(wall.corners.size(), 4U) << what;
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(wall.corners[k].x, corners[k].x, 1e-9) << what << ", wall " << i;
            EXPECT_NEAR(wall.corners[k].y, corners[k].y, 1e-9) << what << ", wall " << i;
            EXPECT_NEAR(wall.corners[k].z, corners[k].z, 1e-9) << what << ", wall " << i;
        }
        expectColour(wall, colour, what);
    }
}

/// Walls and lid.
void expectPrism(const Mesh& mesh, std::size_t at, const Outline& outline, double bottom, double top,
                 const cv::Vec3f& wall, const cv::Vec3f& lid, const std::string& what) {
    ASSERT_GT(mesh.faces.size(), at + outline.size()) << what;
    expectWalls(mesh, at, outline, bottom, top, wall, what);
    expectLid(mesh.faces[at + outline.size()], outline, top, lid, what);
}

/// The four sides and the roof of a cabin, from face `at` on; which sides are glass is answered as "1111".
std::string expectCabin(const Mesh& mesh, std::size_t at, const Outline& low, double bottom, const Outline& high,
                        double top, const std::string& what) {
    std::string glass;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t next = (i + 1) % 4;
        const Face& side = mesh.faces[at + i];
        const std::vector<cv::Point3d> corners{{high[next].x, high[next].y, top},
                                               {high[i].x, high[i].y, top},
                                               {low[i].x, low[i].y, bottom},
                                               {low[next].x, low[next].y, bottom}};
        for (std::size_t k = 0; k < 4; ++k) {
            EXPECT_NEAR(side.corners[k].x, corners[k].x, 1e-9) << what << ", side " << i;
            EXPECT_NEAR(side.corners[k].y, corners[k].y, 1e-9) << what << ", side " << i;
            EXPECT_NEAR(side.corners[k].z, corners[k].z, 1e-9) << what << ", side " << i;
        }
        const bool is_glass = side.finish == Finish::glass;
        glass += is_glass ? '1' : '0';
        expectColour(side, is_glass ? kGlassTone : kPaint, what);
    }
    expectLid(mesh.faces[at + 4], high, top, kPaint, what + ", roof");
    return glass;
}

/// Head lamps and tail lights of a vehicle 3 m wide, from face `at` on.
void expectLights(const Mesh& mesh, std::size_t at, double half_length, double z) {
    const double front = half_length, rear = -half_length;
    const cv::Vec3f white(205, 210, 210), red(40, 36, 120);
    expectLid(mesh.faces[at], box(front - 0.42, front - 0.12, -1.06, -0.80), z, white, "left head lamp");
    expectLid(mesh.faces[at + 1], box(rear + 0.08, rear + 0.26, -1.14, -0.84), z, red, "left tail light");
    expectLid(mesh.faces[at + 2], box(front - 0.42, front - 0.12, 0.80, 1.06), z, white, "right head lamp");
    expectLid(mesh.faces[at + 3], box(rear + 0.08, rear + 0.26, 0.84, 1.14), z, red, "right tail light");
}

/// All of many draws lie in the range, and some near either end.
class Spread {
 public:
    void add(double value) {
        least_ = std::min(least_, value);
        most_ = std::max(most_, value);
    }
    void expect(double low, double high, const std::string& what) const {
        EXPECT_GE(least_, low - 1e-6) << what;
        EXPECT_LE(most_, high + 1e-6) << what;
        EXPECT_LT(least_, low + 0.1 * (high - low) + 1e-6) << what;
        EXPECT_GT(most_, high - 0.1 * (high - low) - 1e-6) << what;
    }

 private:
    double least_ = 1e9, most_ = -1e9;
};

/// Of 1,000 seeds; four deviations are 63 at most.
void expectShare(int count, double share, const std::string& what) {
    EXPECT_NEAR(count / 1000.0, share, 4 * std::sqrt(share * (1 - share) / 1000)) << what;
}

/// The octagon that stands for an ellipse.
Outline octagon(double centre, double half_length, double half_width) {
    const double u = 0.7071 * half_length, v = 0.7071 * half_width;
    return {{centre - half_length, 0}, {centre - u, -v}, {centre, -half_width}, {centre + u, -v},
            {centre + half_length, 0}, {centre + u, v},  {centre, half_width},  {centre - u, v}};
}

}  // namespace

TEST(VehicleShape, ACarHasASkirtABodyACabinAndLights) {
    Spread bonnet, hatch, boot, hatch_slope, boot_slope, windscreen;
    int hatchbacks = 0, sunroofs = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds && !testing::Test::HasFailure(); ++seed) {
        const Mesh car = bodyOf(lookOf(ObjectKind::car, 4, 3, 1.5, seed));
        expectWalls(car, 0, box(-1.95, 1.9, -1.455, 1.455), 0.16, 0.38, kRubberTone, "skirt");
        const Outline body{{-2, -0.93}, {-1.78, -1.35}, {-1.2, -1.5}, {1.1, -1.5}, {1.7, -1.35},  {2, -0.825},
                           {2, 0.825},  {1.7, 1.35},    {1.1, 1.5},   {-1.2, 1.5}, {-1.78, 1.35}, {-2, 0.93}};
        expectPrism(car, 4, body, 0.38, 0.93, {92, 184, 46}, kPaint, "body");
        const double rear = car.faces[17].corners[2].x, front = car.faces[17].corners[3].x;
        const double lid_front = car.faces[17].corners[0].x, lid_rear = car.faces[17].corners[1].x;
        EXPECT_EQ(expectCabin(car, 17, box(rear, front, -1.35, 1.35), 0.93, box(lid_rear, lid_front, -1.05, 1.05), 1.5,
                              "cabin"),
                  "1111");
        bonnet.add((2 - front) / 4);
        windscreen.add(front - lid_front);
        const double trunk = (rear + 2) / 4;
        const bool hatchback = trunk < 0.09;
        hatchbacks += hatchback ? 1 : 0;
        (hatchback ? hatch : boot).add(trunk);
        (hatchback ? hatch_slope : boot_slope).add(lid_rear - rear);
        const bool sunroof = car.faces.size() == 29;
        sunroofs += sunroof ? 1 : 0;
        ASSERT_EQ(car.faces.size(), sunroof ? 29U : 28U);
        if (sunroof)
            expectLid(car.faces[22], box(lid_front - 0.95, lid_front - 0.25, -0.825, 0.825), 1.51, kGlassTone,
                      "sunroof");
        const std::size_t next = sunroof ? 23 : 22;
        expectLid(car.faces[next], box(1.45, 1.5, -1.08, 1.08), 0.94, {70, 140, 35}, "seam");
        expectLid(car.faces[next + 1], box(front + 0.02, front + 0.12, -1.23, 1.23), 0.94, kRubberTone, "wipers");
        expectLights(car, next + 2, 2, 0.94);
    }
    bonnet.expect(0.22, 0.29, "bonnet, of the length");
    hatch.expect(0.02, 0.05, "boot of a hatchback");
    boot.expect(0.13, 0.18, "boot");
    hatch_slope.expect(0.32, 0.32, "rear window of a hatchback");
    boot_slope.expect(0.55, 0.55, "rear window");
    windscreen.expect(0.65, 0.9, "windscreen");
    expectShare(hatchbacks, 0.5, "hatchbacks");
    expectShare(sunroofs, 0.15, "sunroofs");
}

TEST(VehicleShape, AVanHasALongCabinAndSometimesRibs) {
    int at_side = 0, at_rear = 0, ribbed = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds && !testing::Test::HasFailure(); ++seed) {
        const Mesh van = bodyOf(lookOf(ObjectKind::van, 6, 3, 2.2, seed));
        expectWalls(van, 0, box(-2.95, 2.9, -1.455, 1.455), 0.2, 0.45, kRubberTone, "skirt");
        const Outline body{{-3, -1.425}, {-2.7, -1.5}, {2.4, -1.5}, {3, -1.05},
                           {3, 1.05},    {2.4, 1.5},   {-2.7, 1.5}, {-3, 1.425}};
        expectPrism(van, 4, body, 0.45, 1.15, {92, 184, 46}, kPaint, "body");
        const std::string glass =
            expectCabin(van, 13, box(-2.98, 2.25, -1.44, 1.44), 1.15, box(-2.9, 1.45, -1.26, 1.26), 2.2, "cabin");
        EXPECT_EQ(glass[1], '1') << "the windscreen";
        EXPECT_EQ(glass[0], glass[2]);
        at_side += glass[0] == '1' ? 1 : 0;
        at_rear += glass[3] == '1' ? 1 : 0;
        const bool ribs = van.faces.size() == 27;
        ribbed += ribs ? 1 : 0;
        ASSERT_EQ(van.faces.size(), ribs ? 27U : 22U);
        for (std::size_t i = 0; ribs && i < 5; ++i) {
            const double x = -2.4 + 0.75 * static_cast<double>(i);
            expectLid(van.faces[18 + i], box(x, x + 0.09, -1.05, 1.05), 2.21, {78, 156, 39}, "rib");
        }
        expectLights(van, ribs ? 23 : 18, 3, 1.16);
    }
    expectShare(at_side, 0.4, "windows at the side");
    expectShare(at_rear, 0.5, "windows at the rear");
    expectShare(ribbed, 0.5, "ribs");
}

TEST(VehicleShape, ATruckHasACabAndATipperOrABox) {
    Spread gap, lump_x, lump_length, lump_half, lump_shift, lump_tone;
    int tippers = 0, brown = 0, boxes = 0;
    std::map<int, int> greys;
    for (std::uint32_t seed = 1; seed <= kSeeds && !testing::Test::HasFailure(); ++seed) {
        const Mesh truck = bodyOf(lookOf(ObjectKind::truck, 8, 3, 3.5, seed));
        expectPrism(truck, 0, box(-4, 3.8, -1.23, 1.23), 0.5, 1.05, {52, 52, 52}, {52, 52, 52}, "chassis");
        expectPrism(truck, 5, box(2, 4, -1.455, 1.455), 0.5, 1.5, {90, 180, 45}, kPaint, "cab");
        EXPECT_EQ(expectCabin(truck, 10, box(2, 3.95, -1.44, 1.44), 1.5, box(2.05, 3.65, -1.35, 1.35), 2.9, "windows"),
                  "1110");
        const double cargo = truck.faces[15].corners[0].x;
        gap.add(2 - cargo);
        const double top = truck.faces[15].corners[0].z;
        if (top < 2) {
            ++tippers;
            expectPrism(truck, 15, box(-4, cargo, -1.5, 1.5), 1.05, 1.9, {80, 160, 40}, {85, 170, 42.5F}, "bed");
            ASSERT_EQ(truck.faces.size(), 28U);
            expectLid(truck.faces[20], box(-3.88, cargo - 0.12, -1.38, 1.38), 1.91, {70, 88, 102}, "rubble");
            for (std::size_t i = 21; i < 28; ++i) {
                const Face& lump = truck.faces[i];
                lump_x.add((lump.corners[0].x + 3.4) / (cargo - 0.8 + 3.4));
                lump_length.add(lump.corners[1].x - lump.corners[0].x);
                lump_half.add((lump.corners[3].y - lump.corners[0].y) / 2);
                lump_shift.add((lump.corners[3].y + lump.corners[0].y) / 2);
                lump_tone.add(lump.colour[0] / 70);
                EXPECT_NEAR(lump.corners[0].z, 1.92, 1e-9);
            }
            continue;
        }
        ++boxes;
        const cv::Vec3f lid = truck.faces[19].colour;
        ++greys[cvRound(lid[0])];
        const bool is_brown = lid[1] < lid[0] - 1;
        brown += is_brown ? 1 : 0;
        const cv::Vec3f tone =
            is_brown ? cv::Vec3f(lid[0], lid[0] * 0.75F, lid[0] * 0.55F) : cv::Vec3f(lid[0], lid[0], lid[0] * 0.98F);
        expectPrism(truck, 15, box(-4, cargo, -1.5, 1.5), 1.05, 3.5, tone * 0.9F, tone, "box");
        if (lid[0] > 200) {
            EXPECT_EQ(truck.faces.size(), 20U) << "smooth";
            continue;
        }
        ASSERT_GE(truck.faces.size(), 27U);
        for (std::size_t i = 20; i < truck.faces.size(); ++i) {
            const double x = -3.4 + 0.62 * static_cast<double>(i - 20);
            EXPECT_LT(x, cargo - 0.3);
            expectLid(truck.faces[i], box(x, x + 0.07, -1.44, 1.44), 3.51, tone * 0.86F, "rib");
        }
        EXPECT_GE(-3.4 + 0.62 * static_cast<double>(truck.faces.size() - 20), cargo - 0.3) << "up to the front";
    }
    gap.expect(0.35, 0.8, "between cab and cargo");
    lump_x.expect(0, 1, "places of rubble");
    lump_length.expect(0.3, 0.8, "rubble");
    lump_half.expect(0.2, 0.5, "rubble");
    lump_shift.expect(-0.5, 0.5, "rubble");
    lump_tone.expect(0.6, 1.4, "rubble");
    expectShare(tippers, 0.25, "tippers");
    EXPECT_NEAR(static_cast<double>(brown) / boxes, 0.25, 0.07) << "brown boxes";
    EXPECT_EQ(greys.size(), 3U);
    for (const int grey : {205, 150, 96}) EXPECT_GT(greys[grey], 150) << grey;
}

TEST(VehicleShape, WhatIsLongerThanElevenMetresIsALorryWithATrailer) {
    const auto cabOf = [](double length, std::uint32_t seed) {
        return bodyOf(lookOf(ObjectKind::truck, length, 3, 2.5, seed)).faces[5].corners[1].x;
    };
    EXPECT_NEAR(cabOf(11, 1), 5.5 - 2, 1e-9);
    EXPECT_NEAR(cabOf(11.5, 1), 5.75 - 2.3, 1e-9);
    bool light_box = false;
    for (std::uint32_t seed = 1; seed <= 60; ++seed) {
        const Mesh lorry = bodyOf(lookOf(ObjectKind::truck, 15, 3, 3.5, seed));
        EXPECT_NEAR(lorry.faces[15].corners[0].z, 3.5, 1e-9) << "no tipper";
        light_box |= cvRound(lorry.faces[19].colour[0]) == 190;
    }
    EXPECT_TRUE(light_box);
    EXPECT_NEAR(bodyOf(lookOf(ObjectKind::truck, 8, 3, 2.5)).faces[14].corners[0].z, 2.5, 1e-9) << "a low cab";
}

TEST(VehicleShape, ABusHasWindowsAllRoundAndARoofWithHatches) {
    int plain = 0, boxed = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds && !testing::Test::HasFailure(); ++seed) {
        const Mesh bus = bodyOf(lookOf(ObjectKind::bus, 12, 3, 3.2, seed));
        const Outline body{{-6, -1.35}, {-5.75, -1.5}, {5.65, -1.5}, {6, -1.23},
                           {6, 1.23},   {5.65, 1.5},   {-5.75, 1.5}, {-6, 1.35}};
        expectPrism(bus, 0, body, 0.3, 1.2, {90, 180, 45}, kPaint, "body");
        EXPECT_EQ(
            expectCabin(bus, 9, box(-5.98, 5.98, -1.4775, 1.4775), 1.2, box(-5.88, 5.84, -1.41, 1.41), 2.95, "windows"),
            "1111");
        const bool is_plain = bus.faces[18].colour[0] < 150;
        plain += is_plain ? 1 : 0;
        expectPrism(bus, 14, box(-5.9, 5.8, -1.395, 1.395), 2.95, 3.2, kPaint,
                    is_plain ? kPaint : cv::Vec3f(196, 198, 198), "roof");
        const cv::Vec3f hatch(156.8F, 158.4F, 158.4F);
        expectLid(bus.faces[19], box(-3, -2.3, -0.38, 0.38), 3.21, hatch, "rear hatch");
        expectLid(bus.faces[20], box(2.7, 3.4, -0.38, 0.38), 3.21, hatch, "front hatch");
        if (bus.faces.size() == 21U) continue;
        ++boxed;
        ASSERT_EQ(bus.faces.size(), 26U);
        expectPrism(bus, 21, box(-0.9, 1.1, -0.9, 0.9), 3.2, 3.42, {147, 148.5F, 148.5F}, {172.48F, 174.24F, 174.24F},
                    "air conditioning");
    }
    expectShare(plain, 0.4, "roofs in the colour of the bus");
    expectShare(boxed, 0.6, "air conditioning");
}

TEST(VehicleShape, RidersAndPersonsAreOctagons) {
    const cv::Vec3f clothes(85, 170, 42.5F);
    int light_heads = 0, dark_hair = 0;
    for (std::uint32_t seed = 1; seed <= kSeeds && !testing::Test::HasFailure(); ++seed) {
        const Mesh rider = bodyOf(lookOf(ObjectKind::motorcycle, 2, 0.8, 1.68, seed));
        ASSERT_EQ(rider.faces.size(), 24U);
        expectPrism(rider, 0, box(-1, 1, -0.17, 0.17), 0.05, 0.8, kRubberTone, {50, 100, 25}, "motorcycle");
        expectLid(rider.faces[5], box(0.45, 0.55, -0.4, 0.4), 1, {47.6F, 47.6F, 47.6F}, "handlebars");
        expectPrism(rider, 6, octagon(-0.15, 0.26, 0.28), 0.8, 1.4, clothes, kPaint, "rider");
        const bool light = rider.faces[23].colour[0] > 100;
        light_heads += light ? 1 : 0;
        const cv::Vec3f head = light ? cv::Vec3f(190, 190, 190) : cv::Vec3f(50, 54, 70);
        expectPrism(rider, 15, octagon(-0.07, 0.15, 0.14), 1.4, 1.68, head * 0.85F, head, "head");
        const Mesh bicycle = bodyOf(lookOf(ObjectKind::bicycle, 2, 0.6, 1.68, seed));
        expectPrism(bicycle, 0, box(-1, 1, -0.06, 0.06), 0.05, 0.65, kRubberTone, kRubberTone, "bicycle");
        expectPrism(bicycle, 6, octagon(-0.15, 0.26, 0.27), 0.8, 1.4, clothes, kPaint, "narrow rider");

        const Mesh person = bodyOf(lookOf(ObjectKind::person, 0.5, 0.6, 1.8, seed));
        ASSERT_EQ(person.faces.size(), 27U);
        expectPrism(person, 0, octagon(0, 0.15, 0.18), 0, 0.85, {60, 52, 48}, {60, 52, 48}, "legs");
        expectPrism(person, 9, octagon(0, 0.25, 0.3), 0.85, 1.54, clothes, kPaint, "shoulders");
        const bool dark = person.faces[26].colour[0] < 60;
        dark_hair += dark ? 1 : 0;
        const cv::Vec3f hair = dark ? cv::Vec3f(38, 44, 54) : cv::Vec3f(90, 130, 150);
        expectPrism(person, 18, octagon(0.03, 0.11, 0.1), 1.54, 1.8, hair, hair, "hair");
    }
    expectShare(light_heads, 0.5, "light helmets");
    expectShare(dark_hair, 0.7, "dark hair");
}

TEST(VehicleShape, GlintsLookUpwardsFromBonnetAndBoot) {
    Spread front, rear, across;
    double steepness = 0;
    int count = 0, before = 0;
    for (std::uint32_t seed = 1; seed <= 200; ++seed) {
        const Mesh car = bodyOf(lookOf(ObjectKind::car, 4, 3, 1.5, seed));
        ASSERT_EQ(car.glints.size(), 24U);
        ASSERT_EQ(car.glint_places.size(), 24U);
        for (std::size_t i = 0; i < 24; ++i) {
            const cv::Point3d& mirror = car.glints[i];
            EXPECT_NEAR(mirror.dot(mirror), 1, 1e-9);
            EXPECT_GT(mirror.z, 0);
            steepness += (mirror.x * mirror.x + mirror.y * mirror.y) / (mirror.z * mirror.z);
            ++count;
            const cv::Point3d& place = car.glint_places[i];
            (place.x > 0 ? front : rear).add(place.x);
            before += place.x > 0 ? 1 : 0;
            across.add(place.y);
            EXPECT_NEAR(place.z, 1.35, 1e-9);
        }
    }
    EXPECT_NEAR(std::sqrt(steepness / count / 2), 0.28, 0.01) << "deviation in either direction";
    front.expect(0.68, 1.08, "0.2 m about 22 % of the length before the middle");
    rear.expect(-1.4, -1.0, "0.2 m about 30 % of the length behind it");
    across.expect(-0.9, 0.9, "30 % of the width");
    EXPECT_NEAR(static_cast<double>(before) / count, 0.5, 0.04);
    EXPECT_EQ(bodyOf(lookOf(ObjectKind::person, 0.5, 0.6, 1.8)).glints.size(), 2U);
}

TEST(VehicleLook, SizesAreThoseOfTheKind) {
    struct Sizes {
        ObjectKind kind;
        double length[2], width[2], height[2];
    };
    for (const Sizes& sizes : {Sizes{ObjectKind::van, {4.9, 6.4}, {1.92, 2.1}, {1.95, 2.6}},
                               Sizes{ObjectKind::bus, {11.5, 12.4}, {2.55, 2.55}, {3.0, 3.3}},
                               Sizes{ObjectKind::motorcycle, {1.95, 2.25}, {0.75, 0.9}, {1.68, 1.68}},
                               Sizes{ObjectKind::bicycle, {1.65, 1.85}, {0.55, 0.65}, {1.68, 1.68}},
                               Sizes{ObjectKind::person, {0.42, 0.6}, {0.5, 0.65}, {1.55, 1.85}}}) {
        Random random(5);
        Spread length, width, height;
        for (int i = 0; i < 400; ++i) {
            const ObjectLook look = randomLook(sizes.kind, random);
            EXPECT_EQ(look.kind, sizes.kind);
            length.add(look.length);
            width.add(look.width);
            height.add(look.height);
        }
        length.expect(sizes.length[0], sizes.length[1], std::string(nameOf(sizes.kind)) + ", length");
        width.expect(sizes.width[0], sizes.width[1], std::string(nameOf(sizes.kind)) + ", width");
        height.expect(sizes.height[0], sizes.height[1], std::string(nameOf(sizes.kind)) + ", height");
    }
}

TEST(VehicleLook, CarsAndTrucksComeInTwoSorts) {
    Random random(6);
    Spread car_length, car_width, high, low, short_truck, long_truck, truck_width, truck_height;
    double mean = 0, square = 0;
    int tall = 0, trailers = 0;
    for (int i = 0; i < 1000; ++i) {
        const ObjectLook car = randomLook(ObjectKind::car, random);
        EXPECT_GE(car.length, 3.6);
        EXPECT_LE(car.length, 5.1);
        mean += car.length / 1000;
        square += (car.length - 4.45) * (car.length - 4.45) / 1000;
        car_width.add(car.width - 0.1 * car.length);
        tall += car.height > 1.55 ? 1 : 0;
        (car.height > 1.55 ? high : low).add(car.height);
        const ObjectLook truck = randomLook(ObjectKind::truck, random);
        trailers += truck.length > 11 ? 1 : 0;
        (truck.length > 11 ? long_truck : short_truck).add(truck.length);
        truck_width.add(truck.width);
        truck_height.add(truck.height);
    }
    // The longest are cut at two deviations, so that a little is lacking.
    EXPECT_NEAR(mean, 4.45, 0.05);
    EXPECT_NEAR(std::sqrt(square), 0.31, 0.025);
    car_width.expect(1.31, 1.39, "width of a car without a tenth of its length");
    high.expect(1.6, 1.75, "tall cars");
    low.expect(1.42, 1.52, "flat cars");
    short_truck.expect(7, 9.8, "trucks");
    long_truck.expect(13.5, 16, "trucks with trailers");
    truck_width.expect(2.4, 2.55, "trucks");
    truck_height.expect(3.2, 3.9, "trucks");
    expectShare(tall, 0.3, "tall cars");
    expectShare(trailers, 0.3, "trailers");
}

TEST(VehicleLook, TheLongestAndShortestCarsAreCut) {
    Random random(7);
    Spread length;
    for (int i = 0; i < 3000; ++i) length.add(randomLook(ObjectKind::car, random).length);
    length.expect(3.6, 5.1, "cars");
}

TEST(VehicleLook, ColoursAreAsFrequentAsOnTheStreet) {
    Random random(8);
    int white = 0, teal = 0, red = 0;
    Spread brightness;
    for (int i = 0; i < 4000; ++i) {
        const cv::Vec3f colour = randomLook(ObjectKind::car, random).colour;
        if (colour[0] > 180) {
            ++white;
            EXPECT_NEAR(colour[0] / colour[1], 212.0 / 214, 1e-4);
            EXPECT_NEAR(colour[2] / colour[1], 1, 1e-4);
            brightness.add(colour[1]);
        } else if (colour[2] < 0.5 * colour[0] && colour[1] > 0.7 * colour[0]) {
            ++teal;
            EXPECT_NEAR(colour[0] / colour[1], 1.25, 1e-4);
            EXPECT_NEAR(colour[2] / colour[1], 70.0 / 120, 1e-4);
        } else if (colour[2] > 2 * colour[0] && colour[1] < 0.5 * colour[2]) {
            ++red;
        }
    }
    EXPECT_NEAR(white / 4000.0, 0.2, 0.026);
    EXPECT_NEAR(teal / 4000.0, 0.02, 0.009);
    EXPECT_NEAR(red / 4000.0, 0.06, 0.015);
    brightness.expect(214 * 0.88, 214 * 1.1, "white, as clean and as lit as it may be");

    int white_vans = 0, yellow_buses = 0;
    for (int i = 0; i < 1000; ++i) {
        white_vans += randomLook(ObjectKind::van, random).colour == cv::Vec3f(208, 210, 210) ? 1 : 0;
        const cv::Vec3f bus = randomLook(ObjectKind::bus, random).colour;
        const bool yellow = bus == cv::Vec3f(60, 170, 205);
        yellow_buses += yellow ? 1 : 0;
        EXPECT_TRUE(yellow || bus == cv::Vec3f(190, 190, 188));
    }
    expectShare(white_vans, 0.6, "white vans");
    expectShare(yellow_buses, 0.5, "yellow buses");
}

TEST(VehicleLook, MostVehiclesAreCars) {
    Random random(9);
    std::map<ObjectKind, double> share;
    for (int i = 0; i < 10'000; ++i) share[randomVehicleKind(random)] += 1e-4;
    EXPECT_NEAR(share[ObjectKind::car], 0.76, 0.018);
    EXPECT_NEAR(share[ObjectKind::van], 0.13, 0.014);
    EXPECT_NEAR(share[ObjectKind::truck], 0.08, 0.011);
    EXPECT_NEAR(share[ObjectKind::bus], 0.03, 0.007);
}

TEST(VehiclePlaced, ABodyStandsWhereAndAsItsPoseSays) {
    // Forward is down the map, so its right is to the left.
    const ObjectPose pose{{10, 20}, {0, 1}, 5};
    const cv::Point3d at = placed(cv::Point3d(3, 2, 1), pose);
    EXPECT_NEAR(at.x, 8, 1e-12);
    EXPECT_NEAR(at.y, 23, 1e-12);
    EXPECT_NEAR(at.z, 1, 1e-12);
    Mesh body;
    Face face;
    face.corners = {{3, 2, 1}};
    face.normal = {0.6, 0.8, 0.5};
    body.faces = {face};
    body.solids = {{{1, 0, 4}}};
    body.glints = {{0.6, 0.8, 0.5}};
    body.glint_places = {{0, 1, 2}};
    const Mesh world = placed(body, pose);
    EXPECT_EQ(world.faces[0].corners[0], cv::Point3d(8, 23, 1));
    EXPECT_EQ(world.faces[0].normal, cv::Point3d(-0.8, 0.6, 0.5));
    EXPECT_EQ(world.solids[0][0], cv::Point3d(10, 21, 4));
    EXPECT_EQ(world.glints[0], cv::Point3d(-0.8, 0.6, 0.5));
    EXPECT_EQ(world.glint_places[0], cv::Point3d(9, 20, 2));
}

}  // namespace eyrie::vehicle_shape_test

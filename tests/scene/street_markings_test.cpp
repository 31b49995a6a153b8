#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/town_by_hand.h"

/// One straight street or two, where every marking has its place.
namespace eyrie::street_markings_test {

using test::Bounds;
using test::boundsOf;
using test::countOf;
using test::patchesOf;
using test::Range;
using test::townOf;
using test::wideStreet;

TEST(StreetMarkings, AWideStreetHasTwoLinesDashesAndParkingBays) {
    const SceneDescription scene = townOf({wideStreet(390)});
    const std::vector<Bounds> paint = patchesOf(scene, Material::paint);
    // Two lines; 43 dashes of 3 m, 9 m apart, between the lanes of either side; 66 bays of 5.8 m.
    EXPECT_EQ(paint.size(), 2U + 2 * 43 + 2 * 66);
    EXPECT_EQ(countOf(paint, 0, 390, -0.22, -0.09), 1);
    EXPECT_EQ(countOf(paint, 0, 390, 0.09, 0.22), 1);
    for (const double from : {1.0, 10.0, 379.0}) {
        EXPECT_EQ(countOf(paint, from, from + 3, 2.93, 3.07), 1) << from;
        EXPECT_EQ(countOf(paint, from, from + 3, -3.07, -2.93), 1) << from;
    }
    for (const double from : {6.0, 11.8, 383.0}) {
        EXPECT_EQ(countOf(paint, from, from + 0.1, 6, 8), 1) << from;
        EXPECT_EQ(countOf(paint, from, from + 0.1, -8, -6), 1) << from;
    }
    const std::vector<Bounds> kerbs = patchesOf(scene, Material::kerb);
    ASSERT_EQ(kerbs.size(), 1U);
    EXPECT_EQ(countOf(kerbs, 0, 390, -8.3, 8.3), 1);
    const std::vector<Bounds> paving = patchesOf(scene, Material::paving);
    EXPECT_EQ(paving.size(), 20U);
    EXPECT_EQ(countOf(paving, 0, 40, -12, -8), 1);
    EXPECT_EQ(countOf(paving, 360, 390, 8, 12), 1);
    const std::vector<Bounds> road = patchesOf(scene, Material::asphalt);
    EXPECT_EQ(road.size(), 7U);
    EXPECT_EQ(countOf(road, 60, 120, -8, 8), 1);
    EXPECT_EQ(countOf(road, 360, 390, -8, 8), 1);
    const std::vector<Bounds> bays = patchesOf(scene, Material::worn_asphalt);
    EXPECT_EQ(countOf(bays, 0, 390, -8, -6), 1);
    EXPECT_EQ(countOf(bays, 0, 390, 6, 8), 1);
    // Lanes lie 1.5 and 4.5 m from the middle: oil on 0.7 m, rubber from 0.6 to 1.05 m beside it.
    const std::vector<Bounds> stains = patchesOf(scene, Material::stain);
    EXPECT_EQ(stains.size(), 12U);
    for (const double lane : {-4.5, -1.5, 1.5, 4.5}) {
        EXPECT_EQ(countOf(stains, 0, 390, lane - 0.35, lane + 0.35), 1) << lane;
        EXPECT_EQ(countOf(stains, 0, 390, lane - 1.05, lane - 0.6), 1) << lane;
        EXPECT_EQ(countOf(stains, 0, 390, lane + 0.6, lane + 1.05), 1) << lane;
    }
    for (const GroundPatch& patch : scene.patches) {
        const Surface& surface = patch.surface;
        if (surface.material == Material::stain) {
            const double width = boundsOf(patch.outline).bottom - boundsOf(patch.outline).top;
            EXPECT_EQ(surface.opacity, width > 0.5 ? 0.32 : 0.16);
            EXPECT_EQ(surface.tone, 0.9);
        } else if (surface.material == Material::kerb) {
            EXPECT_EQ(surface.tone, 0.95);
        } else if (surface.material == Material::asphalt) {
            EXPECT_TRUE(surface.tone >= 0.93 && surface.tone <= 1.06) << surface.tone;
            EXPECT_EQ(surface.seed, 91U);
            EXPECT_EQ(surface.direction, cv::Point2d(1, 0));
        } else if (surface.material == Material::paving) {
            EXPECT_TRUE(surface.tone >= 0.88 && surface.tone <= 1.05) << surface.tone;
        } else if (surface.material == Material::worn_asphalt) {
            EXPECT_EQ(surface.tone, 0.92);
        }
    }
}

TEST(StreetMarkings, ANarrowStreetHasOneDashedLineAndEdges) {
    Street street = wideStreet(390);
    street.lanes = 1;
    street.parking = 0;
    const std::vector<Bounds> paint = patchesOf(townOf({street}), Material::paint);
    EXPECT_EQ(paint.size(), 33U + 2);  // dashes of 4 m, 12 m apart
    EXPECT_EQ(countOf(paint, 1, 5, -0.07, 0.07), 1);
    EXPECT_EQ(countOf(paint, 385, 389, -0.07, 0.07), 1);
    EXPECT_EQ(countOf(paint, 0, 390, 2.69, 2.81), 1);
    EXPECT_EQ(countOf(paint, 0, 390, -2.81, -2.69), 1);
    street.marked = false;
    EXPECT_TRUE(patchesOf(townOf({street}), Material::paint).empty());
}

TEST(StreetMarkings, BeforeACrossingAreZebrasStopLinesAndArrows) {
    Street narrow;
    narrow.path = Path::rounded({{200, -200}, {200, 200}}, 10);
    narrow.lanes = 1;
    narrow.lane_width = 3;
    narrow.parking = 0;
    narrow.pavement = 2;
    SceneDescription scene;
    Town town(scene, {0, -900, 100, 1}, 1);
    town.addStreet(wideStreet(400));
    town.addStreet(narrow);
    town.build();
    ASSERT_EQ(town.crossings().size(), 1U);
    const Crossing& crossing = town.crossings()[0];
    EXPECT_NEAR(crossing.s_first, 200, 1e-6);
    EXPECT_NEAR(crossing.s_second, 200, 1e-6);
    EXPECT_NEAR(town.stopLineAt(crossing, 0, true), 200 - 9.5, 1e-6);
    EXPECT_NEAR(town.stopLineAt(crossing, 0, false), 200 + 9.5, 1e-6);
    EXPECT_NEAR(town.stopLineAt(crossing, 1, true), 200 - 14.5, 1e-6);
    EXPECT_NEAR(town.stopLineAt(crossing, 1, false), 200 + 14.5, 1e-6);
    const std::vector<Bounds> paint = patchesOf(scene, Material::paint);
    // Lines end 7.5 m before the other's kerb.
    EXPECT_EQ(countOf(paint, 0, 189.5, 0.09, 0.22), 1);
    EXPECT_EQ(countOf(paint, 210.5, 400, 0.09, 0.22), 1);
    EXPECT_EQ(countOf(paint, 202.69, 202.81, -200, -15.5), 1);
    EXPECT_EQ(countOf(paint, 202.69, 202.81, 15.5, 200), 1);
    // Zebras of 3 m, 2.2 m from the kerb, stripes of half a metre; 15 across 16 m, 5 across 6 m.
    const auto stripes = [&](double left, double right, double width, bool across) {
        return std::count_if(paint.begin(), paint.end(), [&](const Bounds& b) {
            const double from = across ? b.left : b.top, to = across ? b.right : b.bottom;
            const double wide = across ? b.bottom - b.top : b.right - b.left;
            return std::abs(from - left) < 1e-6 && std::abs(to - right) < 1e-6 && std::abs(wide - width) < 1e-6;
        });
    };
    EXPECT_EQ(stripes(191.8, 194.8, 0.5, true), 15);
    EXPECT_EQ(stripes(205.2, 208.2, 0.5, true), 15);
    EXPECT_EQ(countOf(paint, 191.8, 194.8, -7.5, -7), 1);
    EXPECT_EQ(countOf(paint, 191.8, 194.8, 6.5, 7), 1);
    EXPECT_EQ(stripes(-13.2, -10.2, 0.5, false), 5);
    EXPECT_EQ(stripes(10.2, 13.2, 0.5, false), 5);
    // Stop lines on the right of each direction.
    EXPECT_EQ(countOf(paint, 190.5, 190.9, 0.2, 6), 1);
    EXPECT_EQ(countOf(paint, 209.1, 209.5, -6, -0.2), 1);
    EXPECT_EQ(countOf(paint, 197, 199.8, -14.5, -14.1), 1);
    EXPECT_EQ(countOf(paint, 200.2, 203, 14.1, 14.5), 1);
    // The shafts of arrows, 7 m before: 2.8 m long from 2 m before to 0.8 m behind the middle.
    for (const double lane : {1.5, 4.5}) {
        EXPECT_EQ(countOf(paint, 181.7, 184.5, lane - 0.11, lane + 0.11), 1) << lane;
        EXPECT_EQ(countOf(paint, 215.5, 218.3, -lane - 0.11, -lane + 0.11), 1) << lane;
    }
    // Both roads go through, and the corners are rounded to 5 m.
    const std::vector<Bounds> road = patchesOf(scene, Material::asphalt);
    EXPECT_EQ(countOf(road, 195, 205, -8, 8), 1);
    EXPECT_EQ(countOf(road, 197, 203, -12, 12), 1);
    const std::vector<Bounds> kerbs = patchesOf(scene, Material::kerb);
    for (const double x : {192.0, 203.0}) {
        EXPECT_EQ(countOf(kerbs, x, x + 5, 8, 13), 1) << x;
        EXPECT_EQ(countOf(kerbs, x, x + 5, -13, -8), 1) << x;
    }
    EXPECT_EQ(countOf(road, 203, 207.6, 8, 12.6), 1) << "0.08 less than the kerb";
    for (const GroundPatch& patch : scene.patches) {
        if (patch.surface.material != Material::kerb || patch.outline.size() != 8U) continue;
        const cv::Point2d corner = patch.outline[0];
        const cv::Point2d middle = patch.outline[4] - corner;  // at 45°: 5 m less 3.5
        EXPECT_NEAR(std::abs(middle.x), 1.4645, 1e-6);
        EXPECT_NEAR(std::abs(middle.y), 1.4645, 1e-6);
        const cv::Point2d third = patch.outline[3] - corner;
        EXPECT_NEAR(std::abs(third.x), 2.5, 1e-6);
        EXPECT_NEAR(std::abs(third.y), 0.67, 1e-6);
    }
}

TEST(StreetMarkings, ArrowsPointAheadOrToTheSideOfTheirLane) {
    int ahead = 0, aside = 0;
    for (std::uint32_t seed = 1; seed <= 12; ++seed) {
        Street narrow = wideStreet(400);
        narrow.path = Path::rounded({{200, -200}, {200, 200}}, 10);
        narrow.lanes = 1;
        narrow.parking = 0;
        const std::vector<Bounds> paint = patchesOf(townOf({wideStreet(400), narrow}, seed), Material::paint);
        // Eastbound: 0.7 m before the middle of the arrow at 183.7 m; lane 0 turns right, lane 1 left.
        for (const auto& [lane, side] : {std::pair(4.5, 1), std::pair(1.5, -1)}) {
            const int straight = countOf(paint, 184.4, 185.7, lane - 0.42, lane + 0.42);
            const double bar = lane + side * 0.3, base = lane + side * 0.6, tip = lane + side * 1.5;
            const int bars = countOf(paint, 184.28, 184.52, bar - 0.375, bar + 0.375);
            EXPECT_EQ(bars, countOf(paint, 183.95, 184.85, std::min(base, tip), std::max(base, tip)));
            EXPECT_EQ(straight + bars, 1);
            ahead += straight;
            aside += bars;
        }
    }
    EXPECT_GT(ahead, 4);
    EXPECT_GT(aside, 4);
}

TEST(StreetMarkings, WearIsSpreadOverTheCarriageway) {
    Street street = wideStreet(4008);
    street.building_share = 0;
    street.tree_distance = street.lamp_distance = 0;
    street.occupancy = 0;
    const SceneDescription scene = townOf({street});
    int repairs = 0, cracks = 0, manholes = 0, light = 0;
    Range long_side, short_side, repair_tone, repair_opacity, place, crack_opacity, gap, aside;
    double last_manhole = 0;
    for (const GroundPatch& patch : scene.patches) {
        if (patch.surface.material != Material::tar) continue;
        const Bounds b = boundsOf(patch.outline);
        const cv::Point2d middle((b.left + b.right) / 2, (b.top + b.bottom) / 2);
        if (patch.outline.size() == 10U) {
            light += patch.surface.tone == 1.6 ? 1 : 0;
            EXPECT_TRUE(patch.surface.tone == 1.6 || patch.surface.tone == 0.7);
            EXPECT_EQ(patch.surface.opacity, 0.9);
            EXPECT_NEAR(b.right - b.left, 0.8, 0.02);
            // The ring begins at its rightmost point.
            const double s = patch.outline[0].x - 0.4;
            if (manholes++ > 0) {
                gap.add(s - last_manhole);
            } else {
                EXPECT_NEAR(s, 9, 1e-6);
            }
            last_manhole = s;
            aside.add(patch.outline[0].y);
            continue;
        }
        ASSERT_EQ(patch.outline.size(), 4U);
        const double side = cv::norm(patch.outline[1] - patch.outline[0]);
        const double width = cv::norm(patch.outline[2] - patch.outline[1]);
        if (width < 0.2) {
            ++cracks;
            EXPECT_NEAR(width, 0.1, 1e-9);
            EXPECT_TRUE(side >= 0.75 && side <= 2.25) << side;
            EXPECT_EQ(patch.surface.tone, 0.8);
            crack_opacity.add(patch.surface.opacity);
        } else {
            ++repairs;
            long_side.add(side);
            short_side.add(width);
            repair_tone.add(patch.surface.tone);
            repair_opacity.add(patch.surface.opacity);
            place.add(middle.y);
        }
    }
    EXPECT_EQ(repairs, 250) << "one on 16 m";
    long_side.expect(1, 7, "repairs");
    short_side.expect(0.6, 2.2, "repairs");
    repair_tone.expect(0.85, 1.75, "repairs");
    repair_opacity.expect(0.5, 0.9, "repairs");
    place.expect(-7, 7, "a metre from either kerb");
    crack_opacity.expect(0.4, 0.8, "cracks");
    EXPECT_NEAR(cracks, 572 * 4, 130) << "one on 7 m, of 2 to 6 pieces";
    gap.expect(18, 42, "manholes");
    aside.expect(-7.3, 7.3, "manholes");
    EXPECT_NEAR(light, manholes / 2.0, 0.21 * manholes);
}

}  // namespace eyrie::street_markings_test

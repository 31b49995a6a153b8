#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "scene/town_by_hand.h"

/// What stands along a straight street and behind it, and the spread of what is left to chance.
namespace eyrie::town_fronts_test {

using test::Bounds;
using test::boundsOf;
using test::Range;
using test::townOf;
using test::wideStreet;

TEST(TownFronts, TreesLampsAndFurnitureStandAlongTheKerb) {
    Street street = wideStreet(6000);
    street.building_share = 0;
    street.occupancy = 0;
    street.tree_distance = 10;
    const SceneDescription scene = townOf({street});
    Range height, radius, spacing, tone, yellow;
    std::map<int, double> last;
    for (const Tree& tree : scene.trees) {
        EXPECT_NEAR(std::abs(tree.position.y), 9.1, 1e-6);
        height.add(tree.height);
        radius.add(tree.crown_radius);
        const int side = tree.position.y > 0 ? 1 : -1;
        // Some places are empty: two spaces and more.
        if (last.contains(side) && tree.position.x - last[side] < 15.9) spacing.add(tree.position.x - last[side]);
        last[side] = tree.position.x;
        EXPECT_NEAR(tree.colour[1] / tree.colour[0], 82.0 / 44, 1e-4);
        tone.add(tree.colour[0] / 44);
        yellow.add(tree.colour[2] / tree.colour[0] * 44 / 60);
    }
    height.expect(6, 11, "trees");
    radius.expect(1.8, 3.2, "crowns");
    tone.expect(0.75, 1.2, "leaves");
    yellow.expect(0.85, 1.25, "leaves");
    spacing.expect(8, 13, "trees, 0.8 to 1.3 times as far as asked");
    EXPECT_NEAR(static_cast<double>(scene.trees.size()), 2 * 6000 / 10.5 * 0.85, 75);

    Range lamp_height;
    ASSERT_EQ(scene.posts.size(), 215U + 214);  // from 3 m and from 17 m on, 28 m apart
    for (const LampPost& post : scene.posts) {
        const bool right = post.position.y > 0;
        EXPECT_NEAR(std::abs(post.position.y), 8.7, 1e-6);
        EXPECT_NEAR(post.arm.y, right ? -1 : 1, 1e-9) << "over the road";
        EXPECT_NEAR(std::fmod(post.position.x, 28), right ? 3 : 17, 1e-6);
        EXPECT_EQ(post.arm_length, 2.2);
        lamp_height.add(post.height);
    }
    lamp_height.expect(7.5, 9, "lamps");

    Range length, width, top, step, grey;
    int hedges = 0;
    std::map<int, double> before;
    for (const Block& block : scene.blocks) {
        EXPECT_NEAR(std::abs(block.centre.y) + block.width / 2, 11.7, 1e-6) << "0.3 m from the fronts";
        length.add(block.length);
        width.add(block.width);
        top.add(block.top);
        const int side = block.centre.y > 0 ? 1 : -1;
        if (before.contains(side)) {
            step.add(block.centre.x - before[side]);
        } else {
            EXPECT_TRUE(block.centre.x >= 5 && block.centre.x <= 25);
        }
        before[side] = block.centre.x;
        if (block.colour == cv::Vec3f(40, 74, 52))
            ++hedges;
        else
            grey.add(block.colour[0]);
    }
    length.expect(0.8, 4, "furniture");
    width.expect(0.6, 1.5, "furniture");
    top.expect(0.8, 2.5, "furniture");
    step.expect(16, 60, "furniture");
    grey.expect(50, 190, "furniture");
    EXPECT_NEAR(static_cast<double>(hedges) / static_cast<double>(scene.blocks.size()), 0.4, 0.12);

    street.tree_overhang = 2;
    Range overhanging, tall;
    for (const Tree& tree : townOf({street}).trees) {
        EXPECT_NEAR(std::abs(tree.position.y), 8.7, 1e-6) << "0.4 m nearer";
        overhanging.add(tree.crown_radius);
        tall.add(tree.height);
    }
    overhanging.expect(2.8, 4.2, "crowns over the street");
    tall.expect(8, 13, "trees over the street");
    street.tree_overhang = 5;
    EXPECT_NEAR(std::abs(townOf({street}).trees.at(0).position.y), 8.5, 1e-6) << "0.6 m at most";
}

TEST(TownFronts, ParkedVehiclesStandInARowByTheKerb) {
    Street street = wideStreet(4000);
    street.building_share = 0;
    street.occupancy = 1;
    const SceneDescription scene = townOf({street});
    Range to_kerb, gap, skew;
    std::map<int, double> end;
    int cars = 0;
    for (const ParkedVehicle& parked : scene.parked) {
        const int side = parked.pose.position.y > 0 ? 1 : -1;
        to_kerb.add(8 - std::abs(parked.pose.position.y) - parked.look.width / 2);
        const double rear = parked.pose.position.x - parked.look.length / 2;
        if (end.contains(side)) {
            gap.add(rear - end[side]);
        } else {
            EXPECT_NEAR(rear, 1, 1e-6);
        }
        end[side] = rear + parked.look.length;
        EXPECT_LE(end[side], 4000);
        EXPECT_GT(parked.pose.direction.x * side, 0.99) << "as traffic runs there";
        skew.add(parked.pose.direction.y / parked.pose.direction.x);
        EXPECT_LE(parked.look.length, 8);
        cars += parked.look.kind == ObjectKind::car ? 1 : 0;
    }
    const auto count = static_cast<double>(scene.parked.size());
    to_kerb.expect(0.1, 0.35, "to the kerb");
    gap.expect(0.6, 1.6, "between two");
    skew.expect(-0.03, 0.03, "skew");
    EXPECT_NEAR(cars / count, 0.86, 0.04);
    EXPECT_GT(count, 1200);
    street.occupancy = 0.5;
    EXPECT_NEAR(static_cast<double>(townOf({street}).parked.size()) / count, 0.5, 0.06);
}

TEST(TownFronts, HousesStandAlongTheStreetWithTheirStoreys) {
    Street street = wideStreet(5000);
    street.building_share = 1;
    street.occupancy = 0;
    street.tree_distance = 0;
    const SceneDescription scene = townOf({street});
    Range length, depth, setback, gap, tile_tone, gravel_tone, tar_tone, facade, machine_length, machine_width,
        machine_top, machine_grey;
    int near_street = 0, close = 0, gaps = 0, gables = 0, tinted = 0, gravel = 0, metal = 0;
    std::set<int> heights;
    std::map<int, double> end;
    for (const Building& house : scene.buildings) {
        length.add(house.length);
        depth.add(house.width);
        const int side = house.centre.y > 0 ? 1 : -1;
        const double back = std::abs(house.centre.y) - house.width / 2 - 12.3;
        if (std::abs(back - 0.4) < 1e-6)
            ++near_street;
        else
            setback.add(back);
        const double rear = house.centre.x - house.length / 2;
        if (end.contains(side)) {
            ++gaps;
            const double space = rear - end[side];
            if (std::abs(space - 0.2) < 1e-6)
                ++close;
            else
                gap.add(space);
        } else {
            EXPECT_TRUE(rear >= 0 && rear <= 8);
        }
        end[side] = rear + house.length;
        heights.insert(cvRound(house.height * 10));
        const Surface& roof = house.roof_surface;
        facade.add(house.facade[2]);
        EXPECT_NEAR(house.facade[0] / house.facade[2], 0.88, 1e-4);
        EXPECT_NEAR(house.facade[1] / house.facade[2], 0.96, 1e-4);
        if (house.roof == RoofKind::gable) {
            ++gables;
            EXPECT_EQ(roof.material, Material::roof_tiles);
            tile_tone.add(roof.tone);
            tinted += roof.tint == cv::Vec3f(1.35F, 1.15F, 0.72F) ? 1 : 0;
        } else if (roof.material == Material::tar) {
            tar_tone.add(roof.tone);
        } else {
            (roof.material == Material::roof_gravel ? gravel : metal) += 1;
            gravel_tone.add(roof.tone);
        }
    }
    const auto count = static_cast<double>(scene.buildings.size());
    ASSERT_GT(count, 330);
    length.expect(13, 34, "houses");
    depth.expect(11, 16, "houses");
    setback.expect(1, 6, "from the pavement");
    gap.expect(2.5, 12, "between two");
    EXPECT_EQ(heights, (std::set<int>{102, 132, 162, 192})) << "1.2 m and three to six storeys of 3 m";
    EXPECT_NEAR(near_street / count, 0.6, 0.11);
    EXPECT_NEAR(static_cast<double>(close) / gaps, 0.55, 0.11);
    EXPECT_NEAR(gables / count, 0.4, 0.1);
    EXPECT_NEAR(static_cast<double>(tinted) / gables, 0.4, 0.16);
    EXPECT_NEAR(gravel / count, 0.35, 0.1);
    EXPECT_NEAR(metal / count, 0.15, 0.07);
    tile_tone.expect(0.65, 1.15, "tiles");
    gravel_tone.expect(0.62, 1.15, "gravel and metal");
    tar_tone.expect(0.9, 1.3, "tar", 0.25);
    facade.expect(110, 195, "facades");
    for (const Block& block : scene.blocks) {
        if (block.bottom == 0) continue;
        machine_length.add(block.length);
        machine_width.add(block.width);
        machine_top.add(block.top - block.bottom);
        machine_grey.add(block.colour[0]);
        const bool on_roof = std::any_of(scene.buildings.begin(), scene.buildings.end(), [&](const Building& house) {
            return house.roof == RoofKind::flat && block.bottom == house.height &&
                   std::abs(block.centre.x - house.centre.x) <= (house.length - block.length - 1.5) / 2 + 1e-9 &&
                   std::abs(block.centre.y - house.centre.y) <= (house.width - block.width - 1.5) / 2 + 1e-9;
        });
        EXPECT_TRUE(on_roof) << "0.75 m from its edges";
    }
    machine_length.expect(0.9, 3.4, "machines");
    machine_width.expect(0.8, 2.4, "machines");
    machine_top.expect(0.6, 2.2, "machines");
    machine_grey.expect(70, 190, "machines");
}

TEST(TownFronts, DetachedHousesHaveGardensAndGables) {
    Street street = wideStreet(5000);
    street.building_share = 1;
    street.occupancy = 0;
    street.tree_distance = 0;
    street.detached = true;
    street.storeys = {1, 2};
    street.frontage = {9, 13};
    street.depth = {9, 12};
    const SceneDescription scene = townOf({street});
    Range garden, gap;
    std::map<int, double> end;
    std::set<int> along, across;
    int turned = 0;
    for (const Building& house : scene.buildings) {
        EXPECT_EQ(house.roof, RoofKind::gable);
        const bool is_turned = std::abs(house.direction.y) > 0.5;
        turned += is_turned ? 1 : 0;
        (is_turned ? across : along).insert(cvRound(house.height * 10));
        const double front = is_turned ? house.length : house.width, wide = is_turned ? house.width : house.length;
        garden.add(std::abs(house.centre.y) - front / 2 - 12.3);
        const int side = house.centre.y > 0 ? 1 : -1;
        if (end.contains(side)) gap.add(house.centre.x - wide / 2 - end[side]);
        end[side] = house.centre.x + wide / 2;
    }
    garden.expect(4, 6, "front gardens");
    gap.expect(1.6, 4, "between two");
    EXPECT_EQ(along, (std::set<int>{34, 64})) << "0.4 m and storeys of 3 m";
    EXPECT_EQ(across, (std::set<int>{32, 60})) << "0.4 m and storeys of 2.8 m";
    EXPECT_NEAR(static_cast<double>(turned) / static_cast<double>(scene.buildings.size()), 0.4, 0.08);
}

TEST(TownFronts, BehindTheStreetsAreCarParksHousesAndTrees) {
    SceneDescription scene;
    Town town(scene, {100, 200, 500, 360}, 3);
    TownStyle style;
    style.car_parks = 0.3;
    style.yard_buildings = 0.3;
    style.bare_ground = 0.7;
    town.setStyle(style);
    town.build();
    Range park_length, tone, height, radius, house_length, house_width, house_height, plot_length, plot_width,
        plot_tone, across;
    std::map<Material, int> plots;
    for (const GroundPatch& patch : scene.patches) {
        const Bounds b = boundsOf(patch.outline);
        if (patch.surface.material == Material::worn_asphalt) {
            EXPECT_NEAR(b.bottom - b.top, 16.5, 1e-9);
            park_length.add(b.right - b.left);
            tone.add(patch.surface.tone);
        } else if (patch.surface.material == Material::paint) {
            EXPECT_NEAR(b.bottom - b.top, 5, 1e-9);
            EXPECT_NEAR(b.right - b.left, 0.1, 1e-9);
            EXPECT_EQ(patch.surface.tone, 0.95);
        } else {
            ++plots[patch.surface.material];
            plot_length.add(b.right - b.left);
            plot_width.add(b.bottom - b.top);
            plot_tone.add(patch.surface.tone);
        }
    }
    park_length.expect(22, 48, "car parks", 0.3);
    tone.expect(0.85, 1.05, "car parks", 0.2);
    plot_length.expect(14, 46, "plots");
    plot_width.expect(10, 30, "plots");
    plot_tone.expect(0.8, 1.1, "plots");
    // One on 900 m²; at 0.7 of the draws and above there is no green.
    EXPECT_EQ(plots.size(), 3U);
    EXPECT_EQ(plots[Material::gravel] + plots[Material::soil] + plots[Material::concrete], 200);
    EXPECT_NEAR(plots[Material::gravel], 0.8 * 200, 24);
    EXPECT_NEAR(plots[Material::soil], 0.1 * 200, 17);
    for (const Building& house : scene.buildings) {
        house_length.add(house.length);
        house_width.add(house.width);
        house_height.add(house.height);
        EXPECT_TRUE(house.centre.x >= 100 && house.centre.x <= 600 && house.centre.y >= 200 && house.centre.y <= 560);
    }
    house_length.expect(7, 26, "houses in yards", 0.3);
    house_width.expect(6, 15, "houses in yards", 0.3);
    house_height.expect(3, 13, "houses in yards", 0.3);
    for (const Tree& tree : scene.trees) {
        height.add(tree.height);
        radius.add(tree.crown_radius / tree.height);
    }
    height.expect(4, 13, "trees", 0.15);
    radius.expect(0.22, 0.36, "crowns, of the height");
    // Parked square to the rows, either way round, 0.3 m forth or back.
    Range skew;
    int down = 0;
    for (const ParkedVehicle& parked : scene.parked) {
        EXPECT_GT(std::abs(parked.pose.direction.y), 0.99);
        skew.add(parked.pose.direction.x / std::abs(parked.pose.direction.y));
        down += parked.pose.direction.y > 0 ? 1 : 0;
        for (const GroundPatch& patch : scene.patches) {
            const Bounds b = boundsOf(patch.outline);
            const cv::Point2d& p = parked.pose.position;
            if (patch.surface.material != Material::worn_asphalt || p.x < b.left || p.x > b.right || p.y < b.top ||
                p.y > b.bottom)
                continue;
            across.add(std::abs(std::abs(p.y - (b.top + b.bottom) / 2) - 5.65));  // 8.25 − 2.6
            const double bay = std::fmod(p.x - b.left - 0.5, 2.5);
            EXPECT_NEAR(bay, 1.25, 0.13);
        }
    }
    across.expect(0, 0.3, "from the middle of a row");
    skew.expect(-0.03, 0.03, "skew");
    EXPECT_NEAR(static_cast<double>(down) / static_cast<double>(scene.parked.size()), 0.5, 0.08);
}

}  // namespace eyrie::town_fronts_test

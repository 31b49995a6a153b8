#include "scene/painting/ground_map.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace eyrie::ground_map_test {
namespace {

/// Blue of the ground at a place.
int blueAt(const GroundMap& map, cv::Point2d place) {
    const cv::Point2d at = map.mapFromGround(place) * 256;
    return static_cast<int>(map.sample(static_cast<std::int32_t>(at.x), static_cast<std::int32_t>(at.y)) & 0xFF);
}

}  // namespace

// The map is painted in strips of rows; a patch reaches over several of them.
TEST(GroundMap, APatchIsPaintedWhollyWhicheverCornerItBeginsWith) {
    std::vector<cv::Point2d> outline{{10, 4}, {60, 30}, {50, 116}, {14, 90}};
    for (std::size_t begin = 0; begin < outline.size(); ++begin) {
        SceneDescription scene;
        scene.base = {Material::plain, 1};
        scene.patches = {{outline, {Material::plain, 0.5}}};
        const GroundMap map(scene, {0, 0, 80, 120}, 0.25);
        const int ground = blueAt(map, {5, 60});
        for (const cv::Point2d inside : {cv::Point2d(14, 10), {30, 18}, {30, 60}, {54, 32}, {46, 108}})
            EXPECT_NEAR(blueAt(map, inside), ground / 2, 2) << begin << inside;
        for (const cv::Point2d outside : {cv::Point2d(30, 5), {70, 60}, {20, 110}})
            EXPECT_EQ(blueAt(map, outside), ground) << begin << outside;
        std::rotate(outline.begin(), outline.begin() + 1, outline.end());
    }
}

}  // namespace eyrie::ground_map_test

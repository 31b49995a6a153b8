#include "motion/vectors/shadow_owners.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace eyrie::shadow_owners_test {
namespace {

const SceneScale kScale{0.25, 25, true};  // a car is 18 × 7 px

/// Corners every 3 px over a rectangle whose motion is along +x.
void addPatch(std::vector<MotionVector>& vectors, cv::Point2f top_left, cv::Size2f size, cv::Point2f velocity) {
    for (float y = 0; y <= size.height; y += 3) {
        for (float x = 0; x <= size.width; x += 3) {
            vectors.push_back({static_cast<CornerId>(vectors.size() + 1), top_left + cv::Point2f(x, y), velocity, 9});
        }
    }
}

struct Scene {
    std::vector<MotionVector> vectors;
    std::vector<char> dark;

    void add(cv::Point2f top_left, cv::Size2f size, cv::Point2f velocity, bool is_dark) {
        addPatch(vectors, top_left, size, velocity);
        dark.resize(vectors.size(), is_dark ? 1 : 0);
    }
    std::ptrdiff_t cast(const ShadowTestOptions& options = {}) const {
        const auto found = ShadowOwners(options, kScale).castShadows(vectors, dark, 0.02);
        return std::count(found.begin(), found.end(), 1);
    }
};

const cv::Point2f kVelocity(1.5F, 0);

TEST(ShadowOwners, AShadowBesideItsVehicleIsOne) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({102, 109}, {18, 6}, kVelocity, true);
    EXPECT_EQ(scene.cast(), 21);
}

TEST(ShadowOwners, AShadowAheadOfItsVehicleOrBehindIsOne) {
    for (const float x : {121.F, 91.F}) {
        Scene scene;
        scene.add({100, 100}, {18, 6}, kVelocity, false);
        scene.add({x, 100}, {6, 6}, kVelocity, true);
        EXPECT_EQ(scene.cast(), 9) << x;
    }
}

TEST(ShadowOwners, WhatLitGroundPartsFromTheVehicleStays) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({102, 109}, {18, 6}, kVelocity, true);
    const auto cast = [&](float lit_from_y) {
        const auto found =
            ShadowOwners({}, kScale)
                .castShadows(scene.vectors, scene.dark, 0.02,
                             [&](const OrientedBox&, cv::Point2f corner) { return corner.y >= lit_from_y; });
        return std::count(found.begin(), found.end(), 1);
    };
    EXPECT_EQ(cast(109), 0);
    EXPECT_EQ(cast(114), 21) << "most of it is not parted";
}

TEST(ShadowOwners, ADarkCarAloneStays) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, true);
    EXPECT_EQ(scene.cast(), 0);
}

TEST(ShadowOwners, ADarkCarInTheNextLaneOrBehindStays) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({100, 114}, {18, 6}, kVelocity, true);
    scene.add({74, 100}, {18, 6}, kVelocity, true);
    EXPECT_EQ(scene.cast(), 0);
}

TEST(ShadowOwners, ADarkThingThatMovesOtherwiseIsNoShadow) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({102, 109}, {18, 6}, {-1.5F, 0}, true);
    EXPECT_EQ(scene.cast(), 0);
}

TEST(ShadowOwners, AShadowMayDifferFromItsVehicleByAnEighthOfTheSpeed) {
    // 2.5 times the 5 % that members of a vehicle may: .1875 px/frame.
    for (const float faster : {-0.18F, 0.18F, -0.195F, 0.195F}) {
        Scene scene;
        scene.add({100, 100}, {18, 6}, kVelocity, false);
        scene.add({102, 109}, {18, 6}, {1.5F + faster, 0}, true);
        EXPECT_EQ(scene.cast(), std::abs(faster) < 0.19F ? 21 : 0) << faster;
    }
}

TEST(ShadowOwners, AGlintOwnsNoShadow) {
    Scene scene;
    scene.add({106, 100}, {3, 3}, kVelocity, false);
    scene.add({100, 104}, {18, 6}, kVelocity, true);
    EXPECT_EQ(scene.cast(), 0);
}

TEST(ShadowOwners, DarkWindowsBelongToTheVehicle) {
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({104, 101}, {3, 3}, kVelocity, true);
    EXPECT_EQ(scene.cast(), 0);
}

TEST(ShadowOwners, OwnersHaveASizeAndShadowsAReach) {
    // Its vectors spread over 4.5 × 1.5 m; the shadow's ends lie up to 9 px beside them, 2.25 m.
    Scene scene;
    scene.add({100, 100}, {18, 6}, kVelocity, false);
    scene.add({102, 109}, {18, 6}, kVelocity, true);
    const struct {
        const char* parameter;
        const char* cast;
        const char* stays;
    } limits[] = {{"motion.shadow_owner_length", "4.4", "4.6"},
                  {"motion.shadow_owner_width", "1.4", "1.6"},
                  {"motion.shadow_reach", "2.1", "1.9"}};  // a pixel more, and the corner 2 px ahead: hypot(9, 2) = 9.2
    for (const auto& limit : limits) {
        ShadowTestOptions options;
        setParameter(describeOf(options), limit.parameter, limit.cast);
        EXPECT_EQ(scene.cast(options), 21) << limit.parameter;
        setParameter(describeOf(options), limit.parameter, limit.stays);
        EXPECT_EQ(scene.cast(options), 0) << limit.parameter;
    }
}

TEST(ShadowOwners, TakesNothing) {
    EXPECT_TRUE(ShadowOwners({}, kScale).castShadows({}, {}, 0.02).empty());
}

}  // namespace
}  // namespace eyrie::shadow_owners_test

#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "scene/towns/town.h"

/// Towns small enough to be worked out by hand.
namespace eyrie::test {

struct Bounds {
    double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
};

inline Bounds boundsOf(const std::vector<cv::Point2d>& outline) {
    Bounds b;
    for (const cv::Point2d& p : outline) {
        b.left = std::min(b.left, p.x);
        b.right = std::max(b.right, p.x);
        b.top = std::min(b.top, p.y);
        b.bottom = std::max(b.bottom, p.y);
    }
    return b;
}

inline std::vector<Bounds> patchesOf(const SceneDescription& scene, Material material) {
    std::vector<Bounds> found;
    for (const GroundPatch& patch : scene.patches)
        if (patch.surface.material == material) found.push_back(boundsOf(patch.outline));
    return found;
}

/// How many of the patches have these bounds.
inline int countOf(const std::vector<Bounds>& patches, double left, double right, double top, double bottom) {
    return static_cast<int>(std::count_if(patches.begin(), patches.end(), [&](const Bounds& b) {
        return std::abs(b.left - left) < 1e-6 && std::abs(b.right - right) < 1e-6 && std::abs(b.top - top) < 1e-6 &&
               std::abs(b.bottom - bottom) < 1e-6;
    }));
}

/// All of many draws lie in the range, and some near either end.
class Range {
 public:
    void add(double value) {
        least_ = std::min(least_, value);
        most_ = std::max(most_, value);
    }
    void expect(double low, double high, const char* what, double slack = 0.1) const {
        EXPECT_GE(least_, low - 1e-6) << what;
        EXPECT_LE(most_, high + 1e-6) << what;
        EXPECT_LE(least_, low + slack * (high - low) + 1e-6) << what;
        EXPECT_GE(most_, high - slack * (high - low) - 1e-6) << what;
    }

 private:
    double least_ = 1e9, most_ = -1e9;
};

/// 8 m of carriageway on either side, 2 m of them parking, and 4 m of pavement.
inline Street wideStreet(double length) {
    Street street;
    street.path = Path::rounded({{0, 0}, {length, 0}}, 10);
    street.lanes = 2;
    street.lane_width = 3;
    street.parking = 2;
    return street;
}

/// A town whose land is too narrow to hold anything but its street.
inline SceneDescription townOf(const std::vector<Street>& streets, std::uint32_t seed = 1) {
    SceneDescription scene;
    Town town(scene, {0, -900, 100, 1}, seed);
    for (const Street& street : streets) town.addStreet(street);
    town.build();
    return scene;
}

}  // namespace eyrie::test

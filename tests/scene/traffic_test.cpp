#include "scene/traffic/traffic.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/geometry/angle.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie::traffic_test {
namespace {

Driver driverAt(double start, double speed) {
    Driver driver;
    driver.start = start;
    driver.desired_speed = speed;
    return driver;
}

double along(const MovingObject& object, int frame) {
    return object.poses[static_cast<std::size_t>(frame - object.first_frame)].position.x;
}

}  // namespace

TEST(Traffic, followsWithoutTouching) {
    const Route road{Path::rounded({{0, 0}, {1000, 0}}, 10), {0}, {}};
    // A slow one ahead, three fast ones behind.
    const auto objects =
        driveTraffic({road}, {driverAt(80, 6), driverAt(60, 15), driverAt(45, 15), driverAt(25, 15)}, 600, 25, 0);
    for (int frame = 0; frame < 600; frame += 5) {
        for (std::size_t i = 1; i < objects.size(); ++i) {
            EXPECT_GT(along(objects[i - 1], frame) - along(objects[i], frame), 4.5 + 0.8) << frame;
        }
    }
    EXPECT_NEAR(objects[3].poses.back().speed, 6, 0.4);
    EXPECT_LT(along(objects[0], 599) - along(objects[1], 599), 4.5 + 12) << "bumper to bumper";
}

TEST(Traffic, stopsAtRedAndStartsAgain) {
    const Route road{Path::rounded({{0, 0}, {600, 0}}, 10), {0}, {{150, {{0, 14}}}}};
    const auto objects = driveTraffic({road}, {driverAt(40, 14)}, 700, 25, 0);
    double least = 1e9;
    for (int frame = 0; frame < 345; ++frame) {
        EXPECT_LT(along(objects[0], frame) + 2.25, 150.6);
        least = std::min(least, objects[0].poses[static_cast<std::size_t>(frame)].speed);
    }
    EXPECT_LT(least, 0.1);
    EXPECT_GT(along(objects[0], 699), 200);
}

TEST(Traffic, overtakesOnTheFreeLane) {
    const Route road{Path::rounded({{0, 0}, {2000, 0}}, 10), {4.9, 1.6}, {}};
    std::vector<Driver> drivers{driverAt(100, 7), driverAt(70, 15)};
    drivers[1].overtakes = true;
    const auto objects = driveTraffic({road}, drivers, 900, 25, 0);
    EXPECT_LT(along(objects[1], 0), along(objects[0], 0));
    EXPECT_GT(along(objects[1], 899), along(objects[0], 899) + 10);
    double leftmost = 10;
    for (const ObjectPose& pose : objects[1].poses) leftmost = std::min(leftmost, pose.position.y);
    EXPECT_LT(leftmost, 2.2);
    EXPECT_NEAR(objects[1].poses.back().position.y, 4.9, 0.5) << "back in the first lane";
}

TEST(Traffic, slowsForBendsAndHeadsAlongItsWay) {
    const Route road{Path::rounded({{0, 0}, {150, 0}, {150, 150}}, 12), {0}, {}};
    const auto objects = driveTraffic({road}, {driverAt(30, 14)}, 500, 25, 0);
    double least = 1e9;
    const auto& poses = objects[0].poses;
    for (std::size_t i = 1; i + 1 < poses.size(); ++i) {
        least = std::min(least, poses[i].speed);
        const cv::Point2d way = poses[i + 1].position - poses[i - 1].position;
        if (std::hypot(way.x, way.y) < 0.2) continue;
        const double turn =
            turnBetween(std::atan2(way.y, way.x), std::atan2(poses[i].direction.y, poses[i].direction.x));
        EXPECT_NEAR(turn, 0, radiansFromDegrees(2.5)) << i;
    }
    // 2.6 m/s² sideways on a radius of 12 m.
    EXPECT_NEAR(least, std::sqrt(2.6 * 12), 1.2);
}

TEST(Traffic, leavesAtTheEndOfTheRoute) {
    const Route road{Path::rounded({{0, 0}, {60, 0}}, 10), {0}, {}};
    const auto objects = driveTraffic({road}, {driverAt(30, 10)}, 300, 25, 0);
    EXPECT_LT(objects[0].poses.size(), 120U);
    EXPECT_GT(objects[0].poses.size(), 40U);
}

TEST(Vehicles, meshesSpanTheirSizeAndLookOutwards) {
    Random random(7);
    for (const ObjectKind kind : {ObjectKind::car, ObjectKind::van, ObjectKind::truck, ObjectKind::bus,
                                  ObjectKind::motorcycle, ObjectKind::bicycle, ObjectKind::person}) {
        for (int i = 0; i < 8; ++i) {
            const ObjectLook look = randomLook(kind, random);
            const Mesh mesh = bodyOf(look);
            double x = 0, y = 0, z = 0;
            for (const Face& face : mesh.faces) {
                for (const cv::Point3d& corner : face.corners) {
                    EXPECT_GE(corner.z, 0);
                    x = std::max(x, std::abs(corner.x));
                    y = std::max(y, std::abs(corner.y));
                    z = std::max(z, corner.z);
                }
                // Faces of convex parts around the axis look away from it or up.
                cv::Point3d middle(0, 0, 0);
                for (const cv::Point3d& corner : face.corners)
                    middle += corner * (1.0 / static_cast<double>(face.corners.size()));
                EXPECT_NEAR(face.normal.dot(face.normal), 1, 1e-9);
                if (std::abs(face.normal.y) > 0.9) {
                    EXPECT_GT(face.normal.y * middle.y, 0) << nameOf(kind);
                }
            }
            EXPECT_NEAR(2 * x, look.length, 0.02) << nameOf(kind);
            EXPECT_NEAR(2 * y, look.width, 0.02) << nameOf(kind);
            EXPECT_LE(z, look.height + 0.35) << nameOf(kind);
        }
    }
}

}  // namespace eyrie::traffic_test

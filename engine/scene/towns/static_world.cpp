#include "scene/towns/static_world.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/geometry/angle.h"
#include "scene/painting/night_lights.h"
#include "scene/portable_math.h"
#include "scene/random.h"
#include "scene/traffic/path.h"
#include "scene/traffic/vehicle_shape.h"

namespace eyrie {
namespace {

const cv::Vec3f kSteel(118, 118, 116);

Mesh meshOf(const Building& building) {
    Mesh mesh;
    const std::vector<cv::Point2d> o =
        rectangleAt(building.centre, building.direction, building.length, building.width);
    addPrism(mesh, o, 0, building.height, building.facade, building.facade, Finish::facade);
    const float storey = 2.8F + 0.6F * static_cast<float>(hashOf(building.seed, 5, 9) >> 8) / 16777215.0F;
    for (Face& face : mesh.faces) {
        face.storey = storey;
        face.seed = building.seed;
    }
    if (building.roof == RoofKind::flat) {
        mesh.faces.back().finish = Finish::map_roof;
        return mesh;
    }
    mesh.faces.pop_back();
    const double ridge = building.height + building.width * 0.3;
    const cv::Point2d a = (o[0] + o[3]) * 0.5;
    const cv::Point2d b = (o[1] + o[2]) * 0.5;
    const auto at = [](cv::Point2d p, double z) { return cv::Point3d(p.x, p.y, z); };
    const double eaves = building.height;
    Face slope;
    slope.finish = Finish::map_roof;
    slope.corners = {at(o[0], eaves), at(o[1], eaves), at(b, ridge), at(a, ridge)};
    mesh.faces.push_back(slope);
    slope.corners = {at(o[2], eaves), at(o[3], eaves), at(a, ridge), at(b, ridge)};
    mesh.faces.push_back(slope);
    Face gable;
    gable.colour = building.facade;
    gable.corners = {at(o[1], eaves), at(o[2], eaves), at(b, ridge)};
    mesh.faces.push_back(gable);
    gable.corners = {at(o[3], eaves), at(o[0], eaves), at(a, ridge)};
    mesh.faces.push_back(gable);
    mesh.solids.front().push_back(at(a, ridge));
    mesh.solids.front().push_back(at(b, ridge));
    return mesh;
}

Mesh meshOf(const Block& block) {
    Mesh mesh;
    addPrism(mesh, rectangleAt(block.centre, block.direction, block.length, block.width), block.bottom, block.top,
             block.colour, block.colour, block.shines ? Finish::lamp : Finish::matte);
    return mesh;
}

Mesh meshOf(const LampPost& post) {
    Mesh mesh;
    addPrism(mesh, rectangleAt(post.position, post.arm, 0.2, 0.2), 0, post.height, kSteel, kSteel, Finish::matte);
    addPrism(mesh, rectangleAt(post.position + post.arm * (post.arm_length / 2), post.arm, post.arm_length, 0.13),
             post.height - 0.12, post.height, kSteel, kSteel, Finish::matte);
    addPrism(mesh, rectangleAt(post.position + post.arm * post.arm_length, post.arm, 0.8, 0.34), post.height - 0.2,
             post.height, kSteel * 1.3F, kSteel * 1.5F, Finish::lacquer);
    return mesh;
}

std::vector<cv::Point2d> ballShadow(const Ball& ball, cv::Point2d shadow_per_metre) {
    const double slant = std::sqrt(shadow_per_metre.dot(shadow_per_metre));
    const cv::Point2d along = slant > 1e-9 ? shadow_per_metre * (1 / slant) : cv::Point2d(1, 0);
    const cv::Point2d centre = cv::Point2d(ball.centre.x, ball.centre.y) + shadow_per_metre * ball.centre.z;
    const double stretch = std::sqrt(1 + slant * slant);
    static constexpr std::array<std::array<double, 2>, 8> circle{
        {{1, 0}, {0.7071, 0.7071}, {0, 1}, {-0.7071, 0.7071}, {-1, 0}, {-0.7071, -0.7071}, {0, -1}, {0.7071, -0.7071}}};
    std::vector<cv::Point2d> outline;
    for (const auto& p : circle) {
        outline.push_back(centre + along * (p[0] * ball.radius * stretch) + rightOf(along) * (p[1] * ball.radius));
    }
    return outline;
}

StandingThing thingOf(Mesh mesh) {
    StandingThing thing;
    cv::Point2d sum(0, 0);
    int count = 0;
    for (const Face& face : mesh.faces) {
        for (const cv::Point3d& corner : face.corners) {
            sum += cv::Point2d(corner.x, corner.y);
            ++count;
        }
    }
    thing.centre = sum * (1.0 / count);
    for (const Face& face : mesh.faces) {
        for (const cv::Point3d& corner : face.corners) {
            const cv::Point2d offset = cv::Point2d(corner.x, corner.y) - thing.centre;
            thing.reach = std::max(thing.reach, std::sqrt(offset.dot(offset)));
            thing.height = std::max(thing.height, corner.z);
        }
    }
    thing.mesh = std::move(mesh);
    orient(thing.mesh);
    return thing;
}

void lightFacades(Mesh& mesh, const SceneDescription& scene) {
    for (Face& face : mesh.faces) {
        if (face.finish != Finish::facade) continue;
        cv::Point3d middle(0, 0, 0);
        for (const cv::Point3d& corner : face.corners)
            middle += corner * (1.0 / static_cast<double>(face.corners.size()));
        const cv::Point2d before(middle.x + 4 * face.normal.x, middle.y + 4 * face.normal.y);
        face.lit = static_cast<float>(lampLightAt(scene, before));
    }
}

}  // namespace

std::vector<Ball> crownOf(const Tree& tree, const Sun& sun, cv::Vec3f direct) {
    Random random(tree.seed);
    const double radius = tree.crown_radius;
    const double crown_height = std::min(tree.height * 0.75, radius * 1.9);
    const double middle = tree.height - crown_height / 2;
    cv::Point3d to_sun(-sun.shadow.x, -sun.shadow.y, 1);
    to_sun *= 1 / std::sqrt(to_sun.dot(to_sun));

    struct Lobe {
        cv::Point3d centre;
        double radius;
    };
    std::vector<Lobe> lobes{{{0, 0, 0.12 * crown_height}, 0.62 * radius}};
    const int count = 5 + random.below(4);
    for (int i = 0; i < count; ++i) {
        const double angle = (i + random.uniform(-0.35, 0.35)) * 2 * kPi / count;
        const double reach = radius * random.uniform(0.42, 0.6);
        const double lift = random.uniform(-0.28, 0.12) * crown_height;
        lobes.push_back({{reach * portable::cosine(angle), reach * portable::sine(angle), lift},
                         radius * random.uniform(0.34, 0.5)});
    }
    std::vector<Ball> balls;
    for (const Lobe& lobe : lobes) {
        const int clumps = std::max(4, static_cast<int>(tree.density * 22 * lobe.radius));
        for (int i = 0; i < clumps; ++i) {
            cv::Point3d out;
            out.x = random.normal();
            out.y = random.normal();
            out.z = 0.4 + random.normal();
            out *= 1 / std::max(1e-6, std::sqrt(out.dot(out)));
            const double depth = random.uniform(0.72, 1.0);
            Ball ball;
            ball.centre = cv::Point3d(tree.position.x, tree.position.y, middle) + lobe.centre +
                          cv::Point3d(out.x * lobe.radius, out.y * lobe.radius,
                                      out.z * std::min(lobe.radius, crown_height * 0.4)) *
                              depth;
            ball.centre.z = std::clamp(ball.centre.z, tree.height * 0.2, tree.height);
            ball.radius = random.uniform(0.2, 0.48) * (tree.density < 0.6 ? 0.6 : 1.0);
            const double lit = std::max(0.0, out.dot(to_sun));
            const double tone = random.uniform(0.6, 1.4);
            for (int c = 0; c < 3; ++c) {
                const double light = sun.ambient * (0.55 + 0.45 * std::max(0.0, out.z)) +
                                     (1 - sun.ambient) * direct[c] * lit * lit * depth;
                ball.colour[c] = tree.colour[c] * static_cast<float>(light * 1.25 * tone);
            }
            balls.push_back(ball);
        }
    }
    return balls;
}

std::vector<std::vector<cv::Point2d>> shadowsOf(const Mesh& mesh, cv::Point2d shadow_per_metre) {
    std::vector<std::vector<cv::Point2d>> shadows;
    for (const auto& solid : mesh.solids) {
        std::vector<cv::Point2d> corners;
        for (const cv::Point3d& corner : solid) {
            corners.push_back(cv::Point2d(corner.x, corner.y) + shadow_per_metre * corner.z);
        }
        shadows.push_back(hullOf(std::move(corners)));
    }
    return shadows;
}

std::vector<StandingThing> standingThings(const SceneDescription& scene) {
    std::vector<StandingThing> things;
    for (const Building& building : scene.buildings) {
        things.push_back(thingOf(meshOf(building)));
        if (scene.night.lamps) lightFacades(things.back().mesh, scene);
    }
    for (const Block& block : scene.blocks) things.push_back(thingOf(meshOf(block)));
    for (const LampPost& post : scene.posts) {
        things.push_back(thingOf(meshOf(post)));
        if (!scene.night.lamps) continue;
        const cv::Point2d at = lightOf(post);
        const cv::Vec3f colour = scene.night.lamp_tint * 220.0F;
        things.back().balls.push_back({{at.x, at.y, post.height - 0.3}, 0.24, colour, true});
    }
    for (const ParkedVehicle& parked : scene.parked) {
        things.push_back(thingOf(placed(bodyOf(parked.look), parked.pose)));
        things.back().shadows = shadowsOf(things.back().mesh, scene.sun.shadow);
    }
    for (const Tree& tree : scene.trees) {
        Mesh trunk;
        addPrism(trunk, rectangleAt(tree.position, {1, 0}, 0.3, 0.3), 0, tree.height * 0.6, {56, 66, 76}, {56, 66, 76},
                 Finish::matte);
        StandingThing thing = thingOf(std::move(trunk));
        const auto lit = static_cast<float>(scene.night.lamps ? lampLightAt(scene, tree.position) : 1);
        thing.balls = crownOf(tree, scene.sun, scene.night.lamps ? scene.night.lamp_tint * lit : cv::Vec3f(1, 1, 1));
        thing.reach = tree.crown_radius * 1.4 + 1;
        thing.height = tree.height + 1;
        thing.sway = 0.012 * tree.height;
        thing.sway_phase = hashOf(tree.seed, 3, 1) / 4294967296.0 * 2 * kPi;
        things.push_back(std::move(thing));
    }
    return things;
}

std::vector<std::vector<cv::Point2d>> staticShadows(const SceneDescription& scene) {
    std::vector<std::vector<cv::Point2d>> shadows;
    SceneDescription without_parked = scene;
    without_parked.parked.clear();
    for (const StandingThing& thing : standingThings(without_parked)) {
        for (auto& shadow : shadowsOf(thing.mesh, scene.sun.shadow)) shadows.push_back(std::move(shadow));
        for (const Ball& ball : thing.balls) shadows.push_back(ballShadow(ball, scene.sun.shadow));
    }
    return shadows;
}

}  // namespace eyrie

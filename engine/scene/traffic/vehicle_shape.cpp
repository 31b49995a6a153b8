#include "scene/traffic/vehicle_shape.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/traffic/path.h"

namespace eyrie {
namespace {

const cv::Vec3f kGlass(46, 42, 38);
const cv::Vec3f kRubber(34, 34, 34);

struct Extent {
    double rear, front, half_width;
};

std::vector<cv::Point2d> boxOutline(const Extent& e) {
    return {{e.rear, -e.half_width}, {e.front, -e.half_width}, {e.front, e.half_width}, {e.rear, e.half_width}};
}

/// A quadrilateral given clockwise as seen from outside.
void addQuad(Mesh& mesh, std::array<cv::Point3d, 4> corners, cv::Vec3f colour, Finish finish) {
    Face face;
    face.corners.assign(corners.begin(), corners.end());
    face.colour = colour;
    face.finish = finish;
    mesh.faces.push_back(face);
}

/// A flat detail on top at height z.
void addPlate(Mesh& mesh, const Extent& e, double shift, double z, cv::Vec3f colour, Finish finish) {
    addQuad(mesh,
            {cv::Point3d(e.rear, shift - e.half_width, z), cv::Point3d(e.front, shift - e.half_width, z),
             cv::Point3d(e.front, shift + e.half_width, z), cv::Point3d(e.rear, shift + e.half_width, z)},
            colour, finish);
}

/// A tapering box: window bands all round and a lid.
void addCabin(Mesh& mesh, const Extent& base, double base_z, const Extent& lid, double lid_z, cv::Vec3f paint,
              bool windows_at_side, bool window_at_rear) {
    const std::array<cv::Point3d, 4> low{
        cv::Point3d(base.rear, -base.half_width, base_z), cv::Point3d(base.front, -base.half_width, base_z),
        cv::Point3d(base.front, base.half_width, base_z), cv::Point3d(base.rear, base.half_width, base_z)};
    const std::array<cv::Point3d, 4> high{
        cv::Point3d(lid.rear, -lid.half_width, lid_z), cv::Point3d(lid.front, -lid.half_width, lid_z),
        cv::Point3d(lid.front, lid.half_width, lid_z), cv::Point3d(lid.rear, lid.half_width, lid_z)};
    const auto side = [&](std::size_t a, std::size_t b, bool window) {
        addQuad(mesh, {high[b], high[a], low[a], low[b]}, window ? kGlass : paint,
                window ? Finish::glass : Finish::lacquer);
    };
    side(0, 1, windows_at_side);
    side(1, 2, true);
    side(2, 3, windows_at_side);
    side(3, 0, window_at_rear);
    addPlate(mesh, lid, 0, lid_z, paint, Finish::lacquer);
    std::vector<cv::Point3d> solid(low.begin(), low.end());
    solid.insert(solid.end(), high.begin(), high.end());
    mesh.solids.push_back(solid);
}

/// Wheels and sills, all dark; nobody sees them from above.
void addSkirt(Mesh& mesh, const Extent& e, double bottom, double top) {
    addPrism(mesh, boxOutline(e), bottom, top, kRubber, kRubber, Finish::matte);
    mesh.faces.pop_back();
}

void addLights(Mesh& mesh, double a, double w, double z) {
    for (const double side : {-1.0, 1.0}) {
        addPlate(mesh, {a - 0.42, a - 0.12, 0.13}, side * (w * 0.62), z, {205, 210, 210}, Finish::lacquer);
        addPlate(mesh, {-a + 0.08, -a + 0.26, 0.15}, side * (w * 0.66), z, {40, 36, 120}, Finish::lacquer);
    }
}

void addCar(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const double h = look.height;
    const double belt = h * 0.62;
    const std::vector<cv::Point2d> outline{
        {-a, -0.62 * w}, {-a + 0.22, -0.9 * w}, {-a + 0.8, -w}, {a - 0.9, -w}, {a - 0.3, -0.9 * w},  {a, -0.55 * w},
        {a, 0.55 * w},   {a - 0.3, 0.9 * w},    {a - 0.9, w},   {-a + 0.8, w}, {-a + 0.22, 0.9 * w}, {-a, 0.62 * w}};
    addSkirt(mesh, {-a + 0.05, a - 0.1, w * 0.97}, 0.16, 0.38);
    addPrism(mesh, outline, 0.38, belt, look.colour * 0.92F, look.colour, Finish::lacquer);
    const bool hatchback = random.chance(0.5);
    const double bonnet = look.length * random.uniform(0.22, 0.29);
    const double boot = hatchback ? look.length * random.uniform(0.02, 0.05) : look.length * random.uniform(0.13, 0.18);
    const Extent base{-a + boot, a - bonnet, 0.90 * w};
    const Extent lid{-a + boot + (hatchback ? 0.32 : 0.55), a - bonnet - random.uniform(0.65, 0.9), 0.70 * w};
    const bool sunroof = random.chance(0.15);
    addCabin(mesh, base, belt, lid, h, look.colour, true, true);
    if (sunroof) addPlate(mesh, {lid.front - 0.95, lid.front - 0.25, 0.55 * w}, 0, h + 0.01, kGlass, Finish::glass);
    // The seam of the bonnet, and the darker edge where lacquer turns down, break up large even areas.
    addPlate(mesh, {a - 0.55, a - 0.50, 0.72 * w}, 0, belt + 0.01, look.colour * 0.7F, Finish::matte);
    addPlate(mesh, {base.front + 0.02, base.front + 0.12, 0.82 * w}, 0, belt + 0.01, kRubber, Finish::matte);
    addLights(mesh, a, w, belt + 0.01);
}

void addVan(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const std::vector<cv::Point2d> outline{{-a, -0.95 * w}, {-a + 0.3, -w}, {a - 0.6, -w}, {a, -0.7 * w},
                                           {a, 0.7 * w},    {a - 0.6, w},   {-a + 0.3, w}, {-a, 0.95 * w}};
    addSkirt(mesh, {-a + 0.05, a - 0.1, w * 0.97}, 0.2, 0.45);
    addPrism(mesh, outline, 0.45, 1.15, look.colour * 0.92F, look.colour, Finish::lacquer);
    const Extent base{-a + 0.02, a - 0.75, 0.96 * w};
    const Extent lid{-a + 0.1, a - 1.55, 0.84 * w};
    const bool windows = random.chance(0.4);
    addCabin(mesh, base, 1.15, lid, look.height, look.colour, windows, random.chance(0.5));
    if (random.chance(0.5)) {
        for (double x = lid.rear + 0.5; x < lid.front - 0.3; x += 0.75) {
            addPlate(mesh, {x, x + 0.09, 0.7 * w}, 0, look.height + 0.01, look.colour * 0.78F, Finish::matte);
        }
    }
    addLights(mesh, a, w, 1.16);
}

void addTruck(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const double h = look.height;
    const bool trailer = look.length > 11;
    const double cab_rear = a - (trailer ? 2.3 : 2.0);
    const double cargo_front = cab_rear - random.uniform(0.35, 0.8);
    const cv::Vec3f chassis(52, 52, 52);
    addPrism(mesh, boxOutline({-a, a - 0.2, w * 0.82}), 0.5, 1.05, chassis, chassis, Finish::matte);
    addPrism(mesh, boxOutline({cab_rear, a, w * 0.97}), 0.5, 1.5, look.colour * 0.9F, look.colour, Finish::lacquer);
    const double cab_top = std::min(h, 2.9);
    addCabin(mesh, {cab_rear, a - 0.05, w * 0.96}, 1.5, {cab_rear + 0.05, a - 0.35, w * 0.9}, cab_top, look.colour,
             true, false);
    const int load = random.below(4);
    if (load == 0 && !trailer) {
        // A tipper with an open bed: dark floor with rubble between bright side walls.
        addPrism(mesh, boxOutline({-a, cargo_front, w}), 1.05, 1.9, look.colour * 0.8F, look.colour * 0.85F,
                 Finish::matte);
        const cv::Vec3f rubble(70, 88, 102);
        addPlate(mesh, {-a + 0.12, cargo_front - 0.12, w - 0.12}, 0, 1.91, rubble, Finish::matte);
        for (int i = 0; i < 7; ++i) {
            const double x = random.uniform(-a + 0.6, cargo_front - 0.8);
            const double length = random.uniform(0.3, 0.8);
            const double half = random.uniform(0.2, 0.5);
            const double shift = random.uniform(-0.5, 0.5);
            const auto tone = static_cast<float>(random.uniform(0.6, 1.4));
            addPlate(mesh, {x, x + length, half}, shift, 1.92, rubble * tone, Finish::matte);
        }
        return;
    }
    static constexpr std::array<float, 4> greys{190, 205, 150, 96};
    const float grey = greys[static_cast<std::size_t>(load)];
    const cv::Vec3f box =
        random.chance(0.25) ? cv::Vec3f(grey, grey * 0.75F, grey * 0.55F) : cv::Vec3f(grey, grey, grey * 0.98F);
    addPrism(mesh, boxOutline({-a, cargo_front, w}), 1.05, h, box * 0.9F, box, Finish::matte);
    if (load >= 2) {
        for (double x = -a + 0.6; x < cargo_front - 0.3; x += 0.62) {
            addPlate(mesh, {x, x + 0.07, w * 0.96}, 0, h + 0.01, box * 0.86F, Finish::matte);
        }
    }
}

void addBus(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const double h = look.height;
    const std::vector<cv::Point2d> outline{{-a, -0.9 * w}, {-a + 0.25, -w}, {a - 0.35, -w}, {a, -0.82 * w},
                                           {a, 0.82 * w},  {a - 0.35, w},   {-a + 0.25, w}, {-a, 0.9 * w}};
    addPrism(mesh, outline, 0.3, 1.2, look.colour * 0.9F, look.colour, Finish::lacquer);
    addCabin(mesh, {-a + 0.02, a - 0.02, w * 0.985}, 1.2, {-a + 0.12, a - 0.16, w * 0.94}, h - 0.25, look.colour, true,
             true);
    const cv::Vec3f roof(196, 198, 198);
    const bool plain = random.chance(0.4);
    addPrism(mesh, boxOutline({-a + 0.1, a - 0.2, w * 0.93}), h - 0.25, h, look.colour, plain ? look.colour : roof,
             Finish::lacquer);
    addPlate(mesh, {-a * 0.5, -a * 0.5 + 0.7, 0.38}, 0, h + 0.01, roof * 0.8F, Finish::matte);
    addPlate(mesh, {a * 0.45, a * 0.45 + 0.7, 0.38}, 0, h + 0.01, roof * 0.8F, Finish::matte);
    if (random.chance(0.6)) {
        addPrism(mesh, boxOutline({-0.9, 1.1, w * 0.6}), h, h + 0.22, roof * 0.75F, roof * 0.88F, Finish::matte);
    }
}

std::vector<cv::Point2d> ellipse(double centre, double half_length, double half_width) {
    static constexpr std::array<std::array<double, 2>, 8> circle{
        {{-1, 0}, {-0.7071, -0.7071}, {0, -1}, {0.7071, -0.7071}, {1, 0}, {0.7071, 0.7071}, {0, 1}, {-0.7071, 0.7071}}};
    std::vector<cv::Point2d> outline;
    for (const auto& point : circle) outline.emplace_back(centre + point[0] * half_length, point[1] * half_width);
    return outline;
}

void addRider(Mesh& mesh, double x, double seat, double half_width, cv::Vec3f clothes, cv::Vec3f head) {
    addPrism(mesh, ellipse(x, 0.26, half_width), seat, seat + 0.6, clothes * 0.85F, clothes, Finish::matte);
    addPrism(mesh, ellipse(x + 0.08, 0.15, 0.14), seat + 0.6, seat + 0.88, head * 0.85F, head, Finish::matte);
}

void addTwoWheeler(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const bool motor = look.kind == ObjectKind::motorcycle;
    const double half = motor ? 0.17 : 0.06;
    addPrism(mesh, boxOutline({-a, a, half}), 0.05, motor ? 0.8 : 0.65, kRubber, motor ? look.colour * 0.5F : kRubber,
             Finish::lacquer);
    // Handlebars give the full width.
    addPlate(mesh, {a - 0.55, a - 0.45, w}, 0, 1.0, kRubber * 1.4F, Finish::matte);
    const cv::Vec3f head = random.chance(0.5) ? cv::Vec3f(190, 190, 190) : cv::Vec3f(50, 54, 70);
    addRider(mesh, -0.15, 0.8, std::min(0.28, w * 0.9), look.colour, head);
}

void addPerson(Mesh& mesh, const ObjectLook& look, Random& random) {
    const double a = look.length / 2;
    const double w = look.width / 2;
    const cv::Vec3f trousers(60, 52, 48);
    const cv::Vec3f hair = random.chance(0.7) ? cv::Vec3f(38, 44, 54) : cv::Vec3f(90, 130, 150);
    addPrism(mesh, ellipse(0, a * 0.6, w * 0.6), 0.0, 0.85, trousers, trousers, Finish::matte);
    addPrism(mesh, ellipse(0, a, w), 0.85, look.height - 0.26, look.colour * 0.85F, look.colour, Finish::matte);
    addPrism(mesh, ellipse(0.03, 0.11, 0.1), look.height - 0.26, look.height, hair, hair, Finish::matte);
}

/// Curved glass and chrome: mirrors that face nearly, not quite, upwards. Each flashes when the camera passes the one
/// direction it throws the sun to.
void addGlintFaces(Mesh& mesh, const ObjectLook& look, Random& random) {
    const int count = isVehicle(look.kind) ? 24 : 2;
    for (int i = 0; i < count; ++i) {
        cv::Point3d mirror{random.normal() * 0.28, random.normal() * 0.28, 1};
        mirror *= 1 / std::sqrt(mirror.dot(mirror));
        mesh.glints.push_back(mirror);
        const double along = (random.chance(0.5) ? 0.22 : -0.3) * look.length + random.uniform(-0.2, 0.2);
        const double across = random.uniform(-0.3, 0.3) * look.width;
        mesh.glint_places.emplace_back(along, across, look.height * 0.9);
    }
}

}  // namespace

Mesh bodyOf(const ObjectLook& look) {
    Mesh mesh;
    Random random(look.seed);
    switch (look.kind) {
        case ObjectKind::car:
            addCar(mesh, look, random);
            break;
        case ObjectKind::van:
            addVan(mesh, look, random);
            break;
        case ObjectKind::truck:
            addTruck(mesh, look, random);
            break;
        case ObjectKind::bus:
            addBus(mesh, look, random);
            break;
        case ObjectKind::motorcycle:
        case ObjectKind::bicycle:
            addTwoWheeler(mesh, look, random);
            break;
        case ObjectKind::person:
            addPerson(mesh, look, random);
            break;
    }
    addGlintFaces(mesh, look, random);
    orient(mesh);
    return mesh;
}

cv::Point3d placed(cv::Point3d point, const ObjectPose& pose) {
    const cv::Point2d right = rightOf(pose.direction);
    return {pose.position.x + pose.direction.x * point.x + right.x * point.y,
            pose.position.y + pose.direction.y * point.x + right.y * point.y, point.z};
}

Mesh placed(const Mesh& body, const ObjectPose& pose) {
    Mesh world = body;
    const cv::Point2d right = rightOf(pose.direction);
    const auto turned = [&](cv::Point3d v) {
        return cv::Point3d(pose.direction.x * v.x + right.x * v.y, pose.direction.y * v.x + right.y * v.y, v.z);
    };
    for (Face& face : world.faces) {
        for (cv::Point3d& corner : face.corners) corner = placed(corner, pose);
        face.normal = turned(face.normal);
    }
    for (auto& solid : world.solids) {
        for (cv::Point3d& corner : solid) corner = placed(corner, pose);
    }
    for (cv::Point3d& place : world.glint_places) place = placed(place, pose);
    for (cv::Point3d& mirror : world.glints) mirror = turned(mirror);
    return world;
}

}  // namespace eyrie

#include "scene/painting/pass_geometry.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie {
namespace {

/// x to the power of 2^doublings.
double powerOfTwo(double x, int doublings) {
    for (int i = 0; i < doublings; ++i) x *= x;
    return x;
}

cv::Point3d unit(cv::Point3d v) {
    return v * (1 / std::sqrt(v.dot(v)));
}

}  // namespace

Light::Light(const SceneDescription& scene)
    : to_sun(unit({-scene.sun.shadow.x, -scene.sun.shadow.y, 1})),
      ambient(scene.sun.ambient),
      shadow(scene.sun.shadow),
      night(scene.night.lamps),
      windows(scene.night.windows),
      sight(scene.sight_m),
      haze(scene.haze_colour) {
    if (night) direct = scene.night.lamp_tint;
}

cv::Rect TileGrid::tile(int index) const {
    const int x = index % columns() * tile_width;
    const int y = index / columns() * tile_height;
    return {x, y, std::min(tile_width, image.width - x), std::min(tile_height, image.height - y)};
}

PassBuilder::PassBuilder(CameraPose camera, cv::Point2d offset, const TileGrid& grid, const Light& light,
                         const GroundMap& map)
    : camera_(camera), grid_(grid), light_(light), map_(map) {
    pass_.tiles.resize(static_cast<std::size_t>(grid.count()));
    camera_.principal -= offset;
    image_from_ground_ = camera_.imageFromGround();
    pass_.ground_from_image = image_from_ground_.inv();
    pass_.ground_inverse_depth = planeOf(camera_.camera_from_world_turn * cv::Vec3d(0, 0, -1 / camera_.position.z));
}

ScreenPlane PassBuilder::planeOf(cv::Vec3d in_camera) const {
    ScreenPlane plane;
    plane.a = static_cast<float>(in_camera[0] / camera_.focal_px);
    plane.b = static_cast<float>(in_camera[1] / camera_.focal_px);
    plane.c = static_cast<float>(
        in_camera[2] - (in_camera[0] * camera_.principal.x + in_camera[1] * camera_.principal.y) / camera_.focal_px);
    return plane;
}

void PassBuilder::Bounds::hold(cv::Point2f point) {
    left = std::min(left, point.x);
    right = std::max(right, point.x);
    top = std::min(top, point.y);
    bottom = std::max(bottom, point.y);
}

bool PassBuilder::inPicture(const Bounds& bounds) const {
    return bounds.right >= 0 && bounds.left <= static_cast<float>(grid_.image.width - 1) && bounds.bottom >= 0 &&
           bounds.top <= static_cast<float>(grid_.image.height - 1);
}

void PassBuilder::enter(const Bounds& bounds, std::vector<int> TileContent::*list, std::size_t position) {
    const auto tileAt = [](float place, int size, int count) {
        return std::clamp(static_cast<int>(std::max(place, 0.0F)) / size, 0, count - 1);
    };
    const int left = tileAt(bounds.left, grid_.tile_width, grid_.columns());
    const int right = tileAt(std::min(bounds.right, 1e6F), grid_.tile_width, grid_.columns());
    const int top = tileAt(bounds.top, grid_.tile_height, grid_.rows());
    const int bottom = tileAt(std::min(bounds.bottom, 1e6F), grid_.tile_height, grid_.rows());
    for (int row = top; row <= bottom; ++row) {
        for (int column = left; column <= right; ++column) {
            (pass_.tiles[static_cast<std::size_t>(row * grid_.columns() + column)].*list)
                .push_back(static_cast<int>(position));
        }
    }
}

void PassBuilder::add(const Mesh& mesh) {
    for (const Face& face : mesh.faces) add(face);
}

void PassBuilder::add(const Face& face) {
    const cv::Point3d& normal = face.normal;
    const cv::Point3d to_camera = camera_.position - face.corners.front();
    const double facing = normal.dot(to_camera);
    if (facing <= 1e-6) return;

    ScreenFace out;
    out.count = static_cast<int>(std::min(face.corners.size(), out.corners.size()));
    Bounds bounds;
    for (int i = 0; i < out.count; ++i) {
        const cv::Point3d& corner = face.corners[static_cast<std::size_t>(i)];
        if (camera_.depth(corner) < 1) return;
        const cv::Point2f p(camera_.project(corner));
        out.corners[static_cast<std::size_t>(i)] = p;
        bounds.hold(p);
    }
    if (!inPicture(bounds)) return;

    const cv::Matx33d& turn = camera_.camera_from_world_turn;
    out.inverse_depth = planeOf(turn * cv::Vec3d(normal) * (-1 / facing));

    // Texture coordinates are linear in space: base + gradient · point.
    const double per_metre = 256 / map_.texel();
    cv::Vec3d u_gradient(per_metre, 0, per_metre * light_.shadow.x);
    cv::Vec3d v_gradient(0, per_metre, per_metre * light_.shadow.y);
    double u_base = -map_.origin().x * per_metre;
    double v_base = -map_.origin().y * per_metre;
    if (face.finish == Finish::map_roof) {
        u_gradient[2] = 0;
        v_gradient[2] = 0;
    } else if (face.finish == Finish::facade) {
        u_gradient = {-normal.y, normal.x, 0};
        u_base = -u_gradient.dot(cv::Vec3d(face.corners.front()));
        v_gradient = {0, 0, 1};
        v_base = 0;
    }
    out.u = planeOf(turn * u_gradient);
    out.v = planeOf(turn * v_gradient);
    out.u_base = static_cast<float>(u_base + u_gradient.dot(cv::Vec3d(camera_.position)));
    out.v_base = static_cast<float>(v_base + v_gradient.dot(cv::Vec3d(camera_.position)));
    out.finish = face.finish;
    out.storey = face.storey;
    out.seed = face.seed;

    const double lambert = std::min(1.5, std::max(0.0, normal.dot(light_.to_sun)) / light_.to_sun.z);
    const double sky = light_.ambient * (0.7 + 0.3 * normal.z);
    const cv::Point3d half = unit(light_.to_sun + unit(to_camera));
    const double aligned = std::max(0.0, normal.dot(half));
    double glare = 0;
    double reflected_sky = 0;
    if (face.finish == Finish::lacquer) {
        glare = 60 * powerOfTwo(aligned, 5);
        reflected_sky = 9;
    } else if (face.finish == Finish::glass) {
        glare = 210 * powerOfTwo(aligned, 8);
        reflected_sky = 20;
    }
    if (light_.night) reflected_sky *= light_.ambient;
    // Lamps light walls from the side.
    const double lit = light_.night && face.finish == Finish::facade ? 0.8 * face.lit : lambert;
    for (std::size_t channel = 0; channel < 3; ++channel) {
        const int c = static_cast<int>(channel);
        const double colour = face.finish == Finish::map_roof ? 1.0 : face.colour[c];
        const bool shines = face.finish == Finish::lamp;
        const double shaded = shines ? colour : colour * sky + reflected_sky;
        const double direct = light_.direct[c];
        const double sunny = shines ? colour : shaded + colour * (1 - light_.ambient) * lit * direct + glare * direct;
        out.sunny[channel] = static_cast<float>(sunny);
        out.shaded[channel] = static_cast<float>(shaded);
    }
    enter(bounds, &TileContent::faces, pass_.faces.size());
    pass_.faces.push_back(out);
}

void PassBuilder::add(const Ball& ball, cv::Point3d shift) {
    const cv::Point3d centre = ball.centre + shift;
    const double depth = camera_.depth(centre);
    if (depth < 1) return;
    const cv::Point2d p = camera_.project(centre);
    ScreenBall out;
    out.x = static_cast<float>(p.x);
    out.y = static_cast<float>(p.y);
    out.radius = static_cast<float>(ball.radius * camera_.focal_px / depth);
    out.inverse_depth = static_cast<float>(1 / depth);
    Bounds bounds;
    bounds.hold({out.x - out.radius, out.y - out.radius});
    bounds.hold({out.x + out.radius, out.y + out.radius});
    if (!inPicture(bounds)) return;
    for (int channel = 0; channel < 3; ++channel) {
        const float value = std::clamp(ball.colour[channel], 0.0F, 255.0F);
        out.colour |= static_cast<std::uint32_t>(value) << (8 * channel);
    }
    if (ball.shines) out.colour |= kShines;
    enter(bounds, &TileContent::balls, pass_.balls.size());
    pass_.balls.push_back(out);
}

std::vector<cv::Point2f> PassBuilder::onScreen(const std::vector<cv::Point2d>& outline, Bounds& bounds) const {
    std::vector<cv::Point2f> corners;
    for (const cv::Point2d& p : outline) {
        const cv::Vec3d seen = image_from_ground_ * cv::Vec3d(p.x, p.y, 1);
        corners.emplace_back(static_cast<float>(seen[0] / seen[2]), static_cast<float>(seen[1] / seen[2]));
        bounds.hold(corners.back());
    }
    return corners;
}

void PassBuilder::addShadow(const std::vector<cv::Point2d>& outline, bool contact) {
    ScreenShadow out;
    out.contact = contact;
    Bounds bounds;
    out.corners = onScreen(outline, bounds);
    if (!inPicture(bounds)) return;
    enter(bounds, &TileContent::shadows, pass_.shadows.size());
    pass_.shadows.push_back(std::move(out));
}

void PassBuilder::addBeam(const std::vector<cv::Point2d>& outline, double light) {
    ScreenBeam out;
    out.light = static_cast<std::uint8_t>(std::clamp(light, 0.0, 1.0) * 255);
    Bounds bounds;
    out.corners = onScreen(outline, bounds);
    if (!inPicture(bounds)) return;
    enter(bounds, &TileContent::beams, pass_.beams.size());
    pass_.beams.push_back(std::move(out));
}

bool PassBuilder::sees(cv::Point2d centre, double reach, double height) const {
    const cv::Point3d low(centre.x, centre.y, 0);
    const cv::Point3d high(centre.x, centre.y, height);
    if (camera_.depth(low) < 1 || camera_.depth(high) < 1) return false;
    const cv::Point2d a = camera_.project(low);
    const cv::Point2d b = camera_.project(high);
    const double margin = (reach + 1) * camera_.focal_px / camera_.depth(high) + 2;
    return std::max(a.x, b.x) + margin > 0 && std::min(a.x, b.x) - margin < grid_.image.width &&
           std::max(a.y, b.y) + margin > 0 && std::min(a.y, b.y) - margin < grid_.image.height;
}

PassGeometry PassBuilder::finish() {
    return std::move(pass_);
}

}  // namespace eyrie

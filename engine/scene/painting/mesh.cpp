#include "scene/painting/mesh.h"

#include <algorithm>
#include <cmath>

namespace eyrie {
namespace {

cv::Point3d normalOf(const Face& face) {
    // Newell's sum, which does not depend on the choice of three corners. It points outwards because the axes are
    // left-handed (y down, z up) and the corners run clockwise as seen from outside.
    cv::Point3d sum(0, 0, 0);
    for (std::size_t i = 0; i < face.corners.size(); ++i) {
        const cv::Point3d& a = face.corners[i];
        const cv::Point3d& b = face.corners[(i + 1) % face.corners.size()];
        sum.x += (a.y - b.y) * (a.z + b.z);
        sum.y += (a.z - b.z) * (a.x + b.x);
        sum.z += (a.x - b.x) * (a.y + b.y);
    }
    const double length = std::sqrt(sum.dot(sum));
    return length > 0 ? sum * (1 / length) : cv::Point3d(0, 0, 1);
}

}  // namespace

void orient(Mesh& mesh) {
    for (Face& face : mesh.faces) face.normal = normalOf(face);
}

void addPrism(Mesh& mesh, const std::vector<cv::Point2d>& outline, double bottom, double top, cv::Vec3f wall,
              cv::Vec3f lid, Finish finish) {
    std::vector<cv::Point3d> solid;
    Face roof;
    roof.colour = lid;
    roof.finish = finish;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const cv::Point2d a = outline[i];
        const cv::Point2d b = outline[(i + 1) % outline.size()];
        Face side;
        side.colour = wall;
        side.finish = finish;
        side.corners = {{b.x, b.y, top}, {a.x, a.y, top}, {a.x, a.y, bottom}, {b.x, b.y, bottom}};
        mesh.faces.push_back(side);
        roof.corners.emplace_back(a.x, a.y, top);
        solid.emplace_back(a.x, a.y, bottom);
        solid.emplace_back(a.x, a.y, top);
    }
    mesh.faces.push_back(roof);
    mesh.solids.push_back(solid);
}

std::vector<cv::Point2d> hullOf(std::vector<cv::Point2d> points) {
    std::sort(points.begin(), points.end(),
              [](cv::Point2d a, cv::Point2d b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
    const auto turn = [](cv::Point2d o, cv::Point2d a, cv::Point2d b) {
        return (a.x - o.x) * (b.y - o.y) - (a.y - o.y) * (b.x - o.x);
    };
    std::vector<cv::Point2d> hull;
    for (int pass = 0; pass < 2; ++pass) {
        const std::size_t start = hull.size();
        for (const cv::Point2d& point : points) {
            while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), point) <= 0) hull.pop_back();
            hull.push_back(point);
        }
        hull.pop_back();
        std::reverse(points.begin(), points.end());
    }
    return hull;
}

}  // namespace eyrie

#pragma once

#include <cstdint>
#include <opencv2/core/matx.hpp>
#include <opencv2/core/types.hpp>
#include <vector>

namespace eyrie {

/// How a face answers to light.
enum class Finish {
    matte,
    lacquer,   ///< broad highlight of the sun
    glass,     ///< dark, with a narrow and strong highlight
    lamp,      ///< shines by itself: its colour is what is seen
    map_roof,  ///< takes its colours from the ground map below it, where roofs are painted
    facade     ///< wall with windows
};

/// A flat convex polygon in space; its corners run clockwise as seen from outside with x right, y down, z up.
struct Face {
    std::vector<cv::Point3d> corners;
    cv::Point3d normal{0, 0, 1};      ///< outwards; `orient` sets it
    cv::Vec3f colour{128, 128, 128};  ///< blue, green, red in full sunlight
    Finish finish = Finish::matte;
    float storey = 3;        ///< m between rows of windows
    std::uint32_t seed = 0;  ///< chooses the windows that are lit at night
    float lit = 1;           ///< share of street lamps' light that reaches a facade's foot at night
};

/// A ball of leaves, a reflection: seen as a disc from everywhere.
struct Ball {
    cv::Point3d centre;
    double radius = 0.5;
    cv::Vec3f colour;
    bool shines = false;  ///< a lamp, with a halo in the picture
};

/// Faces in one system of coordinates, with the outlines whose hulls cast its shadow.
struct Mesh {
    std::vector<Face> faces;
    std::vector<std::vector<cv::Point3d>> solids;  ///< corners of convex parts
    std::vector<cv::Point3d> glints;               ///< directions (unit) of small mirrors, in pairs with `glint_places`
    std::vector<cv::Point3d> glint_places;
};

/// Sets the normals of all faces from their corners.
void orient(Mesh& mesh);

/// Walls over an outline (clockwise on the map as seen from above) and a lid on top.
void addPrism(Mesh& mesh, const std::vector<cv::Point2d>& outline, double bottom, double top, cv::Vec3f wall,
              cv::Vec3f lid, Finish finish);

/// Convex hull of points on the ground, clockwise on the map.
std::vector<cv::Point2d> hullOf(std::vector<cv::Point2d> points);

}  // namespace eyrie

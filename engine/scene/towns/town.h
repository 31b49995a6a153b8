#pragma once

#include <utility>
#include <vector>

#include "core/geometry/oriented_box.h"
#include "scene/random.h"
#include "scene/scene_description.h"
#include "scene/traffic/path.h"

namespace eyrie {

/// A street with everything along it. Traffic drives on the right.
struct Street {
    Path path;
    int lanes = 2;                ///< in each direction
    double lane_width = 3.25;     ///< m
    double parking = 2.2;         ///< m of parking lane on each side; 0: none
    double pavement = 4;          ///< m on each side
    double occupancy = 0.7;       ///< share of parking places in use
    double tree_distance = 11;    ///< m between trees on the pavement; 0: none
    double tree_overhang = 0;     ///< m by which tree crowns reach out over the carriageway
    double lamp_distance = 28;    ///< m; 0: none
    double building_share = 0.9;  ///< share of the frontage that is built up
    std::pair<double, double> storeys{3, 6};
    std::pair<double, double> frontage{13, 34};  ///< m of each building along the street
    std::pair<double, double> depth{11, 16};     ///< m
    bool detached = false;                       ///< houses with gables and front gardens, a gap between any two
    Material material = Material::asphalt;
    bool marked = true;

    double halfCarriageway() const { return lanes * lane_width + parking; }
    double halfWidth() const { return halfCarriageway() + pavement; }
    /// Offset of the middle of a lane to the right of the path; lane 0 is the outer one.
    double laneOffset(int lane) const { return (lanes - 1 - lane + 0.5) * lane_width; }
};

/// What stands away from the streets.
struct TownStyle {
    double car_parks = 0.12;                       ///< share of tries
    double yard_buildings = 0.33;                  ///< likewise; the rest are trees
    std::pair<double, double> yard_height{3, 13};  ///< m
    double m2_per_try = 120;
    double bare_ground = 0;  ///< 0.7: plots are gravel, soil and concrete alone
};

/// Where two streets cross.
struct Crossing {
    int first = 0;   ///< index of a street
    int second = 0;  ///< index of the other
    double s_first = 0;
    double s_second = 0;
};

/// Lays out a town: ground, kerbs, markings, wear, buildings, trees, lamps and parked vehicles along streets, blocks
/// with yards and car parks behind them.
class Town {
 public:
    Town(SceneDescription& scene, cv::Rect2d area, std::uint32_t seed);

    int addStreet(Street street);
    void setStyle(const TownStyle& style) { style_ = style; }
    /// Builds everything into the scene.
    void build();
    const std::vector<Street>& streets() const { return streets_; }
    const std::vector<Crossing>& crossings() const { return crossings_; }
    /// Arc length on a street of the stop line before a crossing, for traffic in the street's direction (or against
    /// it).
    double stopLineAt(const Crossing& crossing, int street, bool forward) const;

 private:
    struct Gap {
        double from, to;
    };

    void findCrossings();
    std::vector<Gap> openStretches(int street, double margin) const;
    void layLand();
    void layStreets();
    void layCrossings();
    void mark(int street);
    void markCrossingArm(int street, double s, double other_half, double side);
    void wear(int street);
    void arrow(const Path& path, double s, double right, bool forward, double turn);
    void furnish(int street);
    void parkAlong(int street);
    void buildFrontage(int street);
    void buildYards();
    void carPark(cv::Point2d centre, cv::Point2d direction, double length, double width);
    bool isFree(const OrientedBox& footprint, double clearance) const;
    bool nearStreet(cv::Point2d point, double clearance) const;
    /// A place anywhere in the town. Draws twice.
    cv::Point2d randomPlace();
    /// Which way the street runs that is nearest to a place: what lies there stands square to it.
    cv::Point2d alongNearestStreet(cv::Point2d place) const;
    void addBuilding(cv::Point2d centre, cv::Point2d direction, double length, double width, double height,
                     double gables = 0.4);
    void addTree(cv::Point2d position, double height, double radius);
    void patch(std::vector<cv::Point2d> outline, const Surface& surface);

    SceneDescription& scene_;
    cv::Rect2d area_;
    Random random_;
    TownStyle style_;
    std::vector<Street> streets_;
    std::vector<Crossing> crossings_;
    std::vector<OrientedBox> built_;  ///< footprints, in metres
};

}  // namespace eyrie

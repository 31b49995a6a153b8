#include <algorithm>
#include <cmath>

#include "scene/portable_math.h"
#include "scene/towns/town.h"
#include "scene/traffic/vehicle_shape.h"

/// What stands beside the streets.
namespace eyrie {

void Town::addBuilding(cv::Point2d centre, cv::Point2d direction, double length, double width, double height,
                       double gables) {
    Building building;
    building.centre = centre;
    building.direction = direction;
    building.length = length;
    building.width = width;
    building.height = height;
    building.seed = random_.bits();
    Surface roof;
    const double draw = random_.uniform();
    building.roof = draw < gables && width < 17 ? RoofKind::gable : RoofKind::flat;
    if (building.roof == RoofKind::gable) {
        roof.material = Material::roof_tiles;
        roof.tone = random_.uniform(0.65, 1.15);
        if (random_.chance(0.4)) roof.tint = {1.35F, 1.15F, 0.72F};
    } else {
        roof.material = draw < 0.75 ? Material::roof_gravel : draw < 0.9 ? Material::roof_metal : Material::tar;
        roof.tone = roof.material == Material::tar ? random_.uniform(0.9, 1.3) : random_.uniform(0.62, 1.15);
    }
    roof.direction = direction;
    roof.seed = random_.bits();
    building.roof_surface = roof;
    const auto tone = static_cast<float>(random_.uniform(110, 195));
    building.facade = cv::Vec3f(tone * 0.88F, tone * 0.96F, tone);
    scene_.buildings.push_back(building);

    if (building.roof != RoofKind::flat) return;
    const int machines = 1 + random_.below(1 + static_cast<int>(length * width / 70));
    const cv::Point2d right = rightOf(direction);
    for (int i = 0; i < machines; ++i) {
        Block block;
        block.length = random_.uniform(0.9, 3.4);
        block.width = random_.uniform(0.8, 2.4);
        const double along = random_.uniform(-0.5, 0.5) * (length - block.length - 1.5);
        const double across = random_.uniform(-0.5, 0.5) * (width - block.width - 1.5);
        block.centre = centre + direction * along + right * across;
        block.direction = direction;
        block.bottom = height;
        block.top = height + random_.uniform(0.6, 2.2);
        const auto grey = static_cast<float>(random_.uniform(70, 190));
        block.colour = {grey, grey, grey};
        scene_.blocks.push_back(block);
    }
}

void Town::buildFrontage(int index) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    for (const double side : {-1.0, 1.0}) {
        double s = random_.uniform(0, 8);
        while (s < street.path.length()) {
            const double length = random_.uniform(street.frontage.first, street.frontage.second);
            const double depth = random_.uniform(street.depth.first, street.depth.second);
            const double setback = street.detached       ? random_.uniform(4, 6)
                                   : random_.chance(0.6) ? 0.4
                                                         : random_.uniform(1, 6);
            const double storeys = std::floor(random_.uniform(street.storeys.first, street.storeys.second + 1));
            const double at = s + length / 2;
            s += length + (street.detached        ? random_.uniform(1.6, 4)
                           : random_.chance(0.55) ? 0.2
                                                  : random_.uniform(2.5, 12));
            const bool wanted = random_.chance(street.building_share);
            const cv::Point2d direction = street.path.direction(at);
            const cv::Point2d centre = street.path.beside(at, side * (street.halfWidth() + setback + depth / 2 + 0.3));
            OrientedBox footprint{centre, length, depth, portable::arcTangent(direction.y, direction.x)};
            if (!wanted || !isFree(footprint, 0)) continue;
            built_.push_back(footprint);
            // Some houses turn their gable to the street.
            if (street.detached && random_.chance(0.4)) {
                addBuilding(centre, rightOf(direction), depth, length, 0.4 + 2.8 * storeys, 1);
            } else {
                addBuilding(centre, direction, length, depth, (street.detached ? 0.4 : 1.2) + 3.0 * storeys,
                            street.detached ? 1 : 0.4);
            }
        }
    }
}

void Town::buildYards() {
    const int tries = static_cast<int>(area_.width * area_.height / style_.m2_per_try);
    for (int i = 0; i < tries; ++i) {
        const cv::Point2d centre = randomPlace();
        const cv::Point2d direction = alongNearestStreet(centre);
        const double draw = random_.uniform();
        const bool park = draw < style_.car_parks;
        const double built_share = style_.car_parks + style_.yard_buildings;
        const double length = park ? random_.uniform(22, 48) : random_.uniform(7, 26);
        const double width = park ? 16.5 : random_.uniform(6, 15);
        const OrientedBox footprint{centre, length, width, portable::arcTangent(direction.y, direction.x)};
        const bool free = draw < built_share && isFree(footprint, park ? 1 : 3);
        if (free) {
            built_.push_back(footprint);
            if (park) {
                carPark(centre, direction, length, width);
            } else {
                addBuilding(centre, direction, length, width,
                            random_.uniform(style_.yard_height.first, style_.yard_height.second));
            }
        } else if (draw >= built_share) {
            const double height = random_.uniform(4, 13);
            const double radius = height * random_.uniform(0.22, 0.36);
            const OrientedBox spot{centre, radius * 1.2, radius * 1.2, 0};
            const bool clear = std::none_of(built_.begin(), built_.end(),
                                            [&](const OrientedBox& b) { return intersectionArea(spot, b) > 0; });
            if (clear && !nearStreet(centre, radius * 0.7)) addTree(centre, height, radius);
        }
    }
}

void Town::carPark(cv::Point2d centre, cv::Point2d direction, double length, double width) {
    Surface ground{Material::worn_asphalt, random_.uniform(0.85, 1.05)};
    ground.direction = direction;
    ground.seed = random_.bits();
    patch(rectangleAt(centre, direction, length, width), ground);
    Surface paint{Material::paint, 0.95};
    paint.seed = random_.bits();
    const cv::Point2d right = rightOf(direction);
    for (const double side : {-1.0, 1.0}) {
        for (double x = -length / 2 + 0.5; x + 2.5 < length / 2; x += 2.5) {
            const cv::Point2d line = centre + direction * x + right * (side * (width / 2 - 2.6));
            patch(rectangleAt(line, right, 5, 0.1), paint);
            if (!random_.chance(0.68)) continue;
            ParkedVehicle parked;
            parked.look = randomLook(random_.chance(0.9) ? ObjectKind::car : ObjectKind::van, random_);
            const double forth = random_.uniform(-0.3, 0.3);
            parked.pose.position = line + direction * (1.25 + random_.uniform(-0.12, 0.12)) + right * (side * forth);
            const double skew = random_.uniform(-0.03, 0.03);
            const cv::Point2d nose = right * (random_.chance(0.5) ? 1.0 : -1.0) + direction * skew;
            parked.pose.direction = nose * (1 / std::sqrt(nose.dot(nose)));
            scene_.parked.push_back(parked);
        }
    }
}

void Town::parkAlong(int index) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    if (street.parking <= 0) return;
    for (const Gap& open : openStretches(index, 11)) {
        for (const double side : {-1.0, 1.0}) {
            double s = open.from + 1;
            while (true) {
                ParkedVehicle parked;
                const double draw = random_.uniform();
                parked.look = randomLook(draw < 0.86   ? ObjectKind::car
                                         : draw < 0.97 ? ObjectKind::van
                                                       : ObjectKind::truck,
                                         random_);
                if (parked.look.length > 8) parked.look = randomLook(ObjectKind::van, random_);
                const double place = s + parked.look.length / 2;
                s += parked.look.length + 0.5 + random_.uniform(0.1, 1.1);
                if (s > open.to) break;
                if (!random_.chance(street.occupancy)) continue;
                const double right =
                    side * (street.halfCarriageway() - parked.look.width / 2 - random_.uniform(0.1, 0.35));
                parked.pose.position = street.path.beside(place, right);
                const double skew = random_.uniform(-0.03, 0.03);
                const cv::Point2d along = street.path.direction(place);
                const cv::Point2d nose = along * side + rightOf(along) * skew;
                parked.pose.direction = nose * (1 / std::sqrt(nose.dot(nose)));
                scene_.parked.push_back(parked);
            }
        }
    }
}

void Town::furnish(int index) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    for (const Gap& open : openStretches(index, street.pavement + 4)) {
        for (const double side : {-1.0, 1.0}) {
            if (street.tree_distance > 0) {
                for (double s = open.from + random_.uniform(1, 6); s < open.to;
                     s += street.tree_distance * random_.uniform(0.8, 1.3)) {
                    const double height = random_.uniform(6, 11);
                    const double radius = random_.uniform(1.8, 3.2) + street.tree_overhang * 0.5;
                    const double right =
                        side * (street.halfCarriageway() + 1.1 - std::min(0.6, street.tree_overhang * 0.2));
                    if (random_.chance(0.85))
                        addTree(street.path.beside(s, right), height + street.tree_overhang, radius);
                }
            }
            if (street.lamp_distance > 0) {
                double s = open.from + (side > 0 ? 3 : 3 + street.lamp_distance / 2);
                for (; s < open.to; s += street.lamp_distance) {
                    LampPost post;
                    post.position = street.path.beside(s, side * (street.halfCarriageway() + 0.7));
                    post.arm = rightOf(street.path.direction(s)) * -side;
                    post.height = random_.uniform(7.5, 9);
                    post.arm_length = 2.2;
                    scene_.posts.push_back(post);
                }
            }
            // Shelters, bins and hedges on the pavement.
            for (double s = open.from + random_.uniform(5, 25); s < open.to - 4; s += random_.uniform(16, 60)) {
                Block block;
                block.direction = street.path.direction(s);
                block.length = random_.uniform(0.8, 4);
                block.width = random_.uniform(0.6, 1.5);
                block.centre = street.path.beside(s, side * (street.halfWidth() - block.width / 2 - 0.3));
                block.top = random_.uniform(0.8, 2.5);
                const auto grey = static_cast<float>(random_.uniform(50, 190));
                block.colour = random_.chance(0.4) ? cv::Vec3f(40, 74, 52) : cv::Vec3f(grey, grey, grey);
                scene_.blocks.push_back(block);
            }
        }
    }
}

}  // namespace eyrie

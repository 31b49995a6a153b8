#include "scene/towns/town.h"

#include <algorithm>
#include <cmath>

#include "scene/portable_math.h"

namespace eyrie {

Town::Town(SceneDescription& scene, cv::Rect2d area, std::uint32_t seed) : scene_(scene), area_(area), random_(seed) {}

int Town::addStreet(Street street) {
    streets_.push_back(std::move(street));
    return static_cast<int>(streets_.size()) - 1;
}

void Town::build() {
    findCrossings();
    layLand();
    layStreets();
    const int count = static_cast<int>(streets_.size());
    for (int street = 0; street < count; ++street) buildFrontage(street);
    buildYards();
    for (int street = 0; street < count; ++street) furnish(street);
    for (int street = 0; street < count; ++street) parkAlong(street);
}

void Town::patch(std::vector<cv::Point2d> outline, const Surface& surface) {
    scene_.patches.push_back({std::move(outline), surface});
}

void Town::findCrossings() {
    const int count = static_cast<int>(streets_.size());
    for (int i = 0; i < count; ++i) {
        for (int k = i + 1; k < count; ++k) {
            const Path& a = streets_[static_cast<std::size_t>(i)].path;
            const Path& b = streets_[static_cast<std::size_t>(k)].path;
            double best = 2;
            Crossing crossing{i, k, 0, 0};
            for (double s = 0; s <= a.length(); s += 1) {
                const double t = b.nearest(a.position(s));
                const cv::Point2d offset = b.position(t) - a.position(s);
                const double distance = std::sqrt(offset.dot(offset));
                if (distance < best) {
                    best = distance;
                    crossing.s_first = s;
                    crossing.s_second = t;
                }
            }
            if (best < 2) crossings_.push_back(crossing);
        }
    }
}

std::vector<Town::Gap> Town::openStretches(int street, double margin) const {
    std::vector<Gap> closed;
    for (const Crossing& crossing : crossings_) {
        if (crossing.first == street) {
            const double half = streets_[static_cast<std::size_t>(crossing.second)].halfCarriageway() + margin;
            closed.push_back({crossing.s_first - half, crossing.s_first + half});
        } else if (crossing.second == street) {
            const double half = streets_[static_cast<std::size_t>(crossing.first)].halfCarriageway() + margin;
            closed.push_back({crossing.s_second - half, crossing.s_second + half});
        }
    }
    std::sort(closed.begin(), closed.end(), [](const Gap& a, const Gap& b) { return a.from < b.from; });
    std::vector<Gap> open;
    double from = 0;
    for (const Gap& gap : closed) {
        if (gap.from > from) open.push_back({from, gap.from});
        from = std::max(from, gap.to);
    }
    const double length = streets_[static_cast<std::size_t>(street)].path.length();
    if (length > from) open.push_back({from, length});
    return open;
}

double Town::stopLineAt(const Crossing& crossing, int street, bool forward) const {
    const bool is_first = crossing.first == street;
    const double s = is_first ? crossing.s_first : crossing.s_second;
    const double half =
        streets_[static_cast<std::size_t>(is_first ? crossing.second : crossing.first)].halfCarriageway() + 6.5;
    return forward ? s - half : s + half;
}

cv::Point2d Town::randomPlace() {
    cv::Point2d place;
    place.x = area_.x + random_.uniform() * area_.width;
    place.y = area_.y + random_.uniform() * area_.height;
    return place;
}

cv::Point2d Town::alongNearestStreet(cv::Point2d place) const {
    cv::Point2d direction(1, 0);
    double best = 1e9;
    for (const Street& street : streets_) {
        const double s = street.path.nearest(place);
        const cv::Point2d offset = place - street.path.position(s);
        const double distance = std::sqrt(offset.dot(offset));
        if (distance < best) {
            best = distance;
            direction = street.path.direction(s);
        }
    }
    return direction;
}

void Town::layLand() {
    // Plots of different ground behind the streets.
    const int plots = static_cast<int>(area_.width * area_.height / 900);
    for (int i = 0; i < plots; ++i) {
        const cv::Point2d centre = randomPlace();
        const cv::Point2d direction = alongNearestStreet(centre);
        Surface surface;
        const double draw = std::max(style_.bare_ground, random_.uniform());
        surface.material = draw < 0.42   ? Material::grass
                           : draw < 0.56 ? Material::paving
                           : draw < 0.68 ? Material::worn_asphalt
                           : draw < 0.8  ? Material::gravel
                           : draw < 0.9  ? Material::soil
                                         : Material::concrete;
        surface.tone = random_.uniform(0.8, 1.1);
        surface.direction = direction;
        surface.seed = random_.bits();
        const double length = random_.uniform(14, 46);
        const double width = random_.uniform(10, 30);
        patch(rectangleAt(centre, direction, length, width), surface);
    }
}

void Town::layStreets() {
    for (const Street& street : streets_) {
        const double length = street.path.length();
        const double half = street.halfCarriageway();
        Surface paving{Material::paving, random_.uniform(0.88, 1.05)};
        paving.seed = random_.bits();
        for (double s = 0; s < length; s += 40) {
            // Slabs follow the street, piece by piece.
            paving.direction = street.path.direction(std::min(length, s + 20));
            const double end = std::min(length, s + 40);
            patch(stripAlong(street.path, s, end, -street.halfWidth(), -half), paving);
            patch(stripAlong(street.path, s, end, half, street.halfWidth()), paving);
        }
    }
    for (const Street& street : streets_) {
        const double half = street.halfCarriageway();
        Surface kerb{Material::kerb, 0.95};
        kerb.seed = random_.bits();
        patch(stripAlong(street.path, 0, street.path.length(), -half - 0.3, half + 0.3), kerb);
    }
    for (const Street& street : streets_) {
        const double half = street.halfCarriageway();
        const double length = street.path.length();
        for (double s = 0; s < length; s += 60) {
            Surface road{street.material, random_.uniform(0.93, 1.06)};
            road.seed = 91;
            road.direction = street.path.direction(std::min(length, s + 30));
            patch(stripAlong(street.path, s, std::min(length, s + 60), -half, half), road);
        }
        if (street.parking > 0) {
            Surface bay{Material::worn_asphalt, 0.92};
            bay.seed = random_.bits();
            patch(stripAlong(street.path, 0, length, -half, -half + street.parking), bay);
            patch(stripAlong(street.path, 0, length, half - street.parking, half), bay);
        }
    }
    for (int street = 0; street < static_cast<int>(streets_.size()); ++street) wear(street);
    layCrossings();
    for (int street = 0; street < static_cast<int>(streets_.size()); ++street) mark(street);
}

void Town::layCrossings() {
    for (const Crossing& crossing : crossings_) {
        const Street& a = streets_[static_cast<std::size_t>(crossing.first)];
        const Street& b = streets_[static_cast<std::size_t>(crossing.second)];
        const cv::Point2d centre = a.path.position(crossing.s_first);
        const cv::Point2d along_a = a.path.direction(crossing.s_first);
        const cv::Point2d along_b = b.path.direction(crossing.s_second);
        Surface road{a.material, 0.98};
        road.direction = along_a;
        road.seed = 93;
        patch(stripAlong(a.path, crossing.s_first - b.halfWidth(), crossing.s_first + b.halfWidth(),
                         -a.halfCarriageway(), a.halfCarriageway()),
              road);
        patch(stripAlong(b.path, crossing.s_second - a.halfWidth(), crossing.s_second + a.halfWidth(),
                         -b.halfCarriageway(), b.halfCarriageway()),
              road);
        // Rounded corners: the carriageway reaches into the pavement.
        for (const double u : {-1.0, 1.0}) {
            for (const double v : {-1.0, 1.0}) {
                const double reach = 5;
                const cv::Point2d corner =
                    centre + along_a * (u * b.halfCarriageway()) + along_b * (v * a.halfCarriageway());
                std::vector<cv::Point2d> fillet{corner};
                for (int i = 0; i <= 6; ++i) {
                    // A quarter of a circle seen from the pavement's side.
                    static const double sines[7] = {0, 0.2588, 0.5, 0.7071, 0.8660, 0.9659, 1};
                    fillet.push_back(corner + along_a * (u * reach * (1 - sines[i])) +
                                     along_b * (v * reach * (1 - sines[6 - i])));
                }
                Surface kerb{Material::kerb, 0.95};
                patch(fillet, kerb);
                for (std::size_t i = 1; i < fillet.size(); ++i) fillet[i] = fillet[i] + (corner - fillet[i]) * 0.08;
                patch(fillet, road);
            }
        }
    }
}

bool Town::nearStreet(cv::Point2d point, double clearance) const {
    return std::any_of(streets_.begin(), streets_.end(), [&](const Street& street) {
        const cv::Point2d offset = point - street.path.position(street.path.nearest(point));
        return std::sqrt(offset.dot(offset)) < street.halfWidth() + clearance;
    });
}

bool Town::isFree(const OrientedBox& footprint, double clearance) const {
    OrientedBox grown = footprint;
    grown.length += 2 * clearance;
    grown.width += 2 * clearance;
    for (const OrientedBox& other : built_) {
        if (intersectionArea(grown, other) > 0) return false;
    }
    // Points along the edges and in the middle are enough against streets.
    for (int i = -2; i <= 2; ++i) {
        for (int k = -1; k <= 1; ++k) {
            const cv::Point2d p = footprint.toImage({footprint.length * i / 4, footprint.width * k / 2});
            if (nearStreet(p, 0.2)) return false;
        }
    }
    return true;
}

void Town::addTree(cv::Point2d position, double height, double radius) {
    Tree tree;
    tree.position = position;
    tree.height = height;
    tree.crown_radius = radius;
    tree.seed = random_.bits();
    const auto tone = static_cast<float>(random_.uniform(0.75, 1.2));
    const auto yellow = static_cast<float>(random_.uniform(0.85, 1.25));
    tree.colour = cv::Vec3f(44 * tone, 82 * tone, 60 * tone * yellow);
    scene_.trees.push_back(tree);
}

// ---- what is painted on the streets and what use has left on them --------------------------------------------------

void Town::mark(int index) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    if (!street.marked) return;
    Surface paint{Material::paint};
    paint.seed = random_.bits();
    const double kerb_lane = street.lanes * street.lane_width;
    for (const Gap& open : openStretches(index, 7.5)) {
        if (street.lanes > 1) {
            patch(stripAlong(street.path, open.from, open.to, -0.22, -0.09), paint);
            patch(stripAlong(street.path, open.from, open.to, 0.09, 0.22), paint);
        }
        const double dash = street.lanes > 1 ? 3 : 4;
        for (double s = open.from + 1; s + dash < open.to; s += dash * 3) {
            if (street.lanes == 1) patch(stripAlong(street.path, s, s + dash, -0.07, 0.07), paint);
            for (int lane = 1; lane < street.lanes; ++lane) {
                const double right = lane * street.lane_width;
                patch(stripAlong(street.path, s, s + dash, right - 0.07, right + 0.07), paint);
                patch(stripAlong(street.path, s, s + dash, -right - 0.07, -right + 0.07), paint);
            }
        }
        if (street.parking > 0) {
            for (double s = open.from + 6; s < open.to - 5; s += 5.8) {
                for (const double side : {-1.0, 1.0}) {
                    const double a = side * kerb_lane;
                    const double b = side * street.halfCarriageway();
                    patch(stripAlong(street.path, s, s + 0.1, std::min(a, b), std::max(a, b)), paint);
                }
            }
        } else {
            for (const double side : {-1.0, 1.0}) {
                const double edge = side * (street.halfCarriageway() - 0.25);
                patch(stripAlong(street.path, open.from, open.to, edge - 0.06, edge + 0.06), paint);
            }
        }
    }
    for (const Crossing& crossing : crossings_) {
        if (crossing.first != index && crossing.second != index) continue;
        const bool is_first = crossing.first == index;
        const double s = is_first ? crossing.s_first : crossing.s_second;
        const Street& other = streets_[static_cast<std::size_t>(is_first ? crossing.second : crossing.first)];
        for (const double side : {-1.0, 1.0}) markCrossingArm(index, s, other.halfCarriageway(), side);
    }
}

void Town::markCrossingArm(int index, double s, double other_half, double side) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    const double zebra = s + side * (other_half + 2.2);
    const double zebra_end = zebra + side * 3;
    const double stop = s + side * (other_half + 6.3);
    const double far = std::max({zebra, zebra_end, stop}) + 20;
    if (far > street.path.length() || std::min({zebra, zebra_end, stop}) < 20) return;
    Surface paint{Material::paint, 1.02};
    paint.seed = random_.bits();
    const double half = street.halfCarriageway();
    for (double right = -half + 0.5; right + 0.5 < half; right += 1.0) {
        patch(stripAlong(street.path, std::min(zebra, zebra_end), std::max(zebra, zebra_end), right, right + 0.5),
              paint);
    }
    // Those who drive towards the crossing keep to the right of their own direction.
    const bool forward = side < 0;
    const double inner = forward ? 0.2 : -0.2;
    const double outer = forward ? street.lanes * street.lane_width : -street.lanes * street.lane_width;
    patch(stripAlong(street.path, stop - 0.2, stop + 0.2, std::min(inner, outer), std::max(inner, outer)), paint);
    for (int lane = 0; lane < street.lanes; ++lane) {
        const double right = street.laneOffset(lane) * (forward ? 1 : -1);
        const double turn = lane == 0 ? 1 : -1;
        arrow(street.path, stop + side * 7, right, forward, random_.chance(0.5) ? turn : 0);
    }
}

void Town::arrow(const Path& path, double s, double right, bool forward, double turn) {
    Surface paint{Material::paint};
    paint.seed = random_.bits();
    const cv::Point2d ahead = path.direction(s) * (forward ? 1.0 : -1.0);
    const cv::Point2d side = rightOf(ahead);
    const cv::Point2d centre = path.beside(s, right);
    patch(rectangleAt(centre - ahead * 0.6, ahead, 2.8, 0.22), paint);
    const cv::Point2d tip_base = centre + ahead * 0.7;
    if (turn == 0) {
        patch({tip_base - side * 0.42, tip_base + ahead * 1.3, tip_base + side * 0.42}, paint);
    } else {
        patch(rectangleAt(tip_base + side * (turn * 0.3), side, 0.75, 0.24), paint);
        const cv::Point2d base = tip_base + side * (turn * 0.6);
        patch({base - ahead * 0.45, base + side * (turn * 0.9), base + ahead * 0.45}, paint);
    }
}

void Town::wear(int index) {
    const Street& street = streets_[static_cast<std::size_t>(index)];
    const double length = street.path.length();
    Surface stain{Material::stain, 0.9, 0.32};
    for (int lane = 0; lane < street.lanes; ++lane) {
        for (const double side : {-1.0, 1.0}) {
            const double right = side * street.laneOffset(lane);
            stain.seed = random_.bits();
            // Oil drips in the middle of the lane, rubber beside it.
            patch(stripAlong(street.path, 0, length, right - 0.35, right + 0.35), stain);
            stain.opacity = 0.16;
            patch(stripAlong(street.path, 0, length, right - 1.05, right - 0.6), stain);
            patch(stripAlong(street.path, 0, length, right + 0.6, right + 1.05), stain);
            stain.opacity = 0.32;
        }
    }
    const double half = street.halfCarriageway();
    const int repairs = static_cast<int>(length / 16);
    for (int i = 0; i < repairs; ++i) {
        const double s = random_.uniform(0, length);
        const double right = random_.uniform(-half + 1, half - 1);
        Surface tar{Material::tar, random_.uniform(0.85, 1.75), random_.uniform(0.5, 0.9)};
        tar.seed = random_.bits();
        const double size = random_.uniform(1, 7);
        const double width = random_.uniform(0.6, 2.2);
        patch(rectangleAt(street.path.beside(s, right), street.path.direction(s), size, width), tar);
    }
    const int cracks = static_cast<int>(length / 7);
    for (int i = 0; i < cracks; ++i) {
        const double s = random_.uniform(0, length);
        double right = random_.uniform(-half, half);
        cv::Point2d at = street.path.beside(s, right);
        double angle = random_.chance(0.5) ? random_.uniform(0, 6.28) : 1.57 + random_.uniform(-0.3, 0.3);
        const cv::Point2d along = street.path.direction(s);
        const cv::Point2d across = rightOf(along);
        Surface tar{Material::tar, 0.8, random_.uniform(0.4, 0.8)};
        const int pieces = 2 + random_.below(5);
        for (int k = 0; k < pieces; ++k) {
            angle += random_.uniform(-0.5, 0.5);
            const cv::Point2d direction = along * portable::cosine(angle) + across * portable::sine(angle);
            const double piece = random_.uniform(0.7, 2.2);
            patch(rectangleAt(at + direction * (piece / 2), direction, piece + 0.05, 0.1), tar);
            at += direction * piece;
        }
    }
    // Manholes.
    for (double s = 9; s < length; s += random_.uniform(18, 42)) {
        const double right = random_.uniform(-half + 0.7, half - 0.7);
        const cv::Point2d centre = street.path.beside(s, right);
        std::vector<cv::Point2d> ring;
        for (int k = 0; k < 10; ++k)
            ring.push_back(centre + cv::Point2d(portable::cosine(0.628 * k), portable::sine(0.628 * k)) * 0.4);
        Surface iron{Material::tar, random_.chance(0.5) ? 0.7 : 1.6, 0.9};
        patch(ring, iron);
    }
}

}  // namespace eyrie

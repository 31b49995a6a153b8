#include "scene/towns/town.h"

#include <algorithm>
#include <cmath>

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

void Town::layLand() {
    // Plots of different ground behind the streets.
    const int plots = static_cast<int>(area_.width * area_.height / 900);
    for (int i = 0; i < plots; ++i) {
        cv::Point2d centre;
        centre.x = area_.x + random_.uniform() * area_.width;
        centre.y = area_.y + random_.uniform() * area_.height;
        // Plots stand square to the nearest street.
        cv::Point2d direction(1, 0);
        double best = 1e9;
        for (const Street& street : streets_) {
            const double s = street.path.nearest(centre);
            const cv::Point2d offset = centre - street.path.position(s);
            const double distance = std::sqrt(offset.dot(offset));
            if (distance < best) {
                best = distance;
                direction = street.path.direction(s);
            }
        }
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

}  // namespace eyrie

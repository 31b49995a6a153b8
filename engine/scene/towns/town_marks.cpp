#include <algorithm>
#include <cmath>

#include "scene/portable_math.h"
#include "scene/towns/town.h"

/// What is painted on the streets and what use has left on them.
namespace eyrie {

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

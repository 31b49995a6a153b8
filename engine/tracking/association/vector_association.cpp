#include "tracking/association/vector_association.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/angle.h"

namespace eyrie {
namespace {

bool finite(const MotionVector& vector) {
    return std::isfinite(vector.position.x) && std::isfinite(vector.position.y) && std::isfinite(vector.velocity.x) &&
           std::isfinite(vector.velocity.y);
}

cv::Point2d positionOf(const MotionVector& vector) {
    return {vector.position.x, vector.position.y};
}

cv::Point2d velocityOf(const MotionVector& vector) {
    return {vector.velocity.x, vector.velocity.y};
}

/// Turn from the vector's own direction to the heading of the box.
double headingOffset(const MotionVector& vector, const OrientedBox& box, double slow_speed) {
    const cv::Point2d v = velocityOf(vector);
    return std::hypot(v.x, v.y) < slow_speed ? 0 : turnBetween(std::atan2(v.y, v.x), box.heading);
}

bool isOutlier(const AssociatedVector& associated, const VectorClaim& claim, const FrameVectors& frame,
               const VectorLimits& limits) {
    const MotionVector& vector = frame.at(associated.index);
    const double margin = limits.margin * std::min(claim.box.length, claim.box.width) + 1;
    return !finite(vector) || !claim.box.contains(positionOf(vector), margin) ||
           !limits.similar(velocityOf(vector), claim.velocity);
}

}  // namespace

FrameVectors::FrameVectors(const std::vector<MotionVector>& vectors) : vectors_(&vectors) {
    by_x_.reserve(vectors.size());
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        if (finite(vectors[i])) by_x_.push_back(static_cast<int>(i));
    }
    std::sort(by_x_.begin(), by_x_.end(), [this](int a, int b) {
        const float ax = at(a).position.x;
        const float bx = at(b).position.x;
        return ax != bx ? ax < bx : a < b;
    });
}

int FrameVectors::find(CornerId id) const {
    const auto found = std::lower_bound(vectors_->begin(), vectors_->end(), id,
                                        [](const MotionVector& vector, CornerId wanted) { return vector.id < wanted; });
    return found != vectors_->end() && found->id == id ? static_cast<int>(found - vectors_->begin()) : -1;
}

std::vector<int> FrameVectors::inside(const OrientedBox& box) const {
    const OrientedBox around = box.upright();
    const double left = around.centre.x - around.length / 2 - 1e-6;
    const double right = around.centre.x + around.length / 2 + 1e-6;
    const cv::Point2d direction = box.direction();
    std::vector<int> found;
    auto at_x = std::lower_bound(by_x_.begin(), by_x_.end(), left,
                                 [this](int index, double x) { return at(index).position.x < x; });
    for (; at_x != by_x_.end() && at(*at_x).position.x <= right; ++at_x) {
        const cv::Point2d r = positionOf(at(*at_x)) - box.centre;
        if (std::abs(r.x * direction.x + r.y * direction.y) <= box.length / 2 &&
            std::abs(r.y * direction.x - r.x * direction.y) <= box.width / 2) {
            found.push_back(*at_x);
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

bool VectorLimits::similar(cv::Point2d vector, cv::Point2d track) const {
    const double allowed = std::max(speed_floor, speed_difference * std::hypot(track.x, track.y));
    return std::hypot(vector.x - track.x, vector.y - track.y) <= allowed;
}

void keepSeenVectors(std::vector<AssociatedVector>& vectors, const FrameVectors& frame) {
    for (AssociatedVector& vector : vectors) vector.index = frame.find(vector.id);
    std::erase_if(vectors, [&frame](const AssociatedVector& v) { return v.index < 0 || !finite(frame.at(v.index)); });
}

void storePlaces(std::vector<AssociatedVector>& vectors, const OrientedBox& box, const FrameVectors& frame, double gain,
                 double slow_speed) {
    for (AssociatedVector& associated : vectors) {
        const MotionVector& vector = frame.at(associated.index);
        const cv::Point2d now = box.toBox(positionOf(vector));
        associated.in_box += (now - associated.in_box) * gain;
        const double offset = headingOffset(vector, box, slow_speed);
        associated.heading_offset =
            wrapPi(associated.heading_offset + gain * turnBetween(associated.heading_offset, offset));
        associated.length += (box.length - associated.length) * gain;
        associated.width += (box.width - associated.width) * gain;
    }
}

void associateVectors(const std::vector<VectorClaim>& claims, const FrameVectors& frame, const VectorLimits& limits) {
    std::vector<char> taken(static_cast<std::size_t>(frame.count()), 0);
    for (const VectorClaim& claim : claims) {
        std::erase_if(*claim.vectors, [&](const AssociatedVector& v) {
            return taken[static_cast<std::size_t>(v.index)] || isOutlier(v, claim, frame, limits);
        });
        for (const AssociatedVector& v : *claim.vectors) taken[static_cast<std::size_t>(v.index)] = 1;
        if (claim.learns)
            storePlaces(*claim.vectors, claim.box, frame, limits.relative_position_gain, limits.slow_speed);
    }

    std::vector<std::vector<int>> inside;
    std::vector<int> boxes_around(static_cast<std::size_t>(frame.count()), 0);
    for (const VectorClaim& claim : claims) {
        inside.push_back(frame.inside(claim.box));
        for (const int index : inside.back()) ++boxes_around[static_cast<std::size_t>(index)];
    }
    for (std::size_t c = 0; c < claims.size(); ++c) {
        const VectorClaim& claim = claims[c];
        if (!claim.may_gain) continue;
        std::vector<int> candidates;
        for (const int index : inside[c]) {
            const auto place = static_cast<std::size_t>(index);
            if (taken[place] || boxes_around[place] > 1) continue;
            if (limits.similar(velocityOf(frame.at(index)), claim.velocity)) candidates.push_back(index);
        }
        // The oldest first: they have proved to last.
        std::stable_sort(candidates.begin(), candidates.end(),
                         [&frame](int a, int b) { return frame.at(a).age > frame.at(b).age; });
        for (const int index : candidates) {
            if (static_cast<int>(claim.vectors->size()) >= limits.max_vectors) break;
            const MotionVector& vector = frame.at(index);
            claim.vectors->push_back({vector.id, claim.box.toBox(positionOf(vector)),
                                      headingOffset(vector, claim.box, limits.slow_speed), index, claim.box.length,
                                      claim.box.width});
        }
    }
}

}  // namespace eyrie

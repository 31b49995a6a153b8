#include "tracking/ground_motion.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <opencv2/core.hpp>
#include <utility>

#include "core/geometry/homography.h"
#include "core/geometry/homography_jacobian.h"

namespace eyrie {
namespace {

/// By how much the horizon may be off, as a share of its distance from the middle of the picture.
constexpr double kHorizonError = 0.1;

bool isFinite(const cv::Matx33d& matrix) {
    for (const double value : matrix.val) {
        if (!std::isfinite(value)) return false;
    }
    return true;
}

bool isFinite(const MovingState& state) {
    return std::isfinite(state.box.centre.x) && std::isfinite(state.box.centre.y) && std::isfinite(state.box.length) &&
           std::isfinite(state.box.width) && std::isfinite(state.box.heading) && std::isfinite(state.velocity.x) &&
           std::isfinite(state.velocity.y);
}

MovingState mapped(const MovingState& state, const cv::Matx33d& matrix) {
    Homography map;
    map.matrix = matrix;
    const cv::Point2d at = state.box.centre;
    const double scale = map.scaleAt(at);
    MovingState result;
    result.box = {map.apply(at), state.box.length * scale, state.box.width * scale, map.turned(at, state.box.heading)};
    result.velocity = map.applyToVector(at, state.velocity);
    return result;
}

}  // namespace

double localScale(const cv::Matx33d& map, cv::Point2d point) {
    Homography homography;
    homography.matrix = map;
    return homography.scaleAt(point);
}

GroundMotion::GroundMotion(const std::vector<FrameMotionSummary>& motion) {
    for (const FrameMotionSummary& summary : motion) add(summary);
}

void GroundMotion::add(const FrameMotionSummary& summary) {
    Step step;
    step.frame = summary.frame;
    step.image_size = summary.image_size;
    step.elapsed = summary.registration.framesPassed();
    step.reliable = summary.registration.reliable();
    step.zoom = summary.registration.zoom;
    step.forward = summary.registration.current_from_previous.matrix;
    bool invertible = false;
    if (isFinite(step.forward)) step.backward = step.forward.inv(cv::DECOMP_LU, &invertible);
    step.usable = invertible && isFinite(step.backward) && summary.registration.state != RegistrationState::first;
    steps_.push_back(step);
}

SceneScale GroundMotion::zooming(SceneScale scale) const {
    std::vector<ZoomCourse::Change> changes;
    double before = 1;
    for (const Step& step : steps_) {
        if (step.zoom != before) changes.emplace_back(step.frame, step.zoom);
        before = step.zoom;
    }
    scale.zoom = ZoomCourse(std::move(changes));
    return scale;
}

const GroundMotion::Step* GroundMotion::stepInto(FrameIndex frame) const {
    if (steps_.empty() || frame < steps_.front().frame || frame > steps_.back().frame) return nullptr;
    // Mostly no frame is missing.
    const auto at = static_cast<std::size_t>(frame - steps_.front().frame);
    if (at < steps_.size() && steps_[at].frame == frame) return &steps_[at];
    const auto found = std::lower_bound(steps_.begin(), steps_.end(), frame,
                                        [](const Step& step, FrameIndex wanted) { return step.frame < wanted; });
    return found != steps_.end() && found->frame == frame ? &*found : nullptr;
}

const cv::Matx33d* GroundMotion::step(FrameIndex from, FrameIndex to, bool guesses) const {
    const Step* step = stepInto(std::max(from, to));
    if (std::abs(from - to) != 1 || step == nullptr || !step->usable || !(step->reliable || guesses)) return nullptr;
    return to > from ? &step->forward : &step->backward;
}

int GroundMotion::elapsed(FrameIndex from, FrameIndex to) const {
    const Step* step = stepInto(std::max(from, to));
    return step == nullptr ? 1 : step->elapsed;
}

std::optional<MovingState> GroundMotion::carried(MovingState state, FrameIndex from, FrameIndex to,
                                                 bool guesses) const {
    const int direction = to > from ? 1 : -1;
    for (FrameIndex frame = from; frame != to; frame += direction) {
        const cv::Matx33d* map = step(frame, frame + direction, guesses);
        if (!map) return std::nullopt;
        const int elapsed = this->elapsed(frame, frame + direction);
        // Forward: move, then map. Backward undoes that in the opposite order.
        if (direction > 0 && elapsed > 0) state.box = movedBy(state.box, state.velocity * elapsed);
        state = mapped(state, *map);
        if (direction < 0 && elapsed > 0) state.box = movedBy(state.box, -state.velocity * elapsed);
        if (!isFinite(state)) return std::nullopt;
    }
    return state;
}

double GroundMotion::zoomAt(const cv::Matx33d& map, cv::Point2d place) const {
    const HomographyJacobian there(map, place);
    if (slope_.isFlat()) return there.scale();
    // Along the horizon a metre grows with the place; across it it also comes to be seen less at an angle.
    const cv::Point2d level = slope_.level();
    const cv::Point2d enlarged = there.vector(level);
    return std::sqrt(enlarged.dot(enlarged) / level.dot(level)) / enlargement(place, there.point());
}

bool GroundMotion::aboveHorizon(const OrientedBox& box) const {
    const auto corners = box.corners();
    return std::all_of(corners.begin(), corners.end(), [this](const cv::Point2d& corner) {
        const cv::Point2d off = corner - slope_.centre();
        return 1 + slope_.right_per_px * off.x + slope_.down_per_px * off.y < -kHorizonError;
    });
}

OrientedBox GroundMotion::movedBy(OrientedBox box, cv::Point2d way) const {
    const cv::Point2d place = box.centre + way;
    const double larger = enlargement(box.centre, place);
    return {place, box.length * larger, box.width * larger, box.heading};
}

cv::Size GroundMotion::imageSize(FrameIndex frame) const {
    const Step* step = stepInto(frame);
    return step == nullptr ? cv::Size() : step->image_size;
}

bool GroundMotion::cutByBorder(const OrientedBox& box, FrameIndex frame) const {
    const cv::Size image = imageSize(frame);
    return image.area() > 0 && areaInImage(box, image) < 0.99 * box.area();
}

}  // namespace eyrie

#include "registration/zoom_follower.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/geometry/homography_jacobian.h"

namespace eyrie {
namespace {

constexpr double kSeconds = 0.5;            ///< that a zoom goes on for …
constexpr std::size_t kFewestPictures = 4;  ///< … and this many pictures
constexpr double kSlowest = 0.06;           ///< share a second; slower ones are not told from errors
constexpr double kAtOnce = 0.15;            ///< from picture to picture
constexpr double kShareOfHalf = 0.25;       ///< of a zoom that falls on either half of that time
constexpr double kFarthest = 2.8;           ///< logarithm of the zoom, either way: sixteen times

}  // namespace

ZoomFollower::ZoomFollower(const SceneScale& scale, double before)
    : level_(scale.slope.level() / std::sqrt(scale.slope.level().dot(scale.slope.level()))),
      frame_rate_hz_(scale.frame_rate_hz),
      window_(std::max(kFewestPictures, static_cast<std::size_t>(std::lround(kSeconds * scale.frame_rate_hz)))),
      zoom_log_(std::log(before)) {}

void ZoomFollower::reset() {
    zoom_log_ = 0;
    zooming_ = false;
    pending_.clear();
}

double ZoomFollower::zoom() const {
    return zoom_log_ == 0 ? 1 : std::exp(zoom_log_);
}

double ZoomFollower::stepOf(const cv::Matx33d& homography, cv::Size image) const {
    const HomographyJacobian map(homography, {(image.width - 1) / 2.0, (image.height - 1) / 2.0});
    const cv::Point2d enlarged = map.vector(level_);
    const double along = std::sqrt(enlarged.dot(enlarged));
    const double across = map.scale() * map.scale() / along;
    const double step = std::log(along * along / across);
    return std::isfinite(step) ? step : 0;
}

double ZoomFollower::pendingSum() const {
    return std::accumulate(pending_.begin(), pending_.end(), 0.0);
}

bool ZoomFollower::begins() const {
    if (std::abs(pending_.back()) >= kAtOnce) return true;
    if (pending_.size() < window_) return false;
    const double sum = pendingSum();
    const double early = std::accumulate(pending_.begin(), pending_.begin() + std::ptrdiff_t(window_ / 2), 0.0);
    return std::abs(sum) >= kSlowest * static_cast<double>(window_) / frame_rate_hz_ &&
           std::min(early / sum, 1 - early / sum) >= kShareOfHalf;
}

double ZoomFollower::next(const Registration& registration, cv::Size image) {
    const bool cut =
        registration.state == RegistrationState::failed && registration.failure.fault == RegistrationFault::cut;
    if (cut || registration.state == RegistrationState::first) {
        zooming_ = false;
        pending_.clear();
        return zoom();
    }
    if (registration.state == RegistrationState::frozen) return zoom();
    // A guess, where registration failed, is made good by the next homography that holds.
    const double step = stepOf(registration.current_from_previous.matrix, image);
    pending_.push_back(step);
    if (pending_.size() > window_) pending_.pop_front();
    if (zooming_) {
        zoom_log_ += step;
        const double least = kSlowest * static_cast<double>(pending_.size()) / frame_rate_hz_;
        zooming_ = pending_.size() < window_ || std::abs(pendingSum()) >= least;
        // What was counted must not be counted once more when the next zoom begins.
        if (!zooming_) pending_.clear();
    } else if (begins()) {
        zoom_log_ += pendingSum();
        zooming_ = true;
        pending_.clear();
    }
    zoom_log_ = std::clamp(zoom_log_, -kFarthest, kFarthest);
    return zoom();
}

}  // namespace eyrie

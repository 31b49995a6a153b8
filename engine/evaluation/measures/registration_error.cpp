#include "evaluation/measures/registration_error.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.h"

namespace eyrie {
namespace {

cv::Matx33d inverseOf(const cv::Matx33d& matrix, FrameIndex frame) {
    if (!(std::abs(cv::determinant(matrix)) > 1e-12)) {
        throw Error(ErrorKind::input, "the true homography of frame " + std::to_string(frame) +
                                          " has no inverse; check the file of homographies");
    }
    return matrix.inv();
}

}  // namespace

FrameRegistrationError gridError(const Homography& estimate, const cv::Matx33d& truth, cv::Size image, int columns,
                                 int rows) {
    Homography exact;
    exact.matrix = truth;
    FrameRegistrationError error;
    error.frame = estimate.to_frame;
    double squares = 0;
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            const cv::Point2d point(columns > 1 ? (image.width - 1.0) * c / (columns - 1) : 0,
                                    rows > 1 ? (image.height - 1.0) * r / (rows - 1) : 0);
            const cv::Point2d apart = estimate.apply(point) - exact.apply(point);
            const double distance = std::hypot(apart.x, apart.y);
            error.mean_px += distance;
            squares += distance * distance;
            error.max_px = std::max(error.max_px, distance);
        }
    }
    const double points = std::max(1, rows * columns);
    error.mean_px /= points;
    error.rms_px = std::sqrt(squares / points);
    return error;
}

RegistrationError registrationError(const std::vector<Registration>& registrations, const TrueHomographies& truth,
                                    cv::Size image) {
    RegistrationError error;
    double squares = 0;
    for (const Registration& registration : registrations) {
        if (registration.state == RegistrationState::first) continue;
        const Homography& estimate = registration.current_from_previous;
        const auto from = truth.find(estimate.from_frame);
        const auto to = truth.find(estimate.to_frame);
        if (from == truth.end() || to == truth.end()) continue;
        if (!registration.reliable()) {
            ++error.unregistered;
            continue;
        }
        const cv::Matx33d true_map = inverseOf(to->second, to->first) * from->second;
        error.frames.push_back(gridError(estimate, true_map, image));
        const FrameRegistrationError& last = error.frames.back();
        error.mean_px += last.mean_px;
        squares += last.rms_px * last.rms_px;
        error.max_px = std::max(error.max_px, last.max_px);
    }
    const double count = std::max<std::size_t>(1, error.frames.size());
    error.mean_px /= count;
    error.rms_px = std::sqrt(squares / count);
    return error;
}

}  // namespace eyrie

#include "annotation/keyframes/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <opencv2/core.hpp>

namespace eyrie {
namespace {

/// The matrix scaled to norm 1, which keeps the sign of the third coordinate; nothing for what is no map.
std::optional<cv::Matx33d> scaled(const cv::Matx33d& matrix) {
    const double norm = cv::norm(matrix);
    if (!std::isfinite(norm) || norm < 1e-12) return std::nullopt;
    const cv::Matx33d result = matrix * (1 / norm);
    if (std::abs(cv::determinant(result)) < 1e-15) return std::nullopt;
    return result;
}

}  // namespace

CameraMotion::CameraMotion(const std::vector<Homography>& steps) {
    std::vector<const Homography*> usable;
    for (const Homography& step : steps) {
        if (step.to_frame == step.from_frame + 1 && step.from_frame >= 0) usable.push_back(&step);
    }
    if (usable.empty()) return;
    const auto [lowest, highest] = std::minmax_element(usable.begin(), usable.end(),
                                                       [](auto* a, auto* b) { return a->from_frame < b->from_frame; });
    first_ = (*lowest)->from_frame;
    std::vector<std::optional<cv::Matx33d>> matrices(static_cast<std::size_t>((*highest)->to_frame - first_));
    for (const Homography* step : usable) {
        matrices[static_cast<std::size_t>(step->from_frame - first_)] = scaled(step->matrix);
    }
    build(matrices);
}

CameraMotion CameraMotion::fromRegistrations(const std::vector<Registration>& registrations) {
    std::vector<Homography> steps;
    for (const Registration& registration : registrations) {
        if (registration.reliable()) steps.push_back(registration.current_from_previous);
    }
    return CameraMotion(steps);
}

CameraMotion CameraMotion::fromCommonFrame(const std::vector<Homography>& common_from_frame) {
    std::vector<Homography> steps;
    for (std::size_t i = 1; i < common_from_frame.size(); ++i) {
        const Homography& previous = common_from_frame[i - 1];
        const Homography& current = common_from_frame[i];
        if (current.from_frame != previous.from_frame + 1) continue;
        bool invertible = false;
        Homography step;
        step.matrix = current.matrix.inv(cv::DECOMP_LU, &invertible) * previous.matrix;
        step.from_frame = previous.from_frame;
        step.to_frame = current.from_frame;
        if (invertible) steps.push_back(step);
    }
    return CameraMotion(steps);
}

CameraMotion CameraMotion::standing(FrameIndex first, FrameIndex last) {
    CameraMotion camera;
    camera.first_ = first;
    camera.build(std::vector<std::optional<cv::Matx33d>>(static_cast<std::size_t>(std::max(0, last - first)),
                                                         cv::Matx33d::eye() * (1 / std::sqrt(3.0))));
    return camera;
}

void CameraMotion::build(const std::vector<std::optional<cv::Matx33d>>& steps) {
    steps_ = steps.size();
    broken_.assign(steps_ + 1, 0);
    std::vector<cv::Matx33d> blocks(steps_);
    for (std::size_t i = 0; i < steps_; ++i) {
        broken_[i + 1] = broken_[i] + (steps[i] ? 0 : 1);
        blocks[i] = steps[i].value_or(cv::Matx33d::eye());
    }
    while (!blocks.empty()) {
        std::vector<cv::Matx33d> doubled(blocks.size() / 2);
        for (std::size_t i = 0; i < doubled.size(); ++i) {
            const cv::Matx33d product = blocks[2 * i + 1] * blocks[2 * i];
            doubled[i] = product * (1 / cv::norm(product));
        }
        levels_.push_back(std::move(blocks));
        blocks = std::move(doubled);
    }
}

bool CameraMotion::connects(FrameIndex a, FrameIndex b) const {
    if (a == b) return true;
    if (a > b) std::swap(a, b);
    if (steps_ == 0 || a < first_ || b - first_ > static_cast<FrameIndex>(steps_)) return false;
    return broken_[static_cast<std::size_t>(a - first_)] == broken_[static_cast<std::size_t>(b - first_)];
}

std::optional<Homography> CameraMotion::map(FrameIndex from, FrameIndex to) const {
    Homography result;
    result.from_frame = from;
    result.to_frame = to;
    if (from == to) return result;
    if (!connects(from, to)) return std::nullopt;
    std::size_t at = static_cast<std::size_t>(std::min(from, to) - first_);
    const std::size_t end = static_cast<std::size_t>(std::max(from, to) - first_);
    cv::Matx33d product = cv::Matx33d::eye();
    while (at < end) {
        std::size_t level = 0;
        while (level + 1 < levels_.size() && (at >> level) % 2 == 0 && at + (std::size_t{2} << level) <= end) ++level;
        product = levels_[level][at >> level] * product;
        at += std::size_t{1} << level;
    }
    if (from > to) {
        bool invertible = false;
        product = product.inv(cv::DECOMP_LU, &invertible);
        if (!invertible) return std::nullopt;
    }
    // Behind the horizon nothing is mapped.
    const double norm = cv::norm(product);
    if (!std::isfinite(norm) || product(2, 2) < 1e-9 * norm) return std::nullopt;
    result.matrix = product * (1 / product(2, 2));
    return result;
}

}  // namespace eyrie

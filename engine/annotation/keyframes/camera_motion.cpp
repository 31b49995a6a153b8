#include "annotation/keyframes/camera_motion.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/core.hpp>
#include <utility>

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
    std::stable_sort(usable.begin(), usable.end(), [](auto* a, auto* b) { return a->from_frame < b->from_frame; });
    empty_ = false;
    first_ = usable.front()->from_frame;
    std::vector<cv::Matx33d> stretch;
    FrameIndex end = first_;  // of the stretch
    const auto close = [&] {
        const std::size_t begin = static_cast<std::size_t>(end - first_) - stretch.size();
        add(begin, std::move(stretch));
        stretch.clear();
    };
    for (std::size_t i = 0; i < usable.size(); ++i) {
        const FrameIndex from = usable[i]->from_frame;
        // Of several steps from a frame the last one counts.
        if (i + 1 < usable.size() && usable[i + 1]->from_frame == from) continue;
        const auto matrix = scaled(usable[i]->matrix);
        if (from != end || !matrix) close();
        if (!matrix) continue;
        stretch.push_back(*matrix);
        end = from + 1;
    }
    close();
}

CameraMotion CameraMotion::fromRegistrations(const std::vector<Registration>& registrations) {
    std::vector<Homography> steps;
    for (const Registration& registration : registrations) {
        if (registration.reliable()) steps.push_back(registration.current_from_previous);
    }
    return CameraMotion(steps);
}

CameraMotion CameraMotion::standing(FrameIndex first, FrameIndex last) {
    CameraMotion camera;
    if (last <= first) return camera;
    camera.empty_ = false;
    camera.first_ = first;
    camera.add(
        0, std::vector<cv::Matx33d>(static_cast<std::size_t>(last - first), cv::Matx33d::eye() * (1 / std::sqrt(3.0))));
    return camera;
}

void CameraMotion::add(std::size_t begin, std::vector<cv::Matx33d> steps) {
    if (steps.empty()) return;
    Stretch stretch{begin, begin + steps.size(), {}};
    Level level{begin, std::move(steps)};
    while (!level.blocks.empty()) {
        Level doubled{(level.first + 1) / 2, {}};
        const std::size_t end = (level.first + level.blocks.size()) / 2;
        for (std::size_t i = doubled.first; i < end; ++i) {
            const cv::Matx33d* pair = &level.blocks[2 * i - level.first];
            const cv::Matx33d product = pair[1] * pair[0];
            doubled.blocks.push_back(product * (1 / cv::norm(product)));
        }
        stretch.levels.push_back(std::move(level));
        level = std::move(doubled);
    }
    stretches_.push_back(std::move(stretch));
}

const CameraMotion::Stretch* CameraMotion::between(FrameIndex a, FrameIndex b) const {
    if (a < first_) return nullptr;
    const auto begin = static_cast<std::size_t>(a - first_);
    const auto after = std::upper_bound(stretches_.begin(), stretches_.end(), begin,
                                        [](std::size_t step, const Stretch& each) { return step < each.begin; });
    if (after == stretches_.begin()) return nullptr;
    const Stretch& stretch = *std::prev(after);
    return static_cast<std::size_t>(b - first_) <= stretch.end ? &stretch : nullptr;
}

bool CameraMotion::connects(FrameIndex a, FrameIndex b) const {
    return a == b || between(std::min(a, b), std::max(a, b)) != nullptr;
}

std::optional<Homography> CameraMotion::map(FrameIndex from, FrameIndex to) const {
    Homography result;
    result.from_frame = from;
    result.to_frame = to;
    if (from == to) return result;
    const Stretch* stretch = between(std::min(from, to), std::max(from, to));
    if (stretch == nullptr) return std::nullopt;
    std::size_t at = static_cast<std::size_t>(std::min(from, to) - first_);
    const std::size_t end = static_cast<std::size_t>(std::max(from, to) - first_);
    cv::Matx33d product = cv::Matx33d::eye();
    while (at < end) {
        std::size_t level = 0;
        while ((at >> level) % 2 == 0 && at + (std::size_t{2} << level) <= end) ++level;
        const Level& blocks = stretch->levels[level];
        product = blocks.blocks[(at >> level) - blocks.first] * product;
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

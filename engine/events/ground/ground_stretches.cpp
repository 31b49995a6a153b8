#include "events/ground/ground_stretches.h"

#include <opencv2/core.hpp>

#include "core/geometry/homography_jacobian.h"
#include "core/geometry/sound_map.h"

namespace eyrie {
namespace {

constexpr double kMostUnlike = 3;  ///< enlargement of a corner of the picture on the ground

}  // namespace

GroundStretches::GroundStretches(const Footage& footage) : footage_(footage) {
    const cv::Point2d middle((footage.image_size.width - 1) / 2.0, (footage.image_size.height - 1) / 2.0);
    for (FrameIndex frame = footage.first_frame; frame <= footage.last_frame; ++frame) {
        const bool connected = !stretches_.empty() && footage.camera.connects(frame - 1, frame);
        std::optional<Homography> to_reference;
        if (connected) to_reference = footage.camera.map(frame, stretches_.back().first_frame);
        if (!to_reference || !isSoundMap(to_reference->matrix, footage.image_size, kMostUnlike)) {
            GroundStretch next{frame, frame, footage.scale.in(frame).gsd_m_per_px, !connected, true};
            if (connected) {
                const GroundStretch& before = stretches_.back();
                next.metres_per_px =
                    before.metres_per_px * HomographyJacobian(reference_from_image_.back(), middle).scale();
                stretches_.back().ends_for_good = false;
            }
            stretches_.push_back(next);
            to_reference = Homography{};
        }
        stretches_.back().last_frame = frame;
        stretch_of_.push_back(static_cast<int>(stretches_.size()) - 1);
        reference_from_image_.push_back(to_reference->matrix);
    }
}

const GroundStretch* GroundStretches::of(FrameIndex frame) const {
    const int index = indexOf(frame);
    return index < 0 ? nullptr : &stretches_[static_cast<std::size_t>(index)];
}

int GroundStretches::indexOf(FrameIndex frame) const {
    if (frame < footage_.first_frame || frame > footage_.last_frame) return -1;
    return stretch_of_[static_cast<std::size_t>(frame - footage_.first_frame)];
}

cv::Point2d GroundStretches::toGround(FrameIndex frame, cv::Point2d image) const {
    return HomographyJacobian(map(frame), image).point() * of(frame)->metres_per_px;
}

OrientedBox GroundStretches::toGround(FrameIndex frame, const OrientedBox& box) const {
    const HomographyJacobian local(map(frame), box.centre);
    const double metres = local.scale() * of(frame)->metres_per_px;
    return {local.point() * of(frame)->metres_per_px, box.length * metres, box.width * metres,
            local.turned(box.heading)};
}

std::optional<cv::Point2d> GroundStretches::toImage(FrameIndex frame, cv::Point2d ground) const {
    const cv::Matx33d back = map(frame).inv();
    const cv::Point2d in_reference = ground * (1 / of(frame)->metres_per_px);
    const double w = back(2, 0) * in_reference.x + back(2, 1) * in_reference.y + back(2, 2);
    if (!(w * back(2, 2) > 0)) return std::nullopt;
    return HomographyJacobian(back, in_reference).point();
}

double GroundStretches::metresPerPixel(FrameIndex frame, cv::Point2d image) const {
    return HomographyJacobian(map(frame), image).scale() * of(frame)->metres_per_px;
}

double GroundStretches::metresByPlace(FrameIndex frame, cv::Point2d image) const {
    const SceneScale& scale = footage_.scale;
    return scale.slope.isFlat() ? 1 : scale.at(frame, image).gsd_m_per_px / metresPerPixel(frame, image);
}

double GroundStretches::metresHere(FrameIndex frame, cv::Point2d image) const {
    const SceneScale& scale = footage_.scale;
    return scale.slope.isFlat() ? metresPerPixel(frame, image) : scale.at(frame, image).gsd_m_per_px;
}

bool GroundStretches::inImage(cv::Point2d image) const {
    const cv::Rect2d picture({-0.5, -0.5}, cv::Size2d(footage_.image_size));
    return picture.contains(image);
}

}  // namespace eyrie

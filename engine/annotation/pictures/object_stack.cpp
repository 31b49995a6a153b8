#include "annotation/pictures/object_stack.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "annotation/keyframes/interpolation.h"

namespace eyrie {
namespace {

constexpr int kLargestSide = 512;
constexpr int kFewestLayers = 3;

/// Pixels of the stack and how they lie on a box.
struct Grid {
    cv::Size size;
    double samples_per_px = 1;

    /// The pixels of the box itself and a little beyond: its border changes as the object moves over the ground.
    cv::Rect inside(const OrientedBox& box) const {
        constexpr double kMargin = 1.15;
        const auto side = [&](double px, int most) {
            return std::clamp(static_cast<int>(std::lround(px * samples_per_px * kMargin)), 2, most);
        };
        const cv::Size part(side(box.length, size.width), side(box.width, size.height));
        return {{(size.width - part.width) / 2, (size.height - part.height) / 2}, part};
    }

    /// Cuts out a box; `growth`: of its size against that of the frame looked at.
    cv::Mat cut(const cv::Mat& picture, const OrientedBox& box, double growth, int border) const {
        const double step = growth / samples_per_px;
        const double c = std::cos(box.heading) * step;
        const double s = std::sin(box.heading) * step;
        const cv::Point2d middle((size.width - 1) / 2.0 + border, (size.height - 1) / 2.0 + border);
        const cv::Matx23d image_from_stack(c, -s, box.centre.x - c * middle.x + s * middle.y,  //
                                           s, c, box.centre.y - s * middle.x - c * middle.y);
        cv::Mat chip;
        cv::warpAffine(picture, chip, image_from_stack, {size.width + 2 * border, size.height + 2 * border},
                       cv::INTER_CUBIC | cv::WARP_INVERSE_MAP, cv::BORDER_REPLICATE);
        return chip;
    }
};

Grid gridFor(const OrientedBox& box, const ObjectStackOptions& options) {
    const double border = std::max(3.0, options.border * box.length);
    const double longest = std::max(box.length, box.width) + 2 * border;
    Grid grid;
    grid.samples_per_px = std::min(options.samples_per_px, kLargestSide / longest);
    const auto side = [&](double px) {
        return std::max(4, static_cast<int>(std::ceil((px + 2 * border) * grid.samples_per_px)));
    };
    grid.size = {side(box.length), side(box.width)};
    return grid;
}

/// Frames in which the object can be seen, the nearest first.
std::vector<FrameIndex> framesAround(const LabelledObject& object, FrameIndex frame, int most) {
    std::vector<FrameIndex> frames{frame};
    const FrameIndex first = firstFrameOf(object);
    for (FrameIndex away = 1; static_cast<int>(frames.size()) < most; ++away) {
        if (frame - away < first && frame + away > object.last_frame) break;
        if (frame - away >= first) frames.push_back(frame - away);
        if (frame + away <= object.last_frame && static_cast<int>(frames.size()) < most) frames.push_back(frame + away);
    }
    std::sort(frames.begin(), frames.end());  // videos are read forward
    return frames;
}

/// The reference has an extent.
double growthOf(const OrientedBox& box, const OrientedBox& reference) {
    if (box.area() <= 0) return 1;
    return std::clamp(std::sqrt(box.area() / reference.area()), 0.25, 4.0);
}

/// The part of a wider cut that looks most like the reference inside `object`; empty where none does.
cv::Mat aligned(const cv::Mat& wide, const cv::Mat& reference, const cv::Rect& object, int shift,
                double min_correlation) {
    const cv::Rect reach(object.tl(), cv::Size(object.width + 2 * shift, object.height + 2 * shift));
    cv::Mat likeness;
    cv::matchTemplate(wide(reach), reference(object), likeness, cv::TM_CCOEFF_NORMED);
    double best = 0;
    cv::Point place;
    cv::minMaxLoc(likeness, nullptr, &best, nullptr, &place);
    if (!(best >= min_correlation)) return {};
    return wide(cv::Rect(place, reference.size())).clone();
}

}  // namespace

ObjectStack stackObject(const LabelledObject& object, FrameIndex frame, const CameraMotion& camera,
                        const GrayFrames& gray, const ObjectStackOptions& options, std::stop_token stop) {
    ObjectStack result;
    result.frame = frame;
    const LabelledBox here = boxAt(object, frame, camera);
    if (!here.visible() || here.box.length <= 0 || here.box.width <= 0) return result;
    const cv::Mat picture = gray(frame);
    if (picture.empty()) return result;
    const Grid grid = gridFor(here.box, options);
    result.area = here.box;
    result.area.length = grid.size.width / grid.samples_per_px;
    result.area.width = grid.size.height / grid.samples_per_px;
    const cv::Mat reference = grid.cut(picture, here.box, 1, 0);
    const cv::Rect inside = grid.inside(here.box);
    const int shift = static_cast<int>(std::lround(options.largest_shift_px * grid.samples_per_px));

    ImageStack stack(options.arrangement, grid.size, options.layers);
    for (const FrameIndex other : framesAround(object, frame, options.layers)) {
        if (stop.stop_requested()) return result;
        if (other == frame) {
            stack.add(reference);
            continue;
        }
        const LabelledBox box = boxAt(object, other, camera);
        if (!box.visible() || box.occlusion == Occlusion::fully) continue;
        const cv::Mat their_picture = gray(other);
        if (their_picture.empty()) continue;
        const cv::Mat wide = grid.cut(their_picture, box.box, growthOf(box.box, here.box), shift);
        const cv::Mat layer = aligned(wide, reference, inside, shift, options.min_correlation);
        if (!layer.empty()) stack.add(layer);
    }
    result.layers = stack.height();
    if (result.layers >= kFewestLayers) result.stacked = stack.stacked();
    return result;
}

}  // namespace eyrie

#include "annotation/pictures/trajectory_refinement.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "annotation/keyframes/interpolation.h"
#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/pictures/trajectory_solver.h"

namespace eyrie {
namespace {

/// All that boxes moved and turned within their reach can show.
cv::Rect partAround(const OrientedBox& box, cv::Size picture) {
    const double half = 1.2 * std::hypot(box.length, box.width) + 4;
    const cv::Point low(static_cast<int>(std::floor(box.centre.x - half)),
                        static_cast<int>(std::floor(box.centre.y - half)));
    const int side = static_cast<int>(std::ceil(2 * half));
    return cv::Rect(low, cv::Size(side, side)) & cv::Rect({}, picture);
}

std::vector<PicturePlace> placesOf(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                                   const PictureFitOptions& options, const std::stop_token& stop) {
    std::vector<PicturePlace> places;
    for (FrameIndex frame = firstFrameOf(object); frame <= object.last_frame && !stop.stop_requested(); ++frame) {
        const LabelledBox shown = boxAt(object, frame, camera);
        if (!shown.visible()) continue;
        PicturePlace place;
        place.frame = frame;
        place.box = shown.box;
        const Keyframe* keyframe = keyframeAt(object, frame);
        place.by_hand = keyframe != nullptr && !keyframe->computed;
        const cv::Mat picture = gray(frame);
        const bool comparable = !picture.empty() && shown.occlusion != Occlusion::fully &&
                                areaInImage(place.box, picture.size()) >= options.min_in_image * place.box.area();
        place.whole = !isCutByBorder(place.box, picture.size());
        if (comparable) {
            const cv::Rect part = partAround(place.box, picture.size());
            place.picture = picture(part).clone();
            place.corner = part.tl();
        }
        places.push_back(std::move(place));
    }
    return places;
}

bool sameFlags(const Keyframe& a, const Keyframe& b) {
    return a.occlusion == b.occlusion && a.outside == b.outside && a.ignore == b.ignore;
}

/// Few keyframes along the boxes found; those set by hand and those at which flags change stay.
LabelledObject withWay(const LabelledObject& object, const std::vector<FrameBox>& boxes, const CameraMotion& camera,
                       const PictureFitOptions& options) {
    ReductionOptions reduction;
    reduction.thorough = true;
    reduction.tolerance_px =
        std::max(options.min_tolerance_px, options.tolerance_of_length * boxes[boxes.size() / 2].box.length);
    LabelledObject changed = object;
    changed.keyframes.clear();
    for (std::size_t i = 0; i < object.keyframes.size(); ++i) {
        const Keyframe& keyframe = object.keyframes[i];
        const bool stays =
            !keyframe.computed || keyframe.outside || (i > 0 && !sameFlags(keyframe, object.keyframes[i - 1]));
        if (stays) changed.keyframes.push_back(keyframe);
    }
    for (Keyframe& keyframe : changed.keyframes) {
        if (!keyframe.computed || keyframe.outside) continue;
        for (const FrameBox& box : boxes)
            if (box.frame == keyframe.frame) keyframe.box = box.box;
    }
    for (Keyframe keyframe : reduceToKeyframes(boxes, camera, reduction)) {
        if (keyframeAt(changed, keyframe.frame) != nullptr) continue;
        const Keyframe* before = keyframeBefore(object, keyframe.frame);
        keyframe.occlusion = before->occlusion;
        keyframe.ignore = before->ignore;
        keyframe.computed = true;
        changed = withKeyframe(std::move(changed), keyframe);
    }
    changed.last_frame = object.last_frame;
    return changed;
}

}  // namespace

PictureFit fittedToPictures(const LabelledObject& object, const CameraMotion& camera, const GrayFrames& gray,
                            const PictureFitOptions& options, std::stop_token stop) {
    PictureFit fit;
    fit.object = object;
    const Keyframe* hand = nullptr;
    bool computed = false;
    for (const Keyframe& keyframe : object.keyframes) {
        if (!keyframe.computed && !keyframe.outside && hand == nullptr) hand = &keyframe;
        computed = computed || keyframe.computed;
    }
    if (hand == nullptr || !computed || hand->box.length < 2 || hand->box.width < 2) return fit;
    const SampleGrid grid = SampleGrid::forBox(hand->box, options.reach_along, options.reach_across);
    std::vector<PicturePlace> places = placesOf(object, camera, gray, options, stop);
    if (stop.stop_requested() || places.empty()) return fit;
    findWayInPictures(places, grid);
    std::vector<FrameBox> boxes;
    for (const PicturePlace& place : places) {
        // A vehicle that the border cuts lies elsewhere than its box.
        if (!place.by_hand || place.whole)
            boxes.push_back({place.frame, grid.moved(place.box, place.found, place.turn)});
        if (place.likeness.empty()) continue;
        constexpr float kSure = 0.6F;
        ++fit.frames;
        fit.sure += place.likeness.at<float>(place.step + cv::Point(grid.reach)) >= kSure ? 1 : 0;
    }
    if (boxes.empty()) return fit;
    fit.object = withWay(object, boxes, camera, options);
    return fit;
}

}  // namespace eyrie

#include "ground/track_story.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "events/ground/ground_path.h"

namespace eyrie {
std::vector<StoryPoint> storyOf(const StoredTracks& run, const GroundStretches& ground, TrackId track,
                                FrameIndex around, const EventOptions& options) {
    const auto found =
        std::find_if(run.tracks.begin(), run.tracks.end(), [&](const auto& one) { return one.id == track; });
    if (found == run.tracks.end()) return {};
    const std::vector<EventTrack> alone{*found};
    std::vector<StoryPoint> story;
    for (const GroundPath& path : groundPaths(alone, ground, options)) {
        if (path.stretch != ground.indexOf(around)) continue;
        double way = 0;
        for (std::size_t i = 0; i < path.samples.size(); ++i) {
            const GroundSample& sample = path.samples[i];
            const OrientedBox& box = path.box(i).box;
            if (i > 0) way += metresBetween(path.samples[i - 1], sample);
            story.push_back({sample.frame, run.secondsOf(sample.frame), path.measured ? sample.speed : 0, way,
                             sample.at, box.centre, box.length});
        }
    }
    return story;
}

std::vector<StoryPoint> chosenAround(const std::vector<StoryPoint>& story, FrameIndex around, double before_s,
                                     double after_s, int most) {
    if (story.empty() || most < 1) return {};
    const auto middle = std::min_element(story.begin(), story.end(), [around](const auto& a, const auto& b) {
        return std::abs(a.frame - around) < std::abs(b.frame - around);
    });
    if (most == 1) return {*middle};
    std::vector<StoryPoint> near;
    for (const StoryPoint& point : story)
        if (point.seconds >= middle->seconds - before_s && point.seconds <= middle->seconds + after_s)
            near.push_back(point);
    if (static_cast<int>(near.size()) <= most) return near;
    std::vector<StoryPoint> chosen;
    for (int i = 0; i < most; ++i) {
        const double at = static_cast<double>(i) * static_cast<double>(near.size() - 1) / (most - 1);
        chosen.push_back(near[static_cast<std::size_t>(std::lround(at))]);
    }
    return chosen;
}

ObjectStack stackOfTrack(const StoredTracks& run, TrackId track, FrameIndex around, const GrayFrames& gray,
                         const std::stop_token& stop) {
    const auto found =
        std::find_if(run.tracks.begin(), run.tracks.end(), [&](const auto& one) { return one.id == track; });
    if (found == run.tracks.end()) return {};
    LabelledObject object;
    for (const TrackedBox& box : found->boxes) {
        Keyframe keyframe;
        keyframe.frame = box.frame;
        keyframe.box = box.box;
        keyframe.heading_set = true;
        object.keyframes.push_back(keyframe);
    }
    object.last_frame = found->boxes.back().frame;
    return stackObject(object, around, run.footage.camera, gray, {}, stop);
}

cv::Mat chipOf(const cv::Mat& picture, cv::Point2d place, double side, int size) {
    if (picture.empty() || size < 1 || !(side > 0)) return {};
    const double scale = size / side;
    // Pixel centres are integers on both sides.
    const double middle = (size - 1) / 2.0;
    const cv::Matx23d chip_from_picture(scale, 0, middle - scale * place.x, 0, scale, middle - scale * place.y);
    cv::Mat chip;
    cv::warpAffine(picture, chip, chip_from_picture, {size, size}, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
    return chip;
}

}  // namespace eyrie

#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "annotation/keyframe_reduction.h"
#include "annotation/scenes.h"
#include "io/box_csv.h"
#include "io/homography_csv.h"
#include "support/shared_data.h"

namespace eyrie {
namespace {

std::map<int, std::vector<FrameBox>> tracksOf(const BoxesByFrame& boxes) {
    std::map<int, std::vector<FrameBox>> tracks;
    for (const auto& [frame, records] : boxes) {
        for (const BoxRecord& record : records) {
            if (record.id) tracks[*record.id].push_back({frame, record.box});
        }
    }
    return tracks;
}

struct Effort {
    double keyframes = 0;
    double worst_overlap = 1;
};

Effort effortOf(const std::map<int, std::vector<FrameBox>>& tracks, const CameraMotion& camera, PathShape shape) {
    ReductionOptions options;
    options.tolerance_px = 0;
    options.min_overlap = 0.7;
    options.shape = shape;
    Effort effort;
    for (const auto& [id, boxes] : tracks) {
        LabelledObject object;
        object.keyframes = reduceToKeyframes(boxes, camera, options);
        object.last_frame = boxes.back().frame;
        effort.keyframes += static_cast<double>(object.keyframes.size()) / static_cast<double>(tracks.size());
        effort.worst_overlap = std::min(effort.worst_overlap, reductionError(object, boxes, camera, shape).min_overlap);
    }
    return effort;
}

/// Keyframes per object of real traffic under a moving camera, at the same accuracy. Printed, because the figures are
/// wanted in reports.
TEST(CollageKeyframes, TheGroundNeedsFarFewerThanTheImage) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    for (const char* name : {"collage_day"}) {
        const auto folder = test::sharedData(name);
        const auto tracks = tracksOf(readBoxCsv(folder / "ground_truth.csv"));
        const CameraMotion camera = CameraMotion::fromCommonFrame(readHomographyCsv(folder / "homography.csv"));
        const Effort ground = effortOf(tracks, camera, PathShape::smooth);
        const Effort ground_straight = effortOf(tracks, camera, PathShape::straight);
        const Effort image = effortOf(tracks, CameraMotion(), PathShape::smooth);
        const Effort image_straight = effortOf(tracks, CameraMotion(), PathShape::straight);
        std::printf("%s, %zu objects, keyframes each: ground %.2f (straight %.2f), image %.2f (straight %.2f)\n", name,
                    tracks.size(), ground.keyframes, ground_straight.keyframes, image.keyframes,
                    image_straight.keyframes);
        EXPECT_GE(ground.worst_overlap, 0.7);
        EXPECT_GE(image.worst_overlap, 0.7);
        EXPECT_LE(ground.keyframes, 0.6 * image_straight.keyframes) << "straight in the image, as elsewhere";
        EXPECT_LE(ground.keyframes, 0.75 * image.keyframes) << "the same smooth path in the image";
        EXPECT_LE(ground.keyframes, ground_straight.keyframes);
    }
}

}  // namespace
}  // namespace eyrie

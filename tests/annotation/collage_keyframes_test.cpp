#include <gtest/gtest.h>

#include <cstdio>
#include <map>

#include "annotation/keyframes/keyframe_reduction.h"
#include "annotation/scenes.h"
#include "core/geometry/angle.h"
#include "io/tables/box_csv.h"
#include "io/tables/homography_csv.h"
#include "support/shared_data.h"

namespace eyrie::collage_keyframes_test {
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

/// How somebody comes to his keyframes.
enum class Way {
    as_annotators_do,  ///< one at the first and one at the last frame, then one wherever it is worst
    best_places        ///< as few as a long search finds
};

/// `headings_set`: as CVAT and VIAME have it, where no heading follows a path.
Effort effortOf(const std::map<int, std::vector<FrameBox>>& tracks, const CameraMotion& camera, PathShape shape,
                Way way, bool headings_set = false) {
    ReductionOptions options;
    options.tolerance_px = 0;
    options.min_overlap = 0.7;
    options.shape = shape;
    options.headings_set = headings_set;
    options.thorough = true;
    Effort effort;
    for (const auto& [id, boxes] : tracks) {
        LabelledObject object;
        object.last_frame = boxes.back().frame;
        if (way == Way::best_places) {
            object.keyframes = reduceToKeyframes(boxes, camera, options);
        } else {
            // Headings told or left to the path, the end told or left standing, whatever needs less.
            LabelledObject best;
            for (const bool set : {true, false}) {
                if (headings_set && !set) continue;
                for (const bool end_too : {true, false}) {
                    LabelledObject start;
                    start.last_frame = boxes.back().frame;
                    start.keyframes.push_back(test::keyframe(boxes.front().frame, boxes.front().box, set));
                    if (end_too && boxes.size() > 1)
                        start.keyframes.push_back(test::keyframe(boxes.back().frame, boxes.back().box, set));
                    const LabelledObject done = refined(start, boxes, camera, options);
                    if (best.keyframes.empty() || done.keyframes.size() < best.keyframes.size()) best = done;
                }
            }
            object = best;
        }
        effort.keyframes += static_cast<double>(object.keyframes.size()) / static_cast<double>(tracks.size());
        effort.worst_overlap = std::min(effort.worst_overlap, reductionError(object, boxes, camera, shape).min_overlap);
    }
    return effort;
}

/// The fewest keyframes there can be with straight lines in the image between them, as CVAT and VIAME draw them: by
/// trying all pairs, without the engine.
std::size_t fewestStraight(const std::vector<FrameBox>& boxes) {
    const auto fits = [&](std::size_t a, std::size_t b, std::size_t until) {
        for (std::size_t i = a + 1; i < until; ++i) {
            const double share =
                a == b ? 0 : static_cast<double>(boxes[i].frame - boxes[a].frame) / (boxes[b].frame - boxes[a].frame);
            OrientedBox box = boxes[a].box;
            box.centre += (boxes[b].box.centre - box.centre) * share;
            box.length += (boxes[b].box.length - box.length) * share;
            box.width += (boxes[b].box.width - box.width) * share;
            box.heading += share * turnBetween(boxes[a].box.heading, boxes[b].box.heading);
            if (overlap(box, boxes[i].box) < 0.7) return false;
        }
        return true;
    };
    std::vector<std::size_t> fewest(boxes.size(), boxes.size());
    fewest[0] = 1;
    std::size_t best = boxes.size();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (fewest[i] < best && fits(i, i, boxes.size())) best = fewest[i];
        for (std::size_t j = i + 1; j < boxes.size(); ++j) {
            if (fewest[i] + 1 < fewest[j] && fits(i, j, j)) fewest[j] = fewest[i] + 1;
        }
    }
    return best;
}

/// Keyframes per object of real traffic under a moving camera, at the same accuracy. Printed, because the figures are
/// wanted in reports.
TEST(CollageKeyframes, TheGroundNeedsHalfOfWhatTheImageNeeds) {
    EYRIE_NEED_SHARED_DATA("collage_day");
    for (const char* name : {"collage_day", "collage_small"}) {
        const auto folder = test::sharedData(name);
        const auto tracks = tracksOf(readBoxCsv(folder / "ground_truth.csv"));
        const CameraMotion camera = test::cameraOf(readHomographyCsv(folder / "homography.csv"));
        const Effort ground = effortOf(tracks, camera, PathShape::smooth, Way::as_annotators_do);
        const Effort smooth = effortOf(tracks, CameraMotion(), PathShape::smooth, Way::as_annotators_do);
        const Effort peers = effortOf(tracks, CameraMotion(), PathShape::straight, Way::as_annotators_do, true);
        std::printf("%s, %zu objects, keyframes each as annotators set them: ground %.2f, image %.2f (smooth %.2f)\n",
                    name, tracks.size(), ground.keyframes, peers.keyframes, smooth.keyframes);
        EXPECT_GE(ground.worst_overlap, 0.7);
        EXPECT_GE(peers.worst_overlap, 0.7);
        EXPECT_LE(ground.keyframes, 0.5 * peers.keyframes);
        EXPECT_LE(ground.keyframes, 0.75 * smooth.keyframes) << "the same smooth path in the image";

        double fewest = 0;
        for (const auto& [id, boxes] : tracks)
            fewest += static_cast<double>(fewestStraight(boxes)) / static_cast<double>(tracks.size());
        const Effort best = effortOf(tracks, camera, PathShape::smooth, Way::best_places);
        std::printf("  at the best places: ground %.2f, image %.2f\n", best.keyframes, fewest);
        EXPECT_LE(best.keyframes, 0.6 * fewest);
    }
}

}  // namespace
}  // namespace eyrie::collage_keyframes_test

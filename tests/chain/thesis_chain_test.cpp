#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>
#include <set>
#include <vector>

#include "chain/chain.h"
#include "scene/painting/scene_renderer.h"
#include "scene/towns/scene_preset.h"
#include "support/moving_scene.h"

/// The thesis' preset, as it is, through the whole chain: two vehicles that merge, one that splits, one that is missed
/// and one that leaves the image (Teutsch §6.2.1, fig. 6.2; §7.4.3).
namespace eyrie::thesis_chain_test {
namespace {

constexpr int kMergeFrom = 16;  // before any stack is high enough to hide it in its median
constexpr int kSplitFrom = 20;
constexpr int kEventFrames = 4;  // too few for a wrong box to become a reliable track
constexpr int kMissed = 26;
enum Who : std::size_t { left, right, longer, missed, leaving };

test::MovingScene traffic() {
    test::MovingScene scene;
    scene.frames = 60;
    scene.camera_per_frame = {0.4, 0.2};
    scene.vehicles = {{{40, 60}, {2, 0}, {24, 11}},
                      {{40, 79}, {2, 0}, {24, 11}},
                      {{250, 130}, {-2, 0}, {40, 12}},
                      {{60, 190}, {2, 0}, {24, 11}},
                      {{262, 215}, {2.4, 0}, {24, 11}}};
    return scene;
}

OrientedBox boxOf(const test::MovingScene& scene, Who who, int frame) {
    const auto& vehicle = scene.vehicles[who];
    return {scene.vehicleAt(vehicle, frame), vehicle.size.width, vehicle.size.height,
            std::atan2(vehicle.velocity.y, vehicle.velocity.x)};
}

/// Paints an upright rectangle in the way of the vehicles' own edges.
void paint(cv::Mat& picture, cv::Point2d centre, cv::Size2d size, int edge, int inside) {
    const cv::Rect area(cvRound(centre.x - size.width / 2), cvRound(centre.y - size.height / 2), cvRound(size.width),
                        cvRound(size.height));
    cv::rectangle(picture, area, cv::Scalar(inside), cv::FILLED);
    if (edge != inside) cv::rectangle(picture, area, cv::Scalar(edge), 1);
}

cv::Mat picture(const test::MovingScene& scene, int frame) {
    test::MovingScene seen = scene;
    if (frame == kMissed) seen.vehicles[missed].start.y += 1000;  // whatever hides it
    cv::Mat drawn = seen.draw(frame);
    if (frame >= kMergeFrom && frame < kMergeFrom + kEventFrames) {
        // What lies between both looks like them.
        const cv::Point2d middle = (boxOf(scene, left, frame).centre + boxOf(scene, right, frame).centre) * 0.5;
        paint(drawn, middle, {24, 10}, 235, 190);
    }
    if (frame >= kSplitFrom && frame < kSplitFrom + kEventFrames)
        paint(drawn, boxOf(scene, longer, frame).centre, {10, 16}, 110, 110);  // like the ground
    return drawn;
}

const std::vector<FrameResult>& results() {
    static const std::vector<FrameResult> all = [] {
        const test::MovingScene scene = traffic();
        test::MemorySource source(scene.frames, scene.size, [&](int frame) { return picture(scene, frame); });
        Chain chain(builtInPreset("thesis"), {0.2, 25, true});
        std::vector<FrameResult> found;
        for (int frame = 0; frame < scene.frames; ++frame) found.push_back(chain.next(source.read(frame, false)));
        return found;
    }();
    return all;
}

/// The reliable track that lies on a vehicle best; null: none does.
const TrackState* trackOn(Who who, int frame) {
    const OrientedBox box = boxOf(traffic(), who, frame);
    const TrackState* best = nullptr;
    for (const TrackState& state : results().at(static_cast<std::size_t>(frame)).tracks) {
        if (state.status == TrackStatus::tentative || overlap(state.box, box) < 0.3) continue;
        if (best == nullptr || overlap(state.box, box) > overlap(best->box, box)) best = &state;
    }
    return best;
}

void expectOneTrack(Who who, int first, int last) {
    const TrackState* before = trackOn(who, first);
    const TrackState* after = trackOn(who, last);
    ASSERT_TRUE(before) << who;
    ASSERT_TRUE(after) << who;
    EXPECT_EQ(before->id, after->id) << who;
}

int statesOf(Who who, int first, int frames, StateOrigin origin) {
    int count = 0;
    for (int frame = first; frame < first + frames; ++frame) {
        const TrackState* state = trackOn(who, frame);
        count += state != nullptr && state->origin == origin;
    }
    return count;
}

}  // namespace

TEST(ThesisChain, mergedVehiclesAreReconstructedAndKeepTheirIds) {
    expectOneTrack(left, kMergeFrom - 1, kMergeFrom + 12);
    expectOneTrack(right, kMergeFrom - 1, kMergeFrom + 12);
    const TrackState* one = trackOn(left, kMergeFrom + 12);
    const TrackState* other = trackOn(right, kMergeFrom + 12);
    ASSERT_TRUE(one && other);
    EXPECT_NE(one->id, other->id);
    EXPECT_GT(statesOf(left, kMergeFrom, kEventFrames, StateOrigin::reconstructed) +
                  statesOf(right, kMergeFrom, kEventFrames, StateOrigin::reconstructed),
              0);
}

TEST(ThesisChain, aSplitVehicleStaysOneTrack) {
    expectOneTrack(longer, kSplitFrom - 1, kSplitFrom + 12);
    EXPECT_GT(statesOf(longer, kSplitFrom, kEventFrames, StateOrigin::reconstructed), 0);
}

TEST(ThesisChain, aMissedVehicleKeepsItsId) {
    expectOneTrack(missed, kMissed - 1, kMissed + 14);
    EXPECT_EQ(statesOf(missed, kMissed, 1, StateOrigin::detected), 0) << "there is nothing to be detected";
}

TEST(ThesisChain, whoLeavesIsFollowedToTheBorderAndNotBeyond) {
    const TrackState* before = trackOn(leaving, 18);
    ASSERT_TRUE(before);
    // Its last corner is out of the picture in frame 35; ten frames by vectors are over by then, 0.3 s are left.
    for (std::size_t frame = 44; frame < results().size(); ++frame) {
        for (const TrackState& state : results()[frame].tracks) EXPECT_NE(state.id, before->id) << frame;
    }
}

TEST(ThesisChain, holdsTheLimitsOfTheText) {
    struct Run {
        int rebuilt = 0;
        int predicted = 0;
    };
    std::map<TrackId, Run> runs;
    int detections = 0;
    for (const FrameResult& result : results()) {
        const cv::Size image = result.motion.image_size;
        for (const MotionVector& vector : result.motion.motion_vectors) {
            EXPECT_FALSE(vector.isInferred()) << "only tracked corners";
            EXPECT_GE(vector.age, 5);
        }
        for (const Detection& detection : result.detections) {
            if (detection.rejection != Rejection::none) continue;
            ++detections;
            EXPECT_GE(detection.vectors.size(), 4U);
            EXPECT_GE(detection.box.area(), 10);
            for (const cv::Point2d& corner : detection.box.corners()) {
                EXPECT_GE(corner.x, -0.51);
                EXPECT_GE(corner.y, -0.51);
                EXPECT_LE(corner.x, image.width - 0.49);
                EXPECT_LE(corner.y, image.height - 0.49);
            }
        }
        for (const TrackState& state : result.tracks) {
            Run& run = runs[state.id];
            if (state.origin == StateOrigin::detected) run = {};
            run.rebuilt += state.origin == StateOrigin::reconstructed;
            run.predicted = state.origin == StateOrigin::predicted ? run.predicted + 1 : 0;
            EXPECT_LE(run.rebuilt, 10) << "track " << state.id << ", frame " << result.motion.frame;
            EXPECT_LE(run.predicted, 8) << "0.3 s; track " << state.id << ", frame " << result.motion.frame;
        }
    }
    EXPECT_GT(detections, 100) << "five vehicles in 60 frames";
}

/// A corner alone, and two that belong together.
TEST(ThesisChain, noClusterIsTooSmallToBeSearched) {
    FrameMotion motion;
    motion.image_size = {320, 240};
    motion.motion_vectors = {{1, {100, 100}, {2, 0}, 9}, {2, {200, 100}, {2, 0}, 9}, {3, {204, 102}, {2, 0}, 9}};
    const auto clusters = MotionClustering(builtInPreset("thesis").clustering, {0.2, 25, true}).cluster(motion);
    ASSERT_EQ(clusters.size(), 2U);
    EXPECT_EQ(clusters[0].members, std::vector<int>{0});
    EXPECT_EQ(clusters[1].members, (std::vector<int>{1, 2}));
}

TEST(ThesisChain, slidingWindowsFindVehiclesByTheModelOfTheText) {
    constexpr double kCar = 4.6, kCarWidth = 2.0;  // m, of a vehicle that fills the window
    constexpr double kThreshold = 30;              // T_d of the model of the text
    ChainOptions options = builtInPreset("thesis");
    options.detection.method = DetectionMethod::sliding_window;
    const SceneRenderer scene(scenePreset("egtest01"));
    const SceneScale scale{scene.scene().gsd_m_per_px, scene.scene().frame_rate_hz, true};
    Chain chain(options, scale);
    int found = 0, on_vehicles = 0;
    std::set<TrackId> reliable;
    for (int frame = 0; frame < 40; ++frame) {
        const RenderedFrame rendered = scene.render(frame);
        const FrameResult result = chain.next(rendered.frame);
        for (const Detection& detection : result.detections) {
            if (detection.rejection != Rejection::none) continue;
            ++found;
            on_vehicles += std::any_of(rendered.truth.begin(), rendered.truth.end(), [&](const SceneObject& object) {
                return overlap(object.box, detection.box) > 0.2;
            });
            EXPECT_TRUE(detection.complete) << "the classifier's own";
            EXPECT_GE(detection.score, kThreshold) << "T_d";
            EXPECT_GE(detection.vectors.size(), 4U);
            // The window has one width and three lengths; areas are scaled to whole pixels.
            EXPECT_NEAR(detection.box.width / scale.px(kCarWidth), 1, 0.05);
            double nearest = 10;
            for (const double length : {0.85, 1.0, 3.8})
                nearest = std::min(nearest, std::abs(detection.box.length / (length * scale.px(kCar)) - 1));
            EXPECT_LT(nearest, 0.05) << detection.box.length << " px";
        }
        for (const TrackState& state : result.tracks) {
            if (state.status != TrackStatus::tentative) reliable.insert(state.id);
        }
    }
    // Three of six vehicles are in the picture at a time.
    EXPECT_GT(found, 30);
    EXPECT_GT(on_vehicles, found / 2);
    EXPECT_GE(reliable.size(), 2U);
}

}  // namespace eyrie::thesis_chain_test

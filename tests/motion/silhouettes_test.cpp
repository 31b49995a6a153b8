#include "motion/differences/silhouettes.h"

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

namespace eyrie::silhouettes_test {
namespace {

const SceneScale kScale{0.3, 25, true};
constexpr int kFrames = 40;

/// A plain lorry, 40 × 9 px, on textured ground under a camera that pans. Only its front has corners.
struct LorryScene {
    cv::Point2d velocity{2, 0};  ///< px/frame over the ground
    int roof = 220;              ///< grey values
    double shadow = 0;           ///< share of the ground's brightness left below the lorry; 0: none
    int road_gap = 0;            ///< px of road visible behind the first 12 px
    int flicker = 0;             ///< grey values by which the ground gets brighter and darker
    cv::Point2d camera{0.5, 0.25};

    cv::Rect2d lorryAt(int frame) const {
        const cv::Point2d corner = cv::Point2d(120, 100) + (velocity - camera) * frame;
        return {corner.x, corner.y, 40, 9};
    }
    Frame frame(int index) const {
        static const cv::Mat ground = [] {
            cv::Mat texture(400, 600, CV_8UC1);
            cv::RNG random(3);
            random.fill(texture, cv::RNG::NORMAL, 110, 25);
            cv::GaussianBlur(texture, texture, {}, 2);
            return texture;
        }();
        cv::Mat gray;
        cv::getRectSubPix(ground, {320, 240}, cv::Point2f(200, 150) + cv::Point2f(camera * index), gray);
        gray += (index * 7 % 13 - 6) * flicker / 6;
        const cv::Rect2d box = lorryAt(index);
        const cv::Rect lorry(cvRound(box.x), cvRound(box.y), 40, 9);
        if (shadow > 0) {
            cv::Mat below = gray(cv::Rect(lorry.x, lorry.br().y, 40, 6));
            below.convertTo(below, CV_8U, shadow);
        }
        gray(cv::Rect(lorry.x + 28, lorry.y, 12, 9)).setTo(roof);
        const int rest = 28 - road_gap;
        gray(cv::Rect(lorry.x, lorry.y, rest, 9)).setTo(roof);
        return {index, index * 40000, gray, {}};
    }
    Registration registration(int index) const {
        Registration registration;
        registration.state = index == 0 ? RegistrationState::first : RegistrationState::registered;
        registration.current_from_previous.from_frame = std::max(0, index - 1);
        registration.current_from_previous.to_frame = index;
        if (index > 0) {
            registration.current_from_previous.matrix(0, 2) = -camera.x;
            registration.current_from_previous.matrix(1, 2) = -camera.y;
        }
        return registration;
    }
    /// What is inferred from the corners of the front in the last frame.
    std::vector<MotionVector> inferred(const SilhouetteOptions& options = {}, const SceneScale& scale = kScale) const {
        Silhouettes silhouettes(options, scale);
        for (int index = 0; index < kFrames; ++index) silhouettes.add(frame(index), registration(index));
        const cv::Rect2d box = lorryAt(kFrames - 1);
        std::vector<MotionVector> corners;
        for (const cv::Point2d offset : {cv::Point2d(33, 1), {38, 1}, {39, 4}, {38, 7}, {33, 7}}) {
            corners.push_back({static_cast<CornerId>(corners.size()), offset + box.tl(), velocity, 20});
        }
        return silhouettes.infer(corners, {0, 1, 2, 3, 4}, 0.01);
    }
};

/// How far behind the front the vectors reach, px; 0 without any.
double reachBehindFront(const LorryScene& scene, const std::vector<MotionVector>& vectors) {
    double reach = 0;
    for (const MotionVector& vector : vectors)
        reach = std::max(reach, scene.lorryAt(kFrames - 1).br().x - double(vector.position.x));
    return reach;
}

TEST(Silhouettes, APlainRoofMovesLikeTheCornersInFrontOfIt) {
    LorryScene scene;
    const auto vectors = scene.inferred();
    EXPECT_NEAR(reachBehindFront(scene, vectors), 40, 2);
    const cv::Rect2d lorry = scene.lorryAt(kFrames - 1);
    for (const MotionVector& vector : vectors) {
        EXPECT_TRUE(vector.isInferred());
        EXPECT_EQ(vector.velocity, cv::Point2f(2, 0));
        EXPECT_GT(vector.position.y, lorry.y - 1.5);
        EXPECT_LT(vector.position.y, lorry.br().y + 1.5);
    }
    EXPECT_GE(vectors.size(), 20u) << "an outline, both sides";
}

TEST(Silhouettes, OutlinesAreSampledEveryTwoPixelsAtAnyScale) {
    // Two pixels to a cell, 40 of the lorry's length: 20 cells on either side, some with a corner beside them.
    const LorryScene scene;
    const auto vectors = scene.inferred({}, {0.15, 25, true});
    EXPECT_NEAR(reachBehindFront(scene, vectors), 40, 3);
    EXPECT_GE(vectors.size(), 30u);
    EXPECT_LE(vectors.size(), 46u);
}

TEST(Silhouettes, IdsGrowAndAreNoCorners) {
    const auto vectors = LorryScene{}.inferred();
    ASSERT_FALSE(vectors.empty());
    EXPECT_GT(vectors.front().id, CornerId{1} << 32);
    for (std::size_t i = 1; i < vectors.size(); ++i) EXPECT_LT(vectors[i - 1].id, vectors[i].id);
}

TEST(Silhouettes, EndWhereTheRoadIsSeen) {
    LorryScene scene;
    scene.road_gap = 8;
    EXPECT_NEAR(reachBehindFront(scene, scene.inferred()), 12, 2) << "the next vehicle is another one";
}

TEST(Silhouettes, LeaveOutShadows) {
    LorryScene scene;
    scene.shadow = 0.55;
    for (const MotionVector& vector : scene.inferred())
        EXPECT_LT(vector.position.y, scene.lorryAt(kFrames - 1).br().y + 1.5);
}

TEST(Silhouettes, NothingWhereNothingIsKnownOfTheGround) {
    LorryScene slow;
    slow.velocity = {0.8, 0};  // 6 m/s: in 28 frames it moves 22 px, half its length
    const double reach = reachBehindFront(slow, slow.inferred());
    EXPECT_LT(reach, 24);
    SilhouetteOptions longer;
    longer.silhouette_frames = 39;
    EXPECT_GT(reachBehindFront(slow, slow.inferred(longer)), reach + 5) << "a longer memory sees more of it";
    LorryScene creeping;
    creeping.velocity = {0.2, 0};
    EXPECT_TRUE(creeping.inferred().empty());
    LorryScene camouflaged;
    camouflaged.roof = 112;
    EXPECT_LT(reachBehindFront(camouflaged, camouflaged.inferred()), 15);
}

TEST(Silhouettes, TooLargeOnesAreNotUsed) {
    SilhouetteOptions options;
    options.silhouette_max_length_m = 10;  // 33 px
    EXPECT_TRUE(LorryScene{}.inferred(options).empty());
}

TEST(Silhouettes, LimitsLieAboutTheLorry) {
    // 15 m/s, 40 × 9 px = 12 × 2.7 m, about 110 grey values brighter than the ground.
    const struct {
        const char* parameter;
        const char* passes;
        const char* refuses;
    } limits[] = {{"motion.silhouette_contrast", "60", "180"},
                  {"motion.silhouette_min_speed", "14", "16"},
                  {"motion.silhouette_max_length", "14", "11"},
                  {"motion.silhouette_max_width", "3", "1.5"}};
    for (const auto& limit : limits) {
        SilhouetteOptions options;
        setParameter(describeOf(options), limit.parameter, limit.passes);
        EXPECT_NEAR(reachBehindFront({}, LorryScene{}.inferred(options)), 40, 3) << limit.parameter;
        setParameter(describeOf(options), limit.parameter, limit.refuses);
        EXPECT_LT(reachBehindFront({}, LorryScene{}.inferred(options)), 30) << limit.parameter;
    }
    // Where the ground itself changes by some grey values, a roof that is little brighter is not told from it.
    LorryScene pale;
    pale.roof = 165;
    pale.flicker = 6;
    SilhouetteOptions options;
    options.silhouette_noise_factor = 0;
    const std::size_t all = pale.inferred(options).size();
    options.silhouette_noise_factor = 50;
    EXPECT_LT(pale.inferred(options).size(), all);
}

TEST(Silhouettes, WidthsAreThoseOfCellsOfAnySize) {
    // At 0.15 m/px a cell is two pixels wide: the lorry's 9 px take five cells, 10 px; 2 px are tolerated.
    SilhouetteOptions options;
    const auto reachWith = [&](double most_px) {
        options.silhouette_max_width_m = most_px * 0.15;
        return reachBehindFront({}, LorryScene{}.inferred(options, {0.15, 25, true}));
    };
    EXPECT_NEAR(reachWith(9), 40, 3);
    EXPECT_EQ(reachWith(7.5), 0);
}

TEST(Silhouettes, CanBeSwitchedOffAndForget) {
    SilhouetteOptions off;
    off.silhouettes = false;
    EXPECT_TRUE(LorryScene{}.inferred(off).empty());
    const LorryScene scene;
    Silhouettes silhouettes({}, kScale);
    for (int index = 0; index < kFrames; ++index) silhouettes.add(scene.frame(index), scene.registration(index));
    silhouettes.add({kFrames, 0, {}, {}}, scene.registration(kFrames));
    EXPECT_TRUE(silhouettes.infer({}, {}, 0.01).empty()) << "a frame without a picture";
}

}  // namespace
}  // namespace eyrie::silhouettes_test

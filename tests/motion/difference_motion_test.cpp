#include "motion/differences/difference_motion.h"

#include <gtest/gtest.h>

#include <map>

#include "core/error.h"
#include "support/moving_scene.h"

namespace eyrie::difference_motion_test {
namespace {

using test::MovingScene;

const SceneScale kScale{0.2, 25, true};

DifferenceOptions optionsOf(MotionMethod method) {
    DifferenceOptions options;
    options.method = method;
    options.gap = 4;
    options.background_frames = 9;
    options.background_step = 4;
    return options;
}

/// Drawn once for all tests; with or without vehicles.
Frame frameOf(const MovingScene& scene, int index) {
    static std::map<std::pair<bool, int>, cv::Mat> drawn;
    cv::Mat& gray = drawn[{scene.vehicles.empty(), index}];
    if (gray.empty()) gray = scene.draw(index);
    Frame frame;
    frame.index = index;
    frame.gray = gray;
    return frame;
}

/// What registration and motion detection would say, exactly: a vector at each vehicle's centre.
FrameMotion trueMotion(const MovingScene& scene, int index) {
    FrameMotion motion;
    motion.frame = index;
    motion.image_size = scene.size;
    motion.registration.state = index == 0 ? RegistrationState::first : RegistrationState::registered;
    Homography& step = motion.registration.current_from_previous;
    step.from_frame = index == 0 ? 0 : index - 1;
    step.to_frame = index;
    if (index > 0) {
        step.matrix(0, 2) = -scene.camera_per_frame.x;
        step.matrix(1, 2) = -scene.camera_per_frame.y;
    }
    for (const auto& vehicle : scene.vehicles) {
        motion.motion_vectors.push_back({static_cast<CornerId>(motion.motion_vectors.size()),
                                         scene.vehicleAt(vehicle, index), vehicle.velocity, 9});
    }
    return motion;
}

DifferenceResult lastOf(const MovingScene& scene, const DifferenceOptions& options) {
    DifferenceMotion motion(options, kScale);
    const int last = scene.frames - 1;
    for (int i = 0; i < last; ++i) motion.remember(frameOf(scene, i), trueMotion(scene, i));
    return motion.next(frameOf(scene, last), trueMotion(scene, last));
}

double bestOverlap(const std::vector<MotionCluster>& clusters, const OrientedBox& vehicle) {
    double best = 0;
    for (const auto& cluster : clusters) best = std::max(best, overlap(cluster.box, vehicle));
    return best;
}

class EveryDifference : public testing::TestWithParam<MotionMethod> {};

std::string methodName(const testing::TestParamInfo<MotionMethod>& info) {
    return nameOf(info.param);
}

}  // namespace

TEST_P(EveryDifference, FindsTheVehiclesAndNothingElse) {
    const MovingScene scene;
    const DifferenceResult result = lastOf(scene, optionsOf(GetParam()));
    for (const auto& vehicle : scene.vehicles) {
        const OrientedBox box{scene.vehicleAt(vehicle, scene.frames - 1), vehicle.size.width, vehicle.size.height,
                              std::atan2(vehicle.velocity.y, vehicle.velocity.x)};
        // A difference of two pictures also answers where the vehicle was, 8 px behind; that may join its area.
        EXPECT_GT(bestOverlap(result.clusters, box), 0.45);
    }
    const bool ghosts = GetParam() == MotionMethod::two_frame_difference;
    EXPECT_LE(result.clusters.size(), ghosts ? 4U : 2U);
    for (const auto& cluster : result.clusters) {
        const bool by_place =
            GetParam() == MotionMethod::three_frame_difference || GetParam() == MotionMethod::median_background;
        EXPECT_TRUE(!by_place || cluster.members.size() == 1U) << "each area has its vehicle's vector";
        if (cluster.members.empty()) continue;  // the place a vehicle has left
        const cv::Point2d velocity = scene.vehicles[static_cast<std::size_t>(cluster.members[0])].velocity;
        EXPECT_NEAR(cluster.velocity.x, velocity.x, 1e-6);
        EXPECT_NEAR(cluster.velocity.y, velocity.y, 1e-6);
        EXPECT_FALSE(cluster.moving_points.empty());
        for (const cv::Point2f& point : cluster.moving_points) EXPECT_TRUE(cluster.box.contains(point, 1e-3));
    }
}

TEST_P(EveryDifference, FindsNothingWhereNothingMoves) {
    MovingScene scene;
    scene.vehicles.clear();
    EXPECT_TRUE(lastOf(scene, optionsOf(GetParam())).clusters.empty());
}

TEST_P(EveryDifference, HasNoAnswerAfterACutAndRepeatsItInAFrozenPicture) {
    const MovingScene scene;
    DifferenceMotion difference(optionsOf(GetParam()), kScale);
    DifferenceResult before;
    for (int i = 0; i < 36; ++i) before = difference.next(frameOf(scene, i), trueMotion(scene, i));
    ASSERT_FALSE(before.clusters.empty());
    FrameMotion frozen = trueMotion(scene, 36);
    frozen.registration.state = RegistrationState::frozen;
    frozen.registration.current_from_previous.matrix = cv::Matx33d::eye();
    Frame repeated = frameOf(scene, 35);
    repeated.index = 36;
    EXPECT_EQ(difference.next(repeated, frozen).clusters.size(), before.clusters.size());
    FrameMotion failed = trueMotion(scene, 37);
    failed.registration.state = RegistrationState::failed;
    EXPECT_TRUE(difference.next(frameOf(scene, 37), failed).clusters.empty());
    EXPECT_FALSE(difference.next(frameOf(scene, 38), trueMotion(scene, 38)).clusters.empty()) << "it was bridged";
    FrameMotion cut = trueMotion(scene, 39);
    cut.registration.state = RegistrationState::first;
    EXPECT_TRUE(difference.next(frameOf(scene, 39), cut).clusters.empty());
}

INSTANTIATE_TEST_SUITE_P(Methods, EveryDifference,
                         testing::Values(MotionMethod::two_frame_difference, MotionMethod::three_frame_difference,
                                         MotionMethod::median_background, MotionMethod::difference_ghosts),
                         methodName);

TEST(DifferenceImage, OfTwoAndThreePicturesByHand) {
    const auto row = [](std::initializer_list<int> values) {
        cv::Mat picture(11, static_cast<int>(values.size()), CV_8UC1);
        int x = 0;
        for (const int value : values) picture.col(x++).setTo(value);
        return picture;
    };
    const auto whole = [](const cv::Mat& gray) {
        return WarpedFrame{gray, cv::Mat(gray.size(), CV_8UC1, cv::Scalar(255))};
    };
    const cv::Mat now = row({10, 10, 10, 90, 10, 10, 10, 10, 10});
    const cv::Mat before = row({10, 10, 10, 10, 90, 10, 10, 10, 10});
    const cv::Mat long_before = row({10, 10, 10, 10, 10, 60, 10, 10, 10});
    const DifferenceImage two = twoFrameDifference(now, whole(before), 0);
    EXPECT_FLOAT_EQ(two.values.at<float>(5, 3), 80);
    EXPECT_FLOAT_EQ(two.values.at<float>(5, 4), 80);  // the ghost
    EXPECT_FLOAT_EQ(two.values.at<float>(5, 5), 0);
    EXPECT_EQ(two.overlap.at<uchar>(5, 1), 0);  // too near the edge
    const DifferenceImage three = threeFrameDifference(now, whole(before), whole(long_before), 0);
    // Only where the vehicle was in the middle picture.
    EXPECT_FLOAT_EQ(three.values.at<float>(5, 3), 0);
    EXPECT_FLOAT_EQ(three.values.at<float>(5, 4), 80);
    EXPECT_FLOAT_EQ(three.values.at<float>(5, 5), 0);
}

TEST(BackgroundModel, MedianIsExact) {
    cv::RNG random(3);
    for (const int count : {1, 2, 5, 8, 30}) {
        std::vector<WarpedFrame> pictures;
        for (int i = 0; i < count; ++i) {
            WarpedFrame picture{cv::Mat(17, 23, CV_8UC1), cv::Mat(17, 23, CV_8UC1)};
            random.fill(picture.gray, cv::RNG::UNIFORM, 0, 256);
            random.fill(picture.inside, cv::RNG::UNIFORM, 0, 4);
            picture.inside = picture.inside > 0;
            pictures.push_back(picture);
        }
        const Background background = medianBackground(pictures);
        for (int y = 0; y < 17; ++y) {
            for (int x = 0; x < 23; ++x) {
                std::vector<int> values;
                for (const auto& picture : pictures) {
                    if (picture.inside.at<uchar>(y, x) != 0) values.push_back(picture.gray.at<uchar>(y, x));
                }
                std::sort(values.begin(), values.end());
                const int expected = values.empty() ? 0 : values[(values.size() - 1) / 2];
                ASSERT_EQ(background.gray.at<uchar>(y, x), expected);
                ASSERT_EQ(background.known.at<uchar>(y, x) != 0,
                          values.size() >= static_cast<std::size_t>((count + 1) / 2));
            }
        }
    }
}

TEST(BackgroundModel, GradientsAreTakenOffTheDifference) {
    cv::Mat ground(40, 40, CV_8UC1, cv::Scalar(50));
    ground.colRange(20, 40).setTo(150);
    cv::Mat shifted(40, 40, CV_8UC1, cv::Scalar(50));
    shifted.colRange(21, 40).setTo(150);  // registered one pixel off
    const Background background{ground, cv::Mat(40, 40, CV_8UC1, cv::Scalar(255))};
    EXPECT_FLOAT_EQ(backgroundDifference(shifted, background, 0, 0).values.at<float>(20, 20), 100);
    EXPECT_FLOAT_EQ(backgroundDifference(shifted, background, 1, 0).values.at<float>(20, 20), 50);
    EXPECT_FLOAT_EQ(backgroundDifference(shifted, background, 2, 0).values.at<float>(20, 20), 0);
}

TEST(DifferenceNoise, IsThatOfThePictures) {
    cv::RNG random(7);
    cv::Mat a(100, 100, CV_32FC1);
    cv::Mat b(100, 100, CV_32FC1);
    random.fill(a, cv::RNG::NORMAL, 100, 6);
    random.fill(b, cv::RNG::NORMAL, 100, 6);
    a.convertTo(a, CV_8U);
    b.convertTo(b, CV_8U);
    a(cv::Rect(30, 30, 20, 20)).setTo(250);  // a vehicle hardly changes it
    const WarpedFrame before{b, cv::Mat(100, 100, CV_8UC1, cv::Scalar(255))};
    EXPECT_NEAR(differenceNoise(twoFrameDifference(a, before, 0)), 6 * std::sqrt(2), 0.7);
    EXPECT_EQ(differenceNoise({}), 0);
}

TEST(MovingPixels, AreAreasThatReachOtsusThresholdOrTheLimit) {
    // Three areas of 12, 30 and 90 grey values and a pixel of 33, noise of 5: Otsu's threshold is 33.
    DifferenceImage difference;
    difference.values = cv::Mat(20, 60, CV_32FC1, cv::Scalar(5));
    difference.overlap = cv::Mat(20, 60, CV_8UC1, cv::Scalar(255));
    difference.values(cv::Rect(5, 5, 8, 8)).setTo(12);
    difference.values(cv::Rect(25, 5, 8, 8)).setTo(30);
    difference.values(cv::Rect(45, 5, 8, 8)).setTo(90);
    difference.values.at<float>(18, 2) = 33;
    const auto moving = [&](double strong_limit) {
        return cv::countNonZero(movingPixels(difference, 10, strong_limit));
    };
    EXPECT_EQ(moving(100), 64 + 1);
    EXPECT_EQ(moving(2), 2 * 64 + 1) << "Otsu's threshold is not followed beyond 20";
    EXPECT_EQ(moving(1), 3 * 64 + 1);
    EXPECT_EQ(cv::countNonZero(movingPixels(difference, 100, 1)), 0);
    difference.values.at<float>(8, 28) = 95;
    EXPECT_EQ(moving(100), 2 * 64 + 1) << "with the whole area of a strong pixel";
    difference.overlap.colRange(40, 60).setTo(0);
    EXPECT_EQ(moving(1), 2 * 64 + 1);
}

TEST(DifferenceMotion, ThresholdIsTheLargerOfNoiseAndContrast) {
    DifferenceOptions options = optionsOf(MotionMethod::two_frame_difference);
    options.noise_factor = 20;
    options.min_contrast = 0;
    const DifferenceResult by_noise = lastOf(MovingScene{}, options);
    EXPECT_GT(by_noise.noise, 0.1);
    EXPECT_DOUBLE_EQ(by_noise.threshold, 20 * by_noise.noise);
    options.noise_factor = 0;
    options.min_contrast = 9;
    EXPECT_DOUBLE_EQ(lastOf(MovingScene{}, options).threshold, 9);
}

TEST(DifferenceMotion, EachLimitHasItsParameter) {
    // Vehicles of 24×11 and 22×10 px, 4.8×2.2 and 4.4×2 m.
    const MovingScene scene;
    const struct {
        MotionMethod method;
        const char* parameter;
        const char* passes;
        const char* refuses;
    } limits[] = {{MotionMethod::median_background, "difference.min_contrast", "10", "250"},
                  {MotionMethod::median_background, "difference.min_area", "4", "20"},
                  {MotionMethod::median_background, "difference.min_area_px", "100", "500"},
                  {MotionMethod::median_background, "difference.max_length", "8", "3"},
                  {MotionMethod::median_background, "difference.opening", "1", "4"},
                  {MotionMethod::difference_ghosts, "difference.ghost_deviation", "0", "255"},
                  {MotionMethod::difference_ghosts, "difference.ghost_gradient", "0", "255"}};
    for (const auto& limit : limits) {
        DifferenceOptions options = optionsOf(limit.method);
        // Either property of a ghost alone decides nothing.
        if (limit.parameter == std::string("difference.ghost_gradient")) options.ghost_deviation = 255;
        if (limit.parameter == std::string("difference.ghost_deviation")) options.ghost_gradient = 255;
        setParameter(describeOf(options), limit.parameter, limit.passes);
        EXPECT_GE(lastOf(scene, options).clusters.size(), 2U) << limit.parameter;
        setParameter(describeOf(options), limit.parameter, limit.refuses);
        EXPECT_EQ(lastOf(scene, options).clusters.size(), 0U) << limit.parameter;
    }
}

TEST(DifferenceMotion, ClosingJoinsAndGradientsAreSuppressed) {
    const MovingScene scene;
    DifferenceOptions options = optionsOf(MotionMethod::median_background);
    const auto pixels = [&](const char* parameter, const char* value) {
        DifferenceOptions changed = options;
        setParameter(describeOf(changed), parameter, value);
        return cv::countNonZero(lastOf(scene, changed).moving);
    };
    options.noise_factor = 0;
    EXPECT_GT(pixels("difference.gradient_suppression", "0"), pixels("difference.gradient_suppression", "3"));
    options.min_contrast = 80;  // leaves parts of the vehicles
    const int parts = pixels("difference.closing", "0");
    EXPECT_LT(parts, pixels("difference.closing", "2"));
    EXPECT_LT(parts, pixels("difference.closing", "0.6")) << "3 px are a disc already";
    EXPECT_EQ(parts, pixels("difference.closing", "0.2")) << "1 px is none";
}

TEST(DifferenceMotion, AllVectorsOnAnAreaBelongToIt) {
    // At the middle of each vehicle, 8 px ahead and behind, and beside it by more than its width.
    const MovingScene scene;
    DifferenceMotion difference(optionsOf(MotionMethod::median_background), kScale);
    const int last = scene.frames - 1;
    for (int i = 0; i < last; ++i) difference.remember(frameOf(scene, i), trueMotion(scene, i));
    FrameMotion motion = trueMotion(scene, last);
    for (const auto& vehicle : scene.vehicles) {
        const cv::Point2d ahead = vehicle.velocity / cv::norm(vehicle.velocity);
        const cv::Point2d centre = scene.vehicleAt(vehicle, last);
        for (const cv::Point2d offset : {8 * ahead, -8 * ahead, 11 * cv::Point2d(-ahead.y, ahead.x)})
            motion.motion_vectors.push_back({99, centre + offset, vehicle.velocity, 9});
    }
    const DifferenceResult result = difference.next(frameOf(scene, last), motion);
    ASSERT_EQ(result.clusters.size(), 2U);
    std::vector<std::vector<int>> members{result.clusters[0].members, result.clusters[1].members};
    std::sort(members.begin(), members.end());
    EXPECT_EQ(members, (std::vector<std::vector<int>>{{0, 2, 3}, {1, 5, 6}}));
}

TEST(DifferenceMotion, WithoutVectorsTheLongerAxisGivesTheHeading) {
    const MovingScene scene;
    DifferenceMotion difference(optionsOf(MotionMethod::three_frame_difference), kScale);
    DifferenceResult result;
    for (int i = 0; i < 30; ++i) {
        FrameMotion motion = trueMotion(scene, i);
        motion.motion_vectors.clear();
        result = difference.next(frameOf(scene, i), motion);
    }
    ASSERT_EQ(result.clusters.size(), 2U);
    for (const auto& cluster : result.clusters) {
        EXPECT_TRUE(cluster.members.empty());
        EXPECT_EQ(cluster.velocity, cv::Point2d(0, 0));
        EXPECT_GE(cluster.box.length, cluster.box.width);
        // One drives along x, the other along y; either way round.
        const bool along_x = cluster.box.centre.x < 150;
        EXPECT_NEAR(std::abs(std::sin(cluster.box.heading)), along_x ? 0 : 1, 0.2);
    }
}

TEST(DifferenceMotion, ThesisComparesPicturesThreeFramesApart) {
    DifferenceOptions options = DifferenceOptions::thesis();
    EXPECT_EQ(options.gap, 3);
    EXPECT_EQ(options.method, MotionMethod::vectors) << "the thesis' own way";
    options.method = MotionMethod::three_frame_difference;
    const MovingScene scene;
    DifferenceMotion difference(options, kScale);
    for (int i = 0; i < 12; ++i) {
        const DifferenceResult result = difference.next(frameOf(scene, i), trueMotion(scene, i));
        EXPECT_EQ(result.difference.values.empty(), i < 6) << i << ": t, t-3 and t-6 (fig. 4.2 d)";
    }
}

TEST(DifferenceMotion, TheBackgroundNeedsThreePictures) {
    DifferenceOptions options = optionsOf(MotionMethod::median_background);
    options.background_frames = 3;
    options.background_step = 2;
    const MovingScene scene;
    DifferenceMotion difference(options, kScale);
    for (int i = 0; i < 10; ++i) {
        const DifferenceResult result = difference.next(frameOf(scene, i), trueMotion(scene, i));
        EXPECT_EQ(result.difference.values.empty(), i < 6) << i << ": t-2, t-4 and t-6";
    }
}

TEST(DifferenceMotion, AreasComeInReadingOrder) {
    for (const MotionMethod method : {MotionMethod::median_background, MotionMethod::three_frame_difference}) {
        const DifferenceResult result = lastOf(MovingScene{}, optionsOf(method));
        ASSERT_EQ(result.clusters.size(), 2U);
        const auto top = [](const MotionCluster& cluster) {
            const OrientedBox upright = cluster.box.upright();
            return upright.centre.y - upright.width / 2;
        };
        EXPECT_LT(top(result.clusters[0]), top(result.clusters[1]));
    }
}

TEST(DifferenceMotion, OfAreasThatBeginInOneRowTheLeftComesFirstHoweverTheOtherGoesOn) {
    const cv::Mat plain(240, 320, CV_8UC1, cv::Scalar(100));
    cv::Mat shown = plain.clone();
    cv::rectangle(shown, {90, 40, 20, 20}, cv::Scalar(220), cv::FILLED);
    cv::rectangle(shown, {150, 40, 16, 60}, cv::Scalar(220), cv::FILLED);
    // From there back to the left, below the first; its last pixels lie farthest left.
    cv::rectangle(shown, {40, 84, 126, 16}, cv::Scalar(220), cv::FILLED);
    cv::rectangle(shown, {40, 84, 16, 40}, cv::Scalar(220), cv::FILLED);
    DifferenceMotion difference(optionsOf(MotionMethod::two_frame_difference), kScale);
    MovingScene standing;
    standing.camera_per_frame = {0, 0};
    standing.vehicles.clear();
    DifferenceResult result;
    for (int i = 0; i < 6; ++i) {
        Frame frame;
        frame.index = i;
        frame.gray = i < 5 ? plain : shown;
        result = difference.next(frame, trueMotion(standing, i));
    }
    ASSERT_EQ(result.clusters.size(), 2U);
    EXPECT_NEAR(result.clusters[0].box.centre.x, 100, 1);
    EXPECT_GT(result.clusters[1].box.area(), 3000);
}

TEST(DifferenceMotion, ShowsWhatItSaw) {
    const MovingScene scene;
    const DifferenceResult result = lastOf(scene, optionsOf(MotionMethod::two_frame_difference));
    const cv::Mat gray = scene.draw(scene.frames - 1);
    const cv::Mat view = differenceView(gray, result.difference);
    EXPECT_EQ(view.size(), gray.size());
    // The camera moves right and down, so older pictures lack what lies there.
    EXPECT_EQ(view.at<cv::Vec3b>(scene.size.height - 1, scene.size.width - 1)[2], 255);
    const uchar grey = gray.at<uchar>(scene.size.height - 1, scene.size.width - 1);
    EXPECT_EQ(view.at<cv::Vec3b>(scene.size.height - 1, scene.size.width - 1)[0], grey / 2);
    EXPECT_EQ(view.at<cv::Vec3b>(scene.size.height - 1, scene.size.width - 1)[1], grey / 2);
    const cv::Vec3b inside = view.at<cv::Vec3b>(100, 20);
    const int seen = gray.at<uchar>(100, 20);
    EXPECT_EQ(inside[0], seen);
    EXPECT_EQ(inside[1], seen);
    EXPECT_NEAR(inside[2], std::min(255.F, static_cast<float>(seen) + 3 * result.difference.values.at<float>(100, 20)),
                0.51);
    EXPECT_EQ(differenceView(gray, {}).size(), gray.size());
}

TEST(DifferenceMotion, RefusesWhatItCannotUse) {
    EXPECT_THROW(DifferenceMotion(DifferenceOptions{}, kScale), Error);
    DifferenceMotion difference(optionsOf(MotionMethod::two_frame_difference), kScale);
    EXPECT_THROW(difference.next(Frame{}, FrameMotion{}), Error);
}

}  // namespace eyrie::difference_motion_test

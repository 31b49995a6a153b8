#include "stacking/image_stacker.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/geometry/angle.h"
#include "imaging/upright_patch.h"

namespace eyrie::image_stacker_test {
namespace {

SceneScale scale() {
    SceneScale s;
    s.gsd_m_per_px = 0.345;
    s.gsd_known = true;
    return s;
}

/// A bright, turning vehicle over striped ground, with exact motion vectors.
struct World {
    cv::Size size{640, 480};
    double turn_per_frame = 0;

    double headingAt(int t) const { return 0.3 + turn_per_frame * t; }
    cv::Point2d centreAt(int t) const { return cv::Point2d(120, 150) + cv::Point2d(1.6, 0.5) * t; }
    OrientedBox boxAt(int t) const { return {centreAt(t), 18, 9, headingAt(t)}; }

    Frame frameAt(int t) const {
        Frame frame;
        frame.index = t;
        frame.gray = cv::Mat(size, CV_8UC1);
        for (int y = 0; y < size.height; ++y) {
            for (int x = 0; x < size.width; ++x) frame.gray.at<std::uint8_t>(y, x) = (x / 7 + y / 5) % 2 ? 130 : 70;
        }
        std::vector<cv::Point> corners;
        for (const auto& c : boxAt(t).corners()) corners.emplace_back(cvRound(c.x * 16), cvRound(c.y * 16));
        cv::fillConvexPoly(frame.gray, corners, cv::Scalar(240), cv::LINE_AA, 4);
        return frame;
    }
    FrameMotion motionAt(int t, int first_id = 1) const {
        FrameMotion motion;
        motion.frame = t;
        motion.image_size = size;
        motion.registration.state = t ? RegistrationState::registered : RegistrationState::first;
        for (int i = 0; i < 12; ++i) {
            MotionVector vector;
            vector.id = first_id + i;
            const cv::Point2d p = boxAt(t).toImage({(i % 4 - 1.5) * 4, (i / 4 - 1.0) * 3});
            vector.position = {float(p.x), float(p.y)};
            vector.velocity = {float(1.6 * std::cos(headingAt(t))), float(1.6 * std::sin(headingAt(t)))};
            vector.age = 10;
            motion.motion_vectors.push_back(vector);
        }
        return motion;
    }
    std::vector<MotionCluster> clustersAt(int t) const {
        MotionCluster cluster;
        cluster.box = boxAt(t);
        cluster.velocity = {1.6 * std::cos(headingAt(t)), 1.6 * std::sin(headingAt(t))};
        for (int i = 0; i < 12; ++i) cluster.members.push_back(i);
        return {cluster};
    }
    std::vector<Detection> detectionsAt(int t) const {
        Detection detection;
        detection.box = boxAt(t);
        for (int i = 0; i < 12; ++i) detection.vectors.push_back(i);
        return {detection};
    }
};

/// Frames 0 to 7 of the world.
void fill(ImageStacker& stacker, const World& world) {
    for (int t = 0; t < 8; ++t) {
        stacker.update(world.frameAt(t), world.motionAt(t), world.clustersAt(t));
        stacker.remember(world.motionAt(t), world.detectionsAt(t));
    }
}

}  // namespace

TEST(MasterVector, staysAtItsPlaceOnATurningObjectWhateverVectorsRemain) {
    World world;
    world.turn_per_frame = 0.02;
    FrameMotion motion = world.motionAt(0);
    MasterVector master(1, {world.centreAt(0), world.headingAt(0), {}});
    for (const auto& vector : motion.motion_vectors) master.relate(vector, world.headingAt(0));
    for (int t = 1; t < 60; ++t) {
        motion = world.motionAt(t);
        std::vector<MasterVector::Suggestion> present;
        for (const auto& vector : motion.motion_vectors) {
            if (vector.id > 3 + t / 10) present.push_back({&vector, world.headingAt(t)});
        }
        ASSERT_TRUE(master.update(present));
        EXPECT_NEAR(cv::norm(master.pose().position - world.centreAt(t)), 0, 1e-3);
        EXPECT_NEAR(turnBetween(master.pose().heading, world.headingAt(t)), 0, 1e-6);
    }
    EXPECT_FALSE(master.update({})) << "a master vector dies with its last related vector";
}

TEST(MasterVector, aFewWrongVectorsDoNotMoveIt) {
    const World world;
    FrameMotion motion = world.motionAt(0);
    MasterVector master(1, {world.centreAt(0), world.headingAt(0), {}});
    for (const auto& vector : motion.motion_vectors) master.relate(vector, world.headingAt(0));
    motion = world.motionAt(1);
    for (int i = 0; i < 4; ++i) motion.motion_vectors[std::size_t(i)].position += cv::Point2f(15, -8);
    std::vector<MasterVector::Suggestion> present;
    for (const auto& vector : motion.motion_vectors) present.push_back({&vector, world.headingAt(1)});
    master.update(present);
    EXPECT_NEAR(cv::norm(master.pose().position - world.centreAt(1)), 0, 1e-3);
}

TEST(MasterVector, keepsItsTurnAgainstItsVectors) {
    MotionVector vector;
    vector.id = 4;
    vector.position = {100, 50};
    MasterVector master(1, {{104, 50}, 0.3, {}});
    master.relate(vector, 0.5);
    vector.position = {110, 53};
    vector.velocity = {1.5F, -0.25F};
    ASSERT_TRUE(master.update({{&vector, 0.9}}));
    EXPECT_NEAR(master.pose().heading, 0.7, 1e-9);
    EXPECT_NEAR(master.pose().position.x, 110 + 4 * std::cos(0.4), 1e-9) << "turned with the vector's direction";
    EXPECT_NEAR(master.pose().position.y, 53 + 4 * std::sin(0.4), 1e-9);
    EXPECT_EQ(master.pose().velocity, cv::Point2d(1.5, -0.25));
}

TEST(MasterVector, followsTheMedianOfWhatItsOwnVectorsSuggest) {
    std::vector<MotionVector> vectors(5);
    MasterVector master(1, {{100, 50}, 0, {}});
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        vectors[i].id = static_cast<CornerId>(10 - i);
        vectors[i].position = {100, 50};
        if (i < 4) master.relate(vectors[i], 0);
    }
    EXPECT_EQ(master.related(), (std::vector<CornerId>{7, 8, 9, 10})) << "ascending";
    const cv::Point2f moved[] = {{101, 58}, {103, 52}, {107, 50.5F}, {99, 53}, {500, 500}};
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        vectors[i].position = moved[i];
        vectors[i].velocity = moved[i] - cv::Point2f(100, 50);
    }
    std::vector<MasterVector::Suggestion> present;
    for (const MotionVector& vector : vectors) present.push_back({&vector, 0});
    ASSERT_TRUE(master.update(present));
    EXPECT_EQ(master.pose().position, cv::Point2d(101, 52)) << "the lower of the two middle values, x and y alone";
    EXPECT_EQ(master.pose().velocity, cv::Point2d(1, 2));
    EXPECT_EQ(master.related(), (std::vector<CornerId>{7, 8, 9, 10}));
    master.relate(vectors[0], 0);  // anew, from where it is
    EXPECT_EQ(master.related().size(), 4U);
    ASSERT_TRUE(master.update({{&vectors[0], 0}}));
    EXPECT_EQ(master.pose().position, cv::Point2d(101, 52));
    EXPECT_EQ(master.related(), (std::vector<CornerId>{10})) << "the others were not seen";
    EXPECT_FALSE(master.update({{&vectors[4], 0}})) << "a stranger suggests nothing";
}

TEST(MasterVector, mediansOfHeadingsGoRoundTheCircle) {
    EXPECT_EQ(lowerMedian({3, 1, 2, 4}), 2);
    EXPECT_EQ(lowerMedian({5, 1, 9}), 5);
    EXPECT_EQ(lowerMedian({7}), 7);
    for (double base = -3.2; base < 3.2; base += 0.4) {
        const double median = medianHeading({base - 0.3, base + 0.02, base + 0.1});
        EXPECT_NEAR(turnBetween(base + 0.02, median), 0, 1e-9) << base;
        EXPECT_LE(std::abs(median), kPi);
        EXPECT_NEAR(turnBetween(base, medianHeading({base + 0.1, base, base - 1.5})), 0, 1e-9) << base;
    }
}

TEST(ImageStacker, keepsTheObjectSharpAndBlursTheGround) {
    for (const auto initialisation : {StackInitialisation::detections, StackInitialisation::k_means}) {
        const World world;
        StackingOptions options = StackingOptions::thesis();
        options.initialisation = initialisation;
        ImageStacker stacker(options, scale());
        for (int t = 0; t < 60; ++t) {
            stacker.update(world.frameAt(t), world.motionAt(t), world.clustersAt(t));
            const auto rois =
                stacker.replace(world.clustersAt(t)[0], 0, world.boxAt(t).scaled(2, 1.25), world.motionAt(t));
            EXPECT_LE(rois.size(), 1U);
            if (t < 25) {
                EXPECT_TRUE(rois.empty()) << "the stack is too low in frame " << t;
            }
            if (t == 25 && initialisation == StackInitialisation::detections) {
                ASSERT_EQ(rois.size(), 1U) << "the first detection is of frame 0, the first layer of frame 1";
                EXPECT_EQ(rois[0].stack_layers, 25);
            }
            if (t == 59) {
                ASSERT_EQ(rois.size(), 1U);
                const cv::Mat& image = rois[0].image;
                const cv::Point centre(image.cols / 2, image.rows / 2);
                EXPECT_GT(image.at<std::uint8_t>(centre), 230);
                cv::Scalar mean, deviation;
                cv::meanStdDev(image.rowRange(0, 4), mean, deviation);
                EXPECT_LT(deviation[0], 15) << "the striped ground (30 grey values) is blurred";
                const cv::Point2d in_image =
                    rois[0].image_from_roi * cv::Vec3d((image.cols - 1) / 2.0, (image.rows - 1) / 2.0, 1);
                EXPECT_LT(cv::norm(in_image - world.centreAt(t)), 1.5);
            }
            stacker.remember(world.motionAt(t), world.detectionsAt(t));
        }
        ASSERT_EQ(stacker.views(world.frameAt(59), StackPictures::none).size(), 1U);
        EXPECT_EQ(stacker.views(world.frameAt(59), StackPictures::none)[0].height, 50);
    }
}

TEST(ImageStacker, newVectorsJoinTheStackOfTheirNeighbours) {
    const World world;
    ImageStacker stacker(StackingOptions::thesis(), scale());
    stacker.update(world.frameAt(0), world.motionAt(0), world.clustersAt(0));
    stacker.remember(world.motionAt(0), world.detectionsAt(0));
    stacker.update(world.frameAt(1), world.motionAt(1), world.clustersAt(1));
    FrameMotion motion = world.motionAt(2);
    for (std::size_t i = 6; i < 12; ++i) motion.motion_vectors[i].id += 100;  // half of the corners were lost
    stacker.update(world.frameAt(2), motion, world.clustersAt(2));
    const auto views = stacker.views(world.frameAt(2), StackPictures::none);
    ASSERT_EQ(views.size(), 1U);
    EXPECT_EQ(views[0].related.size(), 12U);
}

TEST(ImageStacker, showsAsMuchOfAStackAsIsAskedFor) {
    const World world;
    ImageStacker stacker(StackingOptions::thesis(), scale());
    for (int t = 0; t < 5; ++t) {
        stacker.update(world.frameAt(t), world.motionAt(t), world.clustersAt(t));
        stacker.remember(world.motionAt(t), world.detectionsAt(t));
    }
    const Frame frame = world.frameAt(4);
    EXPECT_TRUE(stacker.views(frame, StackPictures::none).at(0).stacked.empty());
    EXPECT_FALSE(stacker.views(frame, StackPictures::none).at(0).searched) << "25 layers are needed";
    const StackView near = stacker.views(frame, StackPictures::surroundings).at(0);
    const StackView whole = stacker.views(frame, StackPictures::whole_area).at(0);
    EXPECT_EQ(whole.stacked.size(), cv::Size(115, 345));
    EXPECT_EQ(near.stacked.size(), cv::Size(16, 33)) << "4.5 m are 13 px";
    EXPECT_EQ(near.raw.size(), near.stacked.size());
    EXPECT_EQ(whole.raw.size(), whole.stacked.size());
    const cv::Rect middle(49, 156, 16, 33);
    EXPECT_EQ(cv::norm(near.stacked, whole.stacked(middle), cv::NORM_INF), 0);
    EXPECT_LE(cv::norm(near.raw, whole.raw(middle), cv::NORM_INF), 6);
}

TEST(ImageStacker, theSurroundingsAreNoLargerThanTheArea) {
    const World world;
    StackingOptions options = StackingOptions::thesis();
    options.area_width_m = 10;
    options.area_length_m = 20;
    options.vehicle_length_m = 12;  // 35 px, of which 43 × 87 px would be shown
    ImageStacker stacker(options, scale());
    for (int t = 0; t < 3; ++t) {
        stacker.update(world.frameAt(t), world.motionAt(t), world.clustersAt(t));
        stacker.remember(world.motionAt(t), world.detectionsAt(t));
    }
    EXPECT_EQ(stacker.views(world.frameAt(2), StackPictures::surroundings).at(0).stacked.size(), cv::Size(29, 58));
}

TEST(ImageStacker, aStackedRoiHoldsTheExtendedClusterWhereItIs) {
    const World world;
    StackingOptions options = StackingOptions::thesis();
    options.min_height = 3;
    ImageStacker stacker(options, scale());
    fill(stacker, world);
    MotionCluster cluster = world.clustersAt(7)[0];
    cluster.members = {2, 7, 11};
    OrientedBox extended = cluster.box.scaled(2.3, 1.7);
    extended.centre += cv::Point2d(5, 3);
    const FrameMotion motion = world.motionAt(7);
    const auto rois = stacker.replace(cluster, 6, extended, motion);
    ASSERT_EQ(rois.size(), 1U);
    EXPECT_TRUE(stacker.views(world.frameAt(7), StackPictures::none).at(0).searched);
    const MotionRoi& roi = rois[0];
    EXPECT_EQ(roi.cluster, 6);
    EXPECT_EQ(roi.velocity, cluster.velocity);
    EXPECT_EQ(roi.box.centre, extended.centre);
    EXPECT_EQ(roi.stack_layers, 7);
    EXPECT_EQ(roi.inside.size(), roi.image.size());
    EXPECT_EQ(cv::countNonZero(roi.inside), roi.image.rows * roi.image.cols);
    ASSERT_EQ(roi.vectors.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        const auto member = static_cast<std::size_t>(cluster.members[i]);
        const cv::Point2d there = toImage(roi.image_from_roi, roi.vectors[i]);
        EXPECT_LT(cv::norm(there - cv::Point2d(motion.motion_vectors[member].position)), 1e-3);
    }
    double left = 1e9, top = 1e9, right = -1e9, bottom = -1e9;
    for (const cv::Point2d& corner : extended.corners()) {
        const cv::Point2d p = toPatch(roi.image_from_roi, corner);
        left = std::min(left, p.x);
        top = std::min(top, p.y);
        right = std::max(right, p.x);
        bottom = std::max(bottom, p.y);
    }
    // All of the extended cluster, and no pixel more than holds it.
    EXPECT_GE(left, 0);
    EXPECT_LT(left, 1);
    EXPECT_GE(top, 0);
    EXPECT_LT(top, 1);
    EXPECT_LE(right, roi.image.cols - 1);
    EXPECT_GT(right, roi.image.cols - 2);
    EXPECT_LE(bottom, roi.image.rows - 1);
    EXPECT_GT(bottom, roi.image.rows - 2);
    // The bright vehicle lies where the ROI says.
    cv::Mat bright = roi.image > 200;
    const cv::Moments m = cv::moments(bright, true);
    const cv::Point2d vehicle = toImage(roi.image_from_roi, {m.m10 / m.m00, m.m01 / m.m00});
    EXPECT_LT(cv::norm(vehicle - world.centreAt(7)), 0.7);
}

TEST(ImageStacker, aRoiSaysWhatLiesOutsideTheImage) {
    World world;
    world.size = {640, 156};  // the vehicle stands at its lower edge
    StackingOptions options = StackingOptions::thesis();
    options.min_height = 1;
    ImageStacker stacker(options, scale());
    for (int t = 0; t < 3; ++t) {
        stacker.update(world.frameAt(t), world.motionAt(t), world.clustersAt(t));
        stacker.remember(world.motionAt(t), world.detectionsAt(t));
    }
    const MotionCluster cluster = world.clustersAt(2)[0];
    const auto rois = stacker.replace(cluster, 0, cluster.box.scaled(2, 2), world.motionAt(2));
    ASSERT_EQ(rois.size(), 1U);
    for (int y = 0; y < rois[0].inside.rows; ++y) {
        for (int x = 0; x < rois[0].inside.cols; ++x) {
            const double row = toImage(rois[0].image_from_roi, cv::Point2d(x, y)).y;
            if (std::abs(row - 155.5) < 0.1) continue;
            ASSERT_EQ(rois[0].inside.at<std::uint8_t>(y, x), row < 155.5 ? 255 : 0) << x << " " << y;
        }
    }
}

TEST(ImageStacker, refusesAStackThatMovesOtherwise) {
    const World world;
    StackingOptions options = StackingOptions::thesis();
    options.min_height = 3;
    ImageStacker stacker(options, scale());
    fill(stacker, world);
    MotionCluster cluster = world.clustersAt(7)[0];
    const OrientedBox extended = cluster.box.scaled(2, 1.25);
    EXPECT_EQ(stacker.replace(cluster, 0, extended, world.motionAt(7)).size(), 1U);
    const auto replaced = [&](const MotionCluster& changed) {
        return stacker.replace(changed, 0, extended, world.motionAt(7)).size() == 1;
    };
    // A quarter of the cluster's speed: 1.6 / 1.26 … 1.6 / 0.76 against a stack of 1.6 px/frame.
    for (const auto& [factor, fits] :
         {std::pair(1.3, true), {1.35, false}, {0.81, true}, {0.79, false}, {2.0, false}}) {
        MotionCluster other = cluster;
        other.velocity *= factor;
        EXPECT_EQ(replaced(other), fits) << factor;
        other = cluster;
        other.velocity = cv::Point2d(-cluster.velocity.y, cluster.velocity.x) * factor;
        EXPECT_EQ(replaced(other), fits) << factor << ": the turn goes by the box";
    }
    for (const double turn : {-19.0, 19.0, -21.0, 21.0}) {
        MotionCluster turned = cluster;
        turned.box.heading += radiansFromDegrees(turn);
        EXPECT_EQ(replaced(turned), std::abs(turn) < 20) << turn;
    }
    MotionCluster elsewhere = cluster;
    elsewhere.box.centre += cv::Point2d(0, 40);
    EXPECT_TRUE(stacker.replace(elsewhere, 0, extended, world.motionAt(7)).empty());
    EXPECT_TRUE(stacker.replace(cluster, 0, cluster.box.scaled(40, 2), world.motionAt(7)).empty())
        << "not fully inside";
}

TEST(ImageStacker, refusesAsMuchAsItsParametersSay) {
    const World world;
    const OrientedBox extended = world.boxAt(7).scaled(2, 1.25);
    const auto replaced = [&](const char* name, const char* value, const MotionCluster& cluster) {
        StackingOptions options = StackingOptions::thesis();
        options.min_height = 3;
        setParameter(describeOf(options), name, value);
        ImageStacker stacker(options, scale());
        fill(stacker, world);
        return stacker.replace(cluster, 0, extended, world.motionAt(7)).size() == 1;
    };
    MotionCluster faster = world.clustersAt(7)[0];
    faster.velocity *= 1.6;  // the stack's speed differs by 0.6 of 1.6
    EXPECT_FALSE(replaced("stacking.max_speed_difference", "0.25", faster));
    EXPECT_FALSE(replaced("stacking.max_speed_difference", "0.37", faster));
    EXPECT_TRUE(replaced("stacking.max_speed_difference", "0.38", faster));
    MotionCluster turned = world.clustersAt(7)[0];
    turned.box.heading += radiansFromDegrees(30);
    EXPECT_FALSE(replaced("stacking.max_turn", "20", turned));
    EXPECT_FALSE(replaced("stacking.max_turn", "29", turned));
    EXPECT_TRUE(replaced("stacking.max_turn", "31", turned));
}

}  // namespace eyrie::image_stacker_test

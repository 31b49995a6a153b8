// Clusters of difference images against slow ones that follow the words of their descriptions.
#include <gtest/gtest.h>

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>
#include <set>

#include "core/geometry/oriented_box.h"
#include "motion/differences/difference_motion.h"
#include "motion/driven_ground.h"

namespace eyrie::slow_differences_test {
namespace {

using test::DrivenGround;

cv::Mat blurred(const cv::Mat& gray, double blur) {
    cv::Mat real;
    gray.convertTo(real, CV_32F);
    if (blur > 0) cv::GaussianBlur(real, real, {}, blur);
    return real;
}

WarpedFrame laidOver(const DrivenGround& scene, const std::vector<cv::Mat>& pictures, int back) {
    const int now = int(pictures.size()) - 1;
    WarpedFrame result;
    cv::warpPerspective(pictures[std::size_t(now - back)], result.gray, scene.path(now - back, now), scene.size,
                        cv::INTER_LINEAR, cv::BORDER_REPLICATE);
    cv::warpPerspective(cv::Mat(scene.size, CV_8UC1, cv::Scalar(255)), result.inside, scene.path(now - back, now),
                        scene.size, cv::INTER_NEAREST);
    return result;
}

/// |a − b| where both show something, two pixels from the edge of it on.
DifferenceImage slowDifference(const cv::Mat& now, const WarpedFrame& before, double blur) {
    DifferenceImage result;
    cv::Mat wide;
    cv::copyMakeBorder(before.inside, wide, 2, 2, 2, 2, cv::BORDER_CONSTANT, cv::Scalar(0));
    result.overlap = cv::Mat::zeros(now.size(), CV_8UC1);
    result.values = cv::Mat::zeros(now.size(), CV_32FC1);
    const cv::Mat a = blurred(now, blur), b = blurred(before.gray, blur);
    for (int y = 0; y < now.rows; ++y) {
        for (int x = 0; x < now.cols; ++x) {
            if (cv::countNonZero(wide(cv::Rect(x, y, 5, 5))) < 25) continue;
            result.overlap.at<uchar>(y, x) = 255;
            result.values.at<float>(y, x) = std::abs(a.at<float>(y, x) - b.at<float>(y, x));
        }
    }
    return result;
}

struct SlowDifferences {
    const DifferenceOptions& options;
    const SceneScale& scale;
    const DrivenGround& scene;
    const std::vector<cv::Mat>& pictures;

    DifferenceImage difference() const {
        const cv::Mat& now = pictures.back();
        const WarpedFrame before = laidOver(scene, pictures, options.gap);
        if (options.method == MotionMethod::three_frame_difference) {
            DifferenceImage first = slowDifference(now, before, options.blur);
            const DifferenceImage second =
                slowDifference(before.gray, laidOver(scene, pictures, 2 * options.gap), options.blur);
            first.values = cv::min(first.values, second.values);
            first.overlap &= second.overlap;
            return first;
        }
        if (options.method != MotionMethod::median_background) return slowDifference(now, before, options.blur);
        std::vector<WarpedFrame> past;
        for (int i = 1; i <= options.background_frames && i * options.background_step < int(pictures.size()); ++i)
            past.push_back(laidOver(scene, pictures, i * options.background_step));
        const Background background = medianBackground(past);
        DifferenceImage result = slowDifference(now, {background.gray, background.known}, options.blur);
        cv::Mat dx, dy, slope;
        cv::Sobel(background.gray, dx, CV_32F, 1, 0);
        cv::Sobel(background.gray, dy, CV_32F, 0, 1);
        cv::magnitude(dx, dy, slope);
        for (int y = 0; y < now.rows; ++y) {
            for (int x = 0; x < now.cols; ++x) {
                float& value = result.values.at<float>(y, x);
                value = std::max(0.0F, value - float(options.gradient_suppression) * slope.at<float>(y, x) / 8);
                if (result.overlap.at<uchar>(y, x) == 0) value = 0;
            }
        }
        return result;
    }
    static double noise(const DifferenceImage& difference) {
        std::vector<float> values;
        for (int y = 0; y < difference.values.rows; ++y) {
            for (int x = 0; x < difference.values.cols; ++x) {
                if (difference.overlap.at<uchar>(y, x) != 0) values.push_back(difference.values.at<float>(y, x));
            }
        }
        std::sort(values.begin(), values.end());
        return double(values[values.size() / 2]) / 0.6745;
    }
    cv::Mat morphed(const DifferenceImage& difference, double threshold) const {
        cv::Mat moving = movingPixels(difference, threshold, options.strong_limit);
        const auto disc = [&](double metres) {
            const int side = cvRound((metres / scale.gsd_m_per_px - 1) / 2) * 2 + 1;
            return cv::getStructuringElement(cv::MORPH_ELLIPSE, {std::max(1, side), std::max(1, side)});
        };
        cv::morphologyEx(moving, moving, cv::MORPH_CLOSE, disc(options.closing_m));
        cv::morphologyEx(moving, moving, cv::MORPH_OPEN, disc(options.opening_m));
        return moving & difference.overlap;
    }
    std::vector<MotionCluster> clusters(const FrameMotion& motion, const cv::Mat& moving) const {
        cv::Mat labels;
        const int count = cv::connectedComponents(moving, labels, 8, CV_32S);
        std::vector<std::vector<cv::Point>> areas(std::size_t(count) - 1);
        std::vector<int> order;
        for (int y = 0; y < labels.rows; ++y) {
            for (int x = 0; x < labels.cols; ++x) {
                const int label = labels.at<int>(y, x);
                if (label == 0) continue;
                if (areas[std::size_t(label) - 1].empty()) order.push_back(label - 1);
                areas[std::size_t(label) - 1].emplace_back(x, y);
            }
        }
        std::vector<MotionCluster> result;
        for (const int at : order) {
            const auto& area = areas[std::size_t(at)];
            const double px2 = 1 / (scale.gsd_m_per_px * scale.gsd_m_per_px);
            if (double(area.size()) < std::max(double(options.min_area_px), options.min_area_m2 * px2)) continue;
            if (options.method == MotionMethod::difference_ghosts && ghost(area)) continue;
            const MotionCluster cluster = clusterOf(area, motion);
            if (std::max(cluster.box.length, cluster.box.width) <= options.max_length_m / scale.gsd_m_per_px)
                result.push_back(cluster);
        }
        return result;
    }
    bool ghost(const std::vector<cv::Point>& area) const {
        const cv::Mat slope = backgroundGradient(pictures.back());
        cv::Mat mask = cv::Mat::zeros(scene.size, CV_8UC1);
        for (const cv::Point& p : area) mask.at<uchar>(p) = 255;
        cv::Scalar mean, deviation;
        cv::meanStdDev(pictures.back(), mean, deviation, mask);
        return deviation[0] < options.ghost_deviation && cv::mean(slope, mask)[0] < options.ghost_gradient;
    }
    MotionCluster clusterOf(const std::vector<cv::Point>& area, const FrameMotion& motion) const {
        const int delay = options.method == MotionMethod::three_frame_difference ? options.gap : 0;
        MotionCluster cluster;
        std::vector<double> vx, vy;
        for (std::size_t i = 0; i < motion.motion_vectors.size(); ++i) {
            const MotionVector& vector = motion.motion_vectors[i];
            const cv::Point2f then = vector.position - vector.velocity * float(delay);
            if (std::none_of(area.begin(), area.end(), [&](const cv::Point& p) {
                    return std::abs(float(p.x) - then.x) <= 1.5F && std::abs(float(p.y) - then.y) <= 1.5F;
                }))
                continue;
            cluster.members.push_back(int(i));
            vx.push_back(double(vector.velocity.x));
            vy.push_back(double(vector.velocity.y));
        }
        std::vector<cv::Point2f> points(area.begin(), area.end());
        double heading = 0;
        if (vx.empty()) {
            const cv::Moments m = cv::moments(area.size() > 0 ? imageOf(area) : cv::Mat(), true);
            heading = 0.5 * std::atan2(2 * m.mu11, m.mu20 - m.mu02);
        } else {
            std::sort(vx.begin(), vx.end());
            std::sort(vy.begin(), vy.end());
            cluster.velocity = {vx[(vx.size() - 1) / 2], vy[(vy.size() - 1) / 2]};
            heading = std::atan2(cluster.velocity.y, cluster.velocity.x);
            for (cv::Point2f& point : points) point += cv::Point2f(cluster.velocity * delay);
        }
        cluster.box = boxAround(points, heading);
        cluster.box.length += 1;
        cluster.box.width += 1;
        for (std::size_t i = 0; i < points.size(); i += std::max<std::size_t>(1, points.size() / 400))
            cluster.moving_points.push_back(points[i]);
        return cluster;
    }
    cv::Mat imageOf(const std::vector<cv::Point>& area) const {
        cv::Mat image = cv::Mat::zeros(scene.size, CV_8UC1);
        for (const cv::Point& p : area) image.at<uchar>(p) = 255;
        return image;
    }
};

}  // namespace

TEST(SlowDifferences, ClustersAreAreasOfWhatDiffers) {
    DrivenGround scene;
    scene.size = {160, 130};
    scene.ground_contrast = 0.3;
    scene.vehicles = {{{60, 50}, {1.6, 0.3}, {26, 16}, 190},
                      {{100, 85}, {-1.2, -0.9}, {12, 9}, 60, 1.2},
                      {{40, 95}, {0.9, 0}, {18, 8}, 215, 0.1},
                      {{105, 35}, {0.2, 1.4}, {7, 14}, 30, 0.5}};
    std::vector<cv::Mat> pictures;
    constexpr int kFrames = 18;
    for (int i = 0; i < kFrames; ++i) pictures.push_back(scene.draw(i));
    std::size_t clusters = 0, members = 0;
    std::set<std::size_t> counts;
    for (const MotionMethod method : {MotionMethod::two_frame_difference, MotionMethod::three_frame_difference,
                                      MotionMethod::median_background, MotionMethod::difference_ghosts}) {
        for (int k = 0; k < 8; ++k) {
            DifferenceOptions options;
            options.method = method;
            options.gap = k == 1 ? 4 : 6;
            options.background_frames = k == 2 ? 4 : 7;
            options.background_step = k == 3 ? 3 : 2;
            options.blur = k == 4 ? 0 : 1;
            options.noise_factor = k == 5 ? 3 : 5;
            options.min_area_m2 = k == 6 ? 3.5 : 1;
            options.min_area_px = k == 7 ? 90 : 12;
            options.max_length_m = k == 2 ? 5 : 40;
            options.opening_m = k == 1 ? 0.2 : 0.7;
            options.closing_m = k == 6 ? 0.3 : 1.5;
            options.ghost_deviation = k == 5 ? 20 : 7;
            options.ghost_gradient = k == 4 ? 3 : 9;
            const SceneScale scale{k % 2 == 0 ? 0.25 : 0.15, 25, true};
            FrameMotion motion;
            motion.image_size = scene.size;
            std::mt19937 random(unsigned(k) + 3);
            const cv::Matx33d now = scene.pictureFromGround(kFrames - 1);
            for (const auto& vehicle : scene.vehicles) {
                for (int i = 0; i < k; ++i) {
                    const cv::Point2d on = vehicle.start + vehicle.velocity * (kFrames - 1) +
                                           cv::Point2d(double(random() % 40) - 20, double(random() % 24) - 12) * 0.6;
                    const cv::Vec3d p = now * cv::Vec3d(on.x, on.y, 1);
                    motion.motion_vectors.push_back({CornerId(motion.motion_vectors.size()),
                                                     cv::Point2d(p[0] / p[2], p[1] / p[2]),
                                                     vehicle.velocity + cv::Point2d(0.01 * i, -0.02 * i), 9});
                }
            }
            DifferenceMotion difference(options, scale);
            for (int i = 0; i + 1 < kFrames; ++i) {
                FrameMotion before;
                before.registration = scene.registration(i);
                difference.remember(test::frameOf(i, pictures[std::size_t(i)]), before);
            }
            motion.registration = scene.registration(kFrames - 1);
            const DifferenceResult found = difference.next(test::frameOf(kFrames - 1, pictures.back()), motion);
            const SlowDifferences slow{options, scale, scene, pictures};
            const DifferenceImage expected = slow.difference();
            ASSERT_EQ(cv::norm(found.difference.overlap, expected.overlap, cv::NORM_INF), 0);
            // Ways that were multiplied step by step round otherwise.
            ASSERT_LT(cv::norm(found.difference.values, expected.values, cv::NORM_INF), 1.3) << nameOf(method) << k;
            ASSERT_LT(cv::norm(found.difference.values, expected.values, cv::NORM_L1) / double(expected.values.total()),
                      0.02);
            EXPECT_NEAR(found.noise, SlowDifferences::noise(found.difference), 1e-5);
            EXPECT_NEAR(found.threshold, std::max(options.min_contrast, options.noise_factor * found.noise), 1e-9);
            const auto slow_clusters = slow.clusters(motion, slow.morphed(found.difference, found.threshold));
            ASSERT_EQ(found.clusters.size(), slow_clusters.size()) << nameOf(method) << k;
            clusters += found.clusters.size();
            counts.insert(found.clusters.size());
            for (std::size_t i = 0; i < slow_clusters.size(); ++i) {
                const MotionCluster& a = found.clusters[i];
                const MotionCluster& b = slow_clusters[i];
                EXPECT_EQ(a.members, b.members);
                members += a.members.size();
                EXPECT_LT(cv::norm(a.velocity - b.velocity), 1e-6);
                EXPECT_LT(cv::norm(a.box.centre - b.box.centre), 1e-3);
                EXPECT_NEAR(a.box.length, b.box.length, 1e-3);
                EXPECT_NEAR(a.box.width, b.box.width, 1e-3);
                EXPECT_NEAR(std::remainder(a.box.heading - b.box.heading, CV_PI), 0, 1e-6);
                ASSERT_EQ(a.moving_points.size(), b.moving_points.size());
                for (std::size_t p = 0; p < a.moving_points.size(); ++p)
                    EXPECT_LT(cv::norm(a.moving_points[p] - b.moving_points[p]), 1e-3);
            }
            // What is shown as moving are the areas of the clusters.
            double shown = 0;
            cv::Mat labels;
            const int areas = cv::connectedComponents(found.moving, labels, 8, CV_32S) - 1;
            EXPECT_EQ(areas, int(found.clusters.size()));
            for (const MotionCluster& cluster : found.clusters) shown += double(cluster.moving_points.size());
            EXPECT_GE(cv::countNonZero(found.moving), shown - 1e-9);
        }
    }
    EXPECT_GT(clusters, 60U);
    EXPECT_GT(members, 100U);
    EXPECT_GT(counts.size(), 3U);
}

}  // namespace eyrie::slow_differences_test

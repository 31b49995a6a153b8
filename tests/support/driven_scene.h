#pragma once

#include <opencv2/imgproc.hpp>
#include <vector>

#include "core/values/frame.h"
#include "core/values/motion_roi.h"
#include "core/values/motion_vector.h"
#include "detection/roi_cutter.h"

namespace eyrie::test {

/// A vehicle on a noisy road, and the cluster of its motion vectors.
struct DrivenScene {
    Frame frame;
    FrameMotion motion;
    MotionCluster cluster;
    OrientedBox vehicle;
};

inline DrivenScene drivenScene(double heading, cv::Point2d centre = {160, 120}, std::uint64_t seed = 1) {
    DrivenScene scene;
    scene.vehicle = {centre, 40, 16, heading};
    constexpr int kFine = 4;  // drawn at four times the size and averaged, so that edges are not jagged
    cv::Mat fine(240 * kFine, 320 * kFine, CV_8UC1, cv::Scalar(90));
    const auto fill = [&](const OrientedBox& box, int grey) {
        std::vector<cv::Point> polygon;
        for (const cv::Point2d& corner : box.corners())
            polygon.emplace_back(cvRound((corner.x + 0.5) * kFine - 0.5), cvRound((corner.y + 0.5) * kFine - 0.5));
        cv::fillConvexPoly(fine, polygon, cv::Scalar(grey));
    };
    fill(scene.vehicle, 180);
    const auto part = [&](double along, double length) {
        return OrientedBox{scene.vehicle.toImage({along, 0}), length, 12, heading};
    };
    fill(part(8, 6), 40);  // windscreen and rear window
    fill(part(-14, 4), 50);
    cv::Mat gray;
    cv::resize(fine, gray, {320, 240}, 0, 0, cv::INTER_AREA);
    cv::Mat noise(gray.size(), CV_16SC1);
    cv::RNG random(seed);
    random.fill(noise, cv::RNG::NORMAL, 0, 2);
    cv::Mat noisy;
    gray.convertTo(noisy, CV_16S);
    noisy += noise;
    noisy.convertTo(scene.frame.gray, CV_8U);

    const cv::Point2d velocity = scene.vehicle.direction() * 1.5;
    for (const double along : {-19.0, -14.0, -7.0, 0.0, 5.0, 11.0, 19.0}) {
        for (const double across : {-7.0, -3.0, 4.0, 7.0}) {
            scene.motion.motion_vectors.push_back({static_cast<CornerId>(scene.motion.motion_vectors.size()),
                                                   scene.vehicle.toImage({along, across}), velocity, 10});
            scene.cluster.members.push_back(static_cast<int>(scene.cluster.members.size()));
        }
    }
    scene.motion.image_size = gray.size();
    scene.motion.corner_count = 3000;
    std::vector<cv::Point2f> positions;
    for (const MotionVector& v : scene.motion.motion_vectors) positions.push_back(v.position);
    scene.cluster.box = boxAround(positions, heading);
    scene.cluster.velocity = velocity;
    return scene;
}

inline const SceneScale kContractScale{0.11, 25, true};

inline MotionRoi roiOf(const DrivenScene& scene, int cluster_index = 3) {
    return cutMotionRoi(scene.frame, scene.cluster, cluster_index, scene.motion, {}, kContractScale);
}

}  // namespace eyrie::test

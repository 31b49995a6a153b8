#pragma once

#include "core/geometry/oriented_box.h"
#include "core/state_archive.h"
#include "core/values/motion_cluster.h"
#include "core/values/motion_vector.h"

/// How the core's values are kept in states.
namespace eyrie {

template <class Archive>
void transfer(Archive& archive, OrientedBox& box) {
    archive(box.centre, box.length, box.width, box.heading);
}

template <class Archive>
void transfer(Archive& archive, Homography& homography) {
    archive(homography.matrix, homography.from_frame, homography.to_frame, homography.inliers, homography.rms_px);
}

template <class Archive>
void transfer(Archive& archive, Registration& registration) {
    archive.word(registration.state, RegistrationState::failed);
    archive(registration.current_from_previous);
    archive.word(registration.failure.fault, RegistrationFault::impossible_motion);
    archive.word(registration.failure.picture, PictureQuality::blank);
    archive(registration.failure.count, registration.failure.of, registration.elapsed, registration.zoom);
}

template <class Archive>
void transfer(Archive& archive, MotionVector& vector) {
    archive(vector.id, vector.position, vector.velocity, vector.age);
}

template <class Archive>
void transfer(Archive& archive, FrameMotion& motion) {
    archive(motion.frame, motion.time_us, motion.image_size, motion.registration, motion.motion_vectors,
            motion.stationary_corners, motion.corner_count, motion.background_speed_sigma);
}

template <class Archive>
void transfer(Archive& archive, MotionCluster& cluster) {
    archive(cluster.box, cluster.velocity, cluster.members, cluster.moving_points);
}

}  // namespace eyrie

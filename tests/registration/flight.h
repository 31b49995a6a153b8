#pragma once

#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "registration/registrar.h"
#include "support/textured_ground.h"

namespace eyrie::test {

inline const cv::Size kSize(320, 240);

inline SceneScale scaleOf(double gsd) {
    SceneScale scale;
    scale.gsd_m_per_px = gsd;
    return scale;
}

/// A camera over textured ground, with what it did.
class Flight {
 public:
    explicit Flight(cv::Size size = kSize, double noise = 2) : size_(size), noise_(noise) {}

    /// Moves the camera; the picture moves by `next_from_present`.
    void move(const cv::Matx33d& next_from_present) { picture_from_ground_ = next_from_present * picture_from_ground_; }
    cv::Matx33d pictureFromGround() const { return picture_from_ground_; }
    cv::Mat picture() { return ground_.picture(size_, picture_from_ground_.inv(), noise_, ++exposures_); }

 private:
    cv::Size size_;
    double noise_;
    TexturedGround ground_{41, 1.5};
    cv::Matx33d picture_from_ground_ = cv::Matx33d::eye();
    unsigned exposures_ = 0;
};

/// Hands pictures to a registrar and remembers the truth of the last one.
class Watch {
 public:
    explicit Watch(const RegistrationOptions& options = {}, double gsd = 0.3) : registrar(options, scaleOf(gsd)) {}

    RegisteredFrame see(Flight& flight) {
        truth = flight.pictureFromGround() * before_.inv();
        before_ = flight.pictureFromGround();
        return seePicture(flight.picture());
    }
    RegisteredFrame seePicture(const cv::Mat& gray) { return registrar.next(frameOf(frame_++, gray)); }
    double error(const RegisteredFrame& result, cv::Size size = kSize) const {
        return gridError(result.registration.current_from_previous.matrix, truth, size);
    }

    Registrar registrar;
    cv::Matx33d truth = cv::Matx33d::eye();

 private:
    cv::Matx33d before_ = cv::Matx33d::eye();
    int frame_ = 0;
};

/// How the camera usually moves from frame to frame.
inline cv::Matx33d drift() {
    return cameraMotion(kSize, 1.7, -0.9, 0.15, 1.001);
}

/// How the picture moves in a sharp turn near the ground: its edges by a tenth to a sixth of its width, all
/// differently.
inline cv::Matx33d sharpTurn(cv::Size size) {
    const auto w = float(size.width - 1);
    const auto h = float(size.height - 1);
    const cv::Point2f from[4] = {{0, 0}, {w, 0}, {w, h}, {0, h}};
    const cv::Point2f to[4] = {
        {-0.175F * w, 0.055F * h}, {0.84F * w, -0.017F * h}, {0.85F * w, 0.87F * h}, {-0.12F * w, 1.117F * h}};
    return {cv::getPerspectiveTransform(from, to)};
}

inline void expectWellFormed(const RegisteredFrame& result, cv::Size size) {
    for (std::size_t i = 0; i < result.corners.size(); ++i) {
        const Corner& corner = result.corners[i];
        if (i > 0) {
            EXPECT_LT(result.corners[i - 1].id, corner.id);
        }
        EXPECT_TRUE(corner.current.x >= 0 && corner.current.y >= 0 && corner.current.x < float(size.width) &&
                    corner.current.y < float(size.height));
        if (corner.age == 0) {
            EXPECT_EQ(corner.previous, corner.current);
        }
    }
}

}  // namespace eyrie::test
